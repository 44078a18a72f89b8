"""Makes and runs all mutants of an exercise, and looks at survivors alone."""

import json
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from building import Building, content, content_of, read_json, stripped
from commands import commands
from crowd import VARIABLE, Crowd
from errors import CourseError
from manifest import Exercise
from mutant import Mutant
from mutate import mutants_of
from outcome import EQUIVALENT, NOT_COMPILED, SURVIVED, outcome
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
                 on_done: Callable[[int], None] = lambda count: None, subtle: bool = False,
                 seeds: tuple[int, ...] = (1,)):
        """A mutant has to be detected with each of the seeds."""
        self._subtle, self._seeds = subtle, seeds
        self._exercise, self._jobs, self._on_done = exercise, jobs, on_done
        self._text = exercise.reference.read_text(encoding="utf-8")
        self._commands = commands(tree, exercise)
        self._folder = tree.path / "mutation" / exercise.function
        self._building = Building(exercise, self._text, self._commands, reference_functions(tree, exercise),
                                  self._folder)

    def results(self) -> list[Result]:
        """Returns the result of each mutant, in the order of the file."""
        mutants = mutants_of(self._text, self._subtle)
        key = content(self._building.made_from, repr(mutants), repr(self._seeds), *map(content_of, self._commands.inputs()))
        kept = self._folder / ("subtle.json" if self._subtle else "results.json")
        known = read_json(kept)
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
        """Measures the reference, which must pass, compiled as a student's file is. A mutant gets ten times its
        time."""
        compiled = self._building.alone("reference", self._text)
        if not compiled:
            raise CourseError(f"{self._exercise.label}: the reference does not compile as a student's file")
        program = compiled.with_name("program")
        self._building.link([compiled], program)
        begin = time.monotonic()
        self._limit = 600.0
        for seed in self._seeds:
            found = self._with_seed(program, None, seed)
            if found[0] != SURVIVED:
                raise CourseError(f"{self._exercise.label}: the reference fails its own tests: {' '.join(found)}")
        self._limit = max(_SHORTEST_LIMIT, 10 * (time.monotonic() - begin) / len(self._seeds))
        self._reference = stripped(compiled)

    def _group(self, mutants: list[Mutant]) -> list[Result]:
        """Returns the mutants that are compiled together."""
        texts = {k: mutant.of(self._text) for k, mutant in enumerate(mutants, 1)}
        folder = self._folder / content(self._building.made_from, *texts.values())[:16]
        folder.mkdir(exist_ok=True)
        if len(texts) == 1:
            program, good = self._single(folder, texts[1])
        else:
            program, good = self._building.together(folder, texts)
            found = self._outcome(program, 0)
            if found[0] != SURVIVED:
                raise CourseError(f"{self._exercise.label}: among mutants it fails, unchanged: "
                                  + " ".join(found))
        # A program that is what it was, whatever else has been built since, does what it did.
        kept, key = folder / "outcomes.json", f"{content_of(program)} {self._seeds}" if good else ""
        known = read_json(kept)
        if known.get("key") != key:
            found = []
            for k, mutant in enumerate(mutants, 1):
                number = k if len(texts) > 1 else None
                found.append(self._judge(mutant, program, number) if k in good else (NOT_COMPILED, ""))
                self._on_done(1)
            known = {"key": key, "outcomes": found}
            kept.write_text(json.dumps(known))
        else:
            self._on_done(len(mutants))
        return [Result(mutant, *found) for mutant, found in zip(mutants, known["outcomes"])]

    def _single(self, folder: Path, text: str) -> tuple[Path, set[int]]:
        compiled = self._building.alone(folder.name, text)
        program = folder / "program"
        if compiled:
            self._building.link([compiled], program)
        return program, {1} if compiled else set()

    def _judge(self, mutant: Mutant, program: Path, number: int | None) -> tuple[str, str]:
        found = self._outcome(program, number)
        return self._judge_alone(mutant) if found[0] == SURVIVED else found

    def _judge_alone(self, mutant: Mutant) -> tuple[str, str]:
        """Compiles a survivor alone, exactly as a student's file, to see whether it differs from the reference."""
        text = mutant.of(self._text)
        compiled = self._building.alone(f"alone-{content(text)[:16]}", text)
        if not compiled:
            return NOT_COMPILED, ""
        if stripped(compiled) == self._reference:
            return EQUIVALENT, ""
        program = compiled.with_name("program")
        self._building.link([compiled], program)
        return self._outcome(program, None)

    def _outcome(self, program: Path, number: int | None) -> tuple[str, str]:
        """Returns the outcome with the first seed, or the seed with which it survived."""
        found = [self._with_seed(program, number, self._seeds[0])]
        for seed in self._seeds[1:]:
            if found[-1][0] == SURVIVED:
                break
            found.append(self._with_seed(program, number, seed))
        return found[-1] if found[-1][0] == SURVIVED else found[0]

    def _with_seed(self, program: Path, number: int | None, seed: int) -> tuple[str, str]:
        found = outcome(program, self._exercise.suite, self._limit, number, VARIABLE, seed)
        return (SURVIVED, f"with seed {seed}") if found[0] == SURVIVED else found
