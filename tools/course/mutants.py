"""Chapters whose mutants ./course test judges anew: those of which something has changed since the last green run.

Before the first one, a chapter has changed if one of its files differs from the last commit, or from where the branch
left the one that it follows. The files of a chapter's mutants are the chapter, its reference, its tests, hidden ones and
mutants, those of the chapters whose headers these include, and what all chapters share. A newer compiler is not seen;
--all judges them all.
"""

import hashlib
import os
import re
import subprocess
from pathlib import Path

from digests import digest, keep, of_last_run
from paths import ROOT
from tree import Tree

_MEMORY = "mutants-killed.json"
_SHARED = ("CMakeLists.txt", "CMakePresets.json", "solutions/CMakeLists.txt", "tests/CMakeLists.txt",
           "chapters/common/*", "tests/support/*", "tools/mutants/*.py", "tools/mutation/crowd.py",
           *(f"tools/course/{name}.py" for name in ("crash", "machine", "manifest", "marker", "symbols", "trial")))
_INCLUDED = re.compile(rb'^ *#include "(?:\.\./)*(\d\d_\w+)/', re.MULTILINE)


def chapters(root: Path = ROOT) -> list[str]:
    return sorted(folder.name for folder in (root / "tests" / "mutants").glob("[0-9][0-9]_*"))


def digests(root: Path = ROOT) -> dict[str, str]:
    """By chapter."""
    shared = digest(root, _shared(root))
    return {chapter: hashlib.sha256(f"{shared} {digest(root, _of(root, chapter))}".encode()).hexdigest()
            for chapter in chapters(root)}


def changed(tree: Tree, now: dict[str, str], root: Path = ROOT) -> list[str]:
    """Returns the chapters whose digests differ from those of the tree's last green run; before the first, those of the
    changed files; without git, all."""
    known = of_last_run(tree, _MEMORY)
    if known is not None:
        return [chapter for chapter, found in now.items() if known.get(chapter) != found]
    touched = _changed_files(root)
    # Whose a deleted file was, no file says.
    if touched is None or touched & set(_shared(root)) or not all(file.exists() for file in touched):
        return list(now)
    return [chapter for chapter in now if touched & set(_of(root, chapter))]


def remember(tree: Tree, now: dict[str, str]) -> None:
    keep(tree, _MEMORY, now)


def _changed_files(root: Path) -> set[Path] | None:
    """Returns the files that differ from the last commit, or from where the branch left the one that it follows; None
    without git or a commit."""
    try:
        top = _git(root, "rev-parse", "--show-toplevel")
        if top is None or Path(top.strip()) != root.resolve():
            return None
        left = _git(root, "merge-base", "HEAD", "@{upstream}") or "HEAD"
        listings = (_git(root, "diff", "--name-only", "--no-renames", "-z", left.strip(), "--"),
                    _git(root, "ls-files", "--others", "--exclude-standard", "-z"))
    except OSError:
        return None
    if None in listings:
        return None
    return {root / name for listing in listings for name in listing.split("\0") if name}


def _git(root: Path, *words: str) -> str | None:
    done = subprocess.run(["git", "-C", str(root), *words], capture_output=True)
    return os.fsdecode(done.stdout) if done.returncode == 0 else None


def _shared(root: Path) -> list[Path]:
    return [file for pattern in _SHARED for file in root.glob(pattern)]


def _of(root: Path, chapter: str) -> list[Path]:
    found, waiting = set(), {chapter}
    files = [file for kind in ("mutants", "hidden") for file in (root / "tests" / kind / chapter).glob("*")]
    while waiting:
        name = waiting.pop()
        found.add(name)
        # A student's own answers are no part of a mutant, and of the tests of other chapters only what can be included.
        theirs = [*(root / "chapters" / name).glob("*.hpp"), root / "chapters" / name / "hints.md",
                  *(root / "solutions" / name).glob("*.?pp"),
                  *(root / "tests" / name).glob("*.?pp" if name == chapter else "*.hpp")]
        files += theirs
        texts = [file.read_bytes() for file in theirs if file.is_file()]
        waiting |= {word.decode() for text in texts for word in _INCLUDED.findall(text)} - found
    return files
