"""Live figures in a browser where nothing can compile the engine: recordings stand for it. What the page makes of them:
words beside sliders, reset, the numbers of a body, and the book's first page."""

import functools
import http.server
import threading
import unittest
from dataclasses import replace
from pathlib import Path

from browser import browser_for_book
from fake_engine import fake_engine
from test_live_figures import figures

from binding.front import hero
from binding.live import ENGINE
from binding.site import build

LESSON, BESIDE = "01_leapfrog", "04_gauss_seidel"  # the second has two runs beside each other


class LivePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = browser_for_book(cls)
        cls.folder = folder / "site"
        (two,) = figures()[BESIDE]
        second = replace(two, settings=two.settings | dict([two.beside]))
        build(cls.folder, engine=fake_engine(folder, [hero(), *figures()[LESSON], two, second]))

    def tearDown(self):
        self.assertEqual(self.browser.messages(), [])

    def ask(self, expression: str):
        return self.browser.run(f"return {expression}")

    def show(self, page: str) -> None:
        """Opens a page from the file system, and asks its figure's frame from then on."""
        self.show_at((self.folder / page).as_uri())

    def show_at(self, address: str) -> None:
        driver = self.browser.driver
        driver.get(address)
        self.browser.wait("return Boolean(document.querySelector('figure.running'))")
        driver.switch_to.frame(driver.find_element("css selector", "figure.running > iframe"))
        self.addCleanup(driver.switch_to.default_content)
        self.browser.wait("return viewer.draws > 0")
        self.browser.run("window.sent = []; const { send } = viewer.live;"
                         "viewer.live.send = (command) => { sent.push(command); return send.call(viewer.live, command); }")

    def click_body(self, body: int) -> None:
        from selenium.webdriver.common.action_chains import ActionChains
        canvas = self.browser.driver.find_element("id", "picture")
        x, y = self.ask(f"viewer.project({body})")
        ActionChains(self.browser.driver).move_to_element_with_offset(
            canvas, round(x - canvas.rect["width"] / 2), round(y - canvas.rect["height"] / 2)).click().perform()

    def test_a_control_has_a_name_words_a_value_and_a_unit(self):
        self.show(f"chapters/{LESSON}/index.html")
        said = self.ask("[...document.querySelectorAll('#sliders label')].map((label) => [label.querySelector('b')"
                        ".textContent, label.querySelector('.words').textContent,"
                        "(label.querySelector('output') || { textContent: '' }).textContent])")
        self.assertEqual(said, [["h", "time step", "0.05 s"], ["eccentricity", "of the ellipse", "0.6"],
                                ["start", "half_step: velocities begin half a step back", ""]])

    def test_reset_sets_what_was_set_and_begins_again(self):
        self.show(f"chapters/{LESSON}/index.html")
        hidden = "document.getElementById('reset').hidden"
        self.assertTrue(self.ask(hidden))
        self.browser.run("const slider = document.querySelector('#sliders [name=h]'); slider.focus(); slider.value = 1;"
                         "slider.dispatchEvent(new Event('input'))")
        self.browser.wait(f"return !{hidden}")
        self.browser.run("window.sent.length = 0")
        self.browser.driver.find_element("id", "reset").click()
        self.browser.wait(f"return {hidden}")
        self.assertEqual(self.ask("sent"), [{"set": {"h": 0.05}}, {"restart": True}, {"pause": False}])
        self.browser.wait("return document.querySelector('#sliders output').textContent === '0.05 s'")

    def test_two_runs_are_named_by_what_differs_also_when_it_is_changed(self):
        self.show(f"chapters/{BESIDE}/index.html")
        names = "[...document.querySelectorAll('#names .run')].map((node) => node.textContent)"
        self.assertEqual(self.ask(names), ["iterations 10", "iterations 2000"])
        self.browser.run("const slider = document.querySelector('#sliders [name=iterations]'); slider.value = 1;"
                         "slider.dispatchEvent(new Event('input'))")
        self.browser.wait(f"return {names}[0] === 'iterations 1000'")
        self.assertEqual(self.ask(names)[1], "iterations 2000")

    def test_nothing_is_written_over_the_picture_s_help_on_a_phone(self):
        self.addCleanup(self.browser.emulate, "Emulation.clearDeviceMetricsOverride")
        self.browser.emulate("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=False)
        for lesson in (LESSON, BESIDE):
            self.show(f"chapters/{lesson}/index.html")
            rows = self.ask("['stage', 'how', 'transport'].map((id) => document.getElementById(id).getBoundingClientRect())"
                            ".map(({ top, bottom }) => [top, bottom])")
            for (top, bottom), (after, _) in zip(rows, rows[1:]):
                self.assertTrue(top < bottom <= after + 0.5, (lesson, rows))
            self.assertIn("pull", self.ask("document.getElementById('how').textContent"))
            self.browser.driver.switch_to.default_content()

    def test_a_click_on_a_body_shows_its_numbers_and_does_not_pull_it(self):
        self.show(f"chapters/{LESSON}/index.html")
        self.browser.run("viewer.live.hold(true)")
        self.browser.wait("return !viewer.stale")
        self.click_body(0)
        self.browser.wait("return !document.getElementById('body').hidden")
        said = self.ask("document.getElementById('body').textContent")
        for text in ("body 0 · point", "position", "m/s"):
            self.assertIn(text, said)
        self.assertEqual(self.ask("sent"), [{"pause": True}])

    def test_the_book_begins_with_a_pile_and_leads_to_the_first_chapter(self):
        self.show("index.html")
        self.assertEqual(self.ask("viewer.runs[0].header.parameters.bodies"), 120)
        self.assertEqual(self.ask("getComputedStyle(document.querySelector('aside')).display"), "none")
        self.assertEqual(self.ask("viewer.graphs.length"), 0)
        self.browser.driver.switch_to.default_content()
        self.assertIn("drag a cube", self.ask("document.querySelector('.says').textContent"))
        self.browser.driver.find_element("link text", "Begin").click()
        self.browser.wait(f"return location.pathname.endsWith('{LESSON}/index.html')")

    def test_a_plain_static_server_will_do(self):
        class Quiet(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *said):
                pass

        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=self.folder)) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            self.addCleanup(self.browser.driver.get, "about:blank")
            self.show_at(f"http://127.0.0.1:{server.server_port}/chapters/{LESSON}/index.html")
            self.browser.wait("return viewer.runs[0].frames.length > 3")
            server.shutdown()

    def test_a_damaged_engine_leaves_the_film_and_says_so(self):
        file = self.folder / ENGINE
        self.addCleanup(file.write_text, file.read_text(encoding="utf-8"), encoding="utf-8")
        for text in ("", "window.spookEngine = { text: 'AAAA', wasm: 'AAAA' };"):
            file.write_text(text, encoding="utf-8")
            self.browser.driver.get((self.folder / "index.html").as_uri())
            self.browser.wait("return Boolean(document.querySelector('.says'))")
            self.assertIn("The film is shown", self.ask("document.querySelector('.says').textContent"))
            self.assertTrue(self.ask("document.querySelector('figure[data-live] img').offsetHeight > 0"))


if __name__ == "__main__":
    unittest.main()
