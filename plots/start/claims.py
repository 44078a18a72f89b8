"""Claims of the figure of ./course start, checked against the numbers that it draws."""

import math
from dataclasses import dataclass

ROUNDINGS = 1e-9  # a relative error below this is roundings, and is drawn and told apart
MARGIN = 0.1  # on an observed order


class ClaimError(Exception):
    """The numbers do not support the caption."""


@dataclass
class Series:
    """One line of the figure: a scene with one choice of parameters, over several h or numbers of sweeps."""

    scene: str
    choice: str
    points: list[dict]  # what `spook run --json` printed, from the cheapest to the dearest

    @property
    def label(self) -> str:
        return f"{self.scene}, {self.choice}" if self.choice else self.scene

    @property
    def errors(self) -> list[float]:
        return [point["error"]["value"] for point in self.points]

    @property
    def exact(self) -> bool:
        return all(error < ROUNDINGS for error in self.errors)

    @property
    def varies_h(self) -> bool:
        return len({point["h"] for point in self.points}) > 1

    def order(self) -> float:
        """Returns log2 of the ratio of errors at the two smallest h, each half of the other."""
        coarse, fine = sorted(self.points, key=lambda point: -point["h"])[-2:]
        return math.log(coarse["error"]["value"] / fine["error"]["value"]) / math.log(coarse["h"] / fine["h"])


def expected_order(series: Series) -> int | None:
    """Returns the theoretical order in h; None where h makes no error, or where something other than h varies."""
    chosen = series.points[0]["parameters"]
    if series.scene in ("orbit", "oscillator"):
        return 2 if chosen["start"] == "half_step" else 1
    if series.scene == "top":
        return 2 if chosen["update"] == "splitting" else 1
    if series.scene == "free_fall" and chosen["start"] == "unshifted":
        return 1
    return None


def caption(all_series: list[Series]) -> str:
    """Describes the figure in words. Raises ClaimError if the numbers do not support a claim."""
    parts = []
    for order, factor in ((2, 4), (1, 2)):
        found = [series for series in all_series if series.varies_h and expected_order(series) == order]
        if found:
            parts.append(f"by {factor} for {_listed([_with_order(series, order) for series in found])}")
    said = ["Halving h doubles the steps, and divides the error " + "; ".join(parts) + "."] if parts else []

    resting = [series for series in all_series if series.scene == "resting_sphere" or _falls_exactly(series)]
    for series in resting:
        if not series.exact:
            worst = max(series.errors)
            raise ClaimError(f"{series.label} is claimed to be exact to round-off, but its error is {worst:.1e}")
    if resting:
        said.append(f"Exact to round-off at any h: {_listed([series.label for series in resting])}.")

    said += [_sweeps(series) for series in all_series if series.scene == "stack" and len(series.points) > 1]
    return " ".join(said)


def _with_order(series: Series, order: int) -> str:
    observed = series.order()
    if not abs(observed - order) <= MARGIN:
        raise ClaimError(f"{series.label} is claimed to be of order {order} ± {MARGIN}, but shows {observed:.2f}")
    return f"{series.scene} ({series.choice + ', ' if series.choice else ''}order {observed:.2f})"


def _falls_exactly(series: Series) -> bool:
    return series.scene == "free_fall" and series.points[0]["parameters"]["start"] == "half_step"


def _sweeps(series: Series) -> str:
    first, last = series.points[0], series.points[-1]
    if not all(after < max(before, ROUNDINGS) for before, after in zip(series.errors, series.errors[1:])):
        raise ClaimError(f"{series.label} is claimed to gain by more sweeps, but its errors are {series.errors}")
    return (f"A heavy sphere on light ones needs sweeps, not small steps: from {first['iterations']} to "
            f"{last['iterations']} of them, the error goes from {_number(series.errors[0])} to "
            f"{_number(series.errors[-1])}.")


def _number(value: float) -> str:
    """Returns a number as 85, 0.12 or 6·10⁻¹⁴."""
    if 0.01 <= value < 1000:
        return f"{value:.0f}" if value >= 10 else f"{value:.2g}"
    digits, exponent = f"{value:.0e}".split("e")
    superscripts = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return f"{digits}·10{str(int(exponent)).translate(superscripts)}"


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
