"""Chapters whose mutants ./course test judges anew: those of which something has changed since all were killed.

A digest a chapter says of what its mutants are made: the chapter, its reference, its tests, hidden ones and mutants,
those of the chapters whose headers these include, and what all chapters share. A newer compiler is not seen; --all
judges them all.
"""

import hashlib
import json
import os
import re
from pathlib import Path

from paths import ROOT
from tree import Tree

_SHARED = ("CMakeLists.txt", "CMakePresets.json", "solutions/CMakeLists.txt", "tests/CMakeLists.txt",
           "chapters/common/*", "tests/support/*", "tools/mutants/*.py", "tools/mutation/crowd.py",
           *(f"tools/course/{name}.py" for name in ("crash", "machine", "manifest", "marker", "symbols", "trial")))
_INCLUDED = re.compile(rb'^ *#include "(?:\.\./)*(\d\d_\w+)/', re.MULTILINE)


def chapters(root: Path = ROOT) -> list[str]:
    return sorted(folder.name for folder in (root / "tests" / "mutants").glob("[0-9][0-9]_*"))


def digests(root: Path = ROOT) -> dict[str, str]:
    """By chapter."""
    shared = _digest(root, [file for pattern in _SHARED for file in root.glob(pattern)])
    return {chapter: hashlib.sha256(f"{shared} {_of(root, chapter)}".encode()).hexdigest()
            for chapter in chapters(root)}


def changed(tree: Tree, now: dict[str, str]) -> list[str]:
    """Chapters whose digests differ from those that the tree remembers; all, if it remembers none."""
    try:
        known = json.loads(_memory(tree).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        known = {}
    return [chapter for chapter, digest in now.items() if not isinstance(known, dict) or known.get(chapter) != digest]


def remember(tree: Tree, killed: dict[str, str]) -> None:
    """What was there before the mutants were built, once all of them are killed."""
    new = _memory(tree).with_suffix(".new")
    new.write_text(json.dumps(killed, indent=2) + "\n", encoding="utf-8")
    os.replace(new, _memory(tree))


def _memory(tree: Tree) -> Path:
    return tree.path / "mutants-killed.json"


def _of(root: Path, chapter: str) -> str:
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
    return _digest(root, files)


def _digest(root: Path, files: list[Path]) -> str:
    parts = hashlib.sha256()
    for file in sorted(file for file in files if file.is_file()):
        parts.update(f"{file.relative_to(root)}\0{hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    return parts.hexdigest()
