"""All drawings: the functions of chapter_NN.py, and of course.py, that return a Drawing, by their files."""

import importlib
import sys
from collections.abc import Callable
from pathlib import Path

HERE = Path(__file__).resolve().parent
CHAPTERS = HERE.parents[1] / "chapters"


def drawings() -> dict[Path, Callable]:
    """Returns the function for each file: chapters/NN_topic/drawings/NAME.svg, or chapters/drawings/NAME.svg."""
    sys.path.insert(0, str(HERE))
    table = {}
    for script in [*sorted(HERE.glob("chapter_[0-9][0-9]*.py")), HERE / "course.py"]:
        folder = CHAPTERS
        if script.stem != "course":
            folder, = CHAPTERS.glob(f"{script.stem.split('_')[1]}_*")
        module = importlib.import_module(script.stem)
        for name, draw in vars(module).items():
            if getattr(draw, "__module__", "") == script.stem and not name.startswith("_") and callable(draw):
                table[folder / "drawings" / f"{name}.svg"] = draw
    return table
