"""Gradescope: a zip with setup.sh and run_autograder at its root, and results in its format."""

import json
import zipfile
from pathlib import Path

from errors import BadInput
from exporting.kit import check_weights, filled, hidden_files, options, replaced
from files import course_files
from grading.results import said
from paths import ROOT

_EXECUTABLE = 0o100755 << 16
_PLAIN = 0o100644 << 16


def write_kit(arguments) -> list[Path]:
    out = Path(arguments.out or "autograder.zip")
    names = course_files()
    for name in names:
        if any(0xDC80 <= ord(letter) <= 0xDCFF for letter in str(name)):  # bytes that are not UTF-8
            raise BadInput(f"export: the names in a zip must be UTF-8, but this one is not: {name}; rename the file")
    words = options(arguments, "$root/source/hidden", "$root/source/weights.csv")
    hidden, table = hidden_files(arguments), check_weights(arguments)
    with replaced(out) as (beside,), zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        _add(archive, "setup.sh", filled("gradescope_setup.sh", options=words).encode(), True)
        _add(archive, "run_autograder", filled("gradescope_run.sh", options=words).encode(), True)
        for name in names:
            _add(archive, f"course/{name}", (ROOT / name).read_bytes(), (ROOT / name).stat().st_mode & 0o100 != 0)
        for name in hidden:
            _add(archive, f"hidden/{name}", (Path(arguments.hidden) / name).read_bytes(), False)
        if table:
            _add(archive, "weights.csv", table, False)
    return [out]


def _add(archive: zipfile.ZipFile, name: str, content: bytes, executable: bool) -> None:
    info = zipfile.ZipInfo(name)  # with the same date each time, so that the same course gives the same zip
    info.external_attr = _EXECUTABLE if executable else _PLAIN
    info.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(info, content)


def of_result(result: dict) -> str:
    return json.dumps(converted(result), indent=1, ensure_ascii=False) + "\n"


def converted(result: dict, output: str = "") -> dict:
    tests = [_test(exercise, test) for exercise in result["exercises"] for test in exercise["tests"]]
    text = "\n".join([output, *result["notes"]]).strip()
    return {"score": result["score"], "output": text, "output_format": "text", "tests": tests,
            "extra_data": {key: result[key] for key in ("seed", "isolation", "tests", "schema")}}


def _test(exercise: dict, test: dict) -> dict:
    printed = f"\n\nYour code printed:\n{test['printed']}" if test["printed"] else ""
    output = "" if test["verdict"] == "passed" else f"{said(test)}\n\n{test['message']}{printed}".strip()
    return {"number": exercise["id"], "name": f"{exercise['function']}: {test['title']}", "score": test["score"],
            "max_score": test["max_score"], "status": "passed" if test["verdict"] == "passed" else "failed",
            "output": output, "output_format": "text", "visibility": test["visibility"],
            "tags": [exercise["chapter"]], "extra_data": {"test": test["name"], "verdict": test["verdict"]}}
