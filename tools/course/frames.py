"""The frame rate of recordings: a short run gets enough frames for slow motion."""

import json
import subprocess
from fractions import Fraction

from beside import value_of
from engine import program

ENOUGH = 150  # frames
_USUAL = 60  # a second of simulated time


def with_frames(words: tuple[str, ...]) -> list[str]:
    """Adds --fps to a run's words if a usual film of it would be short, and a longer --time if the run has too few
    steps. Options that were typed stay."""
    if value_of("--fps", words) is not None:
        return list(words)
    scene = _defaults(words[0])
    time = _number(value_of("--time", words), scene.get("time", 0))
    h = _number(value_of("--h", words), scene.get("h", 0))
    more: list[str] = []
    if h > 0 and time < ENOUGH * h and value_of("--time", words) is None:
        time = ENOUGH * h
        more = ["--time", f"{time:.9g}"]
    if 0 < time < ENOUGH / _USUAL:
        more += ["--fps", f"{ENOUGH / time:.9g}"]
    return [*words, *more]


def _defaults(scene: str) -> dict:
    """Returns the defaults listed by ./course scenes; empty for a scene file or an unknown scene."""
    done = subprocess.run([str(program("spook")), "scenes", scene, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)["scenes"][0] if done.returncode == 0 else {}


def _number(text: str | None, otherwise: float) -> float:
    """Returns a number; 0 for other text, which the engine's program then refuses."""
    try:
        return float(otherwise if text is None else Fraction(text))
    except (ValueError, ZeroDivisionError):
        return 0
