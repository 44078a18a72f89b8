"""All mutants of an exercise: compiled, run, and the survivors looked at alone."""

import hashlib
import json
import subprocess
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

import crowd
from commands import Commands, commands
from crowd import Crowd
from errors import CourseError
from manifest import Exercise
from mutant import Mutant
from mutate import mutants_of
from outcome import EQUIVALENT, KILLED, NOT_COMPILED, SURVIVED, outcome
from paths import CHAPTERS, SOLUTIONS
from symbols import reference_functions
from tree import Tree

_TOGETHER = 40
_SHORTEST_LIMIT = 2.0  # seconds


@dataclass(frozen=True)
class Result:
    mutant: Mutant
    outcome: str
    by: str = ""


class ExerciseRun:
    def __init__(self, tree: Tree, exercise: Exercise, jobs: int,
                 on_done: Callable[[int], None] = lambda count: None):
        self._tree, self._exercise, self._jobs, self._on_done = tree, exercise, jobs, on_done
        self._text = exercise.reference.read_text(encoding="utf-8")
        self._folder = tree.path / "mutation" / exercise.function
        self._folder.mkdir(parents=True, exist_ok=True)

    def results(self) -> list[Result]:
        """Of each mutant, in the order of the file."""
        self._commands = commands(self._tree, self._exercise)
        self._built_from = _hash(self._text, *self._commands.compiler,
                                 *map(_file_hash, _headers(self._exercise.chapter)))
        mutants = mutants_of(self._text)
        key = _hash(self._built_from, repr(mutants), *map(_file_hash, self._commands.inputs()))
        kept = self._folder / "results.json"
        known = _read(kept)
        if known.get("key") == key:
            self._on_done(len(mutants))
            return [Result(Mutant(**entry["mutant"]), entry["outcome"], entry["by"])
                    for entry in known["results"]]
        self._measure()
        size = _TOGETHER if Crowd.can_hold(self._text) else 1
        groups = [mutants[k:k + size] for k in range(0, len(mutants), size)]
        with ThreadPoolExecutor(self._jobs) as pool:
            results = [result for group in pool.map(self._group, groups) for result in group]
        kept.write_text(json.dumps({"key": key, "results": [asdict(result) for result in results]}))
        return results

    def _measure(self) -> None:
        """The reference must pass, compiled as a student's file is; a mutant has ten times as long."""
        compiled = self._alone("reference", self._text)
        if not compiled:
            raise CourseError(f"{self._exercise.label}: the reference does not compile as a student's file")
        program = compiled.with_name("program")
        self._linked([compiled], program)
        begin = time.monotonic()
        found = outcome(program, self._exercise.suite, 600, None, crowd.VARIABLE)
        self._limit = max(_SHORTEST_LIMIT, 10 * (time.monotonic() - begin))
        if found[0] != SURVIVED:
            raise CourseError(f"{self._exercise.label}: the reference fails its own tests: {' '.join(found)}")
        self._reference = _stripped(compiled)

    def _group(self, mutants: list[Mutant]) -> list[Result]:
        texts = {k: mutant.of(self._text) for k, mutant in enumerate(mutants, 1)}
        name = _hash(self._built_from, *texts.values())[:16]
        folder = self._folder / name
        folder.mkdir(exist_ok=True)
        if len(mutants) == 1:
            program, compiled = self._single(folder, texts[1])
            good = {1: None} if compiled else {}
        else:
            program, good = self._crowd(folder, texts)
        # A program that is what it was, whatever else has been built since, does what it did.
        kept, key = folder / "outcomes.json", _file_hash(program) if good else ""
        known = _read(kept)
        if known.get("key") != key:
            found = []
            for k, mutant in enumerate(mutants, 1):
                found.append(self._judge(mutant, program, good[k]) if k in good else (NOT_COMPILED, ""))
                self._on_done(1)
            known = {"key": key, "outcomes": found}
            kept.write_text(json.dumps(known))
        else:
            self._on_done(len(mutants))
        return [Result(mutant, *found) for mutant, found in zip(mutants, known["outcomes"])]

    def _judge(self, mutant: Mutant, program: Path, number: int | None) -> tuple[str, str]:
        found = outcome(program, self._exercise.suite, self._limit, number, crowd.VARIABLE)
        return self._judge_alone(mutant) if found[0] == SURVIVED else found

    def _judge_alone(self, mutant: Mutant) -> tuple[str, str]:
        """A survivor is compiled by itself, exactly as a student's file is: to see whether it is one, and not
        the reference in other words."""
        text = mutant.of(self._text)
        compiled = self._alone(f"alone-{_hash(text)[:16]}", text)
        if not compiled:
            return NOT_COMPILED, ""
        if _stripped(compiled) == self._reference:
            return EQUIVALENT, ""
        program = compiled.with_name("program")
        self._linked([compiled], program)
        return outcome(program, self._exercise.suite, self._limit, None, crowd.VARIABLE)

    def _single(self, folder: Path, text: str) -> tuple[Path, bool]:
        compiled = self._alone(folder.name, text)
        if compiled:
            self._linked([compiled], folder / "program")
        return folder / "program", bool(compiled)

    def _alone(self, name: str, text: str) -> Path | None:
        """The object of a file by itself, named as the exercise is: objects hold it. None if it isn't C++."""
        folder = self._folder / name
        folder.mkdir(exist_ok=True)
        source = folder / self._exercise.reference.name
        compiled = source.with_suffix(".o")
        record = folder / "compiled.json"
        key = _hash(self._built_from, text)
        if _read(record) != {"key": key}:
            source.write_text(text, encoding="utf-8")
            compiled.unlink(missing_ok=True)
            self._commands.compile(source, compiled)
            record.write_text(json.dumps({"key": key}))
        return compiled if compiled.exists() else None

    def _crowd(self, folder: Path, texts: dict[int, str]) -> tuple[Path, dict[int, int]]:
        """A program with all that compile, and their numbers in it."""
        compiled, record = folder / "crowd.o", folder / "compiled.json"
        good = {int(k) for k in _read(record).get("good", [])} if compiled.exists() else set()
        if not good:
            good = self._compile_crowd(folder, dict(texts))
            record.write_text(json.dumps({"good": sorted(good)}))
        program = folder / "program"
        switch = folder / "switch.o"
        self._linked([switch, compiled], program)
        found = outcome(program, self._exercise.suite, self._limit, 0, crowd.VARIABLE)
        if found[0] != SURVIVED:
            raise CourseError(f"{self._exercise.label}: unchanged among mutants it fails: {' '.join(found)}")
        return program, {k: k for k in good if k}

    def _compile_crowd(self, folder: Path, texts: dict[int, str]) -> set[int]:
        source, compiled = folder / "crowd.cpp", folder / "crowd.o"
        texts = {0: self._text} | texts
        while True:
            everyone = Crowd(texts)
            source.write_text(everyone.source(), encoding="utf-8")
            said = self._commands.compile(source, compiled)
            if said.returncode == 0:
                break
            culprits = everyone.culprits(said.stderr)
            if 0 in culprits or not culprits:
                raise CourseError(f"{self._exercise.label} does not compile in many namespaces",
                                  said.stderr[:2000])
            texts = {k: text for k, text in texts.items() if k not in culprits}
        wanted = reference_functions(self._tree, self._exercise)
        (folder / "switch.cpp").write_text(everyone.switch(compiled, wanted), encoding="utf-8")
        said = subprocess.run([self._commands.compiler[0], "-o", str(folder / "switch.o"), "-c",
                               str(folder / "switch.cpp")], capture_output=True, text=True)
        if said.returncode != 0:
            raise CourseError("the switch between mutants does not compile", said.stderr[:2000])
        return set(texts)

    def _linked(self, objects: list[Path], program: Path) -> None:
        said = self._commands.link(objects, program)
        if said.returncode != 0:
            raise CourseError(f"mutants of {self._exercise.label} do not link", said.stderr[:2000])


def _hash(*texts: str) -> str:
    whole = hashlib.sha256()
    for text in texts:
        whole.update(text.encode() + b"\0")
    return whole.hexdigest()


def _file_hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _headers(chapter: int) -> list[Path]:
    """What decides, with the texts, what is compiled: the headers, and how a crowd is put together."""
    of_chapters = [*CHAPTERS.glob("[0-9]*/*.hpp"), *SOLUTIONS.glob("[0-9]*/*.hpp")]
    return sorted([*(path for path in of_chapters if int(path.parent.name[:2]) <= chapter),
                   *CHAPTERS.glob("common/*.hpp"), Path(crowd.__file__)])


def _read(path: Path) -> dict:
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def _stripped(compiled: Path) -> bytes:
    """The object without the lines' numbers."""
    result = compiled.with_suffix(".stripped")
    subprocess.run(["objcopy", "--strip-debug", str(compiled), str(result)], check=True)
    return result.read_bytes()
