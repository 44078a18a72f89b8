"""A browser for tests: Debian's Chromium, headless, with software rendering."""

import io
import tempfile
import time
import unittest
from pathlib import Path

import sandbox  # noqa: F401  (finds the course's modules)

from chromium import headless
from needs import BOOK_NEEDS, BROWSER_NEEDS, VIEW_NEEDS

SIZE = (1280, 800)
_PATIENCE = 60  # seconds, where other tests take the processors


def browser_for_book(case: type[unittest.TestCase]) -> Path:
    """Gives a test case a browser, and returns an empty folder for a book. Skips the case where either lacks packages."""
    if missing := [need.package for need in BOOK_NEEDS if not need.there()]:
        raise unittest.SkipTest(f"no book: {', '.join(missing)} not installed")
    case.browser = Browser()
    case.addClassCleanup(case.browser.close)
    folder = tempfile.TemporaryDirectory()
    case.addClassCleanup(folder.cleanup)
    return Path(folder.name)


class Browser:
    """Skips the test if there is no browser."""

    def __init__(self):
        missing = [need.package for need in (*VIEW_NEEDS, *BROWSER_NEEDS) if not need.there()]
        if missing:
            raise unittest.SkipTest(f"no browser for tests: {', '.join(missing)} not installed")
        from selenium.common.exceptions import WebDriverException
        try:
            self.driver = headless(*SIZE)
        except WebDriverException as error:  # a snap's Chromium cannot be driven
            raise unittest.SkipTest(f"no browser for tests: {str(error).splitlines()[0]}") from None
        self.driver.set_page_load_timeout(_PATIENCE)
        self.driver.set_script_timeout(_PATIENCE)

    def close(self) -> None:
        self.driver.quit()

    def emulate(self, what: str, **parameters) -> None:
        self.driver.execute_cdp_cmd(what, parameters)

    def open(self, page: Path | str, plays: bool = False) -> None:
        """Opens a page and waits until it is ready; a film waits at its start unless it `plays`."""
        self.driver.get(page if isinstance(page, str) else page.as_uri())
        self.wait("return Boolean(window.viewer && viewer.ready)")
        if not plays:
            self.run("if (viewer.player && viewer.runs) { viewer.player.play(false); viewer.scrubTo(0); }")
            self.drawn()

    def run(self, script: str, *values):
        return self.driver.execute_script(script, *values)

    def wait(self, script: str, seconds: float = _PATIENCE) -> None:
        end = time.monotonic() + seconds
        while not self.run(script):
            if time.monotonic() > end:
                raise AssertionError(f"not within {seconds} s: {script}")
            time.sleep(0.05)

    def drawn(self) -> None:
        """Waits until the settings are visible in the picture."""
        self.wait("return !viewer.stale")

    def messages(self) -> list[str]:
        """Returns warnings and errors in the console since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]

    def pixels(self):
        """Returns the picture, as rows of pixels of red, green and blue from 0 to 1."""
        import matplotlib.image
        self.drawn()
        left, top, width, height = self.run(
            "const r = document.getElementById('picture').getBoundingClientRect();"
            "return [r.left, r.top, r.width, r.height].map(Math.round)")
        image = matplotlib.image.imread(io.BytesIO(self.driver.get_screenshot_as_png()), format="png")
        return image[top:top + height, left:left + width, :3]

    def drag(self, element, start: tuple[float, float], by: tuple[float, float], hold=lambda: None,
             shift: bool = False) -> None:
        """Drags from a place in the element, by so many pixels; `hold` is called before the button is released."""
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys
        box = element.rect
        actions = ActionChains(self.driver, duration=50)
        if shift:
            actions.key_down(Keys.SHIFT)
        actions.move_to_element_with_offset(element, round(start[0] - box["width"] / 2),
                                            round(start[1] - box["height"] / 2)).click_and_hold()
        actions.move_by_offset(*by).perform()
        hold()
        ActionChains(self.driver).release().key_up(Keys.SHIFT).perform()
