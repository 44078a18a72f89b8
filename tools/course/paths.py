"""Where things are."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = ROOT / "chapters"
SOLUTIONS = ROOT / "solutions"
STATE = ROOT / ".course"
BUILD = Path(os.environ.get("COURSE_BUILD") or ROOT / "build").absolute()


def shown(path: Path) -> str:
    """A path as it is printed: from the root of the course, if it lies there."""
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
