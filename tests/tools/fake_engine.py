"""A replacement of the live engine without a compiler: recordings of the native program, played in the worker."""

import json
import subprocess
from pathlib import Path

from playing_scene import native
from sandbox import ROOT

from binding.live import LiveFigure

FRAMES = 120
_SCRIPT = ROOT / "tests" / "tools" / "fake_engine.js"


def recorded(figure: LiveFigure) -> dict:
    """Returns the figure's header, and a frame for each sixtieth of a second, as text."""
    first = _lines(figure, 1)
    header = next(line for line in first if "format" in line)
    steps = max(1, round(1 / 60 / header["method"]["h"]))
    lines = _lines(figure, steps)
    begin = max(k for k, line in enumerate(lines) if "format" in line)
    return {"set": figure.settings, "header": lines[begin],
            "frames": [line for line in lines[begin + 1:] if "x" in line]}


def _lines(figure: LiveFigure, steps: int) -> list[dict]:
    commands = [{"pause": True}, *([{"set": figure.settings}] if figure.settings else []), {"restart": True},
                *[{"step": steps}] * FRAMES]
    done = subprocess.run([native(), "play", figure.scene], input="".join(f"{json.dumps(line)}\n" for line in commands),
                          capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def fake_engine(folder: Path, figures: list[LiveFigure]) -> Path:
    """Writes em++'s output files into the folder: NAME.js, whose path it returns, and NAME.wasm."""
    compiled = folder / "engine.js"
    runs = json.dumps([recorded(figure) for figure in figures])
    compiled.write_text(f"const RECORDED = {runs};\n{_SCRIPT.read_text(encoding='utf-8')}", encoding="utf-8")
    compiled.with_suffix(".wasm").write_bytes(b"\0asm")
    return compiled
