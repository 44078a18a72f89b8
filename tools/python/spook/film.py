"""The film of a recording: the page that ./course view makes."""

import subprocess
import sys
import tempfile
import webbrowser
from pathlib import Path

_MAKER = Path(__file__).parent / "_film" / "tools" / "course" / "page.py"


def page(recording: bytes) -> str:
    """Raises RuntimeError where the library that draws it, Debian's libjs-three, is missing."""
    # A process of its own: the command's modules have names that a user's may have, too.
    done = subprocess.run([sys.executable, str(_MAKER)], input=recording, capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.decode(errors="replace").strip())
    return done.stdout.decode()


def show(recording: bytes, name: str, file: str | None) -> str:
    """Writes the page, to a new folder and into a browser unless a file is named; returns where."""
    path = Path(file) if file else Path(tempfile.mkdtemp(prefix="spook-")) / f"{name}.html"
    path.write_text(page(recording), encoding="utf-8")
    if not file:
        webbrowser.open(path.as_uri())
    return str(path)
