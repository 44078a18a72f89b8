"""How finely a film is recorded: a short run has frames enough to be seen in slow motion."""

import json
import subprocess
from fractions import Fraction

from engine import program

ENOUGH = 150  # frames
_USUAL = 60  # a second of simulated time


def with_frames(words: tuple[str, ...]) -> list[str]:
    """The words of a run, with --fps where a usual film of it would be short; and with a longer --time where the run
    has not so many steps. What was typed stays."""
    if _value(words, "--fps") is not None:
        return list(words)
    scene = _defaults(words[0])
    time = _number(_value(words, "--time"), scene.get("time", 0))
    h = _number(_value(words, "--h"), scene.get("h", 0))
    more: list[str] = []
    if h > 0 and time < ENOUGH * h and _value(words, "--time") is None:
        time = ENOUGH * h
        more = ["--time", f"{time:.9g}"]
    if 0 < time < ENOUGH / _USUAL:
        more += ["--fps", f"{ENOUGH / time:.9g}"]
    return [*words, *more]


def _defaults(scene: str) -> dict:
    """As ./course scenes has them; nothing for a scene that is a file, or that there is not."""
    done = subprocess.run([str(program("spook")), "scenes", scene, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)["scenes"][0] if done.returncode == 0 else {}


def _value(words: tuple[str, ...], option: str) -> str | None:
    for k, word in enumerate(words):
        if word.startswith(f"{option}="):
            return word.partition("=")[2]
        if word == option and k + 1 < len(words):
            return words[k + 1]
    return None


def _number(text: str | None, otherwise: float) -> float:
    """0 for what is no number, which the engine's program refuses in its own words."""
    try:
        return float(otherwise if text is None else Fraction(text))
    except (ValueError, ZeroDivisionError):
        return 0
