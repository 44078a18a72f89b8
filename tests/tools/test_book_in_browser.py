"""The book in a browser: each page loads without messages, fits a phone, and has its formulas; equations appear, and
the search finds."""

import gzip
import html
import re
import unittest
from pathlib import Path
from urllib.parse import unquote, urlsplit

from browser import SIZE, Browser
from test_book import bound

PHONE = (360, 740)


def setUpModule():
    box = bound(unittest.addModuleCleanup)
    InBrowser.browser = Browser()
    unittest.addModuleCleanup(InBrowser.browser.close)
    if (result := box.course("book", "--films")).returncode:
        raise AssertionError(result.stderr)
    InBrowser.folder = box.root / "build" / "book"


class InBrowser(unittest.TestCase):
    browser: Browser
    folder: Path

    def setUp(self):
        self.emulate()

    def tearDown(self):
        self.assertEqual(self.browser.messages(), [])

    def emulate(self, size: tuple[int, int] = SIZE, scheme: str = "light", media: str = "") -> None:
        self.browser.emulate("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1,
                             mobile=size == PHONE)
        self.browser.emulate("Emulation.setEmulatedMedia", media=media,
                             features=[{"name": "prefers-color-scheme", "value": scheme}])

    def open(self, page: str | Path) -> None:
        self.browser.driver.get((self.folder / page).as_uri() if isinstance(page, Path)
                                else f"{(self.folder / 'index.html').as_uri().removesuffix('index.html')}{page}")

    def ask(self, expression: str, *values):
        return self.browser.run(f"return {expression}", *values)

    def point_at(self, selector: str) -> None:
        from selenium.webdriver.common.action_chains import ActionChains
        element = self.browser.driver.find_element("css selector", selector)
        self.browser.run("arguments[0].scrollIntoView({ block: 'center' })", element)
        ActionChains(self.browser.driver).move_to_element(element).perform()

    def press(self, *keys: str) -> None:
        from selenium.webdriver.common.action_chains import ActionChains
        ActionChains(self.browser.driver).send_keys(*keys).perform()


class Pages(InBrowser):
    def test_every_page_on_a_desk_and_on_a_phone(self):
        pages = sorted(self.folder.rglob("*.html"))
        lessons = {page for page in pages if page.match("chapters/[0-9][0-9]_*/index.html")}
        self.assertGreater(len(lessons), 13)
        for page in pages:
            for size in (SIZE, PHONE):
                with self.subTest(page=str(page.relative_to(self.folder)), size=size):
                    self.emulate(size)
                    self.open(page)
                    self.browser.run("return document.fonts.ready.then(() => 0)")
                    self.assertEqual(self.browser.messages(), [])
                    self.assertLessEqual(self.ask("document.documentElement.scrollWidth"), size[0])
                    # Those that wait until they are near the window are asked for at once.
                    self.browser.run("for (const image of document.images) image.loading = 'eager'")
                    self.browser.wait("return [...document.images].every((image) => image.complete)")
                    self.assertEqual(self.ask("[...document.images].filter((image) => !image.naturalWidth)"
                                              ".map((image) => image.src)"), [])
                    self.assertEqual(self.ask("document.querySelectorAll('.katex-error').length"), 0)
                    self.assertTrue(self.ask("document.fonts.check('20px Book')"))
                    if page in lessons:
                        self.check_formulas(page)
                    if page in lessons or page == self.folder / "index.html":
                        self.check_commands()

    def check_formulas(self, page: Path) -> None:
        heights = self.ask("[...document.querySelectorAll('.equation .katex-html')]"
                           ".map((formula) => formula.getBoundingClientRect().height)")
        self.assertGreater(len(heights), 5, page)
        self.assertTrue(all(10 < height < 300 for height in heights), (page, heights))
        # In its own typeface: without its style sheet, a formula would show what it says to screen readers, too.
        self.assertTrue(self.ask("[...document.fonts].some((font) => font.family === 'KaTeX_Math' && "
                                 "font.status === 'loaded')"), page)

    def check_commands(self) -> None:
        """None is cut off."""
        self.assertEqual(self.ask("[...document.querySelectorAll('.shell pre')].filter((pre) => "
                                  "pre.scrollWidth > pre.clientWidth).map((pre) => pre.textContent)"), [])

    def test_dark_and_paper(self):
        light = {}
        for scheme, media in (("light", ""), ("dark", ""), ("dark", "print")):
            self.emulate(scheme=scheme, media=media)
            self.open("chapters/04_gauss_seidel/index.html")
            light[scheme, media] = self.ask("getComputedStyle(document.body).backgroundColor.match(/[0-9]+/g)"
                                            ".map(Number)")
            shown = self.ask("getComputedStyle(document.getElementById('contents')).display !== 'none'")
            self.assertEqual(shown, media != "print")
        self.assertGreater(min(light["light", ""]), 200)
        self.assertLess(max(light["dark", ""]), 60)
        self.assertEqual(light["dark", "print"], [255, 255, 255])

    def test_contents_on_a_phone(self):
        self.emulate(PHONE)
        self.open("chapters/02_quaternions/index.html")
        shown = "getComputedStyle(document.getElementById('contents')).display !== 'none'"
        self.assertFalse(self.ask(shown))
        self.browser.driver.find_element("id", "menu").click()
        self.assertTrue(self.ask(shown))
        self.browser.driver.find_element("link text", "Check").click()
        self.assertFalse(self.ask(shown))
        self.assertEqual(self.ask("location.hash"), "#check")

    def test_what_is_folded_away(self):
        self.open("chapters/04_gauss_seidel/index.html")
        self.browser.run("""const equation = document.getElementById("eq-4.10");
            const details = document.createElement("details");
            equation.replaceWith(details);
            details.append(equation);""")
        is_open = "document.getElementById('eq-4.10').parentElement.open"
        self.browser.run("dispatchEvent(new Event('beforeprint'))")
        self.assertTrue(self.ask(is_open))
        self.browser.run("dispatchEvent(new Event('afterprint'))")
        self.assertFalse(self.ask(is_open))
        self.browser.run("location.hash = '#eq-4.10'")
        self.browser.wait(f"return {is_open}")


class Reading(InBrowser):
    BUDGET = 300_000  # bytes of a lesson before its pictures, as a server sends it: text is compressed
    PICTURES = 1_800_000  # bytes of all pictures of the page of plots, in the same way

    def test_a_lesson_is_light(self):
        for page in [self.folder / "index.html", *sorted(self.folder.glob("chapters/[0-9][0-9]_*/index.html"))]:
            self.open(page)
            self.browser.run("return document.fonts.ready.then(() => 0)")
            names = self.ask("[...document.querySelectorAll('link[rel=stylesheet]'), ...document.scripts]"
                             ".map((node) => node.href || node.src).filter(Boolean)")
            files = {page, *(Path(unquote(urlsplit(name).path)) for name in names)}
            fonts = self.loaded_fonts([file for file in files if file.suffix == ".css"])
            self.assertGreaterEqual(len(fonts), 3 if page.parent != self.folder else 1, page)
            sent = (sum(len(gzip.compress(file.read_bytes())) for file in files)
                    + sum(file.stat().st_size for file in fonts))
            self.assertLess(sent, self.BUDGET, page)

    def test_the_page_of_plots_has_a_bound(self):
        """Its pictures, as a server sends them: drawings are text, which is compressed. They load when they come near."""
        page = self.folder / "plots" / "index.html"
        text = page.read_text(encoding="utf-8")
        pictures = re.findall(r"<img [^>]*>", text)
        files = {page.parent / unquote(html.unescape(re.search(r'src="([^"]+)"', picture)[1])) for picture in pictures}
        self.assertGreater(len(files), 20)
        for picture in pictures[1:]:
            self.assertIn('loading="lazy"', picture)
        sent = sum(len(gzip.compress(file.read_bytes())) for file in files)
        self.assertLess(sent, self.PICTURES, sorted(((file.stat().st_size, file.name) for file in files))[-5:])
        self.assertLess(len(gzip.compress(page.read_bytes())), 50_000)

    def test_the_first_text_needs_no_script(self):
        self.browser.emulate("Emulation.setScriptExecutionDisabled", value=True)
        self.addCleanup(self.browser.emulate, "Emulation.setScriptExecutionDisabled", value=False)
        for size in (SIZE, PHONE):
            self.emulate(size)
            for page in ("index.html", "chapters/04_gauss_seidel/index.html"):
                self.open(page)
                self.assertEqual(self.ask("document.querySelectorAll('.copy').length"), 0)  # no script has run
                for part in ("h1", "p", "figure img"):
                    top, height = self.ask("(({ top, height }) => [top, height])(document.querySelector('article ' + "
                                           "arguments[0]).getBoundingClientRect())", part)
                    self.assertTrue(0 < top < size[1] and height > 0, (page, size, part, top, height))

    def loaded_fonts(self, styles: list[Path]) -> set[Path]:
        """Returns the files of the typefaces that the page has loaded, by its style sheets."""
        def key(family: str, style: str, weight: str) -> tuple[str, str, str]:
            return family.strip("\"'"), style, {"normal": "400", "bold": "700"}.get(weight, weight)

        known = {}
        for sheet in styles:
            for face in re.findall(r"@font-face ?\{([^}]*)\}", sheet.read_text(encoding="utf-8")):
                said = {name: (re.search(rf"font-{name}: ?([^;}}]+)", face) or ["", default])[1].strip()
                        for name, default in (("family", ""), ("style", "normal"), ("weight", "normal"))}
                address = re.search(r"url\([\"']?([^)\"']+\.woff2)", face)[1]
                known[key(**said)] = sheet.parent / address
        loaded = self.ask("[...document.fonts].filter((font) => font.status === 'loaded')"
                          ".map((font) => [font.family, font.style, font.weight])")
        return {known[key(*font)] for font in loaded}

    def test_code_is_copied_as_it_stands(self):
        self.open("chapters/04_gauss_seidel/index.html")
        wanted = self.ask("document.querySelector('.shell code').textContent.trim()")
        self.assertRegex(wanted, r"\A\./course view [^\n]+\Z")
        self.browser.run("window.copied = null; Object.defineProperty(navigator, 'clipboard', { value: "
                         "{ writeText: async (text) => { window.copied = text; } } })")
        self.browser.run("document.querySelector('.shell .copy').click()")
        self.browser.wait("return window.copied !== null")
        self.assertEqual(self.ask("window.copied"), wanted)
        self.browser.wait("return document.querySelector('.shell .copy').textContent === 'copied'")

    def test_the_section_that_is_read_is_marked(self):
        self.open("chapters/04_gauss_seidel/index.html")
        marked = "[...document.querySelectorAll('#contents ol [aria-current]')].map((link) => link.textContent)"
        self.assertEqual(self.ask(marked), [])
        for anchor, title in (("the-idea", "The idea"), ("check", "Check")):
            self.browser.run("document.getElementById(arguments[0]).scrollIntoView()", anchor)
            self.browser.wait(f"return String({marked}) === '{title}'")

    def test_figures_on_a_phone(self):
        self.emulate(PHONE)
        self.open("chapters/04_gauss_seidel/index.html")
        self.assertIn("Many contacts", self.ask("document.getElementById('title').textContent"))
        self.assertNotEqual(self.ask("getComputedStyle(document.getElementById('title')).display"), "none")
        for image, natural in self.ask("[...document.querySelectorAll('.picture img[src$=\".svg\"]')].map((image) => "
                                       "[image.clientWidth, Number(image.getAttribute('width'))])"):
            self.assertEqual(image, natural)  # with letters as large as they were drawn
        self.browser.run("document.querySelector('.picture > a:has(img[src*=\"plots\"])').click()")
        self.browser.wait("return document.querySelector('#large[open] img').naturalWidth > 0")
        self.assertEqual(*self.ask("((image) => [image.clientWidth, image.naturalWidth])"
                                   "(document.querySelector('#large img'))"))
        self.browser.run("document.querySelector('#large button').click()")
        self.assertFalse(self.ask("document.getElementById('large').open"))


class Previews(InBrowser):
    PREVIEW = "(document.getElementById('preview') || { textContent: '' }).textContent"

    def test_an_equation_shows_itself_beside_its_reference(self):
        self.open("chapters/04_gauss_seidel/index.html")
        for tag, part in (("3.7", "Σ"), ("4.10", "ρ")):  # of another page, and of this one
            self.point_at(f'a.eqref[data-tag="{tag}"]')
            self.browser.wait(f"return {self.PREVIEW}.includes('{part}')")
            left, top, right, bottom = self.ask(
                "(({ left, top, right, bottom }) => [left, top, right, bottom])"
                "(document.getElementById('preview').getBoundingClientRect())")
            self.assertTrue(0 <= left < right <= SIZE[0] and 0 <= top < bottom <= SIZE[1], (left, top, right, bottom))
        self.point_at("h1")
        self.browser.wait(f"return {self.PREVIEW} === ''")

    def test_a_term_shows_its_entry_of_the_glossary(self):
        self.open("chapters/04_gauss_seidel/index.html")
        self.point_at('a.term[data-tag="term-residual"]')
        self.browser.wait(f"return {self.PREVIEW}.startsWith('residual (04)')")

    def test_with_the_keyboard(self):
        from selenium.webdriver.common.keys import Keys
        self.open("chapters/04_gauss_seidel/index.html")
        self.browser.run("document.querySelector('a.eqref[data-tag=\"3.7\"]').focus()")
        self.browser.wait(f"return {self.PREVIEW}.includes('Σ')")
        self.assertEqual(self.ask("document.activeElement.getAttribute('aria-describedby')"), "preview")
        self.press(Keys.ESCAPE)
        self.assertEqual(self.ask(self.PREVIEW), "")
        self.press(Keys.ENTER)
        self.browser.wait("return location.hash === '#eq-3.7'")
        self.assertTrue(self.ask("location.pathname").endswith("03_single_contact/index.html"))


class Search(InBrowser):
    def search(self, words: str) -> list[str]:
        if not self.ask("document.getElementById('search').open"):
            self.press("/")
        self.browser.wait("return window.bookIndex")
        box = self.browser.driver.find_element("css selector", "#search input")
        box.clear()
        box.send_keys(words)
        return self.ask("[...document.querySelectorAll('#search li')].map((item) => item.textContent)")

    def test_finds(self):
        from selenium.webdriver.common.keys import Keys
        self.open("index.html")
        for words in ("Painlevé", "painleve", "PAINLEVÉ"):
            found = self.search(words)
            self.assertTrue(found, words)
            self.assertTrue(all("Painlevé" in result for result in found), found)
            self.assertEqual(self.ask("document.querySelector('#search mark').textContent"), "Painlevé")
        self.assertTrue(any("warm start" in result for result in self.search("warm star")))
        self.assertIn("4.10", "".join(self.search("(4.10)")))
        self.assertEqual(self.search("noSuchWordAnywhere"), [])
        self.assertIn("nothing", self.ask("document.querySelector('#search [role=status]').textContent"))
        self.assertEqual(self.search("<b>"), [])
        self.search("painleve")
        self.press(Keys.ARROW_DOWN, Keys.ENTER)
        self.browser.wait("return location.pathname.includes('09_better_friction')")
        self.assertTrue(self.ask("document.getElementById(location.hash.slice(1)) !== null"))


if __name__ == "__main__":
    unittest.main()
