"""Autolab's autograde-Makefile and autograde.tar; the Makefile's last printed line holds the scores."""

import io
import json
import tarfile
from pathlib import Path

from exporting.kit import check_weights, filled, hidden_files, options, replaced
from files import course_files
from paths import ROOT


def write_kit(arguments) -> list[Path]:
    names = course_files()
    folder = Path(arguments.out or ".")
    hidden, table = hidden_files(arguments), check_weights(arguments)
    folder.mkdir(parents=True, exist_ok=True)
    makefile, archive = folder / "autograde-Makefile", folder / "autograde.tar"
    words = options(arguments, "hidden", "weights.csv")
    with replaced(makefile, archive) as (new_makefile, new_archive):
        new_makefile.write_text(filled("autograde-Makefile", options=words), encoding="utf-8")
        with tarfile.open(new_archive, "w") as tar:
            for name in names:
                _add(tar, f"course/{name}", ROOT / name)
            for name in hidden:
                _add(tar, f"hidden/{name}", Path(arguments.hidden) / name)
            if table:
                _add(tar, "weights.csv", Path(arguments.weights))
    return [makefile, archive]


def _add(tar: tarfile.TarFile, name: str, file: Path) -> None:
    """Adds a file without the times and owners of this machine."""
    content = file.read_bytes()
    info = tarfile.TarInfo(name)
    info.size, info.mode = len(content), 0o755 if file.stat().st_mode & 0o100 else 0o644
    tar.addfile(info, io.BytesIO(content))


def of_result(result: dict) -> str:
    scores = {f"{exercise['id']} {exercise['function']}": exercise["score"] for exercise in result["exercises"]}
    return json.dumps({"scores": scores}) + "\n"
