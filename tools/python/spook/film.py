"""The film of a recording: the page of ./course view."""

import subprocess
import sys
import tempfile
import webbrowser
from pathlib import Path

_MAKER = Path(__file__).parent / "_film" / "tools" / "course" / "page.py"


def page(recording: bytes) -> str:
    """Returns the page. Raises RuntimeError without Debian's libjs-three, the library that draws it."""
    # A process of its own: the command's modules have names that a user's may have, too.
    done = subprocess.run([sys.executable, str(_MAKER)], input=recording, capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.decode(errors="replace").strip())
    return done.stdout.decode()


def show(recording: bytes, name: str, file: str | None) -> str:
    """Writes the page, into a new folder and a browser unless a file is named; returns its path."""
    path = Path(file) if file else Path(tempfile.mkdtemp(prefix="spook-")) / f"{name}.html"
    path.write_text(page(recording), encoding="utf-8")
    if not file:
        webbrowser.open(path.as_uri())
    return str(path)
