"""The submitted files with an exercise's name, from a folder or an archive, and no others."""

import itertools
import os
import re
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from grading.archives import LARGEST, Entry, cause, entries_of
from grading.choices import ATTEMPTS
from grading.names import Student, attempt_of, student_of, unseen_removed, unseen_shown
from manifest import Exercise, all_exercises
from marker import is_empty, is_stub
from paths import CHAPTERS
from text_encoding import decoded, encoding_of

_NAMES_IN_A_NOTE, _NAME = 8, 200  # names, and characters of one
_NOTES, _NOTE = 30, 2000  # notes, and characters of one
_MOST_CANDIDATES = 20  # for one exercise
# Where a copy of the course keeps its own, which are not the student's.
_NOT_THEIRS = {"solutions", "tests", "plots", "tools", "build", ".git", ".course"}
_COPY = re.compile(r"(?: ?\(\d+\)| - copy(?: ?\(\d+\))?| copy(?: \d+)?| ?\(copy(?: \d+)?\)|~\d?|[-_ ](?:final|v)\d*)$"
                   r"|^(?:copy of|kopie von) ")
# Words of notes about what an instructor should look at.
A_GUESS, NOTHING_FOUND, NOT_TAKEN = ", a guess", "no file of an exercise was found in", "not an exercise's file, so not taken"
UNREAD = "cannot be read"
_ENDING = re.compile(r"\.(?:cpp|cc|cxx|cpp\.txt|txt)(?: ?\(\d+\))?$")
_DIGITS = re.compile(r"([0-9]+)")


@dataclass(frozen=True)
class Source:
    """An exercise's file: its content, or the reason why it cannot be used."""

    path: str
    content: bytes = b""
    problem: str = ""
    is_link: bool = False
    is_reference: bool = False

    @property
    def text(self) -> str:
        return self.content.decode("utf-8", errors="replace")


@dataclass(frozen=True)
class Place:
    path: Path
    inside: str = ""  # of an archive: the path in it of a folder, an archive or a file

    @property
    def name(self) -> str:
        return PurePosixPath(self.inside).name if self.inside else self.path.name


@dataclass(frozen=True)
class Handed:
    """A submission that is not read yet."""

    name: str
    places: tuple[Place, ...]
    student: Student
    notes: tuple[str, ...] = ()  # of what was noticed before it is read


@dataclass
class Submission:
    name: str
    student: Student
    sources: dict[str, Source]  # by the exercise's function
    notes: list[str] = field(default_factory=list)
    attempts: dict[str, list[Source]] = field(default_factory=dict)  # where the best counts: all, the last one first
    seconds: float = field(default=0.0, compare=False)  # of processor time in which it was read


@dataclass(frozen=True)
class _Candidate:
    rank: int  # 0: where it belongs; the higher, the more is guessed
    attempt: str  # the platform's; the last is the greatest
    entry: Entry


def read_submission(handed: Handed, exercises: list[Exercise], attempt: str = ATTEMPTS[0]) -> Submission:
    """Reads a submission, and never raises for its content: a damaged archive is a submission without files, and its
    notes give the reason."""
    submission = Submission(handed.name, handed.student, {}, list(handed.notes))
    if handed.student.late:
        submission.notes.append("late: the name that the platform gave says so, or its time")
    seen: list[str] = []
    found: dict[str, list[_Candidate]] = {}
    for place in handed.places:
        try:
            for entry in entries_of(place.path, place.inside):
                if place.inside:
                    inside = "/".join(entry.path.parts[len(PurePosixPath(place.inside).parts):])
                    entry = replace(entry, path=PurePosixPath(inside or entry.path.name))
                _look(submission, entry, place if len(handed.places) > 1 else None, exercises, seen, found)
        except Exception as error:  # a damaged archive has the library raise whatever its decoders do
            submission.notes.append(f"{place.path.name} {UNREAD}: {cause(error)}")
    for function, candidates in found.items():
        _choose(submission, function, candidates, attempt)
    if not found:
        _say_what_is_there(submission, seen)
    else:
        known = all_exercises()
        others = [name for name in seen if _is_worth_a_line(name) and not rank_of(PurePosixPath(name), known)]
        if others:
            submission.notes.append(f"{NOT_TAKEN}: {_listed(others)}")
    submission.notes = _cut(submission.notes)
    return submission


def _say_what_is_there(submission: Submission, seen: list[str]) -> None:
    """Describes the content of a submission without a file of the graded exercises."""
    exercises = all_exercises()
    known = [(name, ranked[0]) for name in seen if (ranked := rank_of(PurePosixPath(name), exercises))]
    if known:
        more = len(known) - _NAMES_IN_A_NOTE
        told = ", ".join(f"{name[:_NAME]} ({exercise.label})" for name, exercise in known[:_NAMES_IN_A_NOTE])
        submission.notes.append(f"files of exercises that are not graded this time: {told}"
                                + (f" and {more} more" if more > 0 else ""))
    elif seen:
        submission.notes.append(f"{NOTHING_FOUND} {_listed(seen)}")
    elif not any(UNREAD in note for note in submission.notes):
        submission.notes.append("no file of an exercise was found: it is empty")


def rank_of(path: PurePosixPath, exercises: list[Exercise]) -> tuple[Exercise, int] | None:
    """Returns which exercise's file it is, and how uncertain that is.

    0 in its place, or alone; 1 by its folder; 2 by its name; 3 by other capitals, marks or ending; 4 a copy.
    """
    parts = [part.lower() for part in path.parts]
    known = student_of(path.name)
    written = known[1] if known else path.name
    name = unseen_removed(written)
    ending = _ENDING.search(name.lower())
    if ".." in parts or path.is_absolute() or _NOT_THEIRS & set(parts[:-1]) or not ending:
        return None
    stem = name[: ending.start()]
    plain = _COPY.sub("", stem.lower()).strip().replace("-", "_").replace(" ", "_")
    exercise = next((one for one in exercises if one.function == plain), None)
    if not exercise:
        return None
    if _COPY.search(stem.lower()) or ending[0].endswith(")"):
        return exercise, 4
    if stem != exercise.function or name[ending.start():] != ".cpp" or name != written:
        return exercise, 3
    if path.parts[-3:-1] == ("chapters", exercise.folder) or len(parts) == 1:
        return exercise, 0
    return exercise, 1 if parts[-2] == exercise.folder else 2


def _look(submission: Submission, entry: Entry, place: Place | None, exercises: list[Exercise], seen: list[str],
          found: dict[str, list[_Candidate]]) -> None:
    """Adds a file to those that count. `place`: where it lies, if the submission has several."""
    if entry.kind == "damaged":
        submission.notes.append(entry.problem)
        return
    ranked = rank_of(entry.path, exercises)
    if not ranked:
        seen.append(str(entry.path))
        return
    attempt = attempt_of(place.name) if place else ""
    if place and entry.path.name != place.name:
        entry = replace(entry, path=PurePosixPath(place.name) / entry.path)
    found.setdefault(ranked[0].function, []).append(_Candidate(ranked[1], attempt, entry))


def _choose(submission: Submission, function: str, candidates: list[_Candidate], attempt: str) -> None:
    """Chooses the most certain file that is written; of equal ones the last or first attempt, and version in it."""
    candidates = _in_order(candidates, last=attempt != "first")
    if len(candidates) > _MOST_CANDIDATES:
        submission.notes.append(f"{len(candidates)} files could be {function}; only {_MOST_CANDIDATES} were examined")
        del candidates[_MOST_CANDIDATES:]
    sources = [_read(one.entry) for one in candidates]
    chosen = _chosen(sources)
    submission.sources[function] = sources[chosen]
    if sources[chosen].problem:
        submission.notes.append(sources[chosen].problem)
    if attempt == "best" and len(versions := _versions(candidates, sources)) > 1:
        submission.attempts[function] = versions
        return  # which one is taken is known when they are judged
    taken = candidates[chosen]
    if taken.rank > 0 or len(candidates) > 1:
        others = [source.path for k, source in enumerate(sources) if k != chosen]
        equal = any((one.rank, one.attempt) == (taken.rank, taken.attempt) and _is_answer(source)
                    for k, (one, source) in enumerate(zip(candidates, sources)) if k != chosen)
        note = f"taken for {function}: {unseen_shown(sources[chosen].path)}" + (A_GUESS if equal else "")
        submission.notes.append(note + (f"; there is also {_listed(others)}" if others else ""))


def _in_order(candidates: list[_Candidate], last: bool) -> list[_Candidate]:
    """Sorts the most certain file first; of equal ones the last attempt or the first, and in it what is less deep."""
    def kind(one: _Candidate) -> tuple[int, str, int]:
        return one.rank, one.attempt, len(one.entry.path.parts)

    candidates = sorted(candidates, key=kind)
    candidates.sort(key=lambda one: one.attempt, reverse=last)
    candidates.sort(key=lambda one: one.rank)
    return [one for _, some in itertools.groupby(candidates, kind) for one in _by_age(list(some), last)]


def _by_age(candidates: list[_Candidate], last: bool) -> list[_Candidate]:
    """Sorts versions by the numbers in their paths, if nothing else differs: v10 after v9. Others it sorts by the times
    in their archive, and where there are none by their paths."""
    def key(one: _Candidate) -> tuple:
        parts = _DIGITS.split(str(one.entry.path))
        number = [(len(part.lstrip("0")), part.lstrip("0")) for part in parts[1::2]]
        return (number,) if are_numbered else (one.entry.time, parts[::2], number)

    are_numbered = len({_DIGITS.sub("", str(one.entry.path)) for one in candidates}) == 1
    return sorted(candidates, key=key, reverse=last)


def _versions(candidates: list[_Candidate], sources: list[Source]) -> list[Source]:
    """Returns the file of each attempt, the last one first. If others in it are written and as certain, these, too."""
    found = []
    for attempt in sorted({one.attempt for one in candidates}, reverse=True):
        some = [(one.rank, source) for one, source in zip(candidates, sources) if one.attempt == attempt]
        rank, taken = some[_chosen([source for _, source in some])]
        found += [source for other, source in some
                  if source is taken or (other == rank and not taken.problem and _is_answer(source))]
    return found


def _chosen(sources: list[Source]) -> int:
    """Returns the place of the first file that is written. But what is where it belongs is what was handed in, and says
    why it can't be taken."""
    if sources[0].problem:
        return 0
    return next((k for k, source in enumerate(sources) if _is_answer(source)), 0)


def _is_answer(source: Source) -> bool:
    return not (source.problem or is_stub(source.text) or is_empty(source.text))


def _is_worth_a_line(name: str) -> bool:
    """Tells whether a file is worth a note. The course's own files are in every fork; the instructor's are used."""
    path = PurePosixPath(name)
    if ".." in path.parts or path.is_absolute():
        return True
    if _NOT_THEIRS & set(path.parts[:-1]) or not name.endswith((".cpp", ".hpp", ".h", ".cc", ".cxx")):
        return False
    return not os.path.exists(CHAPTERS / "/".join(path.parts[-2:]))  # also where no system takes such a long name


def _cut(notes: list[str]) -> list[str]:
    """Shortens text for reports: names and messages in a submission may have megabytes."""
    more = len(notes) - _NOTES
    return [note[:_NOTE] for note in notes[:_NOTES]] + ([f"{more} further notes"] if more > 0 else [])


def _listed(names: list[str]) -> str:
    more = len(names) - _NAMES_IN_A_NOTE
    listed = ", ".join(unseen_shown(name[:_NAME]) for name in sorted(names)[:_NAMES_IN_A_NOTE])
    return listed + (f" and {more} more" if more > 0 else "")


def _read(entry: Entry) -> Source:
    path = str(entry.path)[:_NAME]
    if entry.kind == "link":
        return Source(path, problem=f"{path} {UNREAD}: it is a link, and those are not followed", is_link=True)
    if entry.kind != "file":
        return Source(path, problem=f"{path} {UNREAD}: it is no regular file")
    try:
        content = entry.read() if entry.size <= LARGEST else b"x" * (LARGEST + 1)
    except Exception as error:  # as above
        return Source(path, problem=f"{path} {UNREAD}: {cause(error)}")
    if len(content) > LARGEST:
        return Source(path, problem=f"{path} {UNREAD}: it is larger than {LARGEST >> 10} KiB")
    return Source(path, _as_utf_8(content))


def _as_utf_8(content: bytes) -> bytes:
    """Converts a text to UTF-8, as compilers read it; other content does not change."""
    if encoding_of(content) not in ("UTF-16", "UTF-32"):
        return content
    try:
        return decoded(content).encode("utf-8")
    except UnicodeError:
        return content
