"""JUnit XML, for continuous integration and other readers: a suite for each exercise."""

import xml.etree.ElementTree as ET

from grading.results import said
from grading.text import clean


def of_results(results: list[dict]) -> str:
    root = ET.Element("testsuites", name="course")
    for result in results:
        for exercise in result["exercises"]:
            _add_suite(root, result["submission"], exercise)
    for key in ("tests", "failures", "errors", "skipped"):
        root.set(key, str(sum(int(suite.get(key)) for suite in root)))
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _add_suite(root: ET.Element, submission: str, exercise: dict) -> None:
    name = f"{exercise['id']} {exercise['function']}"
    suite = ET.SubElement(root, "testsuite", name=f"{clean(submission)}: {name}")
    counts = {"failure": 0, "error": 0, "skipped": 0}
    for number, test in enumerate(exercise["tests"], 1):
        shown = test["visibility"] == "visible"  # of the others nobody who reads this may see a word
        case = ET.SubElement(suite, "testcase", classname=f"{clean(submission)}.{name}",
                             name=test["name"] if shown else f"hidden test {number}")
        kind = {"passed": "", "failed": "failure", "not started": "skipped"}.get(test["verdict"], "error")
        if kind:
            counts[kind] += 1
            ET.SubElement(case, kind, message=clean(said(test))).text = clean(test["message"]) if shown else ""
    suite.set("tests", str(len(exercise["tests"])))
    for key, count in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        suite.set(key, str(counts[count]))
