"""./course play: the local server, how it is kept alive and ended, and the page in a browser."""

import http.client
import json
import os
import time
import unittest
from pathlib import Path
from unittest import mock
from urllib.parse import urlsplit

from browser import Browser
from sandbox import Sandbox, all_exercises

from errors import BadInput
from needs import VIEW_NEEDS
from playing.hub import Hub, Listener
from playing.server import Server

HEADER = json.dumps({"format": "spook recording", "version": 1})
FRAME = json.dumps({"time": 1, "energy": {}})


box: Sandbox  # shared: where no build tree can be laid over, it takes minutes to build


def setUpModule():
    global box
    if not all(need.there() for need in VIEW_NEEDS):
        raise unittest.SkipTest("libjs-three is not installed")
    box = Sandbox(built=True)
    unittest.addModuleCleanup(box.close)
    box.course("run", "free_fall")


class Page:
    """Sends a server good and bad requests."""

    def __init__(self, address: str):
        parts = urlsplit(address)
        self.host, self.path = parts.netloc, parts.path

    def ask(self, method: str, path: str, body: str | None = None, **headers: str) -> int:
        connection = http.client.HTTPConnection(self.host, timeout=10)
        connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        status = connection.getresponse().status
        connection.close()
        return status

    def listen(self):
        connection = http.client.HTTPConnection(self.host, timeout=60)
        connection.request("GET", f"{self.path}frames")
        return connection.getresponse()


def data(response) -> dict:
    """Returns the next line of the engine."""
    while not (line := response.readline()).startswith(b"data: "):
        if not line:
            raise AssertionError("the stream has ended")
    return json.loads(line[6:])


class LocalServer(unittest.TestCase):
    def setUp(self):
        self.hub, self.commands = Hub(), []
        self.server = Server(None, lambda: "<p>the page</p>", self.hub, self.commands.append)
        self.addCleanup(self.server.close)
        self.page = Page(self.server.address)

    def test_only_who_has_the_address_gets_anything(self):
        path, token = self.page.path, self.server.token
        self.assertGreaterEqual(len(token), 32)
        self.assertEqual(self.page.ask("GET", path), 200)
        for other in ("/", "/frames", f"/{token[:-1]}/", f"/{token}x/", f"/{token}", f"{path}other", f"{path}../"):
            self.assertEqual(self.page.ask("GET", other), 404, other)
        self.assertEqual(self.page.ask("POST", "/command", "{}"), 404)

    def test_another_name_or_another_site_is_refused(self):
        path = self.page.path
        for headers in ({"Host": "example.org"}, {"Host": "127.0.0.1"}, {"Origin": "http://example.org"},
                        {"Origin": "null"}):
            self.assertEqual(self.page.ask("GET", path, **headers), 403, headers)
            self.assertEqual(self.page.ask("POST", f"{path}command", "{}", **headers), 403, headers)
        self.assertEqual(self.commands, [])

    def test_a_codespace_s_own_name_is_taken_there_and_nowhere_else(self):
        path, port = self.page.path, urlsplit(self.server.address).port
        name = f"mine-{port}.app.github.dev"
        ours = ({"Host": name}, {"Host": name, "Origin": f"https://{name}"}, {"Origin": f"https://localhost:{port}"})
        for headers in ours:
            self.assertEqual(self.page.ask("GET", path, **headers), 403, headers)
        with mock.patch.dict(os.environ, {"CODESPACE_NAME": "mine",
                                          "GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN": "app.github.dev"}):
            for headers in ours:
                self.assertEqual(self.page.ask("GET", path, **headers), 200, headers)
            for headers in ({"Host": f"other-{port}.app.github.dev"}, {"Origin": "https://example.org"}):
                self.assertEqual(self.page.ask("GET", path, **headers), 403, headers)

    def test_only_this_machine_can_reach_it(self):
        self.assertEqual(self.server._server.server_address[0], "127.0.0.1")

    def test_commands_are_json_objects(self):
        path = f"{self.page.path}command"
        self.assertEqual(self.page.ask("POST", path, '{"pause": true}'), 204)
        self.assertEqual(self.commands, [{"pause": True}])
        for body in ("", "x", "[]", '"pause"', "\xff"):
            self.assertEqual(self.page.ask("POST", path, body), 400, body)
        self.assertEqual(self.page.ask("POST", path, "{" + " " * 70000 + "}"), 413)
        self.assertEqual(len(self.commands), 1)

    def test_a_page_that_comes_later_knows_what_it_has_to(self):
        for line in (HEADER, FRAME, FRAME):
            self.hub.take(line)
        self.hub.say("hello")
        stream = self.page.listen()
        self.assertEqual([sorted(data(stream)) for _ in range(4)],
                         [["clock"], ["format", "version"], ["energy", "time"], ["said"]])
        self.hub.take(FRAME)
        self.assertEqual(data(stream)["time"], 1)

    def test_it_is_known_when_the_last_page_has_gone(self):
        self.assertEqual(self.hub.alone_for(), 0)
        stream = self.page.listen()
        data(stream)
        self.assertEqual(self.hub.alone_for(), 0)
        stream.close()
        end = time.monotonic() + 20
        while not self.hub.alone_for() and time.monotonic() < end:
            self.hub.take(FRAME)
            time.sleep(0.05)
        self.assertGreater(self.hub.alone_for(), 0)

    def test_a_slow_page_misses_frames_but_nothing_else(self):
        listener = Listener()
        for k in range(100):
            listener.put(f"frame {k}", True)
        listener.put("header", False)
        lines = []
        while line := listener.get(0):
            lines.append(line)
        self.assertEqual(lines, ["frame 96", "frame 97", "frame 98", "frame 99", "header"])

    def test_a_port_that_is_taken(self):
        with self.assertRaisesRegex(BadInput, "^play: port"):
            Server(urlsplit(self.server.address).port, lambda: "", Hub(), lambda command: None)


class Played(unittest.TestCase):
    """Starts ./course play."""

    def start(self, *words: str) -> tuple:
        """Returns the process, and the address of its page."""
        running = box.start("play", *words, "--no-open").__enter__()
        self.addCleanup(running.__exit__)
        return running, running.wait_for("http://127.0.0.1:", 300).strip()


class Play(Played):
    def children(self, scene: str) -> list[str]:
        """Returns the engines that play this scene."""
        found = []
        for entry in Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if b"play" in words and scene.encode() in words and words[0].endswith((b"spook", b"spook_mine")):
                found.append(entry.name)
        return found

    def test_ctrl_c_ends_it_and_its_engine(self):
        scene = ("cradle", "--time", "7.25")
        running, address = self.start(*scene)
        self.assertEqual(len(self.children("7.25")), 1)
        stream = Page(address).listen()
        data(stream)
        code, said = running.interrupt()
        self.assertEqual((code, said.replace("building the engine ...\n", "")), (130, ""))
        self.assertEqual(self.children("7.25"), [])

    def test_leaving_the_page_ends_it(self):
        running, address = self.start("cradle", "--time", "7.5")
        stream = Page(address).listen()
        self.assertEqual(data(stream), {"clock": {"rate": 1, "pause": False}})
        self.assertTrue(data(stream)["live"])
        stream.close()
        self.assertEqual(running.end(40), 0)
        self.assertEqual(self.children("7.5"), [])

    def test_a_port_that_is_taken_is_one_line(self):
        _, address = self.start("cradle")
        result = box.course("play", "cradle", "--no-open", "--port", str(urlsplit(address).port))
        self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1), result.stderr)

    def test_commands_reach_the_engine(self):
        _, address = self.start("pendulum")
        page = Page(address)
        stream = page.listen()
        for command in ({"pause": True}, {"set": {"h": 0.002}}, {"nonsense": 1}):
            self.assertEqual(page.ask("POST", f"{page.path}command", json.dumps(command)), 204)
        lines = []
        while not lines or "refused" not in lines[-1]:
            lines.append(data(stream))
        headers = [line for line in lines if "format" in line]
        self.assertEqual(headers[-1]["method"]["h"], 0.002)
        self.assertIn("nonsense", lines[-1]["refused"])

    def test_a_save_goes_on_with_what_was_saved(self):
        kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")
        self.addCleanup(box.restore, kick)
        box.solve(kick)
        _, address = self.start("free_fall", "--mine")
        page = Page(address)
        stream = page.listen()
        self.assertEqual([data(stream).get("mine") for _ in range(2)], [None, ["kick"]])
        page.ask("POST", f"{page.path}command", json.dumps({"set": {"g": 5}}))
        while data(stream).get("parameters", {}).get("g") != 5:
            pass
        good = box.file(kick).read_text()
        box.file(kick).write_text(good.replace("return", "retrun"))
        self.assertIn("Building", self.said(stream))
        self.assertIn("does not compile", self.said(stream))
        start = time.monotonic()
        box.file(kick).write_text(good)
        while data(stream).get("parameters", {}).get("g") != 5:
            pass
        while data(stream)["time"] == 0:
            pass
        print(f"from a save to a moving picture: {time.monotonic() - start:.1f} s")

    def said(self, stream) -> str:
        while "said" not in (line := data(stream)):
            pass
        return line["said"]


class InBrowser(Played):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, *words: str) -> None:
        _, address = self.start(*words)
        self.browser.open(address, plays=True)
        self.addCleanup(self.browser.driver.get, "about:blank")
        self.browser.wait("return Boolean(viewer.runs) && viewer.count > 3")

    def tearDown(self):
        self.assertEqual(self.browser.messages(), [])

    def ask(self, expression: str):
        return self.browser.run(f"return {expression}")

    def test_a_pull_moves_the_body_it_takes(self):
        self.open("pendulum", "--set", "angle=1")
        self.browser.run("viewer.picture.camera.orbit.addEventListener('start', () => { window.turned = true; })")
        start = self.ask("viewer.drawnAt(1)")
        canvas = self.browser.driver.find_element("id", "picture")
        self.browser.drag(canvas, self.ask("viewer.project(1)"), (120, -60), hold=lambda: self.browser.wait(
            f"return Math.abs(viewer.drawnAt(1)[0] - {start[0]}) > 0.1"))
        self.assertFalse(self.ask("Boolean(window.turned)"), "the camera took the drag")
        self.assertTrue(self.ask("document.body.classList.contains('touched')"))
        self.browser.wait("return viewer.picture.hand === null")
        self.assertEqual(self.ask("viewer.notice"), "")

    def test_a_push_and_a_ball(self):
        self.open("stack", "--set", "bodies=1")
        before = self.ask("viewer.drawn()")
        self.browser.driver.find_element("id", "drop").click()
        self.browser.wait(f"return viewer.drawn() > {before}")
        start = self.ask("viewer.drawnAt(1)")
        canvas = self.browser.driver.find_element("id", "picture")
        self.browser.drag(canvas, self.ask("viewer.project(1)"), (0, 0), shift=True)
        self.browser.wait("const [x, y] = viewer.drawnAt(1);"
                          f"return Math.hypot(x - {start[0]}, y - {start[1]}) > 0.05")

    def test_pause_step_and_restart(self):
        self.open("pendulum")
        self.browser.driver.find_element("id", "play").click()
        self.browser.wait("return !viewer.playing")
        time.sleep(0.5)  # what was on its way has come
        at = self.ask("viewer.time")
        time.sleep(0.3)
        self.assertEqual(self.ask("viewer.time"), at)
        self.browser.driver.find_element("id", "next").click()
        self.browser.wait(f"return viewer.time > {at}")
        self.assertAlmostEqual(self.ask("viewer.time"), at + self.ask("viewer.runs[0].header.method.h"))
        self.browser.driver.find_element("id", "start").click()
        self.browser.wait(f"return viewer.playing && viewer.time < {at}")

    def test_a_slider_sets_what_it_says(self):
        self.open("pendulum")
        self.browser.run("const slider = document.querySelector('#sliders [name=g]'); slider.value = 1;"
                         "slider.dispatchEvent(new Event('input'))")
        self.browser.wait("return viewer.runs[0].header.parameters.g > 20")
        self.assertAlmostEqual(self.ask("viewer.runs[0].header.parameters.g"),
                               self.ask("viewer.runs[0].header.controls.find((c) => c.name === 'g').value"))


if __name__ == "__main__":
    unittest.main()
