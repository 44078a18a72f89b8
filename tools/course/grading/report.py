"""report.md for a student: the first failure in full, with its hint; of hidden tests only their number."""

from grading.results import said
from grading.text import fenced, markdown
from manifest import Exercise

_SYMBOL = {"done": "✓", "wrong": "✗", "not started": "·"}
RULE = {"exercises": "An exercise has its points when all of its tests pass.",
        "tests": "Each test that passes has its points. Tests that an empty function passes have none.",
        "equal": "Each exercise has one point, when all of its tests pass."}
_MORE_IN_FULL = 5
_PRINTED_LINES = 20


def report_of(result: dict, exercises: dict[str, Exercise]) -> str:
    """Returns the report; `exercises` are by their function."""
    points = f"{result['score']:g} of {result['max_score']:g} points"
    parts = [f"# {markdown(result['submission'])}: {points}\n", _board(result), f"{RULE[result['points']]}\n"]
    hidden = [test for test in _tests(result) if test["visibility"] != "visible"]
    if hidden:
        passed = sum(test["verdict"] == "passed" for test in hidden)
        if len(hidden) == 1:
            parts.append("1 further test, whose words are not shown, is part of the points; it "
                         f"{'passes' if passed else 'does not pass'}.\n")
        else:
            parts.append(f"{len(hidden)} further tests, whose words are not shown, are part of the points; "
                         f"{passed} of them {'passes' if passed == 1 else 'pass'}.\n")
    wrong = [(exercise, _failing(exercise)) for exercise in result["exercises"] if exercise["state"] == "wrong"]
    seen = [(exercise, tests) for exercise, tests in wrong if tests]
    if seen:
        parts.append("## Start here\n")
        parts += [_in_full(exercise, tests, exercises, result["seed"]) for exercise, tests in seen[:1]]
    if len(seen) > 1:
        parts.append("## And then\n")
        parts += [_in_full(exercise, tests, exercises, result["seed"]) for exercise, tests in seen[1:_MORE_IN_FULL]]
        parts += [_in_a_line(exercise, tests) for exercise, tests in seen[_MORE_IN_FULL:]]
    unseen = [exercise["id"] for exercise, tests in wrong if not tests]
    if unseen:
        parts.append(f"Every test that is shown passes in {', '.join(unseen)}, but a hidden one does not: read the "
                     "lesson again for cases that these tests do not cover.\n")
    if result["notes"]:
        parts += ["## Notes\n", *(f"- {markdown(note)}" for note in result["notes"]), ""]
    return "\n".join(parts)


def _tests(result: dict) -> list[dict]:
    return [test for exercise in result["exercises"] for test in exercise["tests"]]


def _board(result: dict) -> str:
    lines = ["| | exercise | state | points |", "|---|---|---|---|"]
    for exercise in result["exercises"]:
        lines.append(f"| {_SYMBOL[exercise['state']]} | {exercise['id']} {exercise['function']} | {exercise['state']} "
                     f"| {exercise['score']:g} of {exercise['max_score']:g} |")
    return "\n".join(lines) + "\n"


def _failing(exercise: dict) -> list[dict]:
    return [test for test in exercise["tests"] if test["visibility"] == "visible" and test["verdict"] != "passed"]


def _in_full(exercise: dict, tests: list[dict], exercises: dict[str, Exercise], seed: int) -> str:
    first = tests[0]
    known = exercises[exercise["function"]]
    lines = [f"### {exercise['id']} {exercise['function']}: {said(first)}\n"]
    if first["verdict"] == "failed":
        lines.append(f"{first['title']} (`{first['name']}`).\n")
    lines.append(fenced(first["message"]))
    if first["printed"]:
        lines += ["Your code printed:\n", fenced("\n".join(first["printed"].splitlines()[:_PRINTED_LINES]))]
    if first["verdict"] == "failed":  # what does not compile or crashes has no mistake in its physics yet
        lines.append(f"Hint: {known.hints[int(first['hint'].partition('/')[2]) - 1]}\n")
    alone = len({test["verdict"] for test in tests}) == 1 and first["verdict"] in ("does not compile", "tampered")
    others = [] if alone else [f"`{test['name']}` ({said(test)})" for test in tests[1:]]
    if others:
        lines.append(f"Also: {', '.join(others)}.\n")
    lines.append(f"Try it: `./course check {exercise['id']} --seed {seed}`; "
                 f"the lesson: `chapters/{known.folder}/README.md`\n")
    return "\n".join(lines)


def _in_a_line(exercise: dict, tests: list[dict]) -> str:
    return f"- {exercise['id']} {exercise['function']}: {said(tests[0])} in `{tests[0]['name']}`\n"
