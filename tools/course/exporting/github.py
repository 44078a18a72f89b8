"""GitHub Classroom: a workflow, and the JSON, in base64, for its reporter.

Students can change the workflow, so its result is only advice.
"""

import base64
import json
from pathlib import Path

from errors import BadInput
from exporting.kit import check_weights, filled, options, replaced


def write_kit(arguments) -> list[Path]:
    if arguments.hidden:
        raise BadInput("export: hidden tests cannot be kept from those who own the workflow; grade them yourself")
    out = Path(arguments.out or "classroom.yml")
    words = options(arguments, "", "course/tests/classroom_weights.csv")
    table = check_weights(arguments)
    files = [out, out.with_name("classroom_weights.csv")] if table else [out]
    with replaced(*files) as new:
        new[0].write_text(filled("classroom.yml", options=words), encoding="utf-8")
        if table:
            new[1].write_bytes(table)
    if table:
        print("Put classroom_weights.csv into tests/ of your copy of the course: the workflow reads it there.")
    return files


def of_result(result: dict) -> str:
    return base64.b64encode(json.dumps(converted(result)).encode()).decode() + "\n"


def converted(result: dict) -> dict:
    """Returns one test for each exercise. There must be at least one, since the reporter divides by their number."""
    tests = [_test(exercise) for exercise in result["exercises"]] or [
        {"name": "no exercise was graded", "status": "error", "score": 0, "message": ""}]
    passed = all(test["status"] == "pass" for test in tests)
    return {"version": 1, "status": "pass" if passed else "fail", "max_score": result["max_score"], "tests": tests}


def _test(exercise: dict) -> dict:
    failing = [test for test in exercise["tests"] if test["verdict"] != "passed" and test["visibility"] == "visible"]
    message = "\n\n".join(f"{test['name']}: {test['verdict']}\n{test['message']}" for test in failing[:1])
    return {"name": f"{exercise['id']} {exercise['function']}", "score": exercise["score"],
            "max_score": exercise["max_score"], "status": "pass" if exercise["state"] == "done" else "fail",
            "message": message, "filename": exercise["file"]}
