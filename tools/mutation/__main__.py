"""The tests under test: every small change to a reference must fail its exercise's own tests.

    python3 tools/mutation [--chapters 1-3] [--exercise NAME] [--seeds 1,2,3] [--subtle] [--jobs 2] [--list]

With several seeds each must be noticed with all of them: one that is caught with luck is a survivor. --subtle makes
other mutants: thresholds without a unit or as a part of something, floats for doubles, state that lives on, inputs that
are changed, loops that end after sixty-four, zeros taken for nothing given, NaNs that are dropped, fields that should not
matter, and pairs of small changes.

Survivors are printed as the line before and after. Equivalent, 3+1, are those that compile to the same
object, and those that tests/mutants/equivalent.txt lists with a reason. Exit code 1 if a chapter's score is
under 95 %, or if the list is out of date.
"""

import argparse
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1] / "course"))

from equivalents import exempted, read_equivalents  # noqa: E402
from errors import BadInput, CourseError  # noqa: E402
from exercise_run import ExerciseRun, Result  # noqa: E402
from machine import require_linux  # noqa: E402
from manifest import Chapter, Exercise, read_chapters  # noqa: E402
from mutate import mutants_of  # noqa: E402
from outcome import SURVIVED  # noqa: E402
from paths import shown  # noqa: E402
from scores import NEEDED, score, table  # noqa: E402
from terminal import Live, prepare  # noqa: E402
from tree import Tree, jobs  # noqa: E402


def main(words: list[str]) -> int:
    prepare()
    options = _options(words)
    chosen = _chosen(options.chapters, options.exercise)
    if options.list:
        for _, exercises in chosen:
            for exercise in exercises:
                _list(exercise, options.subtle)
        return 0
    require_linux("mutation testing")
    tree, known = Tree("check"), read_equivalents()
    _build(tree, chosen)
    rows, complaints = [], []
    for chapter, exercises in chosen:
        everything: list[Result] = []
        for exercise in exercises:
            results, wrong = exempted(exercise, _run(tree, exercise, options), known, options.subtle)
            everything += results
            complaints += wrong
            _show_survivors(exercise, results)
            print(f"{exercise.label}: {score(results)}", flush=True)
        rows.append((chapter.folder, score(everything)))
    print(table(rows))
    low = [f"{name}: {found.percent:.1f} % detected, {NEEDED:g} % are needed" for name, found in rows
           if found.percent < NEEDED]
    for line in complaints + low:
        print(f"mutation: {line}", file=sys.stderr)
    return 1 if complaints or low else 0


def _options(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="mutation", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--chapters", default="1-99", help="a chapter, 4, or some, 1-3")
    parser.add_argument("--exercise", help="by its function, update_row, or its number, 4.2")
    parser.add_argument("--seeds", type=_seeds, default=(1,), help="of random inputs: 1,2,3")
    parser.add_argument("--subtle", action="store_true", help="the mistakes that look right")
    parser.add_argument("--jobs", type=int, default=jobs(), help="compilers and tests side by side")
    parser.add_argument("--list", action="store_true", help="the mutants, without running them")
    return parser.parse_args(words)


def _seeds(text: str) -> tuple[int, ...]:
    words = text.split(",")
    if not all(word.isdecimal() for word in words):
        raise argparse.ArgumentTypeError(f"{text!r} are no seeds, such as 1,2,3")
    return tuple(map(int, words))


def _chosen(chapters: str, name: str | None) -> list[tuple[Chapter, tuple[Exercise, ...]]]:
    first, _, last = chapters.partition("-")
    if not first.isdecimal() or (last and not last.isdecimal()):
        raise BadInput(f"--chapters: {chapters!r} is neither a chapter, 4, nor some, 1-3")
    numbers = range(int(first), int(last or first) + 1)
    found = [(chapter, tuple(exercise for exercise in chapter.exercises
                             if not name or name in (exercise.function, exercise.id)))
             for chapter in read_chapters() if chapter.number in numbers]
    found = [(chapter, exercises) for chapter, exercises in found if exercises]
    if not found:
        raise BadInput("no such exercise")
    return found


def _list(exercise: Exercise, subtle: bool) -> None:
    text = exercise.reference.read_text(encoding="utf-8")
    for mutant in mutants_of(text, subtle):
        print(f"{shown(exercise.reference)}:{mutant.line(text)}  {mutant.kind}\n"
              f"- {mutant.before(text)}\n+ {mutant.after(text)}")


def _build(tree: Tree, chosen: list[tuple[Chapter, tuple[Exercise, ...]]]) -> None:
    targets = ["spook_reference", "test_support", *(f"tests_{chapter.folder}" for chapter, _ in chosen)]
    built = tree.build(targets, "building the tests")
    if not built.ok:
        raise tree.own_failure(built)


def _run(tree: Tree, exercise: Exercise, options: argparse.Namespace) -> list[Result]:
    total = len(mutants_of(exercise.reference.read_text(encoding="utf-8"), options.subtle))
    live, done = Live(f"mutants of {exercise.label}"), 0

    def on_done(more: int) -> None:
        nonlocal done
        done += more
        live.update(f"[{done}/{total}]")

    results = ExerciseRun(tree, exercise, options.jobs, on_done, options.subtle, options.seeds).results()
    live.done()
    return results


def _show_survivors(exercise: Exercise, results: list[Result]) -> None:
    text = exercise.reference.read_text(encoding="utf-8")
    for result in results:
        if result.outcome == SURVIVED:
            mutant = result.mutant
            print(f"{shown(exercise.reference)}:{mutant.line(text)}  {mutant.kind}  {result.by}\n"
                  f"- {mutant.before(text)}\n+ {mutant.after(text)}", flush=True)


try:
    sys.exit(main(sys.argv[1:]))
except CourseError as error:
    if error.details:
        print(error.details, file=sys.stderr)
    print(f"mutation: {error}", file=sys.stderr)
    sys.exit(error.code)
