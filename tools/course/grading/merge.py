"""Results of a grading: those of earlier runs in the same folder, and those of shards, combined."""

import json
import shutil
from pathlib import Path

from errors import BadInput
from grading.results import SCHEMA, write_json
from paths import shown

_THE_SAME = ("points", "attempt", "seed", "hidden_seed", "seconds_a_test", "tests", "max_score")
_RECORD = "delivery.json"
_REMOVED = "no longer handed in"


def write_delivery(out: Path, names: list[str], left_out: list[tuple[str, str]], *shards: tuple[int, int]) -> None:
    """Writes the whole delivery into each shard's folder, and which shards are in it."""
    out.mkdir(parents=True, exist_ok=True)
    write_json(out / _RECORD, {"names": names, "left_out": left_out, "shards": shards})


def set_aside(out: Path, names: list[str]) -> list[str]:
    """Moves results of submissions that are no longer delivered aside."""
    gone = [file.parent for file in sorted((out / "submissions").glob("*/results.json"))
            if file.parent.name not in names]
    for folder in gone:
        target = out / _REMOVED / folder.name
        target.parent.mkdir(exist_ok=True)
        shutil.rmtree(target, ignore_errors=True)
        folder.rename(target)
    return [folder.name for folder in gone]


def merge(folders: list[Path], out: Path) -> tuple[list[dict], list[tuple[str, str]]]:
    """Copies each submission's folder to `out`; all must have been graded with the same tests, seed and limits.

    Returns the results, and the submissions without one, with the reason.
    """
    results = one_of_each([(folder, read_results(folder)) for folder in folders], "grade")
    check_graded_alike(list(results.values()), "grade")
    records = [_read_record(folder) for folder in folders]
    shards = [(1, 1)] if not missing_shards(folders) else sorted(_shards_in(records))
    for folder in folders:
        for one in sorted((folder / "submissions").iterdir()):
            target = out / "submissions" / one.name
            if target.resolve() != one.resolve():
                shutil.rmtree(target, ignore_errors=True)
                shutil.copytree(one, target)
    names = sorted({name for record in records for name in record["names"]} | set(results))
    if set(names) == set(records[0]["names"]):
        names = records[0]["names"]  # whose order says which shard a submission is in
    left_out = list(dict.fromkeys(tuple(one) for record in records for one in record["left_out"]))
    write_delivery(out, names, left_out, *shards)
    lacking = [(name, f"its shard is not done{_which(name, records)}") for name in names if name not in results]
    return [results[name] for name in sorted(results)], left_out + lacking


def one_of_each(found: list[tuple[Path, dict[str, dict]]], command: str) -> dict[str, dict]:
    """Returns the results of all places by name. A submission that has two different ones is an error."""
    results: dict[str, dict] = {}
    for place, some in found:
        for name, result in some.items():
            if results.setdefault(name, result) != result:
                raise BadInput(f"{command}: {name} was graded twice, with different results; the second is in {place}")
    return results


def check_graded_alike(results: list[dict], command: str) -> None:
    """Refuses results of several gradings that differ in their tests, points, seeds or limits."""
    first = results[0]
    for result in results:
        for key in _THE_SAME:
            if result.get(key) != first.get(key):
                raise BadInput(f"{command}: {result['submission']} was graded with another {key} ({result.get(key)}) than "
                               f"{first['submission']} ({first.get(key)})")


def missing_shards(folders: list[Path]) -> list[str]:
    """Returns the missing shards, as I/N, that other shards mention."""
    found = _shards_in([_read_record(folder) for folder in folders])
    return [f"{k}/{count}" for count in sorted({count for _, count in found})
            for k in range(1, count + 1) if (k, count) not in found]


def _shards_in(records: list[dict]) -> set[tuple[int, int]]:
    return {tuple(shard) for record in records for shard in record["shards"]}


def _which(name: str, records: list[dict]) -> str:
    for record in records:
        if name in record["names"]:
            count = record["shards"][0][1]
            return f": {record['names'].index(name) % count + 1}/{count}"
    return ""


def _read_record(folder: Path) -> dict:
    try:
        record = json.loads((folder / _RECORD).read_text(encoding="utf-8"))
        return {"names": record["names"], "left_out": record["left_out"], "shards": record.get("shards") or [record["shard"]]}
    except (OSError, ValueError, KeyError):
        return {"names": [], "left_out": [], "shards": [(1, 1)]}


def read_results(folder: Path) -> dict[str, dict]:
    """Reads results by name. A folder without any is an error."""
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
        raise BadInput(f"{shown(file)} cannot be read: {error}") from None
    if not isinstance(result, dict) or result.get("schema") != SCHEMA:
        raise BadInput(f"{shown(file)} is no result of ./course grade ({SCHEMA})")
    return result
