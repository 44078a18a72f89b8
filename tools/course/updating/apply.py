"""Carries out a plan in the folder of the course."""

import os
import shutil
import sys
from pathlib import Path

from paths import ROOT
from updating import trees
from updating.plan import Plan


def apply(plan: Plan, what_helps: str) -> None:
    """Carries out the plan; prints `what_helps` if it is interrupted."""
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
    """Copies a file with its dates, and never over an existing one."""
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
    """Removes folders without files from the places of files to come."""
    for path in plan.writes:
        there = ROOT / path
        if there.is_dir() and not there.is_symlink():
            shutil.rmtree(there)
