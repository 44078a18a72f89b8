"""A scene run with every combination of some options and parameters."""

from __future__ import annotations

import html
import itertools
import math
import os
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any, Iterable, Iterator

import numpy as np

from ._spook import SimulationDiverged
from .scene import OPTIONS, Scene

RESULTS = ("h", "error", "order", "state", "us_per_step", "seconds", "row_updates")


class Table:
    """Rows, each a dict. `table["error"]` is a column; pandas.DataFrame(table.rows) is one of pandas'."""

    def __init__(self, rows: list[dict[str, Any]]):
        self.rows = rows

    @property
    def columns(self) -> list[str]:
        return list(self.rows[0]) if self.rows else []

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def __getitem__(self, column: str) -> np.ndarray:
        if column not in self.columns:
            raise KeyError(f"{column!r} is no column; there are: {', '.join(self.columns)}")
        return np.array([row[column] for row in self.rows])

    def where(self, **values: Any) -> Table:
        """The rows with these values: table.where(solver="direct")."""
        return Table([row for row in self.rows if all(row[name] == value for name, value in values.items())])

    def __repr__(self) -> str:
        lines = [self.columns, *([_short(value) for value in row.values()] for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*lines)]
        return "\n".join("  ".join(word.rjust(width) for word, width in zip(line, widths)) for line in lines)

    def _repr_html_(self) -> str:
        def line(words: Iterable[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(word)}</{tag}>" for word in words) + "</tr>"

        body = "".join(line(map(_short, row.values()), "td") for row in self.rows)
        return f"<table>{line(self.columns, 'th')}{body}</table>"


def sweep(scene: Scene, *, jobs: int | None = None, progress: bool = True, **lists: Any) -> Table:
    """Runs the scene with every combination of what is listed, on all cores, or on so many.

    A name is an option of Scene.run or a parameter of the scene; its value a list, or one value. A row has these, and:

        h             as a number [s]
        error         against the known answer
        order         observed, from the last longer or shorter h with all else equal: log(e/e')/log(h/h')
        state         sound, unsolved, lost, or blew up
        us_per_step   [µs]; while other cores run, more than alone. jobs=1 measures speed
        seconds       what the run takes to compute [s]
        row_updates   the same cost on every machine

    Raises ValueError for what makes no sense, before anything is run.
    """
    values = [list(value) if isinstance(value, (list, tuple, range, np.ndarray)) else [value]
              for value in lists.values()]
    points = [dict(zip(lists, combination)) for combination in itertools.product(*values)]
    prepared = [_prepared(scene, point) for point in points]
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1, but is {jobs}")
    with ThreadPoolExecutor(jobs or _processors()) as pool:
        futures = [pool.submit(_row, *run) for run in prepared]
        try:
            for done, _ in enumerate(as_completed(futures), 1):
                _tell(done, len(futures), progress)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    rows = [{**point, **future.result()} for point, future in zip(points, futures)]
    _put_orders(rows, points)
    return Table(rows)


def _processors() -> int:
    """How many this process may use; macOS can tell only how many there are."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _prepared(scene: Scene, point: dict[str, Any]) -> tuple[Scene, dict[str, Any]]:
    options = {name: value for name, value in point.items() if name in OPTIONS}
    parameters = {name: value for name, value in point.items() if name not in OPTIONS}
    changed = scene.with_parameters(**parameters)
    changed.check(options)
    return changed, options


def _row(scene: Scene, options: dict[str, Any]) -> dict[str, Any]:
    none = dict.fromkeys(RESULTS, math.nan)
    try:
        run = scene.run_with(options)
    except SimulationDiverged:
        return none | {"state": "blew up"}
    return none | {"h": run.h, "error": run.error, "state": run.state, "us_per_step": run.us_per_step or math.nan,
                   "seconds": run.seconds, "row_updates": run.row_updates}


def _put_orders(rows: list[dict[str, Any]], points: list[dict[str, Any]]) -> None:
    last: dict[tuple, dict[str, Any]] = {}
    for row, point in zip(rows, points):
        others = tuple((name, str(value)) for name, value in point.items() if name != "h")
        before = last.get(others)
        last[others] = row
        if before and row["error"] > 0 and before["error"] > 0 and row["h"] != before["h"]:
            row["order"] = math.log(row["error"] / before["error"]) / math.log(row["h"] / before["h"])


def _tell(done: int, of: int, progress: bool) -> None:
    if progress and (sys.stderr.isatty() or "ipykernel" in sys.modules):
        print(f"\r{done} of {of} runs" + ("\n" if done == of else ""), end="", file=sys.stderr, flush=True)


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
