"""The outcome of a mutant under the tests of its own exercise only, as `./course check` runs them."""

import signal
from pathlib import Path

from trial import Trial, run_tests

KILLED, CRASHED, TIMED_OUT, SURVIVED = "killed", "crashed", "timed out", "survived"
NOT_COMPILED, EQUIVALENT, LISTED = "does not compile", "same object", "listed"


def outcome(program: Path, suite: str, seconds: float, number: int | None, variable: str,
            seed: int | None = None) -> tuple[str, str]:
    """Returns the outcome, and the test that detected it or the crash; `seconds` are the processor's."""
    more = {"GTEST_FAIL_FAST": "1"} | ({} if number is None else {variable: str(number)})
    return judged(run_tests(program, f"{suite}.*", seed, processor=seconds, more=more))


def judged(trial: Trial) -> tuple[str, str]:
    if trial.timed_out:
        return TIMED_OUT, trial.unfinished
    if trial.exit_code < 0:
        return CRASHED, f"{signal.Signals(-trial.exit_code).name} in {trial.unfinished}"
    if trial.tests is None:
        return CRASHED, f"exit code {trial.exit_code} in {trial.unfinished}"
    failed = [test.name for test in trial.tests if test.failures]
    if failed:
        return KILLED, failed[0]
    return (CRASHED, "no test ran") if not trial.tests or trial.exit_code else (SURVIVED, "")
