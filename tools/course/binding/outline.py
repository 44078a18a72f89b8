"""The pages of the book in reading order: a front page, then every Markdown file of the course except hints and
playgrounds."""

import os
from dataclasses import dataclass
from pathlib import Path

from files import course_files, new_files
from paths import ROOT

# Each group's title, and the files that it begins with; what no group asks for is in the last.
_GROUPS = (
    ("Chapters", ("chapters/[0-9][0-9]_*/README.md",)),
    ("To look up", ("README.md", "chapters/SYMBOLS.md", "chapters/EIGEN.md", "chapters/*.md")),
    ("Experiments", ("plots/README.md", "plots/*/README.md")),
    ("For instructors", ("INSTRUCTORS.md", "tools/course/grading/README.md")),
    ("For contributors", ("CONTRIBUTING.md", "*.md", "*/**/*.md")),
)

_NO_PAGES = ("hints.md", "try.md")  # which ./course hint and ./course try show a piece of


@dataclass(frozen=True)
class Page:
    source: Path  # from the root of the course
    title: str
    group: str

    @property
    def target(self) -> Path:
        """Returns the address of a file, relative to the site's root. The folders are the course's, so links and
        pictures stay valid."""
        if self.source == Path("README.md"):
            return Path("manual.html")
        return self.source.with_name("index.html" if self.source.name == "README.md" else f"{self.source.stem}.html")

    def text(self) -> str:
        return (ROOT / self.source).read_text(encoding="utf-8")


def pages() -> list[Page]:
    left = _pages_of(course_files())
    found = []
    for group, patterns in _GROUPS:
        for pattern in patterns:
            here = [name for name in left if _matches(name, pattern)]
            left = [name for name in left if name not in here]
            found += [MANUAL if name == MANUAL.source else Page(name, _title(name), group) for name in here]
    return found


def new_pages() -> list[Path]:
    """Returns the files of pages that git does not track, which the book leaves out."""
    return _pages_of(new_files())


def _pages_of(names: list[Path]) -> list[Path]:
    return [name for name in names if name.suffix == ".md" and name.name not in _NO_PAGES]


def _matches(name: Path, pattern: str) -> bool:
    """Matches a path with as many folders as the pattern, or any number in place of **."""
    return name.match(pattern) and ("**" in pattern or len(name.parts) == len(Path(pattern).parts))


def _title(name: Path) -> str:
    for line in (ROOT / name).read_text(encoding="utf-8").splitlines():
        if line.startswith("# "):
            return line[2:].strip().replace("`", "")
    return name.stem


FRONT = Page(Path("index.md"), "Write a physics engine", "")  # of which there is no file: binding.front
MANUAL = Page(Path("README.md"), "The manual", "To look up")


def between(here: Path, there: Path) -> str:
    """Returns the relative address from one file of the site to another."""
    return Path(os.path.relpath(there, here.parent)).as_posix()
