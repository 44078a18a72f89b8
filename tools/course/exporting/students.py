"""A repository for students: the course without the reference's sources, in which all that a student does still works.

The answers to the exercises are there as objects of this machine's kind, in solutions/compiled. Mutants, submissions of
the grader's tests, hidden tests and the exam's answers are left out. Written into an earlier export, the command makes
a new release of it, which `./course update` brings into students' copies; on a machine of another kind it adds that
one's objects. What an instructor has added there stays.
"""

import os
import platform
import re
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path, PurePosixPath

from errors import BadInput, CourseError
from files import course_files
from machine import require_linux
from manifest import Exercise, all_exercises
from paths import ROOT
from pick import as_list
from reset import newest_stub_of
from terminal import counted
from tree import Tree
from version import stated_in, version

_COMPILED = Path("solutions/compiled")
_LISTED = _COMPILED / "exercises.txt"
_WRITTEN = _COMPILED / "files.txt"  # the names of an export's files, by which the next one knows them from others
_NAMED = 5
_LEFT_OUT = ("solutions/[0-9][0-9]_*/*.cpp", "tests/mutants/*/*", "tests/mutants/*.txt", "tests/submissions/*/*",
             "tests/submissions/*/*/*", "tests/submissions/*/*/*/*", "tests/hidden/*/*",
             "tools/course/examining/chapters_*", ".github/*", ".github/*/*", ".ci/*")
_OF_EXERCISES = ("hints.md", "try.md")  # without which a chapter is a text to read
_PRESETS = ("check", "release")
_UNNAMED = ("-c", "user.name=course", "-c", "user.email=course@localhost")
_VERSION = re.compile(r"^(project\(\w+ VERSION )\d+\.\d+\.\d+", re.MULTILINE)
_TAG = re.compile(r"v\d+\.\d+\.\d+")
_NOTE = """\
# The reference, compiled

This repository has no sources of the answers to its exercises. Here they are as objects, for {machines}.
`./course check`, `watch`, `run`, `plot` and all other commands for students link them where your own functions are not
yet written. `./course solution`, `./course test` and `./course grade` need the sources, and are not for this
repository.

The objects can be linked by the compiler that made them ({compiler}) and by newer ones of its kind. Elsewhere ask your
instructor, who can add another machine's objects.
"""


def write_repository(arguments) -> list[Path]:
    require_linux("./course export students")  # it takes objects apart
    if not arguments.out:
        raise BadInput("export: students needs --out DIR, the folder of the repository")
    out = Path(arguments.out)
    exercises = arguments.chapters or tuple(all_exercises())
    if out.exists() and not (out / _LISTED).exists() and any(out.iterdir()):
        raise BadInput(f"export: {out} holds files other than a repository for students")
    if ROOT == out.resolve() or ROOT in out.resolve().parents and out.resolve().parts[len(ROOT.parts)] != "build":
        raise BadInput(f"export: {out} lies in the course itself; choose a folder beside it")
    machine = f"{platform.system()}-{platform.machine()}"
    _refuse_changed(out, contents(exercises))
    with tempfile.TemporaryDirectory(prefix="students-") as scratch:
        objects = Path(scratch)
        for preset in _PRESETS:
            _compile(preset, objects / preset)
        _write(out, exercises, machine, objects)
    release = _commit(out, exercises)
    print(f"Release {release} for students: exercises of {as_list(exercises).replace(',', ', ')}; "
          f"the reference is compiled for {', '.join(_machines(out))}.\n"
          "Push it with its tags (git push --follow-tags) to where students clone it from.")
    return [out]


def _compile(preset: str, folder: Path) -> None:
    """Compiles the reference's objects, without debug information about their sources."""
    tree = Tree(preset)
    archive = "spook_reference" if preset == "check" else "reference_by_function"
    built = tree.build([archive], f"building the reference, {preset}")
    if not built.ok:
        raise tree.own_failure(built)
    folder.mkdir()
    _run(["ar", "x", str(tree.path / "solutions" / f"lib{archive}.a")], folder)
    for file in folder.iterdir():
        if file.name.startswith("operations."):  # whose source is among the chapters'
            file.unlink()
        else:
            _run(["strip", "--strip-debug", file.name], folder)


def contents(exercises: tuple[Exercise, ...]) -> dict[Path, bytes]:
    """Returns the content of each file of the export, but for what is in solutions/compiled."""
    stubs = {one.file.relative_to(ROOT): one for one in exercises}
    others = {one.file.relative_to(ROOT) for one in all_exercises()} - set(stubs)
    kept, numbers = {one.folder for one in exercises}, {one.id for one in exercises}
    found = {}
    for name in course_files():
        if name in others or _is_left_out(name, kept):
            continue
        found[name] = newest_stub_of(stubs[name]) if name in stubs else (ROOT / name).read_bytes()
        if name.name == "hints.md":
            found[name] = hints_of(found[name].decode(), numbers).encode()
    return found


def _refuse_changed(out: Path, new: dict[Path, bytes]) -> None:
    """Refuses to write over what somebody else has written there since the last export."""
    tag, theirs = _last_tag(out), set(new)
    if tag:
        ours = _written(out, tag)
        changed = _names(_git(out, "diff", "--name-only", "--no-renames", "--diff-filter=MT", "-z", tag, "--"))
        theirs = {name for name in changed if name in ours} | (theirs - ours)
    lost = [name for name in sorted(theirs) if os.path.lexists(out / name) and not _is_same(out / name, new.get(name))]
    if lost:
        named = ", ".join(map(str, lost[:_NAMED])) + (", ..." if len(lost) > _NAMED else "")
        verb = "has" if len(lost) == 1 else "have"
        raise CourseError(f"export: {counted(len(lost), 'file')} in {out} {verb} changed since {tag or 'the export'} and "
                          f"would be written over: {named}; move your lines to files of their own, and take each change "
                          f"back:  git -C {shlex.quote(str(out))} checkout {tag or 'HEAD'} -- FILE")


def _is_same(file: Path, content: bytes | None) -> bool:
    """Returns True if a file has this content, whatever version it states: an export that was interrupted wrote it."""
    if content is None or file.is_symlink() or not file.is_file():
        return False
    stated = [_VERSION.sub(r"\1", os.fsdecode(text)) for text in (file.read_bytes(), content)]
    return stated[0] == stated[1]


def _write(out: Path, exercises: tuple[Exercise, ...], machine: str, objects: Path) -> None:
    """Writes the export. Of an earlier one remain other machines' objects, and all files that it did not write."""
    new, tag = contents(exercises), _last_tag(out)
    for name in (_written(out, tag) if tag else set()) - set(new):
        (out / name).unlink(missing_ok=True)
    for name, content in new.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).unlink(missing_ok=True)
        (out / name).write_bytes(content)
        shutil.copymode(ROOT / name, out / name)
    place = out / _COMPILED / machine
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(objects, place)
    (out / _WRITTEN).write_bytes(b"".join(os.fsencode(name) + b"\n" for name in new))
    files = [f"{one.folder}/{one.function}.cpp" for one in exercises]
    (out / _LISTED).write_text("\n".join(files) + "\n", encoding="utf-8")
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()
    (out / _COMPILED / "README.md").write_text(_NOTE.format(machines=" and ".join(_machines(out)),
                                                            compiler=compiler[0] if compiler else "unknown"), encoding="utf-8")


def hints_of(text: str, numbers: set[str]) -> str:
    """Returns a hints.md, which lists the exercises of its chapter, with the sections of these exercises only."""
    head, *sections = re.split(r"(?m)^(?=## )", text)
    own = [section for section in sections if section.split()[1] in numbers]
    return (head + "".join(own)).rstrip("\n") + "\n"


def _is_left_out(name: Path, kept: set[str]) -> bool:
    if any(PurePosixPath(name).match(pattern) and len(name.parts) == pattern.count("/") + 1 for pattern in _LEFT_OUT):
        return True
    if len(name.parts) != 3 or name.parts[0] != "chapters" or name.parts[1] in kept or not name.parts[1][:2].isdecimal():
        return False
    return name.suffix == ".cpp" or name.name in _OF_EXERCISES


def _machines(out: Path) -> list[str]:
    return sorted(folder.name for folder in (out / _COMPILED).iterdir() if folder.is_dir())


def _last_tag(out: Path) -> str:
    """Returns the tag of the last export; empty if there is none."""
    tags = _git(out, "tag", "--list", "v*.*.*").split() if (out / ".git").exists() else []
    found = [tag for tag in tags if _TAG.fullmatch(tag)]
    return max(found, key=_numbers, default="")


def _numbers(tag: str) -> tuple[int, ...]:
    return tuple(map(int, tag.removeprefix("v").split(".")))


def _written(out: Path, tag: str) -> set[Path]:
    """Returns the files that an export has written, but for those in solutions/compiled."""
    files = _names(_git(out, "ls-tree", "-r", "-z", "--name-only", "--full-tree", tag))
    if _WRITTEN in files:
        return {Path(name) for name in _git(out, "show", f"{tag}:{_WRITTEN.as_posix()}").splitlines()}
    return {name for name in files if _COMPILED not in name.parents}  # an export of a course without this list


def _names(listing: str) -> list[Path]:
    return [Path(name) for name in listing.split("\0") if name]


def _commit(out: Path, exercises: tuple[Exercise, ...]) -> str:
    """Commits a release: its version is the course's, and each further export increases the last number by one."""
    if not (out / ".git").exists():
        _git(out, "init", "-q", "-b", "main")
    tag = _last_tag(out)
    own, last = _numbers(version()), _numbers(tag) if tag else None
    ours = {*map(Path, os.fsdecode((out / _WRITTEN).read_bytes()).splitlines()), *(_written(out, tag) if tag else ())}
    lists = out / "CMakeLists.txt"
    text = lists.read_text(encoding="utf-8")
    if last and last >= own:
        lists.write_text(_VERSION.sub(rf"\g<1>{'.'.join(map(str, last))}", text), encoding="utf-8")
        _stage(out, ours)
        if not _git(out, "diff", "--cached", "--name-only"):
            return ".".join(map(str, last))
        lists.write_text(_VERSION.sub(rf"\g<1>{last[0]}.{last[1]}.{last[2] + 1}", text), encoding="utf-8")
    release = stated_in(lists.read_text(encoding="utf-8"))
    _stage(out, ours)
    named = () if _git(out, "config", "--default", "", "user.email") else _UNNAMED
    _git(out, *named, "commit", "-q", "-m", f"The course {release}, exercises of {as_list(exercises)}")
    _git(out, *named, "tag", "-a", f"v{release}", "-m", f"The course {release}")
    return release


def _stage(out: Path, ours: set[Path]) -> None:
    """Adds what the export has written or removed to git's index, and no other file of the folder."""
    known = set(_names(_git(out, "ls-files", "-z")))
    names = [name for name in sorted(ours) if name in known or os.path.lexists(out / name)]
    listed = b"\0".join(map(os.fsencode, [*names, _COMPILED]))
    _run(["git", "--literal-pathspecs", "-C", str(out), "add", "-A", "-f", "--pathspec-from-file=-",
          "--pathspec-file-nul"], out, listed)


def _git(out: Path, *words: str) -> str:
    return _run(["git", "-C", str(out), *words], out)


def _run(command: list[str], folder: Path, given: bytes = b"") -> str:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, input=given)
    except FileNotFoundError:
        raise CourseError(f"export: {command[0]} is missing; ./course start installs it") from None
    if done.returncode != 0:
        raise CourseError(f"export: {command[0]} failed", os.fsdecode(done.stderr).strip())
    return os.fsdecode(done.stdout)
