"""Puts together what shards of one grading have written."""

import json
import shutil
from pathlib import Path

from errors import BadInput
from grading.results import SCHEMA
from paths import shown

_THE_SAME = ("seed", "seconds_a_test", "tests", "max_score")


def merge(folders: list[Path], out: Path) -> list[dict]:
    """Copies each submission's folder to `out`; all must have been graded with the same tests, seed and limits."""
    results: dict[str, dict] = {}
    for folder in folders:
        found = read_results(folder)
        for name, result in found.items():
            if name in results and results[name] != result:
                raise BadInput(f"grade: {name} was graded twice, with different results; the second is in {folder}")
            results[name] = result
    first = next(iter(results.values()))
    for result in results.values():
        for key in _THE_SAME:
            if result[key] != first[key]:
                raise BadInput(f"grade: {result['submission']} was graded with another {key} ({result[key]}) than "
                               f"{first['submission']} ({first[key]})")
    for folder in folders:
        for one in sorted((folder / "submissions").iterdir()):
            if (out / "submissions" / one.name).resolve() != one.resolve():
                shutil.copytree(one, out / "submissions" / one.name, dirs_exist_ok=True)
    return [results[name] for name in sorted(results)]


def read_results(folder: Path) -> dict[str, dict]:
    """By name; a folder without any is a mistake."""
    found = {}
    for file in sorted((folder / "submissions").glob("*/results.json")):
        result = read_result(file)
        found[result["submission"]] = result
    if not found:
        raise BadInput(f"grade: {folder} holds no results: no submissions/NAME/results.json")
    return found


def read_result(file: Path) -> dict:
    try:
        result = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BadInput(f"{shown(file)} can not be read: {error}") from None
    if not isinstance(result, dict) or result.get("schema") != SCHEMA:
        raise BadInput(f"{shown(file)} is no result of ./course grade ({SCHEMA})")
    return result
