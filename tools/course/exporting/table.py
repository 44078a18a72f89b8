"""CSV: a row for each test of each submission."""

import csv
import io

from grading.gradebook import cell


def of_results(results: list[dict]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["submission", "student", "identifier", "late", "exercise", "function", "test", "verdict", "reason",
                     "score", "max_score", "visibility"])
    for result in results:
        for exercise in result["exercises"]:
            for test in exercise["tests"]:
                writer.writerow([cell(result["submission"]), cell(result["student"]), cell(result["identifier"]),
                                 "late" if result["late"] else "", exercise["id"], exercise["function"], test["name"],
                                 test["verdict"], cell(test["reason"]), f"{test['score']:g}", f"{test['max_score']:g}",
                                 test["visibility"]])
    return text.getvalue()
