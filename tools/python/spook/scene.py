"""Scenes and their runs."""

from __future__ import annotations

import html
import numbers
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import numpy as np

from . import _spook
from .arguments import by_known_names
from .film import page, show

OPTIONS = ("h", "time", "solver", "iterations", "tolerance", "substeps", "integrator_order", "row_order", "seed",
           "warm_start", "contact_margin", "friction_model", "tangents", "max_parts", "threads",
           "soft_steps", "accuracy")


def as_typed(value: Any) -> str:
    """Returns a value as it is typed after `./course run`: 1/60 may be a number, a Fraction, or a text."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (numbers.Integral, Fraction)):
        return str(value)
    return repr(float(value)) if isinstance(value, numbers.Real) else str(value)


class Scene:
    """A scene with its parameters set. `about` has its description, its known answer, and its parameters."""

    def __init__(self, name: str, **parameters: Any):
        """Raises ValueError for an unknown scene or parameter, or an invalid value; TypeError for a name that is no
        text."""
        if not isinstance(name, str):
            raise TypeError(f"scene: name: a text, got {name!r}")
        self.name = name
        self.about: dict[str, Any] = _spook.describe(name)
        self.parameters = parameters
        self.check({})

    @by_known_names
    def run(self, *, h: Any = None, time: Any = None, solver: str | None = None, iterations: int | None = None,
            tolerance: float | None = None, substeps: int | None = None, integrator_order: int | None = None,
            row_order: str | None = None, seed: int | None = None, warm_start: bool | None = None,
            contact_margin: float | None = None, friction_model: str | None = None, tangents: str | None = None,
            max_parts: int | None = None, threads: int | None = None, soft_steps: int | None = None,
            accuracy: float | None = None) -> Run:
        """Runs the scene and compares it with its answer; then runs it again without observation, for its speed.

        Default of each option: the scene's own. h and time are in seconds. Raises ValueError for invalid input, and
        SimulationDiverged. Other threads of Python continue in the meantime.
        """
        given = {name: value for name, value in locals().items() if name in OPTIONS and value is not None}
        return self.run_with(given)

    def run_with(self, options: dict[str, Any]) -> Run:
        """Runs the scene with the options in a dict."""
        done = _spook.run(self.name, *self._typed(options))
        return Run(scene=self, options=dict(options), **done)

    def check(self, options: dict[str, Any]) -> None:
        """Raises the ValueError that a run would raise, without a step."""
        _spook.check(self.name, *self._typed(options))

    def with_parameters(self, **parameters: Any) -> Scene:
        return Scene(self.name, **{**self.parameters, **parameters})

    def record(self, options: dict[str, Any], fps: float = 60) -> bytes:
        """Returns the output of `./course run --record`: lines of JSON, one a frame."""
        return _spook.record(self.name, *self._typed(options), fps)

    def _typed(self, options: dict[str, Any]) -> tuple[dict[str, str], dict[str, str]]:
        return ({name: as_typed(value) for name, value in self.parameters.items()},
                {name: as_typed(value) for name, value in options.items()})

    def __repr__(self) -> str:
        return f"spook.scene({', '.join([repr(self.name), *_named(self.parameters)])})"

    def _repr_html_(self) -> str:
        return (f"<p><b>{html.escape(self.name)}</b>: {html.escape(self.about['summary'])}</p>"
                f"<p>{html.escape(self.about['answer'])}</p>")


def scene(name: str, **parameters: Any) -> Scene:
    """Returns a scene of spook.scenes(), with its parameters."""
    return Scene(name, **parameters)


@dataclass(frozen=True, eq=False)
class Run:
    """The results of a run. A notebook shows its film."""

    scene: Scene
    options: dict[str, Any]
    error: float  #: against the known answer, in the unit that scene.about["error_unit"] names
    state: str  #: sound, unsolved or lost: says if the run is reliable
    reason: str  #: why, where it is not sound
    note: str  #: a further note, as that of a World
    unsolved_steps: int  #: how many steps the solver left unsolved
    h: float  #: [s]
    steps: int
    solver: str
    us_per_step: float | None  #: median of several runs [µs]; None without a step
    residual: float  #: of the last step [m/s]
    row_updates: int
    columns: list[str] = field(repr=False)  #: names of the samples' columns, units in brackets
    samples: np.ndarray = field(repr=False)  #: a row for each substep, the start included

    @property
    def seconds(self) -> float:
        """The time to compute all of it [s]."""
        return 1e-6 * (self.us_per_step or 0) * self.steps

    def __getitem__(self, column: str) -> np.ndarray:
        """Returns a column of the samples, by its name with or without its unit: run["time"]. run["residual"] has the
        residual of each step; its start has none yet, and 0 instead."""
        for k, name in enumerate(self.columns):
            if column in (name, name.split(" [")[0]):
                return self.samples[:, k]
        raise KeyError(f"{column!r} is no column; there are: {', '.join(self.columns)}")

    def view(self, file: str | None = None, fps: float = 60) -> str:
        """Writes the film's page and opens it in a browser, unless a file is named; returns the page's path."""
        return show(self.scene.record(self.options, fps), self.scene.name, file)

    def _repr_html_(self) -> str:
        said = html.escape(f"{self!r}")
        try:
            film = html.escape(page(self.scene.record(self.options)))
        except RuntimeError as error:
            return f"<p>{said}</p><p>{html.escape(str(error))}</p>"
        return f'<iframe srcdoc="{film}" width="100%" height="480" frameborder="0"></iframe><p>{said}</p>'

    def __repr__(self) -> str:
        speed = "" if self.us_per_step is None else f", {self.us_per_step:.3g} µs a step"
        why = f" ({self.reason})" if self.reason else ""
        unit = self.scene.about["error_unit"]
        error = f", error {self.error:.3g} {unit}".rstrip() if unit else ""  # a file may have no answer
        return f"<{self.scene.name}: {self.state}{why}{error}, {self.steps} steps of {self.h:.4g} s{speed}>"


def _named(values: dict[str, Any]) -> list[str]:
    return [f"{name}={value!r}" for name, value in values.items()]
