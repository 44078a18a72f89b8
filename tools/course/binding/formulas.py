"""Converts formulas to HTML by KaTeX, in one run for all."""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from needs import KATEX
from paths import ROOT

_SCRIPT = ROOT / "tools" / "book" / "formulas.js"


@dataclass(frozen=True)
class Formula:
    tex: str
    display: bool


def rendered(formulas: list[Formula]) -> dict[Formula, tuple[str, str]]:
    """Returns for each formula its HTML and its error message; one of the two is empty."""
    wanted = list(dict.fromkeys(formulas))
    text = json.dumps([{"tex": formula.tex, "display": formula.display} for formula in wanted])
    done = subprocess.run(["node", str(_SCRIPT), str(KATEX / "katex.js")], input=text, capture_output=True, text=True)
    if done.returncode != 0:
        raise CourseError("KaTeX does not run", done.stderr.strip())
    return {formula: (result.get("html", ""), result.get("error", ""))
            for formula, result in zip(wanted, json.loads(done.stdout), strict=True)}


def files() -> dict[Path, Path]:
    """Lists the files that formulas need: the place in the site, and the place in Debian."""
    fonts = sorted((KATEX / "fonts").glob("*.woff2"))
    return ({Path("assets/katex/katex.min.css"): KATEX / "katex.min.css"}
            | {Path("assets/katex/fonts", font.name): font for font in fonts})
