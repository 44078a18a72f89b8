"""A state of the files, path by path, read from git's objects or from the disk and written to git's objects."""

import os
import stat
import tempfile
from pathlib import Path
from typing import NamedTuple

from paths import ROOT
from updating.git import git

_LINK = "120000"


class Entry(NamedTuple):
    mode: str  # git's: 100644, 100755, 120000
    blob: str  # git's name of the content


Tree = dict[str, Entry]


def read(name: str) -> Tree:
    """Reads all files of a commit or a tree."""
    tree = {}
    for line in git("ls-tree", "-r", "-z", "--full-tree", name).split("\0"):
        about, tab, path = line.partition("\t")
        if tab:
            mode, _, blob = about.split(" ")
            tree[path] = Entry(mode, blob)
    return tree


def write(tree: Tree) -> str:
    """Writes a tree with these files, and returns git's name of it."""
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        index = {"GIT_INDEX_FILE": str(Path(folder, "index"))}
        git("update-index", "-z", "--index-info", given=_listed(tree), more=index)
        return git("write-tree", more=index)


def check_out(tree: Tree) -> None:
    """Writes these files into the folder of the course, over what is there."""
    if not tree:
        return
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        index = {"GIT_INDEX_FILE": str(Path(folder, "index"))}
        git("update-index", "-z", "--index-info", given=_listed(tree), more=index)
        git("checkout-index", "--force", "--all", "--quiet", more=index)


def text(entry: Entry) -> str:
    return git("cat-file", "blob", entry.blob)


def on_disk(paths, *, store: bool = False, exact: bool = False) -> Tree:
    """Reads the files at these paths as they are now, and names their content as git does.

    With `store`, git keeps the content. `exact` takes it byte by byte; otherwise git normalises the ends of lines.
    """
    writing = ["-w"] if store else []
    options = writing + (["--no-filters"] if exact else [])
    kinds = {path: mode for path in paths if (mode := _mode(path))}
    files = [path for path, mode in kinds.items() if mode != _LINK]
    blobs = dict(zip(files, _hashed(files, options)))
    links = {path: git("hash-object", *writing, "--stdin", given=os.fsencode(os.readlink(ROOT / path)))
             for path, mode in kinds.items() if mode == _LINK}
    return {path: Entry(kinds[path], blob) for path, blob in (blobs | links).items()}


def _mode(path: str) -> str:
    """Returns git's mode of a file; empty if there is none."""
    try:
        mode = os.lstat(ROOT / path).st_mode
    except (FileNotFoundError, NotADirectoryError):
        return ""
    if stat.S_ISLNK(mode):
        return _LINK
    return ("100755" if mode & stat.S_IXUSR else "100644") if stat.S_ISREG(mode) else ""


def _hashed(files: list[str], options: list[str]) -> list[str]:
    named = os.fsencode("".join(f"{file}\n" for file in files))
    return git("hash-object", *options, "--stdin-paths", given=named).split() if files else []


def _listed(tree: Tree) -> bytes:
    return os.fsencode("".join(f"{entry.mode} {entry.blob}\t{path}\0" for path, entry in tree.items()))
