"""A lesson's live figure, given by one line of Markdown above its film:

    <!-- live: SCENE NAME=VALUE ... | CONTROL ... | GRAPH | VALUE at TIME -->

The line gives the scene and its initial settings; one to three controls for the reader; the graph that the text
describes, `error`, `energy`, `residual` or a column of the scene's own numbers; and its value after so many seconds,
which tests compare with a run. GitHub shows the film alone."""

import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

from films import films

PAGE, ENGINE = Path("assets/live.html"), Path("assets/engine.js")
_MARK = "<!-- live:"
_NUMBER = r"(-?[0-9.]+(?:e[+-]?[0-9]+)?)"
_LINE = re.compile(rf"{_MARK} (\w+)((?: \w+=\S+)*) \|((?: \w+){{1,3}}) \| ([^|]+) \| {_NUMBER} at {_NUMBER} -->")


@dataclass(frozen=True)
class LiveFigure:
    scene: str
    settings: dict[str, str]
    controls: tuple[str, ...] = ()
    graph: str = ""  # empty: none
    said: str = ""  # the value, with the digits that are right
    time: float = 0  # [s]

    @property
    def value(self) -> float:
        return float(self.said)

    def asked(self, folder: str) -> dict:
        """Returns the input of tools/viewer/figure.js; rate and marks are those of the chapter's film."""
        film = films().get(folder, {})
        return {"scene": self.scene, "set": self.settings, "controls": self.controls, "graph": self.graph,
                "rate": film.get("rate", 1), "shows": film.get("shows", [])}

    def attribute(self, folder: str) -> str:
        return html.escape(json.dumps(self.asked(folder)))

    def says(self, mine: bool = False) -> str:
        """The sentence below the figure, which with a student's functions may show something else."""
        unit = self.graph.partition(" [")[2]
        unit = unit.rstrip("]").replace("-", "")
        value = f"{self.said} {unit}".rstrip().replace("-", "−")
        if mine:
            return f"With right functions the graph shows {value} after {self.time:g} s, before you change a setting."
        return f"Before you change a setting, the graph shows {value} after {self.time:g} s."


def is_live(text: str) -> bool:
    return text.startswith(_MARK)


def live_figure(line: str) -> LiveFigure:
    """Reads the line of a live figure. Throws ValueError if it is invalid."""
    found = _LINE.fullmatch(line.strip())
    if not found:
        raise ValueError("a live figure must be <!-- live: SCENE NAME=VALUE ... | CONTROL ... | GRAPH | VALUE at TIME -->")
    settings = dict(pair.split("=", 1) for pair in found[2].split())
    return LiveFigure(found[1], settings, tuple(found[3].split()), found[4], found[5], float(found[6]))
