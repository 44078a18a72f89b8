"""./course import: a model in MJCF as a scene file, and a list of what was left out."""

import json
import os
import sys
from pathlib import Path

from errors import BadInput, CourseError
from terminal import counted


def import_model(arguments) -> int:
    try:
        from importing.defaults import read
        from importing.report import Report
        from importing.scene import SceneWriter
    except ImportError as error:
        raise CourseError(f"{error}; ./course start installs what is missing") from None
    path = Path(arguments.model)
    if arguments.out:
        _require_writable(arguments.out, path)
    report = Report()
    try:
        writer = SceneWriter(read(path, report), path.stem, report)
    except BadInput as error:
        raise BadInput(str(error) if str(error).startswith(str(path)) else f"{path}: {error}") from None
    text = json.dumps(writer.scene, indent=1, ensure_ascii=False) + "\n"
    if arguments.out:
        Path(arguments.out).write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    print(_told(writer.scene, report.left_out(), report.instead()), end="", file=sys.stderr)
    return 0


def _require_writable(out: str, model: Path) -> None:
    """Refuses an output file that cannot be written, and the model itself."""
    file = Path(out)
    if file.is_dir() or not file.parent.is_dir() or not os.access(file if file.exists() else file.parent, os.W_OK):
        raise BadInput(f'import: --out "{out}" cannot be written')
    if file.exists() and model.exists() and file.samefile(model):
        raise BadInput(f'import: --out must be another file than the model, but is "{out}"')


def _told(scene: dict, left_out: list[str], instead: list[str]) -> str:
    moving = sum("mass" in body for body in scene["bodies"])
    joints = len(scene.get("joints", []))
    lines = [f"{moving} {'body that moves' if moving == 1 else 'bodies that move'}, {counted(joints, 'joint')}"]
    for title, found in (("left out:", left_out), ("instead:", instead)):
        lines += [title, *(f"  {what}" for what in found)] if found else []
    return "\n".join(lines) + "\n"
