"""Finds the submissions in a delivery: one submission, a folder of them, or a platform's download.

Nobody is lost: files that belong to no submission are returned, too, with the reason.
"""

import os
from collections import Counter
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path, PurePosixPath

from errors import BadInput
from grading.archives import is_archive, is_litter, names_in, text, without_suffix
from grading.gradescope_export import METADATA, submitters
from grading.names import Student, is_late, lacks_time, look, platforms_of, safe, student_of
from grading.reading import names_apart
from grading.submission import Handed, Place, rank_of
from manifest import Exercise, all_exercises
from terminal import counted

_LOOSE = "a loose file, and its name does not say whose it is"


@dataclass
class Delivery:
    handed: list[Handed] = field(default_factory=list)
    left_out: list[tuple[str, str]] = field(default_factory=list)  # what, and why
    doubts: list[str] = field(default_factory=list)  # of downloads that have no known form

    def add(self, student: Student, *places: Place) -> None:
        self.handed.append(Handed(safe(student.name), places, student))

    def add_known(self, found: list[tuple[Student, Place]]) -> None:
        """Collects one submission for each student, in however many files and folders a platform delivers it."""
        by_student: dict[tuple[str, str], list[tuple[Student, Place]]] = {}
        for student, place in found:
            by_student.setdefault((student.name, student.identifier), []).append((student, place))
        for parts in by_student.values():
            late = any(student.late for student, _ in parts)
            self.add(replace(parts[0][0], late=late), *(place for _, place in parts))

    def drop_late(self, due: datetime | None) -> None:
        """Drops the late attempts of students who also have one on time. Those of other students stay, and are late."""
        self.handed = [_on_time(one, due) for one in self.handed]

    def without_time(self, due: datetime | None) -> list[str]:
        """Returns the names of submissions of which some attempt has no time that can be read."""
        return [one.name for one in self.handed if any(lacks_time(place.name, due) for place in one.places)]


def _on_time(handed: Handed, due: datetime | None) -> Handed:
    late = [place for place in handed.places if is_late(place.name, due)]
    on_time = tuple(place for place in handed.places if place not in late)
    if not late:
        return handed
    if not on_time:
        return replace(handed, student=replace(handed.student, late=True))
    note = f"late, so not counted: {', '.join(place.name for place in late)}"
    return replace(handed, places=on_time, student=replace(handed.student, late=False), notes=(*handed.notes, note))


def find_submissions(paths: list[Path], out: Path) -> Delivery:
    """Returns the submissions in these paths, sorted by name. Equal names are made different.

    `out`, the folder for marks, may be among the paths and is ignored.
    """
    delivery = Delivery()
    exercises = all_exercises()
    for path in paths:
        if not path.exists():
            raise BadInput(f"grade: there is no {path}")
        if not path.is_dir() and not is_archive(path.name):
            raise BadInput(f"grade: {path} is neither a folder nor a zip, tar.gz or 7z")
        names = _names(path, out)
        if not path.is_dir() and _is_gradescopes(names):
            raise BadInput(f"grade: {path} is Gradescope's download: unpack it, and name the folder")
        taken, doubted = len(delivery.handed), len(delivery.doubts)
        if path.is_dir() and (_is_class(names, exercises, at_top=True) or not _is_one(names, exercises)):
            _take_folder(delivery, path, names, out, exercises)
        elif not path.is_dir() and _is_class(_in_root(names)[1], exercises, at_top=False):
            _take_archive(delivery, path, names, exercises)
        else:
            delivery.add(_student(path), Place(path))
        if len(delivery.handed) == taken + 1 and len(delivery.doubts) == doubted:
            _doubt_one(delivery, path, delivery.handed[-1], out, exercises)
    delivery.handed = _named_apart(sorted(delivery.handed, key=lambda one: (one.name, str(one.places[0].path))))
    return delivery


def _doubt(delivery: Delivery, path: Path, taken: int, left_out: int, names: list[PurePosixPath],
           exercises: list[Exercise]) -> None:
    """Adds a doubt if a folder or archive is probably not a class: most of it is left out, or most of its folders hold
    no exercise's file. `taken` and `left_out`: what was before it."""
    holding = {name.parts[0] for name in names if is_archive(name.name) or rank_of(name, exercises)}
    handed, left_out = delivery.handed[taken:], len(delivery.left_out) - left_out
    empty = sum(not any(text(place.name) in holding for place in one.places) for one in handed)
    if left_out > len(handed) or 2 * empty > len(handed):
        delivery.doubts.append(f"{path} has no form that is known: of {counted(len(handed), 'submission')} in it {empty} "
                               f"hold no exercise's file, and {left_out} other things are left out.")


def _doubt_one(delivery: Delivery, path: Path, one: Handed, out: Path, exercises: list[Exercise]) -> None:
    """Adds a doubt if the only submission in a path may be several: it has an exercise in more than one folder, and no
    platform says whose it is."""
    place = one.places[0]
    if len(one.places) > 1 or place.inside or student_of(place.name, is_folder=True):
        return
    folders: dict[tuple[str, int], set[PurePosixPath]] = {}
    for name in _names(place.path, out, opened=True):
        if ranked := rank_of(name, exercises):
            folders.setdefault((ranked[0].function, ranked[1]), set()).add(name.parent)
    best = {function: min(rank for other, rank in folders if other == function) for function, _ in folders}
    several = [function for function, rank in best.items() if len(folders[function, rank]) > 1]
    if several:
        delivery.doubts.append(f"{path} is taken for one submission, but {several[0]} lies in "
                               f"{len(folders[several[0], best[several[0]]])} of its folders. If they are of several "
                               "students, name the folder that holds theirs.")
    elif not folders:
        delivery.doubts.append(f"{path} is taken for one submission, but holds no exercise's file.")


def _names(path: Path, out: Path, opened: bool = False) -> list[PurePosixPath]:
    """Returns the names in it, in an archive also in archives inside it, and in a folder if they are `opened`; none if
    it cannot be read."""
    if not path.is_dir():
        return names_apart(path)
    marks = PurePosixPath(os.path.relpath(_real(out), _real(path)))
    names = names_apart(path) if opened else names_in(path, opened=False)
    return [name for name in names if marks not in name.parents]


def _is_gradescopes(names: list[PurePosixPath]) -> bool:
    """Tells whether an archive is Gradescope's: its file is at the top, or in the only folder there, and so not a
    student's."""
    is_alone = len({name.parts[0] for name in names}) == 1
    return any(name.name == METADATA and len(name.parts) <= 1 + is_alone for name in names)


def _is_one(names: list[PurePosixPath], exercises: list[Exercise]) -> bool:
    """Tells whether the top holds a file of one submission."""
    return any(name.parts[0] == "chapters" or (len(name.parts) == 1 and rank_of(name, exercises)) for name in names)


def _is_class(names: list[PurePosixPath], exercises: list[Exercise], at_top: bool) -> bool:
    """Tells whether it holds several students' work: a platform's names, or an exercise in more than one place.

    `at_top`: for a folder that the instructor names, where each folder and archive belongs to one student.
    """
    if any(name.parts[0].lower() == "chapters" for name in names):
        return False
    tops = list(dict.fromkeys(name.parts[0] for name in names if not is_litter(name)))
    if 2 * sum(student_of(top) is not None for top in tops) >= max(len(tops), 1):
        return True
    archives = [top for top in tops if is_archive(top)]
    held = {(found[0].function, name.parts[0]) for name in names
            if len(name.parts) > 1 and (found := rank_of(name, exercises))}
    loose = sum(len(name.parts) == 1 and rank_of(name, exercises) is not None for name in names)
    if at_top and (count := len(set(archives) | {top for _, top in held})):
        return count > 1 or loose <= 1
    return loose == 0 and max(Counter(function for function, _ in held).values(), default=0) > 1


def _take_folder(delivery: Delivery, folder: Path, names: list[PurePosixPath], out: Path,
                 exercises: list[Exercise]) -> None:
    before = len(delivery.handed), len(delivery.left_out)
    known: list[tuple[Student, Place]] = []
    children = sorted(folder.iterdir())
    platforms, of_gradescope = platforms_of(text(child.name) for child in children), submitters(folder)
    # Only what the instructor names is a class, or the only thing in it: another's archive or folder may be made to
    # look like one, and to hold submissions under the names of others.
    children = [child for child in children
                if not is_litter(PurePosixPath(child.name)) and _real(child) != _real(out)]
    if not children:
        raise BadInput(f"grade: {folder} holds no submission: no chapters/, no folders, no archives")
    if len(children) == 1 and _take_only(delivery, children[0], out, exercises):
        return
    for child in children:
        shown = f"{text(folder.name)}/{text(child.name)}"
        if child.is_symlink():
            delivery.left_out.append((shown, "a link, and those are not followed"))
        elif child.name.startswith("."):
            delivery.left_out.append((shown, "hidden by its name"))
        elif child.name == METADATA and of_gradescope:
            continue
        elif of_gradescope.get(child.name) and child.is_dir():
            # Students choose their names and numbers there, so what two folders say of one is not combined.
            for student in of_gradescope[child.name]:
                delivery.add(student, Place(child))
        elif of_platform := student_of(text(child.name), platforms, child.is_dir()):
            known.append((of_platform[0], Place(child)))
        elif child.is_dir() or is_archive(child.name):
            delivery.add(_student(child), Place(child))
        else:
            is_loose = rank_of(PurePosixPath(child.name), exercises)
            why = _LOOSE if is_loose else "neither a folder nor an archive"
            delivery.left_out.append((shown, why))
    delivery.add_known(known)
    _doubt(delivery, folder, *before, names, exercises)


def _take_only(delivery: Delivery, child: Path, out: Path, exercises: list[Exercise]) -> bool:
    """Adds a class, if the only folder or archive in a folder is one, and tells whether it is."""
    if child.is_symlink() or child.name.startswith(".") or student_of(text(child.name), is_folder=child.is_dir()):
        return False
    names = _names(child, out) if child.is_dir() or is_archive(child.name) else []
    if not any(_is_class(some, exercises, at_top=False) for some in (names, _in_root(names)[1])):
        return False
    if child.is_dir():
        _take_folder(delivery, child, names, out, exercises)
    else:
        _take_archive(delivery, child, names, exercises)
    return True


def _in_root(names: list[PurePosixPath]) -> tuple[PurePosixPath, list[PurePosixPath]]:
    """Returns the folder that holds everything, if there is one, and the names in it. Who packs a folder again has it in
    the archive, and maybe further ones around it. A folder with two others may be one student's, with two versions."""
    names = [name for name in names if not is_litter(name)]
    common = os.path.commonprefix([name.parts[:-1] for name in names])
    depth = next((k for k, top in enumerate(common)
                  if is_archive(top) or top.lower() == "chapters" or student_of(top, is_folder=True)), len(common))
    inside = [PurePosixPath(*name.parts[depth:]) for name in names]
    tops = {name.parts[0] for name in inside}
    if len(tops) < 3 and not all(map(student_of, tops)):
        return PurePosixPath(), names
    return PurePosixPath(*common[:depth]), inside


def _take_archive(delivery: Delivery, archive: Path, names: list[PurePosixPath], exercises: list[Exercise]) -> None:
    """Adds a submission for each folder or archive at the archive's top, and for each student whose loose files lie
    there."""
    before = len(delivery.handed), len(delivery.left_out)
    known: list[tuple[Student, Place]] = []
    root, names = _in_root(names)
    tops = list(dict.fromkeys(name.parts[0] for name in names))
    platforms = platforms_of(tops)
    files = {name.parts[0] for name in names if len(name.parts) == 1}
    for top in tops:
        place = Place(archive, str(root / top))
        if of_platform := student_of(top, platforms, top not in files and not is_archive(top)):
            known.append((of_platform[0], place))
        elif top in files and not is_archive(top):
            delivery.left_out.append((f"{text(archive.name)}/{top}", _LOOSE))
        else:
            delivery.add(Student(without_suffix(top)), place)
    delivery.add_known(known)
    _doubt(delivery, archive, *before, names, exercises)


def _real(path: Path) -> Path:
    """Returns the target of a link; a link to itself leads to itself, without an error."""
    return Path(os.path.realpath(path))


def _student(path: Path) -> Student:
    name = text(path.resolve().name)
    known = student_of(name, is_folder=path.is_dir())
    return known[0] if known else Student(without_suffix(name) if not path.is_dir() else name)


def _named_apart(handed: list[Handed]) -> list[Handed]:
    """Distinguishes students of one name by the platform's number, or else by a count."""
    count = Counter(one.name.casefold() for one in handed)
    taken: set[str] = set()
    apart = []
    for one in handed:
        base = one.name
        if count[base.casefold()] > 1 and one.student.identifier:
            base = f"{one.name} ({one.student.identifier[:20]})"
        name, number = base, 1
        while name.casefold() in taken:
            number += 1
            name = f"{base} ({number})"
        taken.add(name.casefold())
        apart.append(Handed(name, one.places, one.student))
    return _twins_noted(apart)


def _twins_noted(handed: list[Handed]) -> list[Handed]:
    """Notes names that look alike: a name may have invisible letters, or letters of another alphabet."""
    by_look: dict[str, list[Handed]] = {}
    for one in handed:
        by_look.setdefault(look(one.student.name), []).append(one)
    noted = []
    for one in handed:
        twins = [other.name for other in by_look[look(one.student.name)] if other.student.name != one.student.name]
        note = f"its name looks like that of {', '.join(ascii(name) for name in twins[:3])}, but is {ascii(one.student.name)}"
        noted.append(replace(one, notes=(note,)) if twins else one)
    return noted
