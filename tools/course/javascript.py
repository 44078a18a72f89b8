"""Finds libraries for the browser: in Debian's folders, or where npm installs them for the course."""

from pathlib import Path

from machine import conda, is_mac
from paths import STATE

NPM_FOLDER = STATE / "npm"
_DEBIAN = Path("/usr/share/javascript")


def _from_npm(name: str) -> bool:
    return not (_DEBIAN / name).exists() and (is_mac() or conda() is not None or (_npm(name)).exists())


def _npm(name: str) -> Path:
    return NPM_FOLDER / "node_modules" / name


def three() -> Path:
    """Returns the folder that holds examples/."""
    return _npm("three") if _from_npm("three") else _DEBIAN / "three"


def three_min() -> Path:
    return three() / "build" / "three.min.js" if _from_npm("three") else three() / "three.min.js"


def katex() -> Path:
    """Returns the folder that holds katex.js."""
    return _npm("katex") / "dist" if _from_npm("katex") else _DEBIAN / "katex"
