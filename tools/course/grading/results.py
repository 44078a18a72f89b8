"""results.json, the complete result of one submission, from which all other reports are made.

It holds no times. So the same work, graded again, gives the same file, byte for byte. README.md has its schema.
"""

import hashlib
import json
from pathlib import Path

from errors import CourseError
from grading.judge import NOT_STARTED, PASSED, TAMPERED, ExerciseVerdict
from grading.submission import Submission
from grading.weights import Weights
from manifest import Exercise

SCHEMA = "spook-course/results/2"


def result_of(submission: Submission, verdicts: list[tuple[Exercise, ExerciseVerdict]], weights: Weights,
              settings: dict) -> dict:
    """Returns the result. `settings` are those of the grading, including the rule for points."""
    exercises = [_exercise(submission, exercise, verdict, weights, settings["points"])
                 for exercise, verdict in verdicts]
    return {
        "schema": SCHEMA,
        "submission": submission.name,
        "student": submission.student.name,
        "identifier": submission.student.identifier,
        "late": submission.student.late,
        "platform": submission.student.platform,
        "score": _sum(exercises, "score"),
        "max_score": _sum(exercises, "max_score"),
        **settings,
        "notes": submission.notes + [f"{exercise.label}: {note}" for exercise, verdict in verdicts
                                     for note in verdict.notes],
        "exercises": exercises,
    }


def score(exercise: dict, rule: str) -> None:
    """Gives each test of an exercise its score by the rule, and the exercise their sum."""
    tests = exercise["tests"]
    counts = rule == "tests" or all(test["verdict"] == PASSED for test in tests)
    total = sum(test["points"] for test in tests)
    for test in tests:
        test["max_score"] = test["points"] / total if rule == "equal" and total else test["points"]
        test["score"] = test["max_score"] if counts and test["verdict"] == PASSED else 0.0
    exercise["score"], exercise["max_score"] = _sum(tests, "score"), _sum(tests, "max_score")


def _exercise(submission: Submission, exercise: Exercise, verdict: ExerciseVerdict, weights: Weights,
              rule: str) -> dict:
    source = submission.sources.get(exercise.function)
    tests = []
    for test in verdict.tests:
        weight = weights.of(test.test)
        tests.append({
            "name": test.test,
            "title": weight.title,
            "verdict": test.verdict,
            "reason": test.reason,
            "points": weight.points,
            "score": 0.0,
            "max_score": 0.0,
            "visibility": weight.visibility,
            "hint": weight.hint,
            "message": test.message,
            "printed": test.printed,
        })
    result = {
        "id": exercise.id,
        "function": exercise.function,
        "chapter": exercise.folder,
        "file": source.path if source else "",
        "sha256": hashlib.sha256(source.content).hexdigest() if source and not source.problem else "",
        "state": _state(tests),
        "score": 0.0,
        "max_score": 0.0,
        "tests": tests,
    }
    score(result, rule)
    return result


def _state(tests: list[dict]) -> str:
    verdicts = {test["verdict"] for test in tests}
    return "done" if verdicts == {PASSED} else "not started" if verdicts == {NOT_STARTED} else "wrong"


def _sum(parts: list[dict], key: str) -> float:
    return round(sum(part[key] for part in parts), 9)


def said(test: dict) -> str:
    """Returns the verdict with its reason, in the words of all reports."""
    return test["verdict"] + (f": {test['reason']}" if test["reason"] else "")


def folder_of(out: Path, name: str) -> Path:
    """Returns the folder of a submission's results, always inside `submissions/`."""
    folder = out / "submissions" / name
    if name in ("", ".", "..") or folder.name != name or folder.parent != out / "submissions":
        raise CourseError(f"the submission {name!a} cannot have a folder of its name")
    return folder


def write_json(file: Path, content: dict) -> None:
    """Writes the file completely or not at all."""
    unfinished = file.with_name(file.name + ".part")
    unfinished.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8",
                          errors="replace")
    unfinished.replace(file)


def tampered(result: dict) -> bool:
    return any(test["verdict"] == TAMPERED for exercise in result["exercises"] for test in exercise["tests"])
