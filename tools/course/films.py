"""The films of the chapters, from tools/films.json: each shows what its reader will be able to simulate.

`mine` has commands that show a finished chapter with the student's own functions: words of ./course view, one text for
each film. Between them they call every exercise of the chapter except those in `without`.
"""

import json

from paths import ROOT

TABLE = ROOT / "tools" / "films.json"


def films() -> dict[str, dict]:
    """Returns the films by the chapter's folder; README has one, too."""
    return json.loads(TABLE.read_text(encoding="utf-8"))


def words(film: dict) -> list[str]:
    """Returns the words of ./course that show a film."""
    return ["view", film["scene"], *film["options"], *(["--beside", film["beside"]] if "beside" in film else [])]


def command(film: dict) -> str:
    return " ".join(["./course", *words(film)])


def milestones(folder: str) -> list[str]:
    """Returns the commands that show a finished chapter with the student's own functions; empty if it has no film."""
    return [f"./course view {mine} --mine" for mine in films().get(folder, {}).get("mine", [])]


def not_shown(folder: str) -> list[str]:
    """Returns the functions of the chapter that no milestone calls."""
    return films().get(folder, {}).get("without", [])


def own_step(folder: str) -> str:
    """Returns the command for a scene that runs by the chapter's final step; empty if the chapter has no such step."""
    scene = films().get(folder, {}).get("own_step")
    return f"./course view {scene} --engine mine" if scene else ""
