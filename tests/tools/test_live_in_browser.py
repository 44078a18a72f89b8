"""Live figures in a browser, from the file system: each starts and moves without messages; sliders, pauses, damage."""

import json
import unittest
from pathlib import Path

from browser import browser_for_book
from test_live_engine import built
from test_live_figures import figures

from binding.live import ENGINE
from binding.site import build

MOST_RUNNING = 2


class Live(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        engine = built()
        cls.folder = browser_for_book(cls)
        build(cls.folder, engine=engine)

    def tearDown(self):
        self.assertEqual(self.browser.messages(), [])

    def lesson(self, name: str) -> Path:
        return self.folder / "chapters" / name / "index.html"

    def show(self, page: Path, place: int = 0) -> None:
        """Opens a page, and waits until a figure of its film runs; later requests go to the figure's frame."""
        driver = self.browser.driver
        driver.get(page.as_uri())
        self.browser.run("document.querySelector('figure[data-live]').scrollIntoView({ block: 'center' })")
        self.browser.wait("return Boolean(document.querySelector('figure.running'))")
        if place:
            self.browser.run("document.querySelectorAll('.scenes button')[arguments[0]].click()", place)
        self.browser.wait("return document.querySelector('figure[data-live]').begun")
        driver.switch_to.frame(driver.find_element("css selector", "figure.running > iframe"))
        self.addCleanup(driver.switch_to.default_content)
        self.browser.wait("return Boolean(window.viewer) && viewer.draws > 0")

    def each(self):
        """Shows each figure of each lesson in turn, and yields it."""
        for name, found in figures().items():
            for place, figure in enumerate(found):
                with self.subTest(name, scene=figure.scene):
                    self.show(self.lesson(name), place)
                    yield figure
                self.browser.driver.switch_to.default_content()

    def ask(self, expression: str):
        return self.browser.run(f"return {expression}")

    def test_each_figure_starts_and_goes_on(self):
        for figure in self.each():
            first = self.ask("viewer.time")
            self.browser.wait(f"return viewer.time > {first}")
            self.assertEqual(self.ask("viewer.runs[0].header.scene"), figure.scene)
            headers = self.ask("viewer.runs.map((run) => run.header)")
            wanted = [figure.settings, *([figure.settings | dict([figure.beside])] if figure.beside else [])]
            self.assertEqual(len(headers), len(wanted))
            for header, settings in zip(headers, wanted):
                for setting, text in settings.items():
                    value = (header["parameters"] | header["method"])[setting]
                    self.assertEqual(value, text if isinstance(value, str) else float(text), setting)
            self.assertEqual(self.ask("[...document.querySelectorAll('#sliders [name]')].map((node) => node.name)"),
                             list(figure.controls))
            for mark in figure.shows:
                self.assertTrue(self.ask("viewer.picture.shown[arguments[0]]".replace("arguments[0]", f"'{mark}'")))
            self.assertEqual(self.ask("viewer.graphs.length"), 1)
            self.assertEqual(self.ask("viewer.notice"), "")
            self.browser.driver.switch_to.default_content()
            self.assertIn(figure.says(), self.ask("document.querySelector('.says').textContent"))
            caption = self.ask("getComputedStyle(document.querySelector('figure[data-live] > figcaption')).display")
            self.assertEqual(caption == "none", self.ask("document.querySelector('figure[data-live]').classList"
                                                         ".contains('other')"))

    def test_each_figure_answers_its_first_control(self):
        for figure in self.each():
            name = figure.controls[0]
            value = ("(viewer.runs.map(({ header }) => [header.parameters, header.method]"
                     f".map((all) => all['{name}']).find((one) => one !== undefined)))")
            before = self.ask(value)
            changed = 1 if figure.beside and figure.beside[0] == name else len(before)  # runs that it changes
            self.browser.run(f"const control = document.querySelector('#sliders [name={name}]');"
                             "if (control.tagName === 'SELECT') control.selectedIndex = (control.selectedIndex + 1) % control.length;"
                             "else control.value = Number(control.value) > 0.5 ? 0.45 : 0.55;"
                             "control.dispatchEvent(new Event(control.tagName === 'SELECT' ? 'change' : 'input'))")
            self.browser.wait(f"return {value}.every((now, k) => (now !== {json.dumps(before)}[k]) === (k < {changed}))")
            shown = self.ask("viewer.draws")
            self.browser.wait(f"return viewer.draws > {shown}")
            self.assertEqual(self.ask("viewer.notice"), "")

    def test_two_runs_stand_beside_each_other(self):
        self.show(self.lesson("11_direct"))
        self.assertEqual(self.ask("[...document.querySelectorAll('#names .run')].map((node) => node.textContent)"),
                         ["solver gauss seidel", "solver direct"])
        self.browser.wait("return viewer.time > 0.15")
        # Ten sweeps a step leave the wire unsolved. Live runs do not say how far they part.
        self.assertIn(self.ask("document.getElementById('parting').textContent"),
                      ("", "solver gauss seidel: unsolved by now."))
        swept, solved = self.ask("viewer.runs.map(({ frames }) => frames.at(-1).error)")
        self.assertGreater(swept, 100 * solved)
        self.browser.wait("return viewer.runs.every(({ frames }, k) => frames.at(-1).time > 0)")

    def test_a_run_that_ends_begins_again(self):
        name, place, lasts = next((name, place, figure.lasts) for name, found in figures().items()
                                  for place, figure in enumerate(found) if figure.scene == "sliding_block")
        self.show(self.lesson(name), place)
        self.browser.wait(f"return viewer.time > {0.6 * lasts}")
        self.browser.wait(f"return viewer.time < {0.4 * lasts}")

    def test_a_slider_changes_the_run(self):
        self.show(self.lesson("03_single_contact"))
        before = self.ask("viewer.runs[0].header.parameters.k")
        self.browser.run("const slider = document.querySelector('#sliders [name=k]'); slider.value = 0.9;"
                         "slider.dispatchEvent(new Event('input'));")
        self.browser.wait(f"return viewer.runs[0].header.parameters.k > 2 * {before}")
        k = self.ask("viewer.runs[0].header.parameters.k")
        self.browser.wait(f"return Math.abs(viewer.runs[0].frames.at(-1).sample[1] + 9.81 / {k}) < 1e-3 * 9.81 / {k}")

    def test_the_start_begins_again(self):
        self.show(self.lesson("01_leapfrog"))
        self.browser.wait("return viewer.time > 0.5")
        self.browser.driver.find_element("id", "start").click()
        self.browser.wait("return viewer.time < 0.5 && viewer.time > 0")

    def test_it_begins_again_when_its_bodies_have_left_the_view(self):
        self.show(self.lesson("05_friction_box"))  # the sphere rolls on for ever
        self.browser.wait("return viewer.time > 1.5")
        self.browser.wait("return viewer.time < 1.5")
        self.assertEqual(self.ask("viewer.runs[0].frames.at(-1).state || 'sound'"), "sound")

    def test_out_of_sight_it_pauses(self):
        self.show(self.lesson("01_leapfrog"))
        driver = self.browser.driver
        driver.switch_to.default_content()
        self.browser.run("window.scrollTo(0, document.body.scrollHeight)")
        driver.switch_to.frame(driver.find_element("css selector", "figure.running > iframe"))
        self.browser.wait("return !viewer.live.running")
        driver.switch_to.default_content()
        self.browser.run("document.querySelector('figure.running').scrollIntoView({ block: 'center' })")
        driver.switch_to.frame(driver.find_element("css selector", "figure.running > iframe"))
        self.browser.wait("return viewer.live.running")

    def test_no_more_than_two_run(self):
        """Three of one lesson's, in one view."""
        page = self.lesson("01_leapfrog")
        text = page.read_text(encoding="utf-8")
        begin = text.index('<figure class="film" data-live')
        figure = text[begin:text.index("</figure>", begin) + len("</figure>")]
        three = page.with_name("three.html")
        small = "<style>figure[data-live] > iframe { height: 12rem !important; } img { height: 12rem !important; }</style>"
        three.write_text(text[:begin] + small + 3 * figure + text[begin + len(figure):], encoding="utf-8")
        self.show(three)
        self.browser.driver.switch_to.default_content()
        self.browser.run("window.scrollTo(0, document.querySelector('figure[data-live]').offsetTop)")
        self.browser.wait("return document.querySelectorAll('figure.running').length >= 2")
        driver = self.browser.driver
        running = 0
        for frame in driver.find_elements("css selector", "figure.running > iframe"):
            driver.switch_to.frame(frame)
            self.browser.wait("return viewer.draws > 0")
            running += self.ask("viewer.live.running")
            driver.switch_to.default_content()
        self.assertEqual(running, MOST_RUNNING)

    def test_a_damaged_engine_leaves_the_film_and_says_so(self):
        file = self.folder / ENGINE
        whole = file.read_text(encoding="utf-8")
        self.addCleanup(file.write_text, whole, encoding="utf-8")
        for text in ("", "window.spookEngine = { text: 'AAAA', wasm: 'AAAA' };", whole.replace('wasm: "', 'wasm: "AAAA')):
            with self.subTest(json.dumps(text[:60])):
                file.write_text(text, encoding="utf-8")
                self.browser.driver.get(self.lesson("01_leapfrog").as_uri())
                self.browser.run("document.querySelector('figure[data-live]').scrollIntoView()")
                self.browser.wait("return Boolean(document.querySelector('.says'))")
                self.assertIn("The film is shown", self.ask("document.querySelector('.says').textContent"))
                self.assertTrue(self.ask("document.querySelector('figure[data-live] img').offsetHeight > 0"))


if __name__ == "__main__":
    unittest.main()
