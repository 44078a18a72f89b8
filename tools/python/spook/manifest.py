"""Writes a manifest beside a table: the call, the module by its SHA-256, versions, and the machine that computed it."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import time
from pathlib import Path

import numpy as np

from . import _spook


def write(table: str | os.PathLike, call: str, scene: str) -> None:
    """Writes TABLE.manifest.json. Raises OSError."""
    files = [Path(_spook.__file__), *([Path(scene)] if scene.endswith(".json") else [])]
    manifest = {"command": call, "folder": os.getcwd(), "version": _spook.__version__,
                "sha256": {str(file): hashlib.sha256(file.read_bytes()).hexdigest() for file in files if file.is_file()},
                "compiler": _spook.__compiler__, "python": platform.python_version(), "numpy": np.__version__,
                "machine": f"{platform.system()} {platform.machine()}", "processors": os.cpu_count(),
                "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
    text = json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
    Path(f"{os.fspath(table)}.manifest.json").write_text(text, encoding="utf-8")
