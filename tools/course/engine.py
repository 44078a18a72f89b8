"""The programs of the engine, at full speed: built when they are needed."""

from pathlib import Path

import diagnostics
from errors import CourseError
from tree import Tree

RELEASE = Tree("release")


def program(target: str) -> Path:
    """The path of the program, up to date."""
    built = RELEASE.build([target], f"building the engine{_how_long()}", keep_going=True)
    if built.ok:
        return RELEASE.program(target)
    does_not_link = diagnostics.linker_error(built.output)
    if does_not_link and target.endswith("_mine"):
        raise CourseError(f"your functions do not link with the rest: {does_not_link}")
    raise RELEASE.own_failure(built)


def _how_long() -> str:
    return "" if (RELEASE.path / "solutions" / "libspook_scenes.a").exists() else " (a minute or so, the first time)"
