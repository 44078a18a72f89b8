"""./course book: all lessons and pages as a site that opens from the file system."""

import subprocess
import tempfile
from pathlib import Path

from binding.folder import has_book
from binding.outline import new_pages
from binding.site import build
from binding.views import film_pages
from engine import program_of_pages
from errors import BadInput, CourseError
from files import left_out
from install import install, offer
from manifest import Exercise
from mine import begun, program_of_own_pages, told
from needs import BOOK_NEEDS, LIVE_NEEDS, VIEW_NEEDS
from paths import BUILD, ROOT, shown
from terminal import fold

_BRANCH = "gh-pages"
_COST = "a download of 110 MB, and some minutes to compile the engine once"


def book(arguments) -> int:
    folder = _target(Path(arguments.out)) if arguments.out else BUILD / "book"
    remote = _remote(arguments.publish) if arguments.publish else ""
    install(BOOK_NEEDS, yes=False)
    mine = begun() if arguments.mine else []
    if arguments.mine:
        print(fold(told(mine) if mine else "You have written no exercise yet, so all figures are the reference's."))
    engine = None if arguments.films else _engine(mine)
    views = arguments.views or bool(mine and engine is None)  # a film itself cannot be of theirs
    count = build(folder, views, engine, mine=bool(mine))
    if views:
        film_pages(folder, mine=bool(mine))
    if left := left_out(new_pages()):
        print(left)
    print(f"{shown((folder / 'index.html').absolute())}: {count} pages. Open it in a browser.")
    if remote:
        _push(folder, remote)
        print(f"Published: branch {_BRANCH} of {remote}.")
    return 0


def _engine(mine: list[Exercise]) -> Path | None:
    """The engine of live figures, with the student's functions; None where there is nothing to make it or to draw it with,
    which is told."""
    if not offer((*LIVE_NEEDS, *VIEW_NEEDS), f"so that figures run in their pages: {_COST}"):
        missing = [need.package for need in (*LIVE_NEEDS, *VIEW_NEEDS) if not need.there()]
        print(f"Figures are films, since {' and '.join(missing)} is missing (emscripten is {_COST}).")
        return None
    return program_of_own_pages(mine) if mine else program_of_pages()


def _target(folder: Path) -> Path:
    """Checks that the target is empty or has an old book, which is replaced."""
    if folder.exists() and not has_book(folder) and not _is_empty(folder):
        raise BadInput(f"book: {folder} holds files and no book; choose another --out")
    if not folder.absolute().parent.is_dir():
        raise BadInput(f"book: {folder} cannot be written: {folder.absolute().parent} is not a folder")
    return folder


def _is_empty(folder: Path) -> bool:
    return folder.is_dir() and not any(folder.iterdir())


def _remote(name: str) -> str:
    """Returns the address of one of the course's remotes, or the given address."""
    known = _git(["-C", str(ROOT), "remote", "get-url", name])
    address = known.stdout.strip() if known.returncode == 0 else name
    reached = _git(["ls-remote", address])
    if reached.returncode != 0:
        raise BadInput(f"book: --publish must be a git remote that answers, but is {name!r}")
    return address


def _push(folder: Path, remote: str) -> None:
    """Replaces the content of the branch by one commit: earlier books can be made again from the course."""
    with tempfile.TemporaryDirectory(prefix="course-") as scratch:
        tree = ["--git-dir", scratch, "--work-tree", str(folder)]
        for words in (["init", "-q"], ["add", "-A", "-f"],
                      ["-c", "user.name=course", "-c", "user.email=course@localhost", "-c", "commit.gpgsign=false",
                       "commit", "-q", "-m", "The book"],
                      ["push", "-q", "--force", remote, f"HEAD:refs/heads/{_BRANCH}"]):
            done = _git([*tree, *words])
            if done.returncode != 0:
                raise CourseError(f"book: git {words[0] if words[0] != '-c' else 'commit'} failed", done.stderr.strip())


def _git(words: list[str]) -> subprocess.CompletedProcess:
    return subprocess.run(["git", *words], capture_output=True, text=True, stdin=subprocess.DEVNULL)
