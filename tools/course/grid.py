"""Sweeps as ./course run and Python's spook.sweep share them: every combination of values, orders, means over seeds.

A point is a dict of the swept names and one value of each.
"""

import csv
import functools
import itertools
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

ORDERED = ("h", "d", "k")  # names that an error may go with a power of
SEED = "seed"


def combinations(axes: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Returns the product of all values; the last name changes fastest."""
    return [dict(zip(axes, values)) for values in itertools.product(*axes.values())]


def columns(point: Mapping[str, Any], results: Iterable[str]) -> dict[str, Any]:
    """Returns a point by the names of its columns in a table.

    A parameter that has the name of a result, as ratio may have, gets the column "ratio=". No parameter is called so,
    since --set takes what is before the "=" as the name.
    """
    return {f"{name}=" if name in results else name: value for name, value in point.items()}


def impossible_value(points: Sequence[Mapping[str, Any]], refusals: Sequence[str]) -> str:
    """Returns the refusal of a value that no combination takes; empty if each value is part of one that runs.

    `refusals` has a message for each point, which is empty for a point that runs.
    """
    taken = {(name, str(value)) for point, why in zip(points, refusals) if not why for name, value in point.items()}
    for point, why in zip(points, refusals):
        for name, value in point.items():
            if why and (name, str(value)) not in taken:
                return f"{name}={value} is refused in every combination: {why}" if taken else why
    return ""


def number(value: Any) -> float | None:
    """The value of a number or of a text such as 1/60; None for anything else."""
    if isinstance(value, bool):
        return None
    try:
        return float(Fraction(value)) if isinstance(value, str) else float(value)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return None


def same(one: Any, other: Any) -> bool:
    """Returns True if two values are equal as they are typed: 1/60 may be a text or a number."""
    if one == other or str(one) == str(other):
        return True
    numbers = number(one), number(other)
    return None not in numbers and numbers[0] == numbers[1]


@dataclass(frozen=True)
class Row:
    """A run of a sweep."""

    point: Mapping[str, Any]
    error: float | None  # None or NaN where there is none
    state: str = "sound"
    end: float | None = None  # the time that it reached [s]
    round_off: float = 0.0  # an error that may come from rounding alone

    @property
    def is_lost(self) -> bool:
        """Tells whether the motion is not that of the problem, or the run did not get to its end."""
        return self.state in ("lost", "blew up")

    @property
    def at_round_off(self) -> bool:
        return not self.is_lost and self.error is not None and self.error <= self.round_off

    def has_order(self, axis: str) -> bool:
        """Tells whether the error may show an order in this name."""
        return not self.is_lost and not self.at_round_off and all(
            each and 0 < each < math.inf for each in (number(self.point[axis]), self.error))


def round_off(steps: float) -> float:
    """Returns the largest relative error that is taken for round-off: a few units in the last place for each step."""
    return 4 * sys.float_info.epsilon * steps


def _axis(names: Iterable[str]) -> str | None:
    return next((name for name in ORDERED if name in names), None)


def _groups(rows: Iterable[Row], names: Iterable[str]) -> list[list[Row]]:
    """Returns the rows with the same values of these names together."""
    groups: dict[tuple, list[Row]] = {}
    for row in rows:
        groups.setdefault(tuple(str(row.point[name]) for name in names), []).append(row)
    return list(groups.values())


def orders(rows: Sequence[Row], names: Iterable[str]) -> list[tuple[float | None, float | None]]:
    """Returns for each row the ratio of errors and the observed order.

    Both are from the last row before that differs in h, or else d, or else k, alone. There is none for a lost run, for
    an error at round-off, and between runs that end at different times.

    The order p of errors e and e' is log(e/e')/log(h/h'). A sweep of none of the three has none.
    """
    axis = _axis(names)
    last: dict[tuple, Row] = {}
    found = []
    for row in rows:
        others = tuple(str(row.point[name]) for name in names if name != axis)
        found.append(_order(last[others], row, axis) if axis and others in last else (None, None))
        last[others] = row
    return found


def _order(before: Row, now: Row, axis: str) -> tuple[float | None, float | None]:
    if not (before.has_order(axis) and now.has_order(axis)) or ends_apart([before, now]):
        return None, None
    values = number(before.point[axis]), number(now.point[axis])
    if values[0] == values[1]:
        return None, None
    return before.error / now.error, math.log(now.error / before.error) / math.log(values[1] / values[0])


def ends_apart(rows: Iterable[Row]) -> tuple[float, float] | None:
    """Returns the first and the last end of these runs; None if they end together, up to round-off."""
    ends = [row.end for row in rows if row.end is not None]
    return (min(ends), max(ends)) if ends and max(ends) - min(ends) > 1e-9 * max(ends) else None


def uneven(rows: Sequence[Row], names: Iterable[str]) -> tuple[float, float] | None:
    """Returns the first and the last end of runs that differ in h, or else d, or else k, and in when they end."""
    axis = _axis(names)
    groups = _groups(rows, [name for name in names if name != axis]) if axis else []
    return next((ends for ends in map(ends_apart, groups) if ends), None)


@dataclass(frozen=True)
class Mean:
    point: dict[str, Any]  # without the seed
    runs: int  # that have an error and are not lost
    unsolved: int  # of these
    lost: int  # the runs that are left out as lost
    mean: float | None
    half_width: float | None  # of the 95 % confidence interval of the mean; None for fewer than two runs
    row: Row  # the mean as a run of its own


def means(rows: Sequence[Row], names: Iterable[str], over: str = SEED) -> list[Mean]:
    """Returns the mean error over seeds for each combination of the other values. Lost runs are left out, and counted.

    The interval holds for errors that are normally distributed.
    """
    others = [name for name in names if name != over]
    return [_mean({name: group[0].point[name] for name in others}, group) for group in _groups(rows, others)]


def _mean(point: dict[str, Any], rows: list[Row]) -> Mean:
    lost = sum(row.is_lost for row in rows)
    kept = [row for row in rows if not row.is_lost and row.error is not None and math.isfinite(row.error)]
    unsolved = sum(row.state == "unsolved" for row in kept)
    errors, count = [row.error for row in kept], len(kept)
    if count == 0:
        return Mean(point, 0, 0, lost, None, None, Row(point, None))
    mean = math.fsum(errors) / count
    row = Row(point, mean, end=kept[0].end, round_off=max(row.round_off for row in kept))
    if count == 1:
        return Mean(point, 1, unsolved, lost, mean, None, row)
    deviation = math.sqrt(math.fsum((error - mean) ** 2 for error in errors) / (count - 1))
    return Mean(point, count, unsolved, lost, mean, student_t(count - 1) * deviation / math.sqrt(count), row)


def mean_orders(found: Sequence[Mean]) -> list[float | None]:
    """Returns the observed order of each mean, from the last one before that differs in h, or else d, or else k, alone."""
    return [order for _, order in orders([mean.row for mean in found], found[0].point if found else ())]


@dataclass(frozen=True)
class Fit:
    point: dict[str, Any]  # without the seed, and without h, or else d, or else k
    runs: int
    order: float
    half_width: float  # of the 95 % confidence interval of the order


def fits(rows: Sequence[Row], names: Iterable[str]) -> list[Fit]:
    """Returns the order p of each combination of the other values, by a line through log(error) over log(h).

    Lost runs and errors at round-off are left out. So are combinations with fewer than three runs or values of h, or
    with runs that end at different times. The interval holds for logarithms that scatter normally about the line.
    """
    axis = _axis(names)
    others = [name for name in names if name not in (axis, SEED)]
    groups = _groups((row for row in rows if axis and row.has_order(axis)), others)
    return [_fit({name: group[0].point[name] for name in others}, group, axis) for group in groups
            if len({number(row.point[axis]) for row in group}) > 2 and not ends_apart(group)]


def _fit(point: dict[str, Any], rows: list[Row], axis: str) -> Fit:
    x, y = [math.log(number(row.point[axis])) for row in rows], [math.log(row.error) for row in rows]
    count, x_mean, y_mean = len(rows), math.fsum(x) / len(rows), math.fsum(y) / len(rows)
    spread = math.fsum((each - x_mean) ** 2 for each in x)
    order = math.fsum((a - x_mean) * (b - y_mean) for a, b in zip(x, y)) / spread
    left = math.fsum((b - y_mean - order * (a - x_mean)) ** 2 for a, b in zip(x, y))
    return Fit(point, count, order, student_t(count - 2) * math.sqrt(left / (count - 2) / spread))


@functools.cache
def student_t(freedom: int, probability: float = 0.95) -> float:
    """Returns the t that a variable of Student's distribution exceeds in size with 1 - probability.

    With t = √ν tan θ the density is proportional to cos^(ν-1) θ, and Simpson's rule integrates it. Beyond 12/√ν the
    density is below round-off.
    """
    def part(angle: float, pieces: int = 200) -> float:
        values = [math.cos(angle * k / pieces) ** (freedom - 1) for k in range(pieces + 1)]
        return angle / (3 * pieces) * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))

    end = min(math.pi / 2, 12 / math.sqrt(freedom))
    low, high, whole = 0.0, end, part(end)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if part(middle) < probability * whole else (low, middle)
    return math.sqrt(freedom) * math.tan(low)


def write_csv(file: str, rows: Sequence[Mapping[str, Any]], names: Iterable[str] = ()) -> None:
    """Writes a line of names, and a line for each row. `names` are those of a table without rows. Raises OSError."""
    with open(file, "w", encoding="utf-8", newline="") as out:
        lines = csv.writer(out, lineterminator="\n")
        if head := list(rows[0] if rows else names):
            lines.writerow(head)
        lines.writerows(["" if value is None else value for value in row.values()] for row in rows)


def write_parquet(file: str, rows: Sequence[Mapping[str, Any]], names: Iterable[str] = ()) -> None:
    """Writes a column for each name. `names` are those of a table without rows. Raises OSError; ImportError without the
    package pyarrow.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise ImportError(f'"{file}" needs the Python package pyarrow; pip install pyarrow, or write CSV') from None

    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else names)}
    # Swept values are text. A column becomes numbers if all of its values are numbers.
    for name, values in columns.items():
        if all(isinstance(value, str) and number(value) is not None for value in values):
            columns[name] = [number(value) for value in values]
    parquet.write_table(pyarrow.table(columns), file)
