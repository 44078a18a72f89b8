"""Writes a manifest beside a result: the command, files, commit, compiler and machine that computed it."""

import hashlib
import json
import os
import subprocess
import time
from pathlib import Path

from engine import RELEASE
from machine import processor_model, processors
from version import commit, version


def write_manifest(result: Path, command: list[str], files: list[Path]) -> None:
    """Writes RESULT.manifest.json. `command` is the typed command, with all options and seeds; `files` are the program
    and what it read, by which the manifest has their SHA-256."""
    hashes = {str(file): hashlib.sha256(file.read_bytes()).hexdigest() for file in files if file.is_file()}
    manifest = {"command": ["./course", *command], "sha256": hashes, "version": version(), "commit": commit(),
                "compiler": _compiler(), "flags": RELEASE.setting("CMAKE_CXX_FLAGS"), "machine": _machine(),
                "processors": processors(), "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
    path = result.with_name(f"{result.name}.manifest.json")
    path.write_text(json.dumps(manifest, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _compiler() -> str:
    """Returns the first line of the compiler's version."""
    path = RELEASE.setting("CMAKE_CXX_COMPILER")
    try:
        told = subprocess.run([path, "--version"], capture_output=True, text=True) if path else None
    except OSError:
        return path
    return told.stdout.splitlines()[0] if told and told.stdout else path


def _machine() -> str:
    """Returns the system, the architecture and the model of the processor."""
    return f"{os.uname().sysname} {os.uname().machine}, {processor_model() or 'unknown processor'}"
