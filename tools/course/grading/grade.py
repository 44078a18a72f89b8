"""./course grade: marks for a class of submissions."""

import shutil
import signal
import sys
import time
from pathlib import Path

from errors import BadInput, CourseError
from exporting import gradescope
from grading.choices import ON_TIME
from grading.delivery import Delivery, find_submissions
from grading.feedback import FEEDBACK
from grading.gradebook import Class, not_graded, statistics_line, uncertain, write_gradebook
from grading.grader import Grader
from grading.isolation import Isolation
from grading.merge import merge, missing_shards, set_aside, write_delivery
from grading.results import write_json
from grading.roster import Roster, read_roster
from grading.names import Student
from grading.similar_page import write_similarity
from grading.submission import Handed, Place
from grading.text import one_line
from install import install
from machine import require_linux
from manifest import all_exercises
from needs import GRADE_NEEDS, NEEDS
from paths import ROOT, shown
from pick import as_list
from slurm import run_array
from sources import need_sources
from terminal import counted, fold


_NAMED = 10  # submissions that are named before a question
_UNCERTAIN = 20  # lines about files that may be others than those meant


def grade(arguments) -> int:
    """Grades a class. Ctrl-C, or SIGTERM, ends it at once, and keeps the results of finished submissions."""
    def interrupt(*_):
        raise KeyboardInterrupt
    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        return _grade(arguments)
    except KeyboardInterrupt:
        again = "the same command without --fresh" if arguments.fresh else "the same command"
        print(f"\nInterrupted. Finished results are kept; {again} continues from there.", file=sys.stderr)
        return 130
    finally:
        signal.signal(signal.SIGTERM, before)


def _grade(arguments) -> int:
    need_sources("grade")
    if arguments.due and arguments.attempt != ON_TIME:
        raise BadInput(f"grade: --due is for --attempt {ON_TIME}, but the attempt is {arguments.attempt}")
    out = Path(arguments.out)
    roster = read_roster(Path(arguments.roster)) if arguments.roster else None
    if arguments.merge:
        return _merge([Path(folder) for folder in arguments.merge], out, roster, arguments.similarity)
    require_linux("grading isolates submissions, and")
    if arguments.prepare:
        return _prepare(arguments)
    if arguments.gradescope:
        return _grade_on_gradescope(arguments, out)
    if not arguments.paths:
        raise BadInput("grade: a submission, or a folder of them, is needed; see ./course grade --help")
    delivery = find_submissions([Path(path) for path in arguments.paths], out)
    if arguments.attempt == ON_TIME:
        _say_who_has_no_time(delivery.without_time(arguments.due))
        delivery.drop_late(arguments.due)
    names = [one.name for one in delivery.handed]
    if delivery.doubts and not arguments.yes:
        _ask(delivery)
    if arguments.slurm:
        return _grade_on_slurm(arguments, out, roster, names)
    first, count = arguments.shard or (1, 1)
    handed = delivery.handed[first - 1::count]
    with Grader(arguments) as grader:
        write_delivery(out, names, delivery.left_out, (first, count))
        gone = set_aside(out, names)
        _say_how(grader, len(handed))
        start = time.monotonic()
        results = grader.grade(handed, out)
        took = time.monotonic() - start
    of_class = Class(delivery.left_out, roster if count == 1 else None)
    if results:
        write_gradebook(out, results, of_class)
    if grader.failures:
        what = "exercise or submission" if len(grader.failures) == 1 else "exercises or submissions"
        raise CourseError(f"{len(grader.failures)} {what} could not be graded; the others were, and the same command "
                          "continues from there", "\n".join(grader.failures))
    if arguments.similarity:
        _compare(out, results)
    _say_who_is_missing(not_graded(results, of_class) + [f"{one_line(name)}: graded before, and not handed in now; "
                                                         "its results are set aside" for name in gone])
    _say_what_is_uncertain(results, out)
    if not results:
        print("This shard has no submissions.")
        return 0
    print(f"{statistics_line(results)}; {took / len(results):.2g} s each.")
    print(f"{_where(out)},\nand each student's report in {shown(out / 'submissions')}/NAME/report.md.")
    return 0


def _ask(delivery: Delivery) -> None:
    """Reports how a download of unknown form was understood; on a terminal it asks before it grades."""
    for doubt in delivery.doubts:
        print(fold(doubt))
    print(fold(f"Each of these is taken for one submission: {_named([one.name for one in delivery.handed])}."))
    if sys.stdin and sys.stdin.isatty() and input("Grade these? [y/N] ").strip().lower() not in ("y", "yes"):
        raise BadInput("grade: nothing was graded; README of tools/course/grading has the forms that are read")


def _named(names: list[str]) -> str:
    more = f", and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return ", ".join(one_line(name) for name in names[:_NAMED]) + more


def _say_who_has_no_time(names: list[str]) -> None:
    if names:
        print(fold(f"The time of these submissions cannot be read, so they count as on time: {_named(names)}."))


def _grade_on_slurm(arguments, out: Path, roster: Roster | None, names: list[str]) -> int:
    """Builds and tests the reference here, grades a shard in each part, and merges the results."""
    if arguments.shard:
        raise BadInput("grade: --slurm makes its own shards; leave out --shard")
    with Grader(arguments):
        pass
    count, shards = min(arguments.slurm, len(names)), out.absolute() / "shards"
    shutil.rmtree(shards, ignore_errors=True)
    command = [str(ROOT / "course"), "grade", *(str(Path(path).absolute()) for path in arguments.paths),
               *_for_a_shard(arguments), "--shard", f"@I@/{count}", "--out", f"{shards}/@I@"]
    failed = run_array(command, count, out.absolute() / "slurm", "grading on Slurm")
    set_aside(out, names)
    done = [folder for k in range(1, count + 1) if (folder := shards / str(k)) and _has_results(folder)]
    if not done:
        raise CourseError("no part has graded anything", _told(failed))
    code = _merge(done, out, roster, arguments.similarity, names)
    if failed:
        raise CourseError(f"{len(failed)} of {count} parts failed; the same command again grades what is missing",
                          _told(failed))
    return code


def _told(failed: dict[int, str]) -> str:
    return "\n".join(f"part {part}: {why}" for part, why in failed.items())


def _has_results(folder: Path) -> bool:
    return any(folder.glob("submissions/*/results.json"))


def _for_a_shard(arguments) -> list[str]:
    """Returns the options for a shard, which are those given here."""
    words = ["--jobs", str(arguments.jobs), "--points", arguments.points, "--attempt", arguments.attempt,
             "--weights", str(Path(arguments.weights).absolute())]
    for name in ("seed", "hidden_seed", "time_limit", "exercise_time", "submission_time", "isolation"):
        if (value := getattr(arguments, name)) is not None:
            words += [f"--{name.replace('_', '-')}", str(value)]
    if arguments.due:
        words += ["--due", arguments.due.strftime("%Y-%m-%dT%H:%M")]
    if arguments.chapters:
        words += ["--chapters", as_list(arguments.chapters)]
    if arguments.hidden:
        words += ["--hidden", str(Path(arguments.hidden).absolute())]
    return words + (["--fresh"] if arguments.fresh else [])


def _merge(folders: list[Path], out: Path, roster: Roster | None, compare: bool,
           names: list[str] | None = None) -> int:
    """Merges results. Results of other submissions in `out` are set aside. `names` are all submissions, if known."""
    missing = missing_shards(folders) if names is None else []  # read before a merge into one of them
    results, left_out = merge(folders, out)
    gone = set_aside(out, [result["submission"] for result in results])
    of_class = Class(left_out, roster)
    write_gradebook(out, results, of_class)
    if compare:
        _compare(out, results)
    _say_who_is_missing(not_graded(results, of_class) + [f"{one_line(name)}: graded before, and not among these results; "
                                                         "its results are set aside" for name in gone])
    _say_what_is_uncertain(results, out)
    print(f"{statistics_line(results)}.\n{_where(out)}.")
    if missing:
        raise CourseError(f"shard {', '.join(missing)} of this grading is missing: grade it, and merge again"
                          if len(missing) == 1 else f"the shards {', '.join(missing)} of this grading are missing")
    return 0


def _compare(out: Path, results: list[dict]) -> None:
    graded = {exercise["function"] for result in results for exercise in result["exercises"]}
    found = write_similarity(out, [exercise for exercise in all_exercises() if exercise.function in graded])
    print(fold(f"Pairs of submissions that share unusually much: {len(found.pairs)}; submissions like the reference: "
               f"{len(found.references)}; see {shown(out / 'similarity.html')}."))


def _say_what_is_uncertain(results: list[dict], out: Path) -> None:
    lines = uncertain(results)
    if lines:
        print("Files to look at:")
        for line in lines[:_UNCERTAIN]:
            print(fold(f"- {line}", "  "))
    if len(lines) > _UNCERTAIN:
        print(f"- {len(lines) - _UNCERTAIN} more: see {shown(out / 'summary.md')}")


def _say_who_is_missing(lines: list[str]) -> None:
    if lines:
        print("Not graded, or not assigned to a student:")
        for line in lines:
            print(fold(f"- {line}", "  "))


def _where(out: Path) -> str:
    told = f"The marks are in {shown(out / 'grades.csv')}, the class in {shown(out / 'summary.md')}"
    feedback = out / FEEDBACK
    return told + (f", reports for Moodle in {shown(feedback)}" if feedback.exists() else "")


def _prepare(arguments) -> int:
    install(NEEDS + GRADE_NEEDS, arguments.yes)
    with Grader(arguments) as grader:
        print(f"Ready to grade {counted(len(grader.exercises), 'exercise')}; isolation: {grader.isolation.name}.")
        _say_what_is_open(grader.isolation)
    return 0


def _grade_on_gradescope(arguments, out: Path) -> int:
    """Grades one submission, whatever its folders. The file is written at once, and again after each exercise."""
    if len(arguments.paths) != 1:
        raise BadInput(f"grade: --gradescope takes one submission, but {len(arguments.paths)} are named")
    path, file = Path(arguments.paths[0]), Path(arguments.gradescope)

    def write(result: dict, left: int) -> None:
        unfinished = f"Not finished: {counted(left, 'exercise')} still to be graded." if left else ""
        write_json(file, gradescope.converted(result, unfinished))

    with Grader(arguments) as grader:
        result = grader.grade_one(Handed("submission", (Place(path),), Student("submission")), out, write)
    print(f"{result['score']:g} of {result['max_score']:g} points")
    return 0


def _say_how(grader: Grader, count: int) -> None:
    print(f"{counted(count, 'submission')}, {counted(len(grader.exercises), 'exercise')}, seed {grader.seed}"
          f"{_of_hidden(grader)}; isolation: {grader.isolation.name}.", flush=True)
    _say_what_is_open(grader.isolation)


def _of_hidden(grader: Grader) -> str:
    if not grader.unseen:
        return ""
    if grader.hidden_seed == grader.seed:
        return " (also the seed of hidden tests, and reports state it; --hidden-seed sets another one for them)"
    return f", seed of hidden tests {grader.hidden_seed}"


def _say_what_is_open(isolation: Isolation) -> None:
    if isolation.does_not_deny:
        print(fold(f"With this isolation a submission can still use {isolation.does_not_deny}."), flush=True)
