"""The slowest of the fast tests. Once all tests have passed, ./course test runs each of these again only if one of its
files has changed. A newer compiler is not seen; --all runs them all.
"""

from pathlib import Path

from digests import digest, keep, of_last_run
from paths import ROOT
from tree import Tree

_MEMORY = "slowest-passed.json"
_ANSWERS = ("course", "CMakeLists.txt", "CMakePresets.json", "chapters", "solutions/CMakeLists.txt", "solutions/[0-9]*",
            "tests/CMakeLists.txt", "tests/[0-9]*", "tests/hidden", "tests/remote", "tests/support", "tests/submissions",
            "tests/weights.csv", "tests/tools", "tools")
# The files and folders of each, besides its own.
_FILES = {"tools.stubs": _ANSWERS,
          "tools.course_check": _ANSWERS,
          "tools.grade_class": _ANSWERS,
          "tools.course_run": (*_ANSWERS, "solutions", "plots")}


def now(strict: bool, root: Path = ROOT) -> dict[str, str]:
    """Returns the digest of each test's files, by test. With `strict`, a warning fails a test, so it is another digest."""
    return {name: f"{'strict ' if strict else ''}{digest(root, _files(root, name))}" for name in _FILES}


def unchanged(tree: Tree, now: dict[str, str]) -> list[str]:
    """Returns the tests whose files are those of the tree's last green run."""
    known = of_last_run(tree, _MEMORY) or {}
    return [name for name, found in now.items() if known.get(name) == found]


def remember(tree: Tree, now: dict[str, str]) -> None:
    keep(tree, _MEMORY, now)


def _files(root: Path, name: str) -> list[Path]:
    own = root / "tests" / "tools" / f"test_{name.removeprefix('tools.')}.py"
    found = {own}
    for place in (place for pattern in _FILES[name] for place in root.glob(pattern)):
        found |= {file for file in place.rglob("*") if _counts(file)} if place.is_dir() else {place}
    return sorted(found)


def _counts(file: Path) -> bool:
    is_another_test = file.parent.parts[-2:] == ("tests", "tools") and file.name.startswith("test_")
    return "__pycache__" not in file.parts and not is_another_test
