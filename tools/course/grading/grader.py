"""The instructor's side of grading: tests, weights, isolation and the judge."""

import queue
import shutil
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from errors import CourseError
from grading.confined import STOP, Interrupted
from grading.isolation import User, choose, take_user
from grading.judge import PASSED, ExerciseVerdict, Judge
from grading.names import unseen_shown
from grading.reading import read_apart
from grading.report import report_of
from grading.results import folder_of, result_of, write_json
from grading.submission import Handed, Source, Submission
from grading.text import one_line
from grading.weights import read_weights
from grading.workshop import Workshop, check_hidden
from manifest import Exercise, all_exercises
from paths import BUILD, SOLUTIONS
from pick import chapters_of
from terminal import Bar

_MEMORY = BUILD / "grade"
_LONGEST = 2000  # characters of a note
_FREE = 3.0  # seconds of processor time in which a submission may be read; more counts


class Grader:
    """Grades with one choice of exercises, tests, seed and limits; the reference first."""

    def __init__(self, arguments):
        self.seed = arguments.seed if arguments.seed is not None else 1
        self.hidden_seed = arguments.hidden_seed if arguments.hidden_seed is not None else self.seed
        self.exercises = list(arguments.chapters or all_exercises())
        self.chapters = chapters_of(self.exercises)
        self.failures: list[str] = []
        self._jobs = arguments.jobs
        self._seconds = arguments.time_limit
        self._points = arguments.points
        self._attempt = arguments.attempt
        self._due = f", due {arguments.due:%Y-%m-%d %H:%M}" if arguments.due else ""
        self._of_submission = arguments.submission_time
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
            idle = self._workshop.idle_tests() if hidden else set()
            self._weights.check(expected, self._workshop.hidden_tests, idle)
            self.unseen = {test for test in expected if self._weights.of(test).visibility != "visible"}
            self._seeds = dict.fromkeys(self.unseen, self.hidden_seed)
            self._judge = Judge(self._workshop, self.isolation, self.seed, self._seconds, arguments.exercise_time,
                                _MEMORY, arguments.fresh, self._seeds)
            for _ in range(self._jobs):
                self._users.put(take_user(self.isolation))
            self._grade_reference()
        except BaseException:
            self._workshop.close()
            raise

    def __enter__(self) -> "Grader":
        return self

    def __exit__(self, *_) -> None:
        while not self._users.empty():
            self._users.get().release()
        self._workshop.close()

    def grade(self, handed: list[Handed], out: Path) -> list[dict]:
        """Grades in the order of `handed`, and writes each submission's folder as soon as its result is known.

        An error in the grader stops no other submission: it is reported in that one's row, and kept in `failures`.
        """
        bar = Bar("grading", len(handed))
        results: dict[str, dict] = {}
        pool = ThreadPoolExecutor(self._jobs)
        try:
            waiting = {pool.submit(self.grade_one, one, out): one for one in handed}
            for done in as_completed(waiting):
                one = waiting[done]
                error = done.exception()
                results[one.name] = self._not_graded(one, out, error) if error else done.result()
                bar.step(one_line(one.name))
        finally:
            _end(pool)
            bar.done()
        return [results[one.name] for one in handed]

    def grade_one(self, handed: Handed, out: Path, on_exercise: Callable[[dict, int], None] | None = None) -> dict:
        """Grades one submission. `on_exercise` gets the results so far, and the number of exercises left."""
        submission = read_apart(handed, self.exercises, self._attempt)
        judged = {exercise: self._judge.unjudged(exercise) for exercise in self.exercises}
        user, lost = self._users.get(), max(0.0, submission.seconds - _FREE)
        try:
            for count, exercise in enumerate(self.exercises):
                if on_exercise:
                    on_exercise(self._result(submission, judged), len(self.exercises) - count)
                if lost < self._of_submission or exercise.function not in submission.sources:
                    judged[exercise], lost = self._best_judged(submission, exercise, user, lost)
                else:
                    judged[exercise] = self._judge.without_time(exercise)
        finally:
            self._users.put(user)
        result = self._result(submission, judged)
        if on_exercise:
            on_exercise(result, 0)
        self._write(result, folder_of(out, handed.name), submission)
        return result

    def _not_graded(self, handed: Handed, out: Path, error: BaseException) -> dict:
        why = f"{type(error).__name__}: {error}"
        self.failures.append(f"{one_line(handed.name)}: {why}")
        submission = Submission(handed.name, handed.student, {}, [f"could not be graded: {why}"[:_LONGEST]])
        result = self._result(submission, {one: self._judge.not_judged(one, error) for one in self.exercises})
        try:
            self._write(result, folder_of(out, handed.name), submission)
        except Exception as failed:
            self.failures.append(f"{one_line(handed.name)}: its results cannot be written: {failed}")
        return result

    def _best_judged(self, submission: Submission, exercise: Exercise, user: User,
                     lost: float) -> tuple[ExerciseVerdict, float]:
        """Judges one exercise, and where the best attempt counts, each of them, from the last to the first, while the
        submission has time. Returns the verdict that counts, and the seconds `lost` so far with those of all attempts."""
        function = exercise.function
        sources = submission.attempts.get(function, [submission.sources.get(function)])
        verdicts = []
        for source in sources:
            if verdicts and lost >= self._of_submission:
                verdicts.append(self._judge.without_time(exercise))
                continue
            verdicts.append(self._judged(submission, exercise, source, user))
            lost += self._judge.lost(exercise, verdicts[-1])
        best = max(range(len(sources)), key=lambda k: self._worth(verdicts[k]))  # of equal ones the last attempt
        if len(sources) > 1:
            submission.sources[function] = sources[best]
            submission.notes.append(f"taken for {function}: {unseen_shown(sources[best].path)}, the best of "
                                    f"{len(sources)} attempts")
        return verdicts[best], lost

    def _worth(self, verdict: ExerciseVerdict) -> tuple[bool, float]:
        passed = [test.test for test in verdict.tests if test.verdict == PASSED]
        return len(passed) == len(verdict.tests), sum(self._weights.of(test).points for test in passed)

    def _judged(self, submission: Submission, exercise: Exercise, source: Source | None, user: User) -> ExerciseVerdict:
        """Judges one file. An error in the grader itself costs only this exercise of this submission, and is reported
        at the end."""
        try:
            return self._judge.judge(exercise, source, user)
        except Interrupted:
            raise
        except Exception as error:
            self.failures.append(f"{one_line(submission.name)}: {exercise.label}: {type(error).__name__}: {error}")
            return self._judge.not_judged(exercise, error)

    def _write(self, result: dict, folder: Path, submission: Submission) -> None:
        shutil.rmtree(folder / "taken", ignore_errors=True)
        (folder / "taken").mkdir(parents=True)
        for function, source in submission.sources.items():
            if not source.problem:
                (folder / "taken" / f"{function}.cpp").write_bytes(source.content)
        write_json(folder / "results.json", result)
        by_function = {exercise.function: exercise for exercise in self.exercises}
        (folder / "report.md").write_text(report_of(result, by_function), encoding="utf-8", errors="replace")

    def _result(self, submission: Submission, judged: dict[Exercise, ExerciseVerdict]) -> dict:
        settings = {"points": self._points, "attempt": self._attempt + self._due, "seed": self.seed,
                    "hidden_seed": self.hidden_seed, "seconds_a_test": self._seconds, "isolation": self.isolation.name,
                    "not_denied": self.isolation.does_not_deny, "tests": self._workshop.sources}
        return result_of(submission, list(judged.items()), self._weights, settings)

    def _grade_reference(self) -> None:
        """Grades the reference: a test that it fails, on this machine and with this seed, would fail everyone."""
        sources = {exercise.function: Source(str(exercise.reference.relative_to(SOLUTIONS.parent)),
                                             exercise.reference.read_bytes(), is_reference=True)
                   for exercise in self.exercises}
        bar = Bar("trying the tests on the reference", len(self.exercises))
        pool = ThreadPoolExecutor(self._jobs)
        try:
            for tests in pool.map(lambda exercise: self._reference_tests(exercise, sources[exercise.function]),
                                  self.exercises):
                bar.step()
                for test in tests:
                    if test.verdict != "passed":
                        seed = self._seeds.get(test.test, self.seed)
                        raise CourseError(f"the reference itself does not pass {test.test} ({test.verdict}) with seed "
                                          f"{seed}; nothing is graded", test.message)
        finally:
            _end(pool)
            bar.done()

    def _reference_tests(self, exercise: Exercise, source: Source):
        user = self._users.get()
        try:
            return self._judge.judge(exercise, source, user).tests
        finally:
            self._users.put(user)


def _end(pool: ThreadPoolExecutor) -> None:
    """Waits for running work to end; after an error it is stopped."""
    if sys.exc_info()[0] is not None:
        STOP.set()
    pool.shutdown(cancel_futures=True)
