"""The instructor's files for every submission: headers, the precompiled header, reference and tests.

All of it is built once and copied to two folders. A submission is compiled with the first, which holds no answers. The
second has the reference, for the linker, and a program with each chapter's tests, which are never linked with a
student's code. After that nothing is read from the build tree, so a later build there changes no verdict.
"""

import hashlib
import json
import os
import shlex
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput, CourseError
from grading.confined import Limits
from grading.copies import Copies
from grading.isolation import Isolation, take_user
from grading.reference import Reference
from manifest import Chapter, Exercise, all_exercises
from paths import CHAPTERS, ROOT, SOLUTIONS, shown
from process import tail
from tree import Tree

CHECK = Tree("check")
_REFERENCE = "libspook_reference.a"
_TRIES = 20  # to copy files of one build, a second after one another
_LOOKING = Limits(cpu=5, wall=20, memory=1 << 30, files=0, processes=16, output=1 << 16)


@dataclass(frozen=True)
class Linking:
    """Linker options of a chapter's program: `before` the student's object, or the hidden tests, and `after` it."""

    before: tuple[str, ...]
    after: tuple[str, ...]

    def of_answer(self, exercise: Exercise, reference: Reference, object_file: str) -> list[str]:
        """Returns the options with the part of the reference that this exercise may call."""
        def chosen(word: str) -> str:
            file = Path(word)
            if file.name == _REFERENCE:
                return str(reference.archive_for(exercise))
            return str(reference.asks_only_for(exercise, file)) if file.name.startswith("answering_") else word
        return [*map(chosen, self.before), object_file, *map(chosen, self.after)]


def build_tests(chapters: list[Chapter]) -> None:
    built = CHECK.build([f"{side}_{chapter.folder}" for chapter in chapters for side in ("grade", "answer")],
                        "building the tests (some minutes, the first time)")
    if not built.ok:
        raise CHECK.own_failure(built)


def listed_tests(chapter: Chapter) -> list[str]:
    """Returns the course's own tests of a chapter, which must be built."""
    return _listed(test_program(chapter))


def test_program(chapter: Chapter) -> Path:
    """Returns the program of the course's own tests."""
    return CHECK.program(f"grade_{chapter.folder}")


def idle_tests(program: Path, tests: list[str]) -> list[str]:
    """Returns the tests of a chapter that pass although their exercise's function does nothing."""
    passing = []
    for exercise in all_exercises():
        own = [test for test in tests if test.partition(".")[0] == exercise.suite]
        if own:
            told = subprocess.run([str(program), "--idle", exercise.function], input="\n".join(own) + "\n", text=True,
                                  capture_output=True, errors="replace").stdout
            passing += [line for line in told.splitlines() if line in own]
    return passing


class Workshop:
    def __init__(self, chapters: list[Chapter], hidden: Path | None):
        self._folder = tempfile.TemporaryDirectory(prefix="grade-")
        self.root = Path(self._folder.name).resolve()
        self.root.chmod(0o711)  # a worker's folder can be reached by its name, and no other be listed
        self.headers, self.answers = self.root / "headers", self.root / "answers"
        self.reference_headers = self.root / "reference"  # which its own helpers have, and no submission sees
        _copy_headers(CHAPTERS, self.headers / "chapters")
        _copy_headers(SOLUTIONS, self.reference_headers)
        self._stage_one_build(chapters, hidden)
        self.reference = Reference(self._archive, self.answers / "reference")
        self.functions = self.reference.symbols
        self.tests = {chapter.folder: self._list_tests(chapter) for chapter in chapters}
        self.hidden_tests = {test for tests in self.tests.values() for test in tests} - self._own_tests
        self.build = self._fingerprint_of_build()
        self.sources = _fingerprint_of_sources(chapters, hidden)

    def close(self) -> None:
        self._folder.cleanup()

    def _stage_one_build(self, chapters: list[Chapter], hidden: Path | None) -> None:
        """Copies files of one build. If another process changes one of them meanwhile, begins again. So it does if the
        second build has something to do: a program may be linked with an archive that was half written."""
        build_tests(chapters)
        for _ in range(_TRIES):
            shutil.rmtree(self.answers, ignore_errors=True)
            self.answers.mkdir(mode=0o700)
            self._copies, self._own_tests = Copies(), set()
            failed = None
            with CHECK.alone():
                try:
                    self._stage(chapters, hidden)
                except (CourseError, OSError) as error:  # of a file that is half written
                    failed = error
            build_tests(chapters)
            changed = self._copies.changed()
            if not changed and failed:
                raise failed
            if not changed:
                return
            time.sleep(1)
        raise CourseError(f"{shown(changed)} changes while it is copied: another process is building there. Grade when "
                          "it has ended")

    def _stage(self, chapters: list[Chapter], hidden: Path | None) -> None:
        for commands in ("compile_commands.json", "build.ninja"):
            self._copies.watch(CHECK.path / commands)
        self._flags = self._stage_headers(chapters[0].exercises[0])
        self._counting = {exercise.function: _counting(exercise) for chapter in chapters for exercise in chapter.exercises}
        self._links = {chapter.folder: self._stage_link(f"answer_{chapter.folder}") for chapter in chapters}
        self._programs = {chapter.folder: self._stage_tests(chapter, hidden) for chapter in chapters}
        self._archive = Path(self._stage_answer(CHECK.path / "solutions" / _REFERENCE))

    def compile_command(self, exercise: Exercise, source: str, to: str) -> list[str]:
        return [*self._flags, *self._counting[exercise.function], "-c", source, "-o", to]

    def link_command(self, exercise: Exercise, object_file: str, to: str) -> list[str]:
        """Returns the linker's command, which reports the object that defines each of the exercise's functions: see
        objects.py."""
        told = [f"-Wl,--trace-symbol={symbol}" for symbol in sorted(self.functions[exercise.function])]
        return [*self._links[exercise.folder].of_answer(exercise, self.reference, object_file), *told, "-o", to]

    def test_program(self, exercise: Exercise) -> Path:
        return self._programs[exercise.folder]

    def expected_tests(self, exercise: Exercise) -> list[str]:
        """Returns the tests of an exercise, hidden ones last."""
        return [test for test in self.tests[exercise.folder] if test.split(".")[0] == exercise.suite]

    def idle_tests(self) -> set[str]:
        """Returns the tests that an idle function passes."""
        return {test for folder, tests in self.tests.items() for test in idle_tests(self._programs[folder], tests)}

    def check_unreadable(self, isolation: Isolation) -> None:
        """Checks that, without namespaces, the users of submissions cannot read the answers."""
        if isolation.name != "uid":
            return
        user = take_user(isolation)
        for answers in (SOLUTIONS, CHECK.path / "solutions", self.answers):
            if isolation.run(["/usr/bin/test", "-r", str(answers)], _LOOKING, user).code == 0:
                raise CourseError(f"a submission could read {answers}; first:  chmod go-rwx {ROOT}")
        user.release()

    def _stage_headers(self, example: Exercise) -> list[str]:
        """Adds the precompiled header, and returns the compiler's command without the file."""
        file = f"chapters/{example.folder}/{example.function}.cpp"
        counting, flags = _counting(example), []
        words = (word for word in _compile_command(lambda entry: Path(entry["file"]).match(file))
                 if word not in counting)
        for word in words:
            if word in ("-o", "-c"):
                next(words)
            elif word == "-Xclang":  # CMake hands clang both the precompiled header and the header, word by word
                option, _, name = next(words), next(words), next(words)
                flags += ["-include", str(self._stage_precompiled(Path(name)))] if option == "-include" else []
            elif word == "-include":
                flags += ["-include", str(self._stage_precompiled(Path(next(words))))]
            elif not word.startswith("-I"):
                flags.append(word)
        # Unique symbols, as GCC makes of the library's static tables, would stay global whatever objcopy is told.
        unique = ["-fno-gnu-unique"] if "clang" not in Path(flags[0]).name else []
        return [*flags, *unique, f"-I{self.headers / 'chapters'}"]

    def _stage_precompiled(self, header: Path) -> Path:
        """Copies GCC's precompiled header. Clang's must stay in place, so clang reads the header itself."""
        for name in (header, header.with_name(header.name + ".gch")):
            if name.exists():
                self._copies.copy(name, self.headers / name.name)
        return self.headers / header.name

    def _stage_link(self, target: str) -> Linking:
        before, after = [], []
        words = iter(_link_command(target))
        for word in words:
            if word == "-o":
                next(words)
            elif word.startswith("-Wl,--dependency-file="):  # CMake's since 3.27: a file in its own build tree
                continue
            elif word.endswith((".o", ".a")):
                (before if word.endswith(".o") else after).append(self._stage_answer(CHECK.path / word))
            else:
                (after if word.startswith("-l") else before).append(word)
        return Linking(tuple(before), tuple(after))

    def _stage_tests(self, chapter: Chapter, hidden: Path | None) -> Path:
        """Copies the chapter's tests as a program, linked again if there are hidden ones."""
        program = self.answers / f"grade_{chapter.folder}"
        sources = _hidden_sources(chapter, hidden)
        self._copies.copy(test_program(chapter), program)
        program.chmod(0o755)
        self._own_tests |= set(_listed(program))
        if not sources:
            return program
        link = self._stage_link(program.name)
        command = [*link.before, *(self._compile_hidden(chapter, source) for source in sources), *link.after]
        result = subprocess.run([*command, "-o", str(program)], capture_output=True, text=True)
        if result.returncode != 0:
            raise CourseError(f"the tests of {chapter.folder} do not link", tail(result.stderr))
        return program

    def _stage_answer(self, file: Path) -> str:
        """Copies each file under a name of its own; archives that chapters share are copied once."""
        copy = self.answers / hashlib.sha256(str(file).encode()).hexdigest()[:12] / file.name
        if not copy.exists():
            copy.parent.mkdir()
            self._copies.copy(file, copy)
        return str(copy)

    def _compile_hidden(self, chapter: Chapter, source: Path) -> str:
        """Compiles hidden tests with the options of the chapter's own tests."""
        compiled = self.answers / f"hidden_{chapter.folder}_{source.stem}.o"
        command = [*_without_files(_compile_command(lambda entry: f"/tests_{chapter.folder}.dir/" in entry["command"])),
                   "-c", str(source), "-o", str(compiled)]
        result = subprocess.run(command, capture_output=True, text=True, cwd=CHECK.path)
        if result.returncode != 0:
            raise BadInput(f"grade: the hidden test {source} does not compile:\n{tail(result.stderr)}")
        return str(compiled)

    def _list_tests(self, chapter: Chapter) -> list[str]:
        tests = _listed(self._programs[chapter.folder])
        strange = [test for test in tests
                   if test.split(".")[0] not in {exercise.suite for exercise in chapter.exercises}]
        if strange:
            raise BadInput(f"grade: the test {strange[0]} belongs to no exercise of {chapter.folder}; suites are "
                           f"{', '.join(exercise.suite for exercise in chapter.exercises)}")
        return tests

    def _fingerprint_of_build(self) -> str:
        """Returns a fingerprint of everything on this machine, besides the student's file, that a verdict depends
        on."""
        total = hashlib.sha256(" ".join(self._flags).replace(str(self.root), "").encode())
        total.update(repr(self._counting).encode())
        for file in sorted(self.root.rglob("*")):
            # The precompiled header differs each time that it is made; the headers in it do not.
            if file.is_file() and file.suffix not in (".gch", ".a"):
                total.update(str(file.relative_to(self.root)).encode() + b"\0" + file.read_bytes())
            elif file.suffix == ".a":
                total.update(_archive_content(file))
        for file in sorted(Path(__file__).parent.glob("*.py")):
            total.update(file.read_bytes())
        return total.hexdigest()


def _add_files(total, name: str, files: Iterable[Path]) -> None:
    for file in sorted(files):
        total.update(f"{name}/{file.parent.name}/{file.name}".encode() + b"\0" + file.read_bytes())


def _fingerprint_of_sources(chapters: list[Chapter], hidden: Path | None) -> str:
    """Returns a fingerprint of the course and its hidden tests, the same on every machine."""
    total = hashlib.sha256()
    for chapter in chapters:
        for root, pattern in ((CHAPTERS, "*.hpp"), (SOLUTIONS, "*.[ch]pp"), (ROOT / "tests", "*.[ch]pp")):
            _add_files(total, root.name, (root / chapter.folder).glob(pattern))
        if hidden:
            _add_files(total, "hidden", (hidden / chapter.folder).glob("*.[ch]pp"))
    _add_files(total, "support", (ROOT / "tests" / "support").iterdir())
    return total.hexdigest()


def _copy_headers(folder: Path, to: Path) -> None:
    for header in folder.glob("*/*.hpp"):
        copy = to / header.relative_to(folder)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(header, copy)


def _listed(program: Path) -> list[str]:
    listing = subprocess.run([str(program), "--list"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    tests = listing.stdout.split()
    if listing.returncode != 0 or not tests:
        raise CourseError(f"{program.name} cannot list its tests", tail(listing.stderr))
    return tests


def _archive_content(archive: Path) -> bytes:
    """Returns an archive's content without the times of its members."""
    return hashlib.sha256(subprocess.run(["ar", "p", str(archive)], capture_output=True).stdout).digest()


def _hidden_sources(chapter: Chapter, hidden: Path | None) -> list[Path]:
    return sorted((hidden / chapter.folder).glob("*.cpp")) if hidden else []


def check_hidden(hidden: Path | None, chapters: list[Chapter]) -> None:
    """Refuses a folder of hidden tests without tests: its path is probably wrong."""
    if hidden and not any(hidden.glob("[0-9][0-9]_*/*.cpp")):
        raise BadInput(f"grade: no hidden tests in {hidden}: they lie in NN_topic/*.cpp there, as in tests/")


def _compile_command(wanted: Callable[[dict], bool]) -> list[str]:
    """Returns the command that compiles the first of the requested files."""
    entries = json.loads((CHECK.path / "compile_commands.json").read_text(encoding="utf-8"))
    found = next(filter(wanted, entries), None)
    if not found:
        raise CourseError(f"{shown(CHECK.path)} has no command that compiles an exercise or a test; does git status "
                          f"name a file of tests/ or CMakeLists.txt as changed?")
    words = shlex.split(found["command"])
    return [*_compiler(words[0]), *words[1:]]


def _counting(exercise: Exercise) -> list[str]:
    """Returns the options that count operations; none if no test measures cost."""
    file = f"chapters/{exercise.folder}/{exercise.function}.cpp"
    words = _compile_command(lambda entry: Path(entry["file"]).match(file))
    return [word for word in words if word.startswith(("-fsanitize-coverage=", "-fno-builtin-"))]


def _without_files(command: list[str]) -> list[str]:
    words = iter(command)
    kept = []
    for word in words:
        if word in ("-o", "-c"):
            next(words)
        else:
            kept.append(word)
    return kept


def _link_command(target: str) -> list[str]:
    """Returns the last of the commands that make the target: ": && c++ ... && :"."""
    listing = subprocess.run(["ninja", "-C", str(CHECK.path), "-t", "commands", target], capture_output=True, text=True)
    command = listing.stdout.strip().splitlines()[-1].replace("-Xlinker ", "-Wl,")  # clang's word for it
    words = [word for word in shlex.split(command) if word not in (":", "&&")]
    # GoogleTest's own main is left out: tests/remote has ours.
    return [*_compiler(words[0]), *(word for word in words[1:] if not word.endswith("libgtest_main.a"))]


def _compiler(name: str) -> list[str]:
    """Returns the compiler's path under /usr, without the alternatives in /etc. clang++ is clang by another name."""
    path = os.path.realpath(name)
    is_clang = "clang" in Path(path).name
    return [path, "--driver-mode=g++"] if is_clang else [path]
