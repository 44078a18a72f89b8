"""The viewer's page: tools/viewer, the libraries, and the data, in one self-contained file."""

import base64
import gzip
import html
import re
import sys
from pathlib import Path

from errors import CourseError
from needs import THREE, THREE_MIN
from paths import ROOT

VIEWER = ROOT / "tools" / "viewer"
_LIBRARIES = {"three.min.js": THREE_MIN,
              "OrbitControls.js": THREE / "examples" / "js" / "controls" / "OrbitControls.js"}
_STYLE = re.compile(r'<link rel="stylesheet" href="([\w.]+)">')
_SCRIPT = re.compile(r'<script src="([\w.]+)"></script>')
_LIBRARY_TAG = re.compile(r'<script data-library="([\w.]+)"></script>')
_DATA, _BACK = "<!-- data -->", "<!-- back -->"


def film(recordings: list[tuple[str, bytes]], back: tuple[str, str] | None = None) -> str:
    """Returns the page of recordings, each with its label. The first is the one to compare with. `back` is the address
    and title of the page that leads here."""
    return _page("\n".join(f'<script type="application/gzip" data-recording="{html.escape(label)}">{_packed(content)}'
                           "</script>" for label, content in recordings), back)


def live() -> str:
    """Returns the page of a running simulation. It reads `frames` and writes to `command`, next to its own address."""
    return _page('<script type="application/json" id="live">{}</script>')


def figure() -> str:
    """Returns the page of a lesson's live figure, which runs the engine of engine_file() in its folder."""
    return _page('<script type="application/json" id="live">{"figure": true}</script>')


def engine_file(compiled: Path) -> str:
    """Returns the engine of em++, NAME.js with NAME.wasm beside it, as a script that holds it as text. Any page may
    load a script, also from the file system."""
    text = compiled.read_bytes() + b"\n" + (VIEWER / "worker.js").read_bytes()
    wasm = compiled.with_suffix(".wasm").read_bytes()
    return f'window.spookEngine = {{\n  text: "{_packed(text)}",\n  wasm: "{_packed(wasm)}" }};\n'


def _page(data: str, back: tuple[str, str] | None = None) -> str:
    text = (VIEWER / "viewer.html").read_text(encoding="utf-8")
    text = _STYLE.sub(lambda found: f"<style>\n{_source(found[1])}</style>", text)
    text = _SCRIPT.sub(lambda found: f"<script>\n{_source(found[1])}</script>", text)
    text = _LIBRARY_TAG.sub(_library, text)
    way = f'<a id="way-back" href="{html.escape(back[0])}">← {html.escape(back[1])}</a>' if back else ""
    return text.replace(_BACK, way).replace(_DATA, data)


def _source(name: str) -> str:
    return (VIEWER / name).read_text(encoding="utf-8")


def _library(found: re.Match) -> str:
    path = _LIBRARIES[found[1]]
    try:
        content = path.read_bytes()
    except OSError:
        raise CourseError(f"{path} is missing; it comes with Debian's libjs-three") from None
    return f'<script type="application/gzip" data-library="{found[1]}">{_packed(content)}</script>'


def _packed(content: bytes) -> str:
    # Without a time the same data make the same page.
    return base64.b64encode(gzip.compress(content, 6, mtime=0)).decode()


# The Python module's way to a film: the recording comes in, the page goes out.
if __name__ == "__main__":
    try:
        sys.stdout.buffer.write(film([("", sys.stdin.buffer.read())]).encode())
    except CourseError as missing:
        sys.exit(str(missing))
