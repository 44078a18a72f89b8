"""./course grade: marks for a class of submissions."""

import queue
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from errors import BadInput, CourseError
from exporting import gradescope
from grading.gradebook import statistics_line, write_gradebook
from grading.isolation import choose, take_user
from grading.judge import ExerciseVerdict, Judge
from grading.merge import merge
from grading.report import report_of
from grading.results import result_of, write_json
from grading.submission import Handed, Source, Submission, find_submissions, read_submission
from grading.text import one_line
from grading.weights import read_weights
from grading.workshop import Workshop, check_hidden
from install import GRADE_PACKAGES, PACKAGES, install
from manifest import Chapter, Exercise, read_chapters
from paths import BUILD, SOLUTIONS, shown
from terminal import Bar

_MEMORY = BUILD / "grade"


def grade(arguments) -> int:
    out = Path(arguments.out)
    if arguments.merge:
        results = merge([Path(folder) for folder in arguments.merge], out)
        write_gradebook(out, results)
        print(f"{statistics_line(results)}.\n{_where(out)}.")
        return 0
    if arguments.prepare:
        return _prepare(arguments)
    if arguments.gradescope:
        return _grade_on_gradescope(arguments, out)
    if not arguments.paths:
        raise BadInput("grade: a submission, or a folder of them, is needed; see ./course grade --help")
    handed = find_submissions([Path(path) for path in arguments.paths])
    if arguments.shard:
        first, count = arguments.shard
        handed = handed[first - 1::count]
        if not handed:
            print("This shard has no submissions.")
            return 0
    with Grading(arguments) as grading:
        _say_how(grading, len(handed))
        start = time.monotonic()
        results = grading.grade(handed, out)
        took = time.monotonic() - start
    if results:
        write_gradebook(out, results)
    if grading.failures:
        raise CourseError(f"{len(grading.failures)} of {len(handed)} submissions could not be graded; the others were, "
                          f"and grading again goes on from there", "\n".join(grading.failures))
    print(f"{statistics_line(results)}; {took / len(results):.2g} s each.")
    print(f"{_where(out)},\nand each student's report in {shown(out / 'submissions')}/NAME/report.md.")
    return 0


def _where(out: Path) -> str:
    return f"The marks are in {shown(out / 'grades.csv')}, the class in {shown(out / 'summary.md')}"


def _prepare(arguments) -> int:
    install(PACKAGES | GRADE_PACKAGES, arguments.yes)
    with Grading(arguments) as grading:
        print(f"Ready to grade {len(grading.exercises)} exercises; isolation: {grading.isolation.name}.")
        if grading.isolation.does_not_deny:
            print(f"This isolation does not deny {grading.isolation.does_not_deny}.")
    return 0


def _grade_on_gradescope(arguments, out: Path) -> int:
    """One submission, whatever its folders; the file is written at once, and again after each exercise."""
    if len(arguments.paths) != 1:
        raise BadInput(f"grade: --gradescope takes one submission, but {len(arguments.paths)} are named")
    path, file = Path(arguments.paths[0]), Path(arguments.gradescope)

    def write(result: dict, left: int) -> None:
        unfinished = f"Not finished: {left} exercises are still to be graded." if left else ""
        write_json(file, gradescope.converted(result, unfinished))

    with Grading(arguments) as grading:
        result = grading.grade_one(Handed("submission", path), out, write)
    print(f"{result['score']:g} of {result['max_score']:g} points")
    return 0


def _say_how(grading: "Grading", count: int) -> None:
    isolation = grading.isolation
    print(f"{count} submission{'s' if count != 1 else ''}, {len(grading.exercises)} exercises, seed {grading.seed}; "
          f"isolation: {isolation.name}.")
    if isolation.does_not_deny:
        print(f"This isolation does not deny {isolation.does_not_deny}.")


class Grading:
    """The instructor's side: tests, weights, isolation and the judge; the reference is graded first."""

    def __init__(self, arguments):
        self.seed = arguments.seed if arguments.seed is not None else 1
        self.chapters = _chosen(arguments.chapters)
        self.exercises = [exercise for chapter in self.chapters for exercise in chapter.exercises]
        self.failures: list[str] = []
        self._jobs = arguments.jobs
        self._seconds = arguments.time_limit
        hidden = Path(arguments.hidden).absolute() if arguments.hidden else None
        check_hidden(hidden, self.chapters)
        self._weights = read_weights(Path(arguments.weights), hidden)
        self.isolation = choose(arguments.isolation or "")
        self._users: queue.SimpleQueue = queue.SimpleQueue()
        self._workshop = Workshop(self.chapters, hidden)
        try:
            self._workshop.check_unreadable(self.isolation)
            expected = {test: exercise for exercise in self.exercises
                        for test in self._workshop.expected_tests(exercise)}
            self._weights.check(expected, self._workshop.hidden_tests)
            self._judge = Judge(self._workshop, self.isolation, self.seed, self._seconds,
                                None if arguments.fresh else _MEMORY)
            for _ in range(self._jobs):
                self._users.put(take_user(self.isolation))
            self._grade_reference()
        except BaseException:
            self._workshop.close()
            raise

    def __enter__(self) -> "Grading":
        return self

    def __exit__(self, *_) -> None:
        while not self._users.empty():
            self._users.get().release()
        self._workshop.close()

    def grade(self, handed: list[Handed], out: Path) -> list[dict]:
        """In the order of `handed`; each submission's folder is written as soon as it is known.

        What goes wrong in the grader itself stops no other submission; it is kept in `failures`.
        """
        bar = Bar("grading", len(handed))
        results: dict[str, dict] = {}
        pool = ThreadPoolExecutor(self._jobs)
        try:
            waiting = {pool.submit(self.grade_one, one, out): one for one in handed}
            for done in as_completed(waiting):
                one = waiting[done]
                if error := done.exception():
                    self.failures.append(f"{one_line(one.name)}: {type(error).__name__}: {error}")
                else:
                    results[one.name] = done.result()
                bar.step(one_line(one.name))
        finally:
            pool.shutdown(cancel_futures=True)
            bar.done()
        return [results[one.name] for one in handed if one.name in results]

    def grade_one(self, handed: Handed, out: Path, on_exercise: Callable[[dict, int], None] | None = None) -> dict:
        """`on_exercise` is given what is known so far, and how many exercises are left."""
        submission = read_submission(handed, self.exercises)
        judged = {exercise: self._judge.unjudged(exercise) for exercise in self.exercises}
        user = self._users.get()
        try:
            for count, exercise in enumerate(self.exercises):
                if on_exercise:
                    on_exercise(self._result(submission, judged), len(self.exercises) - count)
                judged[exercise] = self._judge.judge(exercise, submission.sources.get(exercise.function), user)
        finally:
            self._users.put(user)
        result = self._result(submission, judged)
        if on_exercise:
            on_exercise(result, 0)
        self._write(result, out / "submissions" / handed.name)
        return result

    def _write(self, result: dict, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        write_json(folder / "results.json", result)
        by_function = {exercise.function: exercise for exercise in self.exercises}
        (folder / "report.md").write_text(report_of(result, by_function), encoding="utf-8")

    def _result(self, submission: Submission, judged: dict[Exercise, ExerciseVerdict]) -> dict:
        settings = {"seed": self.seed, "seconds_a_test": self._seconds, "isolation": self.isolation.name,
                    "not_denied": self.isolation.does_not_deny, "tests": self._workshop.sources}
        return result_of(submission, list(judged.items()), self._weights, settings)

    def _grade_reference(self) -> None:
        """A test that the reference fails, here and with this seed, would fail everyone."""
        sources = {exercise.function: Source(str(exercise.reference.relative_to(SOLUTIONS.parent)),
                                             exercise.reference.read_bytes()) for exercise in self.exercises}
        bar = Bar("trying the tests on the reference", len(self.exercises))
        with ThreadPoolExecutor(self._jobs) as pool:
            for tests in pool.map(lambda exercise: self._reference_tests(exercise, sources[exercise.function]),
                                  self.exercises):
                bar.step()
                for test in tests:
                    if test.verdict != "passed":
                        raise CourseError(f"the reference itself does not pass {test.test} ({test.verdict}) with seed "
                                          f"{self.seed}; nobody is graded", test.message)
        bar.done()

    def _reference_tests(self, exercise: Exercise, source: Source):
        user = self._users.get()
        try:
            return self._judge.judge(exercise, source, user).tests
        finally:
            self._users.put(user)


def _chosen(numbers: set[int] | None) -> list[Chapter]:
    chapters = read_chapters()
    if numbers is None:
        return chapters
    unknown = numbers - {chapter.number for chapter in chapters}
    if unknown:
        raise BadInput(f"grade: there is no chapter {min(unknown)}; chapters are 1 to {chapters[-1].number}")
    return [chapter for chapter in chapters if chapter.number in numbers]
