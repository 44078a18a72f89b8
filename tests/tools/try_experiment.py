"""An experiment in its quick size: `try_experiment.py PROGRAM plots/TOPIC/NAME.cpp`.

Its claims hold, they stand word for word in the README.md of its folder, or in plots/README.md if it has none; the
figure is in the tree, and the same numbers are drawn as the same bytes.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path


def main(program: str, source: Path) -> list[str]:
    """Returns the failures."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        done = subprocess.run([program, "--quick", "--jobs", "1", "--out", temporary], stdout=subprocess.PIPE, text=True)
        print(done.stdout, end="")
        if done.returncode != 0:
            return [f"exit code {done.returncode}"]
        wrong = claims_not_shown(folder / "claims.json", source)
        figures = [folder / "first.png", folder / "second.png", folder / "first.svg", folder / "second.svg"]
        for chosen in (figures[0::2], figures[1::2]):
            outs = [word for figure in chosen for word in ("--out", str(figure))]
            drawn = subprocess.run([sys.executable, str(source.with_suffix(".py")), "--data", temporary, *outs])
            if drawn.returncode != 0:
                return [*wrong, "it could not be drawn"]
        for first, second in (figures[:2], figures[2:]):
            if first.read_bytes() != second.read_bytes():
                wrong.append(f"two drawings of the same numbers differ, as {first.suffix}")
    return wrong


def claims_not_shown(claims: Path, source: Path) -> list[str]:
    plots = source.parents[1]
    page = source.parent / "README.md"
    if not page.exists():
        page = plots / "README.md"
    text = " ".join(page.read_text(encoding="utf-8").split()).casefold()
    name = page.relative_to(plots.parent)
    figure = next((path for kind in (".svg", ".png") if (path := source.with_suffix(kind)).exists()),
                  source.with_suffix(".svg"))
    wrong = [] if figure.exists() else [f"{figure.relative_to(plots.parent)} is not in the tree"]
    if str(figure.relative_to(page.parent)) not in text:
        wrong.append(f"{name} does not show {figure.name}")
    for claim in json.loads(claims.read_text(encoding="utf-8")):
        if claim["text"].casefold() not in text:
            wrong.append(f"{name} does not have: {claim['text']}")
    return wrong


if __name__ == "__main__":
    faults = main(sys.argv[1], Path(sys.argv[2]).resolve())
    for fault in faults:
        print(f"try_experiment.py: {fault}", file=sys.stderr)
    sys.exit(1 if faults else 0)
