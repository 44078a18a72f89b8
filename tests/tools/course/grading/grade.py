"""./course grade: marks for a class of submissions."""

import os
import queue
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from errors import BadInput, CourseError
from grading.gradebook import statistics_line, write_gradebook
from grading.isolation import choose, take_user
from grading.judge import Judge
from grading.merge import merge
from grading.report import report_of
from grading.results import result_of, write_json
from grading.submission import Handed, Source, Submission, find_submissions, read_submission
from grading.text import one_line
from grading.weights import read_weights
from grading.workshop import Workshop, check_hidden
from manifest import Chapter, Exercise, read_chapters
from paths import BUILD, ROOT, SOLUTIONS, shown
from terminal import Bar

_MEMORY = BUILD / "grade"


def grade(arguments) -> int:
    out = Path(arguments.out)
    if arguments.merge:
        results = merge([Path(folder) for folder in arguments.merge], out)
        write_gradebook(out, results)
        print(f"{statistics_line(results)}\nThe marks are in {shown(out / 'grades.csv')}, the class in {shown(out / 'summary.md')}.")
        return 0
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
    write_gradebook(out, results)
    print(f"{statistics_line(results)}; {took / len(results):.2g} s each.")
    print(f"The marks are in {shown(out / 'grades.csv')}, the class in {shown(out / 'summary.md')},\n"
          f"and each student's report in {shown(out / 'submissions')}/NAME/report.md.")
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
        self._workshop.close()

    def grade(self, handed: list[Handed], out: Path) -> list[dict]:
        """In the order of `handed`; each submission's folder is written as soon as it is known."""
        bar = Bar("grading", len(handed))
        results: dict[str, dict] = {}
        pool = ThreadPoolExecutor(self._jobs)
        try:
            waiting = {pool.submit(self._grade_one, one, out): one for one in handed}
            for done in as_completed(waiting):
                one = waiting[done]
                results[one.name] = done.result()
                bar.step(one_line(one.name))
        finally:
            pool.shutdown(cancel_futures=True)
            bar.done()
        return [results[one.name] for one in handed]

    def _grade_one(self, handed: Handed, out: Path) -> dict:
        submission = read_submission(handed, self.exercises)
        result = self._result(submission)
        folder = out / "submissions" / handed.name
        folder.mkdir(parents=True, exist_ok=True)
        write_json(folder / "results.json", result)
        by_function = {exercise.function: exercise for exercise in self.exercises}
        (folder / "report.md").write_text(report_of(result, by_function), encoding="utf-8")
        return result

    def _result(self, submission: Submission) -> dict:
        user = self._users.get()
        try:
            verdicts = [(exercise, self._judge.judge(exercise, submission.sources.get(exercise.function), user))
                        for exercise in self.exercises]
        finally:
            self._users.put(user)
        settings = {"seed": self.seed, "seconds_a_test": self._seconds, "isolation": self.isolation.name,
                    "not_denied": self.isolation.does_not_deny, "tests": self._workshop.fingerprint}
        return result_of(submission, verdicts, self._weights, settings)

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
