"""./course run --sweep: the same scene with one thing changed, a line of a table each."""

import json
import math
from dataclasses import dataclass
from fractions import Fraction

from terminal import fold


@dataclass(frozen=True)
class Result:
    value: str  # of what is swept
    run: dict | None  # as run --json prints it; None for a run that did not get to its end
    why: str  # it did not


def orders(results: list[Result]) -> list[float | None]:
    """p of errors that go with the p-th power of the value, from each result and the one before it."""
    found: list[float | None] = [None] * min(len(results), 1)
    return found + [_order(before, now) for before, now in zip(results, results[1:])]


def _order(before: Result, now: Result) -> float | None:
    values, errors = [_number(before.value), _number(now.value)], [_error(before), _error(now)]
    if not all(number and number > 0 for number in values + errors) or values[0] == values[1]:
        return None
    return math.log(errors[1] / errors[0]) / math.log(values[1] / values[0])


def _number(text: str) -> float | None:
    try:
        return float(Fraction(text))
    except (ValueError, ZeroDivisionError):
        return None


def _error(result: Result) -> float | None:
    return result.run["error"]["value"] if result.run else None


def as_json(name: str, results: list[Result]) -> str:
    runs = [{"value": result.value, "observed_order": order, "why": result.why or None} | (result.run or {})
            for result, order in zip(results, orders(results))]
    return json.dumps({"sweep": name, "runs": runs}, ensure_ascii=False)


def as_table(name: str, results: list[Result]) -> str:
    ended = next((result.run for result in results if result.run), None)
    if ended is None:
        return "\n".join(result.why for result in results)
    numbers = all(_number(result.value) is not None for result in results)
    rows = [[name, "error", *(["ratio", "order"] if numbers else []), "residual [m/s]", "µs a step"]]
    for k, (result, order) in enumerate(zip(results, orders(results))):
        ratio = _ratio(results[k - 1], result) if k else None
        rows.append([result.value, _shown(_error(result), "lost"),
                     *([_shown(ratio, "", ".3g"), _shown(order, "", ".2f")] if numbers else []),
                     _shown(result.run and result.run["residual"], "", ".2g"),
                     _shown(result.run and result.run["us_per_step"], "", ".3g")])
    kept = [k for k in range(len(rows[0])) if k < 2 or any(row[k] for row in rows[1:])]
    widths = [max(len(row[k]) for row in rows) for k in kept]
    lines = ["  ".join(row[k].rjust(width) if k else row[k].ljust(width) for k, width in zip(kept, widths)).rstrip()
             for row in rows]
    unit = ended["error"]["unit"]
    about = fold(f"{ended['scene']}: {ended['error']['name']}{f' [{unit}]' if unit else ''}")
    lost = [f"{name} = {result.value}: {result.why}" for result in results if result.why]
    meaning = [f"order p: the error is proportional to {name}^p, from each line and the one above"] if "order" in (
        rows[0][k] for k in kept) else []
    return "\n".join([about, "", *lines, "", *meaning, *map(fold, lost)]).rstrip()


def _ratio(before: Result, now: Result) -> float | None:
    """How many times smaller the error became."""
    errors = _error(before), _error(now)
    return errors[0] / errors[1] if all(errors) else None


def _shown(number: float | None, otherwise: str, form: str = ".4g") -> str:
    return otherwise if number is None else format(number, form)
