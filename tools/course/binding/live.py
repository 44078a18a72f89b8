"""A lesson's live figures, each given by a comment of Markdown above its film:

    <!-- live: SCENE NAME=VALUE ... OPTION ... | CONTROL ... | GRAPH | VALUE at TIME | TRIAL; ... SENTENCES -->

It gives the scene and its initial settings; one to three controls for the reader; the graph that the text describes,
`error`, `energy`, `residual` or a column of the scene's own numbers; and its value after so many seconds, which tests
compare with a run. A trial changes settings and gives the value after the same time, which tests compare, too:

    NAME=VALUE ... gives VALUE.

Several trials are separated by `;`. The sentences say what the reader then sees. The options, in this order, are

    beside NAME=VALUE    a second run beside the first, with this setting; a control of this name changes the first alone
    showing MARK ...     marks, such as `impulses`; for the film's own scene those of the film, if there are none
    rate NUMBER          simulated seconds per second; for the film's own scene that of the film, otherwise 1
    for SECONDS          the run begins again after this time

If a film has several, buttons choose one. GitHub shows the film alone."""

import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

from films import films

PAGE, ENGINE = Path("assets/live.html"), Path("assets/engine.js")
_MARK = "<!-- live:"
_NUMBER = r"(-?[0-9]+(?:\.[0-9]+)?(?:e[+-]?[0-9]+)?)"
_OPTIONS = rf"(?: beside (\w+=\S+))?(?: showing((?: (?!rate |for )\w+)+))?(?: rate {_NUMBER})?(?: for {_NUMBER})?"
_TRIAL = re.compile(rf"((?:\w+=\S+ )+)gives {_NUMBER}(?:; |\. ?)")
_LINE = re.compile(rf"{_MARK} (\w+)((?: \w+=\S+)*){_OPTIONS} \|((?: \w+){{1,3}}) \| ([^|]+) \| {_NUMBER} at {_NUMBER}"
                   r"(?: \| ([^|]+\.))? -->")


@dataclass(frozen=True)
class Trial:
    """Settings that the reader is told to change, and the value of the graph that they give."""

    changed: dict[str, str]
    said: str

    def says(self, unit: str, graph: str) -> str:
        changes = [f"{name.replace('_', ' ')} to {value}" for name, value in self.changed.items()]
        return f"If you set {' and '.join(changes)} and begin again, {graph} shows {_text(self.said, unit)} at that time."


@dataclass(frozen=True)
class LiveFigure:
    scene: str
    settings: dict[str, str]
    controls: tuple[str, ...] = ()
    graph: str = ""  # empty: none
    said: str = ""  # the value, with the digits that are right
    time: float = 0  # [s]
    beside: tuple[str, str] | None = None  # a setting of the second run
    shows: tuple[str, ...] = ()
    rate: float | None = None
    lasts: float = 0  # [s]; 0: for ever
    trials: tuple[Trial, ...] = ()
    argues: str = ""  # sentences about the trials

    @property
    def value(self) -> float:
        return float(self.said)

    def asked(self, folder: str) -> dict:
        """Returns the input of tools/viewer/figure.js. Rate and marks of the chapter's film hold for its scene."""
        film = films().get(folder, {})
        own = film if film.get("scene") == self.scene else {}
        return {"scene": self.scene, "set": self.settings, "controls": self.controls, "graph": self.graph,
                "beside": dict([self.beside]) if self.beside else None, "lasts": self.lasts,
                "rate": self.rate or own.get("rate", 1), "shows": self.shows or own.get("shows", [])}

    def says(self, mine: bool = False) -> str:
        """The text below the figure; with a student's functions the figure may show something else."""
        unit = self.graph.partition(" [")[2].rstrip("]").replace("-", "")
        value = _text(self.said, unit)
        name = self.beside[0] if self.beside else ""
        shown = f"the graph of {name} {self.settings[name]} shows".replace("_", " ") if name else "the graph shows"
        said = (f"With right functions {shown} {value} after {self.time:g} s, before you change a setting." if mine
                else f"Before you change a setting, {shown} {value} after {self.time:g} s.")
        graph = "that graph" if name else "the graph"
        return " ".join([said, *(trial.says(unit, graph) for trial in self.trials), self.argues]).rstrip()


def _text(number: str, unit: str) -> str:
    """Returns a number as tools/viewer/numbers.js writes it, with its unit."""
    digits, _, power = number.partition("e")
    if power:
        power = str(int(power)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        digits = f"{digits}·10{power}"
    return f"{digits} {unit}".rstrip().replace("-", "−")


def attributes(figures: list[tuple[LiveFigure, str]], folder: str) -> str:
    """Returns the attribute of a film in whose place these figures run, each with the sentence below it."""
    asked = [figure.asked(folder) | {"says": says} for figure, says in figures]
    return f' data-live="{html.escape(json.dumps(asked))}"'


def is_live(text: str) -> bool:
    return text.startswith(_MARK)


def live_figure(comment: str) -> LiveFigure:
    """Reads the comment of a live figure, which may have several lines. Throws ValueError if it is invalid."""
    found = _LINE.fullmatch(" ".join(comment.split()))
    if not found:
        raise ValueError("a live figure must be <!-- live: SCENE NAME=VALUE ... | CONTROL ... | GRAPH | VALUE at TIME | ... -->")
    scene, pairs, beside, shows, rate, lasts, controls, graph, said, time, more = found.groups()
    settings = _settings(pairs)
    name, _, value = (beside or "").partition("=")
    if name and name not in settings:
        raise ValueError(f"a live figure beside {beside} must set {name} of the first run, too")
    trials, more = [], more or ""
    while trial := _TRIAL.match(more):
        trials.append(Trial(_settings(trial[1]), trial[2]))
        more = more[trial.end():]
    return LiveFigure(scene, settings, tuple(controls.split()), graph, said, float(time), (name, value) if name else None,
                      tuple((shows or "").split()), float(rate) if rate else None, float(lasts or 0), tuple(trials), more)


def _settings(pairs: str) -> dict[str, str]:
    return dict(pair.split("=", 1) for pair in pairs.split())
