"""A lesson's live figure, as one line of Markdown above its film says it:

    <!-- live: SCENE NAME=VALUE ... | CONTROL ... | GRAPH | VALUE at TIME -->

The scene and what is set at first; one to three controls that the reader may turn; the graph that the text speaks of,
`error`, `energy`, `residual` or a column of the scene's own numbers; and what it shows after so many seconds, which
tests compare with a run. GitHub shows the film alone."""

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
        """What tools/viewer/figure.js reads; the film of the chapter has its rate and marks."""
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
    """Throws ValueError for a line that cannot be read."""
    found = _LINE.fullmatch(line.strip())
    if not found:
        raise ValueError("a live figure must be <!-- live: SCENE NAME=VALUE ... | CONTROL ... | GRAPH | VALUE at TIME -->")
    settings = dict(pair.split("=", 1) for pair in found[2].split())
    return LiveFigure(found[1], settings, tuple(found[3].split()), found[4], found[5], float(found[6]))
