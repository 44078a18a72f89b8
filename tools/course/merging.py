"""./course run --merge: joins the tables that the shards of one sweep have written, and no others."""

import csv
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput, CourseError
from extras import Extras, taken
from grid import columns, combinations, same
from provenance import manifest_of
from sweep import RESULTS, Result, Sweep, named, result_of
from terminal import counted

_OF_OUTPUT = ("--csv", "--json", "-v", "--verbose")  # options without effect on what a sweep computes


@dataclass(frozen=True)
class Shard:
    file: str
    rows: list[dict[str, str]]
    manifest: dict
    sha256: str  # of the table

    def refusals(self) -> list[tuple[dict[str, str], str]]:
        """Returns the points that the engine refused, and why. Older manifests do not have them."""
        return [(dict(one["point"]), one["why"]) for one in self.manifest.get("skipped", [])]


def require_other(table: str, merged_tables: Sequence[str]) -> None:
    """Refuses to replace a merged table, or its manifest, by the joined table or its manifest."""
    ours = [path for path in (Path(table), manifest_of(Path(table))) if path.exists()]
    theirs = [path for file in merged_tables for path in (Path(file), manifest_of(Path(file))) if path.exists()]
    if any(one.samefile(other) for one in ours for other in theirs):
        raise BadInput(f'run: --csv must be another file than the merged tables and their manifests, but is "{table}"')


def read_shard(file: str) -> Shard:
    try:
        content = Path(file).read_bytes()
        lines = csv.DictReader(content.decode().splitlines())
        rows = list(lines)
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f'run: --merge "{file}" cannot be read: {error}') from None
    for name in (*RESULTS, "h"):
        if name not in (lines.fieldnames or ()):
            raise BadInput(f'run: --merge "{file}" is no table of a sweep: it has no column {name}')
    beside = manifest_of(Path(file))
    try:
        manifest = json.loads(beside.read_text(encoding="utf-8"))
        shard = Shard(file, rows, manifest, hashlib.sha256(content).hexdigest())
        manifest["command"], manifest["sha256"].values(), shard.refusals()
    except (OSError, ValueError, LookupError, AttributeError, TypeError):
        raise BadInput(f'run: --merge "{file}" needs its manifest, which says how it was computed: copy '
                       f'"{beside.name}", too') from None
    return shard


def merged(words: list[str], extras: Extras, shards: Sequence[Shard]) -> Sweep:
    """Returns the sweep of shards that were run before, from their tables and manifests. Refuses those of other runs.
    Raises CourseError if a combination is in no shard.
    """
    for shard in shards:
        _require_same(shard, shards[0], words, extras)
    points, refused = combinations(extras.sweep), [refusal for shard in shards for refusal in shard.refusals()]
    found, skipped, missing = [], [], []
    for point in points:
        cells = columns(point, RESULTS)
        row = next((row for shard in shards for row in shard.rows if _is_at(row, cells)), None)
        why = next((why for other, why in refused if row is None and _is_at(other, point)), None)
        if row is not None:
            found.append(result_of(words[0], point, row))
        elif why is not None:
            skipped.append(Result(point, None, why))
        else:
            missing.append(point)
    if missing:
        raise CourseError(f"run: --merge lacks {len(missing)} of {counted(len(points), 'combination')}, the first with "
                          f"{named(missing[0])}: add the tables of the other shards")
    return Sweep(extras.sweep, found, skipped)


def _is_at(values: Mapping[str, str], point: Mapping[str, str]) -> bool:
    """Tells whether these values, by name, have all of a point's."""
    return all(same(values.get(name), value) for name, value in point.items())


def _require_same(shard: Shard, first: Shard, words: list[str], extras: Extras) -> None:
    was, then = taken(shard.manifest["command"][2:])
    here, there = _asked(extras, words), _asked(was, then)
    for what in sorted(here.keys() | there.keys()):
        if here.get(what) != there.get(what):
            raise BadInput(f'run: --merge "{shard.file}" is of another sweep: it was computed with {what} '
                           f"{_told(there.get(what))}, but this call has {_told(here.get(what))}; repeat its call, with "
                           "--merge in place of --shard")
    if _hashes(shard) != _hashes(first):
        raise BadInput(f'run: --merge "{shard.file}" and "{first.file}" were computed by different programs, or from '
                       "different contents of the scene file: compute one of them again")
    if words[0].endswith(".json") and _hash(words[0]) not in _hashes(shard):
        raise BadInput(f'run: --merge "{shard.file}" was computed from another content of "{words[0]}": compute it again')


def _asked(extras: Extras, words: list[str]) -> dict[str, list[str]]:
    """Returns what decides the results of a sweep but for the swept values, in any order of the words."""
    # The content of a file is compared by its hash: it may be elsewhere now.
    asked = {"the scene": ["a file"] if words[0].endswith(".json") else [words[0]], "swept names": sorted(extras.sweep)}
    if extras.mine:
        asked["--mine"] = []
    option = "the scene"
    for word in words[1:]:
        if word.startswith("--") or word in _OF_OUTPUT:
            option, equals, word = word.partition("=")
            asked.setdefault(option, [])
            if not equals:
                continue
        asked[option].append(word)
    return {name: sorted(values) for name, values in asked.items() if name not in _OF_OUTPUT}


def _told(values: list[str] | None) -> str:
    return "none" if values is None else " ".join(values) or "on"


def _hashes(shard: Shard) -> set[str]:
    return set(shard.manifest["sha256"].values())


def _hash(scene: str) -> str:
    try:
        return hashlib.sha256(Path(scene).read_bytes()).hexdigest()
    except OSError as error:
        raise BadInput(f'run: the scene "{scene}" cannot be read: {error}') from None
