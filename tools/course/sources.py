"""Refuses commands that need the reference's sources in a repository for students, which has it compiled."""

from errors import CourseError
from paths import SOLUTIONS


def need_sources(command: str) -> None:
    if (SOLUTIONS / "compiled").exists():
        raise CourseError(f"{command} needs the reference's sources, and this repository for students has none")
