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


def write_delivery(out: Path, names: list[str], left_out: list[tuple[str, str]], shard: tuple[int, int]) -> None:
    """Writes the whole delivery into each shard's folder, and which shard this is."""
    out.mkdir(parents=True, exist_ok=True)
    write_json(out / _RECORD, {"names": names, "left_out": left_out, "shard": shard})


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
    results: dict[str, dict] = {}
    records = []
    for folder in folders:
        found = read_results(folder)
        records.append(_read_record(folder))
        for name, result in found.items():
            if name in results and results[name] != result:
                raise BadInput(f"grade: {name} was graded twice, with different results; the second is in {folder}")
            results[name] = result
    first = next(iter(results.values()))
    for result in results.values():
        for key in _THE_SAME:
            if result.get(key) != first.get(key):
                raise BadInput(f"grade: {result['submission']} was graded with another {key} ({result.get(key)}) than "
                               f"{first['submission']} ({first.get(key)})")
    for folder in folders:
        for one in sorted((folder / "submissions").iterdir()):
            if (out / "submissions" / one.name).resolve() != one.resolve():
                shutil.copytree(one, out / "submissions" / one.name, dirs_exist_ok=True)
    names = sorted({name for record in records for name in record["names"]} | set(results))
    left_out = list(dict.fromkeys(tuple(one) for record in records for one in record["left_out"]))
    write_delivery(out, names, left_out, (1, 1))
    lacking = [(name, f"its shard is not done{_which(name, records)}") for name in names if name not in results]
    return [results[name] for name in sorted(results)], left_out + lacking


def missing_shards(folders: list[Path]) -> list[str]:
    """Returns the missing shards, as I/N, that other shards mention."""
    found = {tuple(_read_record(folder)["shard"]) for folder in folders}
    return [f"{k}/{count}" for count in sorted({count for _, count in found})
            for k in range(1, count + 1) if (k, count) not in found]


def _which(name: str, records: list[dict]) -> str:
    for record in records:
        if name in record["names"]:
            count = record["shard"][1]
            return f": {record['names'].index(name) % count + 1}/{count}"
    return ""


def _read_record(folder: Path) -> dict:
    try:
        return json.loads((folder / _RECORD).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {"names": [], "left_out": [], "shard": (1, 1)}


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
