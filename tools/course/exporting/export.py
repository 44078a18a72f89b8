"""./course export: kits that run the grader on other platforms, and results in their formats."""

import sys
from collections.abc import Callable
from pathlib import Path

from errors import BadInput
from exporting import autolab, github, gradescope, grades, junit, students, table, weights
from files import left_out, new_files
from grading.choices import TABLE
from grading.merge import check_graded_alike, one_of_each, read_result, read_results
from grading.results import score
from grading.roster import read_roster
from grading.text import one_line
from grading.weights import defaults, read_weights
from manifest import all_exercises

_KITS: dict[str, Callable] = {"gradescope": gradescope.write_kit, "github": github.write_kit,
                              "autolab": autolab.write_kit, "students": students.write_repository}
_OF_THE_COURSE = ("gradescope", "autolab", "students")  # kits that have the course's files in them
# What the results of several submissions can be written as, and what holds one submission only.
_OF_MANY = {"junit": junit.of_results, "csv": table.of_results}
_OF_ONE = {"gradescope": gradescope.of_result, "github": github.of_result, "autolab": autolab.of_result}
# What fills in a table that the platform has given, and where that is found.
_OF_A_ROSTER = {"canvas": "the gradebook that Canvas exports", "moodle": "the assignment's grading worksheet"}


# The options that kits, results and the other exports use; --out and --chapters are for all.
_OF_KITS = ("hidden", "seed", "hidden_seed", "weights", "points", "time_limit")
_OF_RESULTS = ("hidden", "weights", "points", "time_limit")  # the last has an error of its own
_OPTIONS = (*_OF_KITS, "roster", "assignment")
_ASSIGNMENT = "Assignment"


def export(arguments) -> int:
    what, out = arguments.what, arguments.out
    _refuse_unused(arguments)
    if what == "weights":
        return _write(weights.table(arguments.chapters), out)
    if arguments.results:
        found = one_of_each([(Path(path), _read(Path(path))) for path in arguments.results], "export")
        results = list(found.values())
        _weigh_again(results, arguments)
        check_graded_alike(results, "export")
        if what in _OF_A_ROSTER:
            return _grades(what, results, arguments)
        if what in _OF_MANY:
            return _write(_OF_MANY[what](results), out)
        if len(results) != 1:
            raise BadInput(f"export: {what} takes the results of one submission, but these are {len(results)}")
        return _write(_OF_ONE[what](results[0]), out)
    if what not in _KITS:
        raise BadInput(f"export: {what} needs results: a results.json, or a folder that ./course grade has written")
    written = _KITS[what](arguments)
    if what in _OF_THE_COURSE and (told := left_out(new_files())):
        print(told, file=sys.stderr)
    print(f"Written: {', '.join(map(str, written))}")
    return 0


def _refuse_unused(arguments) -> None:
    """Refuses results and options that would change nothing."""
    what = arguments.what
    if arguments.results and what not in (*_OF_MANY, *_OF_ONE, *_OF_A_ROSTER):
        raise BadInput(f"export: {what} takes no results, but {arguments.results[0]} is given")
    used = () if what in ("weights", "students") else _OF_KITS if what in _KITS and not arguments.results else _OF_RESULTS
    if what in _OF_A_ROSTER:
        used = (*used, "roster", "assignment") if what == "canvas" else (*used, "roster")
    for name in _OPTIONS:
        if name not in used and (value := getattr(arguments, name)) is not None:
            kind = f"{what} of results" if arguments.results and what in _KITS else what
            raise BadInput(f"export: {kind} does not use --{name.replace('_', '-')}, but it is {str(value)!r}")


def _grades(what: str, results: list[dict], arguments) -> int:
    if not arguments.roster:
        raise BadInput(f"export: {what} needs --roster FILE: {_OF_A_ROSTER[what]}")
    roster = read_roster(Path(arguments.roster))
    for name, reason in grades.not_on_it(results, roster).items():
        why = one_line(reason) or f"not in {arguments.roster}"
        print(f"left out of the import: {one_line(name)}: {why}", file=sys.stderr)
    if what == "canvas":
        return _write(grades.for_canvas(results, roster, arguments.assignment or _ASSIGNMENT), arguments.out)
    return _write(grades.for_moodle(results, roster), arguments.out)


def _weigh_again(results: list[dict], arguments) -> None:
    """Computes the points again by another table or rule, or of fewer exercises; the verdicts do not change."""
    if arguments.time_limit is not None:
        raise BadInput("export: --time-limit is for grading; these are results, graded with "
                       f"{results[0]['seconds_a_test']} s a test")
    hidden = Path(arguments.hidden) if arguments.hidden else None
    if not (arguments.weights or hidden or arguments.points or arguments.chapters):
        return
    weights = {}
    if hidden and not (hidden / "weights.csv").exists():
        raise BadInput(f"export: --hidden {hidden} has no weights.csv; of hidden tests results use only that table")
    if arguments.weights or hidden:
        table = read_weights(Path(arguments.weights or TABLE), hidden)
        graded = {test["name"] for result in results for exercise in result["exercises"] for test in exercise["tests"]}
        weights = defaults(all_exercises())
        table.check_names(list(graded | weights.keys()), {test.partition(".")[0] for test in graded})
        weights |= table.rows()
    chosen = {exercise.function: exercise for exercise in arguments.chapters or ()}
    for result in results:
        result["points"] = arguments.points or result["points"]
        if chosen:
            result["exercises"] = [exercise for exercise in result["exercises"] if exercise["function"] in chosen]
            graded = {exercise["function"] for exercise in result["exercises"]}
            if lacking := next((exercise.label for function, exercise in chosen.items() if function not in graded), ""):
                raise BadInput(f"export: {lacking} was not graded in these results")
        for exercise in result["exercises"]:
            for test in exercise["tests"]:
                test.setdefault("points", test["max_score"])
                if weight := weights.get(test["name"]):
                    test |= {"points": weight.points, "visibility": weight.visibility, "title": weight.title}
            score(exercise, result["points"])
        for key in ("score", "max_score"):
            result[key] = round(sum(exercise[key] for exercise in result["exercises"]), 9)


def _read(path: Path) -> dict[str, dict]:
    if path.is_dir():
        return read_results(path)
    result = read_result(path)
    return {result["submission"]: result}


def _write(text: str, out: str | None) -> int:
    if out:
        Path(out).write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    return 0
