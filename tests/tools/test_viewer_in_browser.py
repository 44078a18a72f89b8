"""The viewer's page in a browser: the drawing, and the effect of the controls. Compares pixels and the page's own
numbers."""

import gzip
import json
import math
import struct
import tempfile
import unittest
from base64 import b64decode, b64encode
from pathlib import Path

import recordings
from browser import Browser
from sandbox import Sandbox

from gltf import gltf
from needs import THREE
from page import film

FLOAT = 1e-6  # positions are float32


class Viewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)

    def open(self, *texts: str, labels: tuple[str, ...] = ("", "beside", "third"), plays: bool = False) -> None:
        page = self.folder / "page.html"
        page.write_text(film(list(zip(labels, (text.encode() for text in texts)))))
        self.browser.open(page, plays)

    def tearDown(self):
        self.assertEqual(self.browser.messages(), [])

    def click(self, name: str) -> None:
        self.browser.driver.find_element("id", name).click()

    def keys(self, *keys: str) -> None:
        self.browser.driver.find_element("tag name", "body").send_keys(*keys)

    def ask(self, expression: str):
        return self.browser.run(f"return {expression}")


class Picture(Viewer):
    def test_bodies_stand_where_the_recording_says(self):
        self.open(recordings.rolling_ball(speed=1))
        self.assertEqual(self.ask("viewer.drawn()"), 1)
        for frame in (0, 17, 60):
            self.browser.run("viewer.scrubTo(arguments[0])", frame)
            self.browser.drawn()
            for got, wanted in zip(self.ask("viewer.drawnAt(1)"), (frame * recordings.H, 0, 0.2)):
                self.assertAlmostEqual(got, wanted, delta=FLOAT)
            for got, wanted in zip(self.ask("viewer.ghostAt(1)"), (frame * recordings.H, 0.3, 0.2)):
                self.assertAlmostEqual(got, wanted, delta=FLOAT)

    def test_pixels_show_a_body_and_that_it_moves(self):
        self.open(recordings.rolling_ball())
        places = []
        for frame in (0, 60):
            self.browser.run("viewer.scrubTo(arguments[0])", frame)
            pixels = self.browser.pixels()
            x, y = self.ask("viewer.project(1)")
            around = pixels[round(y) - 30:round(y) + 30, round(x) - 30:round(x) + 30]
            light = around.sum(axis=2)
            # Two tones, both darker than the floor and the page.
            self.assertLess(light.min(), 1.7)
            self.assertGreater(light.max() - light.min(), 0.5)
            places.append((x, y, pixels))
        (x0, y0, first), (x1, y1, last) = places
        self.assertGreater(abs(x1 - x0), 100)
        for x, y in ((x0, y0), (x1, y1)):
            self.assertGreater(abs(first[round(y), round(x)] - last[round(y), round(x)]).max(), 0.1)

    def test_a_ball_shows_how_it_turns(self):
        text = recordings.rolling_ball(speed=0)
        lines = [json.loads(line) for line in text.splitlines()]
        lines[30]["q"] = recordings.floats(1, 0, 0, 0, 0.7071, 0, 0.7071, 0)  # a quarter turn on the spot
        self.open(recordings.text(*lines))
        images = []
        for frame in (28, 29):
            self.browser.run("viewer.scrubTo(arguments[0])", frame)
            images.append(self.browser.pixels())
        x, y = map(round, self.ask("viewer.project(1)"))
        changed = abs(images[0] - images[1])[y - 40:y + 40, x - 40:x + 40].max(axis=2) > 0.1
        self.assertGreater(changed.mean(), 0.2)

    def test_all_of_the_run_is_in_view(self):
        for text, body in ((recordings.rolling_ball(), 1), (recordings.hanging_wire(), 12), (recordings.tower(), 6)):
            self.open(text)
            width, height = self.ask("[viewer.picture.canvas.clientWidth, viewer.picture.canvas.clientHeight]")
            for frame in (0, 30, 60):
                self.browser.run("viewer.scrubTo(arguments[0])", frame)
                self.browser.drawn()
                x, y = self.ask(f"viewer.project({body})")
                self.assertTrue(0 < x < width and 0 < y < height, (x, y))

    def test_switches_draw_more(self):
        self.open(recordings.tower())
        self.browser.run("viewer.scrubTo(30)")
        before = self.browser.pixels()
        for name in ("contacts", "impulses", "friction", "pairs", "colours"):
            with self.subTest(name):
                self.click(f"show-{name}")
                with_it = self.browser.pixels()
                self.assertGreater((abs(with_it - before).max(axis=2) > 0.1).sum(), 50)
                self.click(f"show-{name}")
                self.assertLess((abs(self.browser.pixels() - before).max(axis=2) > 0.1).sum(), 5)

    def test_pairs_of_one_colour_share_no_body(self):
        self.open(recordings.tower(6))
        self.browser.run("viewer.scrubTo(30)")
        between, colours = self.ask("[Array.from(viewer.runs[0].frames[30].between),"
                                    "coloursOf(viewer.runs[0].header, viewer.runs[0].frames[30])]")
        pairs = {tuple(between[k:k + 2]): colours[k // 2] for k in range(0, len(between), 2)}
        self.assertEqual([pairs[pair] for pair in sorted(pairs)], [0, 1, 0, 1, 0, 1])  # the floor, body 0, has no colour
        self.assertEqual(len(colours), len(between) // 2)

    def test_on_a_pile_small_impulses_have_no_arrows(self):
        arrows = "viewer.picture.parts[0].marks.{}.shafts.count"
        for boxes, drawn, where in ((5, 20, "arrows"), (20, 68, "crowded")):  # 20 and 80 contacts, (k+1)/boxes of the largest
            with self.subTest(boxes):
                self.open(recordings.tower(boxes))
                self.browser.run("viewer.scrubTo(30)")
                self.click("show-impulses")
                self.browser.drawn()
                self.assertEqual(self.ask(arrows.format(where)), drawn)
                self.assertEqual(self.ask(arrows.format("crowded" if where == "arrows" else "arrows")), 0)
                self.assertEqual("below a fifth" in self.ask("document.getElementById('arrow-key').textContent"),
                                 where == "crowded")
                self.click("show-impulses")

    def test_titles_fit(self):
        """The longest text that a scene has, on a wide and on a narrow page."""
        long = "Two words and ω = m g s/(I ω), " * 14
        self.addCleanup(self.browser.emulate, "Emulation.clearDeviceMetricsOverride")
        for width, height in ((1280, 800), (390, 844)):
            self.browser.emulate("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                                 mobile=False)
            bodies = [{"shape": "ball", "radius": 0.2}]
            self.open(recordings.text(recordings.header("flat_box_100_contacts", bodies, answer=long, summary=long),
                                      recordings.frame(0, [0, 0, 0], q=recordings.floats(1, 0, 0, 0)),
                                      recordings.frame(1, [0, 0, 1], q=recordings.floats(1, 0, 0, 0)), {"end": "done"}))
            for name in ("scene", "summary", "method", "answer"):
                with self.subTest(name, width=width):
                    left, right, inside, whole, height_, all_ = self.ask(
                        "((node) => [node.getBoundingClientRect().left, node.getBoundingClientRect().right, node.clientWidth,"
                        f"node.scrollWidth, node.clientHeight, node.scrollHeight])(document.getElementById('{name}'))")
                    self.assertTrue(0 <= left and right <= width, (left, right))
                    self.assertLessEqual(whole, inside)
                    self.assertLessEqual(all_, height_ + 1)

    def test_rods_take_the_colour_of_their_tension(self):
        self.open(recordings.hanging_wire(amplitude=0.3))
        self.browser.run("viewer.scrubTo(10)")
        pixels = self.browser.pixels()
        redness = []
        for link in (0, 11):
            ends = [self.ask(f"viewer.project({link + end})") for end in (0, 1)]
            x, y = (round(sum(end[axis] for end in ends) / 2) for axis in (0, 1))
            around = pixels[y - 2:y + 3, x - 2:x + 3]
            redness.append((around[:, :, 0] - around[:, :, 1]).max())
        self.assertGreater(redness[0], redness[1] + 0.2)

    def test_a_thousand_bodies(self):
        self.open(recordings.crowd(1000, frames=3))
        self.assertEqual(self.ask("viewer.drawn()"), 1000)
        self.open(recordings.empty_scene())
        empty = self.ask("viewer.measure(5)")
        self.open(recordings.crowd(1000, frames=3))
        crowd = self.ask("viewer.measure(5)")
        print(f"pictures a second, drawn in software: {crowd:.2f} of 1,000 balls, {crowd / empty:.4f} of an empty scene's")

    def test_in_the_dark_and_on_a_phone(self):
        self.open(recordings.tower())
        light = self.browser.pixels().mean()
        self.browser.emulate("Emulation.setEmulatedMedia",
                             features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.addCleanup(self.browser.emulate, "Emulation.setEmulatedMedia", features=[])
        self.browser.wait("return matchMedia('(prefers-color-scheme: dark)').matches")
        self.browser.run("viewer.rebuild()")
        self.assertLess(self.browser.pixels().mean(), light - 0.3)
        self.browser.emulate("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1,
                             mobile=True)
        self.addCleanup(self.browser.emulate, "Emulation.setDeviceMetricsOverride", width=1280, height=800,
                        deviceScaleFactor=1, mobile=False)
        self.browser.wait("return viewer.picture.canvas.clientWidth <= 390")
        self.assertLessEqual(self.ask("document.documentElement.scrollWidth"), 390)

    def test_in_a_frame_of_another_page(self):
        (self.folder / "inner.html").write_text(film([("", recordings.tower().encode())]))
        outer = self.folder / "outer.html"
        outer.write_text('<iframe src="inner.html" width="900" height="600"></iframe>')
        self.browser.driver.get(outer.as_uri())
        self.browser.driver.switch_to.frame(0)
        self.addCleanup(self.browser.driver.switch_to.default_content)
        self.browser.wait("return Boolean(window.viewer && viewer.ready)")
        self.assertEqual(self.ask("viewer.drawn() || viewer.count"), 5 if self.ask("viewer.drawn()") else 61)


class Films(Viewer):
    """Films of all scenes, as the engine records them."""

    def test_every_scene(self):
        box = Sandbox(built=True)
        self.addCleanup(box.close)
        names = [scene["name"] for scene in json.loads(box.course("scenes", "--json").stdout)["scenes"]]
        self.assertGreater(len(names), 20)
        for name in names:
            with self.subTest(name):
                result = box.course("view", name, "--fps", "10", "--out", "film.html")
                self.assertEqual(result.returncode, 0, result.stderr)
                page = self.folder / "film.html"
                page.write_text((box.root / "film.html").read_text())
                self.browser.open(page)
                self.browser.run("viewer.scrubTo(viewer.count >> 1)")
                self.browser.drawn()
                self.assertEqual((self.browser.messages(), self.ask("viewer.notice")), ([], ""))
                header = self.ask("viewer.runs[0].header")
                shapes = [body for body in header["bodies"] if body["shape"] != "plane"]
                self.assertEqual(self.ask("viewer.drawn()"), len(shapes))
                width, height = self.ask("[viewer.picture.canvas.clientWidth, viewer.picture.canvas.clientHeight]")
                for body in (k for k, shape in enumerate(header["bodies"]) if shape["shape"] != "plane"):
                    x, y = self.ask(f"viewer.project({body})")
                    self.assertTrue(0 < x < width and 0 < y < height, f"body {body} is out of view")


class Time(Viewer):
    def test_play_and_pause(self):
        self.open(recordings.rolling_ball(), plays=True)
        self.assertTrue(self.ask("viewer.playing"))
        self.browser.wait("return viewer.index > 2")
        self.click("play")
        self.browser.drawn()
        at = self.ask("viewer.index")
        self.browser.run("viewer.dirty()")
        self.browser.drawn()
        self.assertEqual((self.ask("viewer.index"), self.ask("viewer.playing")), (at, False))

    def test_it_ends_at_its_end_unless_it_loops(self):
        self.open(recordings.rolling_ball(frames=5))
        self.click("loop")
        self.click("play")
        self.browser.wait("return !viewer.playing && viewer.index === 4")
        self.click("loop")
        self.click("play")  # from the start, again and again
        self.browser.wait("return viewer.playing && viewer.index < 4")
        self.browser.wait("return viewer.index === 4")
        self.browser.wait("return viewer.index < 4")

    def test_keys(self):
        from selenium.webdriver.common.keys import Keys
        self.open(recordings.rolling_ball())
        for keys, index in (((Keys.ARROW_RIGHT,), 1), ((Keys.ARROW_RIGHT,) * 2, 3), ((Keys.ARROW_LEFT,), 2),
                            ((Keys.END,), 60), ((Keys.ARROW_RIGHT,), 60), ((Keys.HOME,), 0), ((Keys.ARROW_LEFT,), 0)):
            self.keys(*keys)
            self.assertEqual(self.ask("viewer.index"), index)
        self.keys(" ")
        self.assertTrue(self.ask("viewer.playing"))
        self.keys(" ")
        self.assertFalse(self.ask("viewer.playing"))
        self.keys(Keys.ARROW_DOWN)
        self.assertEqual(self.ask("viewer.player.rate"), 0.25)

    def test_steps_and_the_scrub_bar(self):
        self.open(recordings.rolling_ball())
        self.click("next")
        self.click("next")
        self.click("back")
        self.assertEqual(self.ask("viewer.index"), 1)
        scrub = self.browser.driver.find_element("id", "scrub")
        self.browser.drag(scrub, (scrub.rect["width"] / 2, scrub.rect["height"] / 2), (5, 0))
        self.assertAlmostEqual(self.ask("viewer.index"), 30, delta=3)
        self.click("start")
        self.assertEqual(self.ask("viewer.index"), 0)

    def test_a_graph_scrubs(self):
        self.open(recordings.rolling_ball())
        for key in ("error", "energy", "residual", "sample", "us"):
            with self.subTest(key):
                graph = self.browser.driver.find_element("css selector", f'.graph[data-key="{key}"] canvas')
                width, height = graph.rect["width"], graph.rect["height"]
                self.browser.run("viewer.scrubTo(0)")
                self.browser.drag(graph, (width / 4, height / 2), (round(width / 2), 0))
                part = (0.75 * width - self.ask("PAD.left")) / (width - self.ask("PAD.left + PAD.right"))
                self.assertAlmostEqual(self.ask("viewer.time"), part, delta=0.03)

    def test_numbers_at_the_cursor(self):
        self.open(recordings.rolling_ball())
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        values = {key: self.ask(f"document.querySelector('.graph[data-key=\"{key}\"] .values').textContent")
                  for key in ("error", "energy", "sample")}
        self.assertEqual(values["error"], "0.001")
        self.assertIn("total 1", values["energy"])
        self.assertEqual(values["sample"], "0.2")
        self.assertIn("1.000 s", self.ask("document.getElementById('now').textContent"))


class Seen(Viewer):
    """A film can be followed by eye, and its numbers have the meaning that they show."""

    def test_a_short_run_is_slowed(self):
        lines = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        for line in lines[1:-1]:
            line["time"] /= 100
        for text, rate in ((recordings.rolling_ball(frames=181), 1), (recordings.rolling_ball(), 0.5),
                           (recordings.text(*lines), 1 / 256)):
            self.open(text)
            self.assertEqual(self.ask("viewer.player.rate"), rate)
            self.assertEqual(float(self.ask("document.getElementById('speed').value")), rate)

    def test_no_part_of_the_picture_is_left_black(self):
        self.open(recordings.tower(), recordings.tower(), recordings.tower())
        pixels = self.browser.pixels()
        self.assertGreater(pixels[-120:-60, -120:-60].min(), 0.9)  # a fourth panel would be here

    def test_the_ends_of_joints_are_in_view(self):
        lines = [json.loads(line) for line in recordings.hanging_wire(links=2).splitlines()]
        lines[0]["joints"][0]["p_i"] = [5, 0, 0]
        self.open(recordings.text(*lines))
        self.assertGreaterEqual(self.ask("viewer.picture.box.high.x"), 5)

    def test_ticks_differ(self):
        self.browser.open(self.folder / "page.html")
        for ticks in ([0.5, 0.50001, 0.50002], [0.5, 0.5 + 1e-10, 0.5 + 2e-10], [100.5, 100.6, 100.7], [0, 1, 2]):
            texts = self.ask(f"tickTexts({ticks})")
            self.assertEqual(len(set(texts)), len(ticks), texts)
        self.assertEqual(texts, ["0", "1", "2"])

    def graph(self, key: str, what: str):
        return self.ask(f"viewer.graphs.find((graph) => graph.quantity.key === '{key}').{what}")

    def test_round_off_is_called_so(self):
        lines = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        lines[0]["error"] = {"name": "error over the answer", "unit": "relative"}
        lines[0]["columns"][1] = "v [m/s]"
        for k, line in enumerate(lines[1:-1]):
            line |= {"residual": 10.0 ** (-30 + k % 5), "error": 1e-16 * (k // 20), "sample": [line["time"], -1e-17 * k]}
        self.open(recordings.text(*lines))
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        for key in ("residual", "error", "sample"):
            with self.subTest(key):
                said = self.ask(f"document.querySelector('.graph[data-key=\"{key}\"] .values').textContent")
                self.assertEqual((said, self.graph(key, "noise")), ("round-off", True))
        self.assertEqual(self.graph("residual", "logarithmic"), True)
        self.assertEqual((self.graph("residual", "low"), self.graph("residual", "high")), (-14, -11))  # of 1 m/s
        self.assertAlmostEqual(self.graph("error", "high"), 1e-12, delta=1e-13)
        self.assertLess(self.graph("sample", "low"), -1e-12)

    def test_energy_constant_up_to_round_off_is_a_straight_line(self):
        lines = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        for drift, least, most in ((2e-16, 0.05, 0.2), (1e-9, 6e-8, 7e-8)):
            for k, line in enumerate(lines[1:-1]):
                line["energy"] = {"field": 0.5 + drift * k}
            self.open(recordings.text(*lines))
            low, high = self.graph("energy", "low"), self.graph("energy", "high")
            with self.subTest(drift):
                self.assertTrue(least < high - low < most, (low, high))

    def test_labels_of_a_time_axis_have_room(self):
        self.browser.open(self.folder / "page.html")
        for ticks, widths in (([60, 100, 140, 180], [50, 50, 50, 50]), ([60, 300], [30, 30]), ([60], [400])):
            shown = [(centre - wide / 2, centre + wide / 2) for centre, wide
                     in zip(self.ask(f"roomsFor({ticks}, {widths}, 344)"), widths) if centre is not None]
            self.assertTrue(shown)
            self.assertTrue(all(one[1] < other[0] for one, other in zip(shown, shown[1:])), shown)
        # A run of one frame has the labels of a frame's time, and not of a billionth of a second.
        header, frame, *_ = recordings.rolling_ball().splitlines()
        self.open("\n".join([header, frame, json.dumps({"end": "done"}), ""]))
        self.assertAlmostEqual(self.graph("error", "last"), recordings.H)

    def test_legend_and_help_do_not_overprint(self):
        self.addCleanup(self.browser.emulate, "Emulation.clearDeviceMetricsOverride")
        for width, height in ((1280, 800), (800, 600), (390, 844)):
            self.browser.emulate("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                                 mobile=False)
            self.open(recordings.tower(20))
            self.browser.run("viewer.scrubTo(30)")
            self.click("show-impulses")
            self.browser.drawn()
            with self.subTest(width):
                edges = "['stage', 'how', 'transport'].map((id) => document.getElementById(id).getBoundingClientRect())"
                stage, said, bar = self.ask(f"{edges}.map(({{ top, bottom, height }}) => [top + scrollY, bottom + scrollY, height])")
                self.assertGreater(said[2], 0)
                self.assertLessEqual(stage[1], said[0] + 0.5)
                keys = self.ask("(({ top, bottom }) => [top + scrollY, bottom + scrollY])"
                                "(document.getElementById('keys').getBoundingClientRect())")
                self.assertTrue(stage[0] <= keys[0] and keys[1] <= stage[1], (stage, keys))
            self.click("show-impulses")

    def test_a_spike_does_not_hide_the_rest(self):
        lines = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        lines[30]["us"] = [1e6, 0, 0]
        self.open(recordings.text(*lines))
        high = self.ask("viewer.graphs.find((graph) => graph.quantity.key === 'us').high")
        self.assertLess(high, 100)
        self.assertIn("spike", self.ask("document.querySelector('.graph[data-key=\"us\"]').textContent"))

    def test_a_link_to_a_moment(self):
        self.open(recordings.rolling_ball())
        self.browser.run("viewer.scrubTo(30)")
        self.click("moment")
        self.assertEqual(self.ask("location.hash"), "#t=0.5")
        self.browser.driver.refresh()
        self.browser.wait("return Boolean(window.viewer && viewer.ready)")
        self.assertEqual((self.ask("viewer.index"), self.ask("viewer.playing")), (30, False))

    def test_what_the_pointer_does_is_said(self):
        self.open(recordings.rolling_ball())
        self.assertIn("double click", self.ask("document.getElementById('how').textContent"))

    def colours(self, tint: str, bodies: range) -> list:
        self.browser.run("const select = document.getElementById('tint'); select.value = arguments[0];"
                         "select.dispatchEvent(new Event('change'))", tint)
        self.browser.drawn()
        return [self.ask(f"viewer.picture.parts[0].bodies.tintAt({body})") for body in bodies]

    def test_colours_tell_bodies_and_islands_apart(self):
        lines = [json.loads(line) for line in recordings.tower(boxes=4, frames=2).splitlines()]
        lines[1] |= {"between": recordings.integers(0, 2, 2, 3, 0, 4, 4, 5), "contacts": recordings.floats(*[0] * 40)}
        self.open(recordings.text(*lines))
        bodies = range(2, 6)
        self.assertEqual(len({tuple(colour) for colour in self.colours("plain", bodies)}), 1)
        self.assertEqual(len({tuple(colour) for colour in self.colours("body", bodies)}), 4)
        first, second, third, fourth = self.colours("island", bodies)  # two on each of two places of the floor
        self.assertEqual((first, third), (second, fourth))
        self.assertNotEqual(first, third)

    def test_colours_tell_speeds(self):
        lines = [json.loads(line) for line in recordings.tower(boxes=3, frames=2).splitlines()]
        lines[1]["v"] = recordings.floats(*[0] * 6, 1, 0, 0, 0, 2, 0, 0, 0, 0)
        self.open(recordings.text(*lines))
        slow, fast, still = self.colours("speed", range(2, 5))
        for k in range(3):
            self.assertAlmostEqual(slow[k], (fast[k] + still[k]) / 2, delta=FLOAT)
        self.assertNotEqual(fast, still)

    def test_a_click_on_a_body_shows_its_numbers(self):
        from selenium.webdriver.common.action_chains import ActionChains
        self.open(recordings.rolling_ball(speed=0.6))
        canvas = self.browser.driver.find_element("id", "picture")

        def click(x: float, y: float) -> str:
            ActionChains(self.browser.driver).move_to_element_with_offset(
                canvas, round(x - canvas.rect["width"] / 2), round(y - canvas.rect["height"] / 2)).click().perform()
            self.browser.drawn()
            return self.ask("document.getElementById('body').hidden ? '' : document.getElementById('body').textContent")

        self.browser.run("viewer.scrubTo(30)")
        self.browser.drawn()
        said = click(*self.ask("viewer.project(1)"))
        for text in ("body 1 · ball", "(0.3, 0, 0.2) m", "speed0.6 m/s", "(0, 3, 0) rad/s", "1 contact"):
            self.assertIn(text, said)
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        self.assertIn("(0.6, 0, 0.2) m", self.ask("document.getElementById('body').textContent"))
        self.assertEqual(click(5, 5), "")


class Runs(Viewer):
    def test_they_are_in_step_and_part(self):
        self.open(recordings.rolling_ball(), recordings.rolling_ball(speed=1.2), labels=("ours", "faster"))
        size = self.ask("viewer.picture.box.size")
        # They are 0.2 t apart: the first frame in which that is more than a thousandth of the scene's size.
        since = next(k * recordings.H for k in range(61) if 0.2 * k * recordings.H > 1e-3 * size)
        self.assertAlmostEqual(self.ask("viewer.since[0]"), since, delta=1e-9)
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        self.assertAlmostEqual(self.ask("viewer.drawnAt(1, 1)[0] - viewer.drawnAt(1, 0)[0]"), 0.2, delta=FLOAT)
        said = self.ask("document.getElementById('parting').textContent")
        for text in ("faster", "ours", "since", "Now 0.2 m", "body 1"):
            self.assertIn(text, said)

    def test_side_by_side_and_in_one_picture(self):
        self.open(recordings.rolling_ball(), recordings.rolling_ball(side=0.5))
        width = self.ask("viewer.picture.canvas.clientWidth")
        first, second = (self.ask(f"viewer.project(1, {run})")[0] for run in (0, 1))
        self.assertTrue(first < width / 2 < second, (first, second))
        apart = self.browser.pixels()
        self.click("show-overlaid")
        self.assertGreater((abs(self.browser.pixels() - apart).max(axis=2) > 0.1).sum(), 1000)
        first, second = (self.ask(f"viewer.project(1, {run})")[0] for run in (0, 1))
        self.assertLess(abs(first - second), width / 3)

    def test_equal_runs_do_not_part_and_different_bodies_are_not_compared(self):
        self.open(recordings.tower(), recordings.tower(), recordings.tower(boxes=3))
        self.assertEqual(self.ask("viewer.since"), [None, None])
        said = self.ask("document.getElementById('parting').textContent").splitlines()
        self.assertIn("at the same places", said[0])
        self.assertIn("not compared", said[1])

    def test_the_largest_difference_is_told_and_chaos(self):
        self.open(recordings.rolling_ball(), recordings.rolling_ball(speed=1 + 1e-4))
        self.assertEqual(self.ask("viewer.since"), [None])
        end = 60 * recordings.H
        self.assertAlmostEqual(self.ask("viewer.farthest[0].distance"), 1e-4 * end, delta=1e-6 * end)
        self.assertAlmostEqual(self.ask("viewer.farthest[0].time"), end, delta=1e-9)
        told = self.ask("document.getElementById('parting').textContent")
        self.assertIn("at most, at ", told)
        self.assertNotIn("chaotic", told)
        first = recordings.rolling_ball()
        self.open(first.replace('"answer"', '"chaotic": true, "answer"', 1), recordings.rolling_ball(speed=1.2))
        told = self.ask("document.getElementById('parting').textContent")
        for text in ("at most, at ", "since", "This scene is chaotic"):
            self.assertIn(text, told)

    def test_the_shorter_one_waits_at_its_end(self):
        self.open(recordings.rolling_ball(frames=11), recordings.rolling_ball(frames=61))
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        self.assertAlmostEqual(self.ask("viewer.drawnAt(1, 0)[0]"), 10 * recordings.H, delta=FLOAT)
        self.assertAlmostEqual(self.ask("viewer.drawnAt(1, 1)[0]"), 60 * recordings.H, delta=FLOAT)

    def test_a_double_click_follows_a_body(self):
        from selenium.webdriver.common.action_chains import ActionChains
        self.open(recordings.rolling_ball())
        canvas = self.browser.driver.find_element("id", "picture")
        x, y = self.ask("viewer.project(1)")
        ActionChains(self.browser.driver).move_to_element_with_offset(
            canvas, round(x - canvas.rect["width"] / 2), round(y - canvas.rect["height"] / 2)).double_click().perform()
        self.browser.drawn()
        before = self.ask("viewer.project(1)")
        self.browser.run("viewer.scrubTo(60)")
        self.browser.drawn()
        for a, b in zip(before, self.ask("viewer.project(1)")):
            self.assertAlmostEqual(a, b, delta=2)


class Damage(Viewer):
    def notice(self, *texts: str) -> str:
        self.open(*texts)
        said = self.ask("viewer.notice")
        self.assertEqual(self.ask("document.getElementById('notice').textContent"), said)
        self.assertNotIn("\n", said)
        return said

    def test_what_is_no_recording(self):
        for text, told in (("", "empty"), ("x", "not a recording"), ("[]\n", "not a recording"), ("{}\n", "not a recording"),
                           ('{"format": "spook recording", "version": 7}\n', "version 7"),
                           ('{"format": "spook recording", "version": 1}\n', "lists no bodies"),
                           (recordings.rolling_ball().splitlines()[0], "no frames")):
            self.assertIn(told, self.notice(text))

    def test_what_is_cut_off_is_shown_up_to_there(self):
        text = recordings.rolling_ball()
        self.assertIn("cut off at 1 s", self.notice("".join(text.splitlines(keepends=True)[:-1])))
        self.assertEqual(self.ask("viewer.count"), 61)
        self.assertIn("Line 62", self.notice(text[:len(text) - 100]))
        self.assertEqual(self.ask("viewer.count"), 60)

    def test_what_is_damaged_is_shown_up_to_there(self):
        good = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        for change, told in (({"x": recordings.floats(1, 2)}, "x has 2 numbers, not 6"), ({"x": "?"}, "x cannot be read"),
                             ({"q": "AAA="}, "q cannot be read"), ({"time": None}, "its time is missing"),
                             ({"between": recordings.integers(0, 9)}, "body that does not exist"),
                             ({"contacts": recordings.floats(1)}, "contacts has 1 numbers, not 10")):
            lines = [dict(line) for line in good]
            lines[20] |= change
            said = self.notice(recordings.text(*lines))
            self.assertIn("Line 21", said)
            if "between" not in change:
                self.assertIn(told, said)
            self.assertEqual(self.ask("viewer.count"), 19)

    def test_a_run_that_blew_up_says_why(self):
        lines = recordings.rolling_ball().splitlines()
        lost = json.dumps({"end": "blown up", "why": "body 1 is not finite"})
        self.assertEqual(self.notice("\n".join([*lines[:30], lost])), "The run blew up: body 1 is not finite.")
        lost = json.dumps({"end": "blown up", "why": "blew up in step 1"})  # as the engine says it
        self.assertEqual(self.notice("\n".join([*lines[:30], lost])), "The run blew up in step 1.")
        self.assertEqual(self.ask("viewer.count"), 29)

    def test_numbers_that_are_not_finite_are_no_exception(self):
        lines = [json.loads(line) for line in recordings.rolling_ball().splitlines()]
        for line in lines[30:-1]:
            nan = float("nan")
            line |= {"x": recordings.floats(0, 0, 0, nan, nan, 1e30), "error": None, "residual": None,
                     "energy": {"motion": None}, "sample": [0.5, None], "us": [None] * 3}
        self.assertEqual(self.notice(recordings.text(*lines)), "")
        self.browser.run("viewer.scrubTo(40)")
        self.browser.drawn()
        self.assertEqual(self.ask("viewer.drawn()"), 0)

    def test_what_is_too_large_is_not_read(self):
        page = film([("", b"TOO LARGE")])
        packed = b64encode(gzip.compress(recordings.rolling_ball().encode() + b" " * 65 * 2**20, 1)).decode()
        (self.folder / "page.html").write_text(
            page.replace(b64encode(gzip.compress(b"TOO LARGE", 6, mtime=0)).decode(), packed))
        self.browser.open(self.folder / "page.html")
        self.assertIn("too large", self.ask("viewer.notice"))

    def test_one_damaged_run_leaves_the_other(self):
        self.assertIn("beside: The recording is empty", self.notice(recordings.tower(), ""))
        self.assertEqual(self.ask("viewer.runs.length"), 1)


class Gltf(Viewer):
    """The output for other programs, as three.js' own reader reads it."""

    LOADER = "examples/js/loaders/GLTFLoader.js"
    POSES = """
        const [text, times, names, done] = arguments;
        new THREE.GLTFLoader().parse(text, "", (file) => {
          const mixer = new THREE.AnimationMixer(file.scene);
          for (const clip of file.animations) mixer.clipAction(clip).setLoop(THREE.LoopOnce).play().clampWhenFinished = true;
          done(times.map((time) => {
            mixer.setTime(time);
            file.scene.updateMatrixWorld(true);
            return names.map((name) => {
              const node = file.scene.getObjectByName(name);
              if (!node) return null;
              const [x, q, s] = [new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
              node.matrixWorld.decompose(x, q, s);
              return { x: x.toArray(), up: new THREE.Vector3(0, 0, 1).applyQuaternion(q).toArray(), s: s.toArray() };
            });
          }));
        }, (error) => done(String(error)));"""

    def poses(self, recording: str, times: list[float], *names: str):
        self.open(recording)
        self.browser.run((THREE / self.LOADER).read_text())
        found = self.browser.driver.execute_async_script(self.POSES, gltf(recording.encode()), times, names)
        self.assertNotIsInstance(found, str, found)
        return found

    def assert_near(self, got, wanted, within=1e-5):
        self.assertLess(max(abs(a - b) for a, b in zip(got, wanted, strict=True)), within, (got, wanted))

    def test_a_ball_rolls_with_y_up(self):
        times = [0, 0.5, 1]
        for time, (ball, plane) in zip(times, self.poses(recordings.rolling_ball(), times, "ball_1", "plane_0")):
            self.assert_near(ball["x"], (time, 0.2, 0))
            self.assert_near(ball["s"], (0.2, 0.2, 0.2))
            angle = time / 0.2  # about y, which is -z there
            self.assert_near(ball["up"], (math.sin(angle), math.cos(angle), 0), 2e-3)  # between frames it is not exact
            self.assert_near(plane["up"], (0, 1, 0))
            self.assertAlmostEqual(plane["x"][1] + plane["s"][2], 0, 6)  # its top is the floor

    def test_rods_go_from_point_to_point(self):
        recording = recordings.hanging_wire(links=3)
        header, *frames, _ = map(json.loads, recording.splitlines())
        k = 30
        x = [struct.unpack("<3f", b64decode(frames[k]["x"])[12 * body:12 * body + 12]) for body in range(4)]
        (rods,) = self.poses(recording, [frames[k]["time"]], "rod_0-1", "rod_1-2", "rod_2-3")
        for rod, (a, b) in zip(rods, zip(x, x[1:])):
            middle, along = [(p + q) / 2 for p, q in zip(a, b)], [q - p for p, q in zip(a, b)]
            length = math.sqrt(sum(number * number for number in along))
            self.assert_near(rod["x"], (middle[0], middle[2], -middle[1]))
            self.assertAlmostEqual(rod["s"][2], length / 2, 5)
            self.assert_near(rod["up"], (along[0] / length, along[2] / length, -along[1] / length))



if __name__ == "__main__":
    unittest.main()
