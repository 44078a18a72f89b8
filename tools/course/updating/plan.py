"""Plans an update: decides about each file before anything is changed.

It compares three states: `base`, the release that the student began from; `target`, the release to come; and the
student's files. A file that the student has not changed becomes the target's. An exercise that the student has changed
stays, and moves with its chapter. Any other file that both have changed is kept aside under a new name.
"""

import os
from collections.abc import Set
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from errors import CourseError
from paths import ROOT
from updating import trees
from updating.exercises import Homes
from updating.trees import Entry, Tree


@dataclass
class Plan:
    before: Tree = field(default_factory=dict)  # of all paths that are touched; what is there now
    writes: Tree = field(default_factory=dict)
    removals: set[str] = field(default_factory=set)
    moves: dict[str, str] = field(default_factory=dict)  # the student's, from and to
    aside: dict[str, str] = field(default_factory=dict)  # the student's, from and to; the target's comes in its place
    kept: list[str] = field(default_factory=list)  # exercises that the student has changed, where they are now

    def touched(self) -> set[str]:
        pairs = self.moves | self.aside
        return {*self.writes, *self.removals, *pairs, *pairs.values()}

    def saved_since(self) -> list[str]:
        """Lists the paths whose files were saved after they were planned for."""
        now = trees.on_disk(self.touched())
        return sorted(path for path in self.touched() if now.get(path) != self.before.get(path))

    def after(self) -> Tree:
        """Returns the state of all touched paths after the plan is carried out."""
        result = {path: entry for path, entry in self.before.items() if path in self.touched()}
        for old, new in (self.aside | self.moves).items():
            result[new] = self.before[old]
        for path in (self.removals | set(self.moves)) - set(self.moves.values()):
            result.pop(path, None)
        return result | self.writes


def plan(base: Tree, target: Tree, homes: Homes) -> Plan:
    """Compares the files in the folder of the course."""
    now = trees.on_disk(base.keys() | target.keys())
    made = Plan()
    _keep_answers(made, base, now, homes)
    arriving = set(made.moves.values())
    _move_companions(made, homes, base.keys() | target.keys())
    for path in sorted(base.keys() | target.keys()):
        wanted, is_there = target.get(path), now.get(path)
        if path in made.kept or path in made.moves:
            continue
        if path in arriving:
            if is_there and is_there.blob not in _blobs(wanted, base.get(path)):
                made.aside[path] = _free_name(path, target, made)
            continue
        if wanted == base.get(path) or _same(is_there, wanted):
            continue
        if is_there and not _same(is_there, base.get(path)):
            made.aside[path] = _free_name(path, target, made)
        if wanted:
            made.writes[path] = wanted
        elif is_there:
            made.removals.add(path)
    made.before = now | trees.on_disk(made.touched() - now.keys())
    _refuse_obstacles(made)
    return made


def merged(base: Tree, target: Tree, ours: Tree, homes: Homes) -> Tree:
    """Applies the same rules to a commit of the student's or to git's index."""
    result = dict(target)
    for path in base.keys() - ours.keys():
        if target.get(path) == base[path]:
            result.pop(path)  # deleted by the student, unchanged by the release
    for path, entry in ours.items():
        if entry == base.get(path):
            continue
        if path in homes:
            result[homes[path] or path] = entry
        elif target.get(path) == base.get(path):
            result[path] = entry
    return _without_clashes(result, target)


def _keep_answers(made: Plan, base: Tree, now: Tree, homes: Homes) -> None:
    for path, home in sorted(homes.items()):
        if path not in now or _same(now[path], base.get(path)):
            continue
        if home in (None, path):
            made.kept.append(path)
        else:
            made.moves[path] = home


def _move_companions(made: Plan, homes: Homes, known: Set[str]) -> None:
    """Moves files of ./course reset and ./course try along with their exercise to another folder."""
    for path, home in homes.items():
        if home is None or PurePosixPath(path).parent == PurePosixPath(home).parent:
            continue
        old, new = Path(path), Path(home)
        beside = [file.relative_to(ROOT) for file in (ROOT / old.parent).glob(f"{old.name}.mine-*")]
        playground = old.parent / "try" / f"try_{old.name}"
        found = {file.as_posix(): (new.parent / file.name).as_posix() for file in beside}
        found[playground.as_posix()] = (new.parent / "try" / playground.name).as_posix()
        made.moves |= {source: place for source, place in found.items()
                       if source not in known and (ROOT / source).is_file() and not os.path.lexists(ROOT / place)}


def _same(one: Entry | None, other: Entry | None) -> bool:
    """Compares content and kind only: git restores permissions."""
    return (one and (one.blob, one.mode == "120000")) == (other and (other.blob, other.mode == "120000"))


def _blobs(*entries: Entry | None) -> set[str]:
    return {entry.blob for entry in entries if entry}


def _free_name(path: str, target: Tree, made: Plan) -> str:
    """Returns an unused name beside the file, one that no build looks for."""
    number = 1
    while True:
        name = f"{path}.mine-{number}"
        taken = (*made.aside.values(), *made.moves.values())
        if not os.path.lexists(ROOT / name) and name not in target and name not in taken:
            return name
        number += 1


def _refuse_obstacles(made: Plan) -> None:
    """Raises if a folder is in the place of a file, or a file or link in that of a folder."""
    arriving = {*made.writes, *made.moves.values(), *made.aside.values()}
    going = made.removals | set(made.moves)
    for path in sorted(arriving):
        for folder in list(PurePosixPath(path).parents)[:-1]:
            there = ROOT / folder
            if os.path.lexists(there) and (there.is_symlink() or not there.is_dir()) and folder.as_posix() not in going:
                raise CourseError(f"{folder} must be a folder for {path} of the release, and is not; "
                                  "rename it and update again (nothing was changed)")
        there = ROOT / path
        if there.is_dir() and not there.is_symlink() and _holds_other_files(there, going):
            raise CourseError(f"{path} is a folder, and a file of the release; rename the folder and update again "
                              "(nothing was changed)")


def _holds_other_files(folder: Path, going: set[str]) -> bool:
    return any(file.relative_to(ROOT).as_posix() not in going
               for file in folder.rglob("*") if file.is_symlink() or not file.is_dir())


def _without_clashes(result: Tree, target: Tree) -> Tree:
    """Drops a student's file whose name is a folder of the release, or the reverse."""
    folders = {parent.as_posix() for path in target for parent in PurePosixPath(path).parents}
    return {path: entry for path, entry in result.items()
            if path in target or path not in folders
            and not any(parent.as_posix() in target for parent in PurePosixPath(path).parents)}
