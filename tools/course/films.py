"""What is filmed of each chapter, tools/films.json: what its reader will be able to simulate."""

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


def milestone(folder: str) -> str:
    """What shows a finished chapter's scene on the student's own functions; empty where nothing is filmed."""
    film = films().get(folder)
    return f"./course view {film['scene']} --mine" if film else ""


def own_step(folder: str) -> str:
    """What shows a scene moved by the step that the chapter ends with; empty where it ends with none."""
    scene = films().get(folder, {}).get("own_step")
    return f"./course view {scene} --engine mine" if scene else ""
