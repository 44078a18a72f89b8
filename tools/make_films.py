#!/usr/bin/env python3
"""Makes the films at the head of the lessons: python3 tools/make_films.py [NAME ...].

films.json describes each film: a scene with options of ./course view, its speed, the viewer's switches, and the zoom.
The viewer itself draws it, in a headless Chromium. A film is an animated WebP below 400 kB: film.webp in the chapter's
folder, and plots/film.webp for README.
"""

import argparse
import base64
import io
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "tools" / "course"))

from chromium import headless  # noqa: E402
from films import films, words  # noqa: E402

SIZE = (520, 390)
PER_SECOND = 15
MOST_BYTES = 400_000


def main() -> int:
    table = films()
    parser = argparse.ArgumentParser(description="Makes the films at the head of the lessons.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(table)}; all unless named")
    names = parser.parse_args().names or list(table)
    unknown = [name for name in names if name not in table]
    if unknown:
        parser.error(f"there is no film {unknown[0]}; there are {', '.join(table)}")
    driver = headless(*SIZE)
    try:
        for name in names:
            to = ROOT / ("plots" if name == "README" else f"chapters/{name}") / "film.webp"
            _write(_pictures(driver, table[name]), to)
    finally:
        driver.quit()
    return 0


def _pictures(driver, film: dict) -> list:
    """Returns a picture for each fifteenth of a second of the film."""
    from PIL import Image
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "film.html")
        subprocess.run([ROOT / "course", *words(film), "--out", page], check=True)
        driver.get(page.as_uri())
        _wait(driver, "return Boolean(window.viewer && viewer.ready)")
        driver.execute_script("viewer.film(arguments[0], arguments[1])", film.get("shows", []), film.get("zoom", 1.4))
        end = driver.execute_script("return viewer.player.lead.frames.slice(-1)[0].time")
        pictures = []
        for k in range(int(end / film["rate"] * PER_SECOND) + 1):
            driver.execute_script("viewer.seek(arguments[0])", k * film["rate"] / PER_SECOND)
            _wait(driver, "return !viewer.stale")
            png = base64.b64decode(driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"])
            pictures.append(Image.open(io.BytesIO(png)).convert("RGB"))
        return pictures


def _wait(driver, script: str) -> None:
    from selenium.webdriver.support.wait import WebDriverWait
    WebDriverWait(driver, 60, 0.01).until(lambda _: driver.execute_script(script))


def _write(pictures: list, to: Path) -> None:
    """Writes the film at the best quality that fits. The last picture is shown for a second."""
    durations = [1000 // PER_SECOND] * (len(pictures) - 1) + [1000]
    for quality in (80, 65, 50, 35, 20):
        data = io.BytesIO()
        pictures[0].save(data, "WEBP", save_all=True, append_images=pictures[1:], duration=durations, loop=0,
                         quality=quality, method=4)
        if len(data.getvalue()) < MOST_BYTES:
            break
    else:
        raise SystemExit(f"{to} does not fit into {MOST_BYTES} bytes: make it shorter")
    to.write_bytes(data.getvalue())
    print(f"{to.relative_to(ROOT)}: {len(pictures)} pictures, {len(data.getvalue()) // 1000} kB, quality {quality}")


if __name__ == "__main__":
    sys.exit(main())
