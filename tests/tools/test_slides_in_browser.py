"""The slides in a browser: each fits its page, keys turn them, the notes follow, and they print."""

import base64
import re
import tempfile
import unittest
from pathlib import Path

from browser import Browser
from test_book import bound

from binding.outline import pages
from binding.reading import read
from binding.slide_page import slide_page
from manifest import read_chapters

SIZE = (1280, 720)


class InBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        bound(cls.addClassCleanup)  # skips them where the book cannot be made
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)
        folder = tempfile.TemporaryDirectory(prefix="slides-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.drafts = Path(folder.name), [read(page) for page in pages()]
        cls.counts: dict = {}

    def open(self, chapter) -> int:
        """Opens the deck of a chapter; returns the number of its slides."""
        file = self.folder / f"{chapter.folder}.html"
        if not file.exists():
            page, self.counts[chapter] = slide_page(chapter, self.drafts)
            file.write_text(page, encoding="utf-8")
        self.browser.emulate("Emulation.setDeviceMetricsOverride", width=SIZE[0], height=SIZE[1], deviceScaleFactor=1,
                             mobile=False)
        self.browser.driver.get(file.as_uri())
        self.browser.wait("return document.body.classList.contains('showing')")
        return self.counts[chapter]

    def test_everything_is_within_its_slide(self):
        for chapter in read_chapters():
            with self.subTest(chapter.folder):
                count = self.open(chapter)
                self.assertEqual(self.browser.messages(), [])
                self.assertEqual(self.browser.run("""
                    document.body.classList.add("noted");
                    const left = [];
                    for (const slide of document.querySelectorAll(".slide")) {
                      const page = slide.getBoundingClientRect();
                      for (const part of slide.querySelectorAll("h1, h2, p, li, img, table, .katex-html, pre")) {
                        const box = part.getBoundingClientRect();
                        if (box.left < page.left || box.right > page.right + 1 || box.top < page.top ||
                            box.bottom > page.bottom) left.push(slide.dataset.number + " " + part.textContent);
                      }
                    }
                    return left;"""), [])
                smallest = self.browser.run("""return Math.min(...[...document.querySelectorAll(".slide")].map(
                    (slide) => Number(slide.style.getPropertyValue("--fit") || 1)))""")
                self.assertGreater(smallest, 0.55)  # of 32 pixels at 1280: what can be read from the last row
                self.assertEqual(self.browser.run("return document.querySelectorAll('section').length"), count)

    def test_keys_and_notes(self):
        self.open(read_chapters()[3])
        def now():
            return self.browser.run("return [slides[now].id, slides[now].classList.contains('answered')]")
        def press(key):
            self.browser.run("window.onkeydown({key: arguments[0], preventDefault() {}})", key)
        press("ArrowRight")
        self.assertEqual(now(), ["2", False])
        question = self.browser.run("return slides.findIndex((slide) => slide.querySelector('.answer'))")
        self.browser.run("show(arguments[0])", question)
        hidden = "return getComputedStyle(slides[now].querySelector('.answer')).visibility"
        self.assertEqual(self.browser.run(hidden), "hidden")
        press(" ")
        self.assertEqual(now(), [str(question + 1), True])
        self.assertEqual(self.browser.run(hidden), "visible")
        press(" ")
        self.assertEqual(now(), [str(question + 2), False])
        press("End")
        press("ArrowRight")
        self.assertEqual(now()[0], str(self.browser.run("return slides.length")))
        press("Home")
        press("ArrowLeft")
        self.assertEqual(now()[0], "1")
        self.browser.run("document.body.click()")
        self.assertEqual(now()[0], "2")

    def test_it_prints_a_slide_a_page(self):
        count = self.open(read_chapters()[3])
        self.assertEqual(self.pages(), [(960, 540)] * count)
        self.browser.run("document.body.classList.add('noted')")
        sizes = self.pages()
        self.assertGreaterEqual(len(sizes), count)
        self.assertEqual(set(sizes), {(595, 842)})

    def pages(self) -> list[tuple[int, int]]:
        """Returns width and height of each page of a print, in points."""
        printed = self.browser.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})
        content = base64.b64decode(printed["data"])
        boxes = re.findall(rb"/MediaBox\s*\[\s*0 0 ([0-9.]+) ([0-9.]+)", content)
        return [(round(float(width)), round(float(height))) for width, height in boxes]


if __name__ == "__main__":
    unittest.main()
