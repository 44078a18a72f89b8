"""Carries out a plan in the folder of the course."""

import os
import shutil
import sys
from pathlib import Path

from paths import ROOT
from updating import trees
from updating.plan import Plan


def apply(plan: Plan, what_helps: str) -> None:
    """Names the command that helps if it is broken off."""
    try:
        for old, new in plan.aside.items():
            _copy(ROOT / old, ROOT / new)
        for old, new in plan.moves.items():
            (ROOT / new).parent.mkdir(parents=True, exist_ok=True)
            os.replace(ROOT / old, ROOT / new)
            _drop_empty_folders(ROOT / old)
        for path in sorted(plan.removals):
            (ROOT / path).unlink(missing_ok=True)
            _drop_empty_folders(ROOT / path)
        _clear_empty_folders(plan)
        trees.check_out(plan.writes)
    except BaseException:
        print(f"This stopped half-way. {what_helps}", file=sys.stderr)
        raise


def _copy(old: Path, new: Path) -> None:
    """With its dates, and never over something: the name may have been taken since it was chosen."""
    if old.is_symlink():
        os.symlink(os.readlink(old), new)
        return
    with open(old, "rb") as source, open(new, "xb") as out:
        shutil.copyfileobj(source, out)
    shutil.copystat(old, new)


def _drop_empty_folders(file: Path) -> None:
    for folder in file.parents:
        if folder == ROOT:
            return
        try:
            folder.rmdir()
        except OSError:
            return


def _clear_empty_folders(plan: Plan) -> None:
    """Where a file comes, a folder without a file may still be."""
    for path in plan.writes:
        there = ROOT / path
        if there.is_dir() and not there.is_symlink():
            shutil.rmtree(there)
