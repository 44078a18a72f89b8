"""The folders of the course."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = ROOT / "chapters"
SOLUTIONS = ROOT / "solutions"
STATE = ROOT / ".course"
BUILD = Path(os.environ.get("COURSE_BUILD") or ROOT / "build").absolute()


def shown(path: Path) -> str:
    """Returns a path for printing: relative to the root of the course, if it is inside."""
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
