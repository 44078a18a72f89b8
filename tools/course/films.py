"""Reads tools/films.json: for each chapter a film of what its reader will be able to simulate.

`mine` lists films of a finished chapter by the student's own functions: words of ./course view, one text a film.
Together they call every exercise of the chapter except those in `without`.
"""

import json

from paths import ROOT

TABLE = ROOT / "tools" / "films.json"


def films() -> dict[str, dict]:
    """Returns the films by the folders of their chapters. README has one, too."""
    return json.loads(TABLE.read_text(encoding="utf-8"))


def words(film: dict) -> list[str]:
    """Returns the words of ./course that show the film."""
    return ["view", film["scene"], *film["options"], *(["--beside", film["beside"]] if "beside" in film else [])]


def command(film: dict) -> str:
    return " ".join(["./course", *words(film)])


def milestones(folder: str) -> list[str]:
    """Returns the commands that show a finished chapter by the student's own functions; none if it has no film."""
    return [f"./course view {mine} --mine" for mine in films().get(folder, {}).get("mine", [])]


def not_shown(folder: str) -> list[str]:
    """Returns the functions of the chapter that no milestone calls."""
    return films().get(folder, {}).get("without", [])


def own_step(folder: str) -> str:
    """Returns the command that shows a scene moved by the student's own step; empty if there is none. From chapter 09 on it
    also has what the chapter adds."""
    scene, _, options = films().get(folder, {}).get("own_step", "").partition(" ")
    return " ".join(["./course view", scene, "--engine mine", *options.split()]) if scene else ""
