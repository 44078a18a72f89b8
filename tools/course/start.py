"""./course start: from a fresh clone to the first exercise."""

import json
import subprocess
import sys
from pathlib import Path

from board import progress
from engine import program
from errors import CourseError
from install import install
from machine import is_mac
from manifest import read_chapters
from needs import NEEDS
from paths import BUILD, ROOT, shown
from speed_error import measure, show_table
from terminal import paint
from verdict import CHECK

_ON_MACOS = "This course is tested on macOS 14. Grading and mutants need Linux."


def start(arguments) -> int:
    if is_mac():
        print(_ON_MACOS, flush=True)
    install(NEEDS, arguments.yes)
    spook = program("spook")
    _build_tests()
    print(f"{paint('Speed against error', 'bold')}, measured now, with the reference engine:\n", flush=True)
    results = measure(str(spook))
    show_table(results)
    print(f"\nThe same as a figure: {shown(_draw(results))}", flush=True)
    arguments.json = False
    return progress(arguments)


def _build_tests() -> None:
    """Builds what the first `check` would wait for: tests of the begun chapters, and of the next."""
    chapters = read_chapters()
    begun = [chapter for chapter in chapters if any(exercise.started() for exercise in chapter.exercises)]
    ahead = [chapter for chapter in chapters if not all(exercise.started() for exercise in chapter.exercises)][:1]
    tests = sorted({f"tests_{chapter.folder}" for chapter in begun + ahead})
    archive = CHECK.path / "solutions" / "libspook_reference.a"
    how_long = "" if archive.exists() else " (two minutes or so, the first time)"
    built = CHECK.build(["spook_reference", "test_support", *tests],
                        f"building what your exercises are tested with{how_long}")
    if not built.ok:
        raise CHECK.own_failure(built)


def _draw(results: list[dict]) -> Path:
    data, figure = BUILD / "start.json", BUILD / "start.png"
    data.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    command = [sys.executable, str(ROOT / "plots" / "start" / "draw.py"),
               "--results", str(data), "--out", str(figure)]
    drawn = subprocess.run(command, capture_output=True, text=True)
    if drawn.returncode != 0 or not figure.exists():
        said = (drawn.stderr.strip() or "nothing was drawn").splitlines()[-1]
        raise CourseError(f"plots/start/draw.py failed: {said}")
    return figure
