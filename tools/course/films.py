"""What is filmed of each chapter, tools/films.json: what its reader will be able to simulate.

`mine` has what shows a finished chapter on the student's own functions: words of ./course view, one text a film. Between
them they call every exercise of the chapter but those in `without`.
"""

import json

from paths import ROOT

TABLE = ROOT / "tools" / "films.json"


def films() -> dict[str, dict]:
    """By the chapter's folder; README has one, too."""
    return json.loads(TABLE.read_text(encoding="utf-8"))


def words(film: dict) -> list[str]:
    """Of ./course, that show what is filmed."""
    return ["view", film["scene"], *film["options"], *(["--beside", film["beside"]] if "beside" in film else [])]


def command(film: dict) -> str:
    return " ".join(["./course", *words(film)])


def milestones(folder: str) -> list[str]:
    """The commands that show a finished chapter on the student's own functions; none where nothing is filmed."""
    return [f"./course view {mine} --mine" for mine in films().get(folder, {}).get("mine", [])]


def not_shown(folder: str) -> list[str]:
    """The functions of the chapter that no milestone calls."""
    return films().get(folder, {}).get("without", [])


def own_step(folder: str) -> str:
    """What shows a scene moved by the student's own step, from chapter 09 on with what the chapter adds; empty if there is
    none."""
    scene, _, options = films().get(folder, {}).get("own_step", "").partition(" ")
    return " ".join(["./course view", scene, "--engine mine", *options.split()]) if scene else ""
