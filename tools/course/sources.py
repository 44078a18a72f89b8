"""Refuses what needs the reference's sources in a repository that has it compiled, as students have it."""

from errors import CourseError
from paths import SOLUTIONS


def need_sources(command: str) -> None:
    if (SOLUTIONS / "compiled").exists():
        raise CourseError(f"{command} needs the reference's sources, and this repository for students has none")
