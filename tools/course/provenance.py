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


def manifest_of(result: Path) -> Path:
    """Returns the place of a result's manifest."""
    return result.with_name(f"{result.name}.manifest.json")


def hashes_of(files: list[Path]) -> dict[str, str]:
    """Returns the SHA-256 of each file, by its name as given. What is no file is left out."""
    return {str(file): hashlib.sha256(file.read_bytes()).hexdigest() for file in files if file.is_file()}


def write_manifest(result: Path, command: list[str], hashes: dict[str, str], skipped: list[dict] | None = None) -> None:
    """Writes RESULT.manifest.json. `command` is the typed command, with all options and seeds; `hashes` are those of the
    program and of what it read. `skipped` are the combinations of a sweep that have no row, and why."""
    _write(result, {**_call(command), "sha256": hashes, "version": version(), "commit": commit(),
                    "compiler": _compiler(), "flags": RELEASE.setting("CMAKE_CXX_FLAGS"), "machine": _machine(),
                    "processors": processors()} | ({} if skipped is None else {"skipped": skipped}))


def write_merged_manifest(result: Path, command: list[str], tables: list[dict], skipped: list[dict]) -> None:
    """Writes RESULT.manifest.json of a table that is joined from others: what their manifests have in common, and each
    table's "file", "sha256" and "manifest". `skipped` are the combinations of all tables that have no row, and why."""
    manifests = [table["manifest"] for table in tables]
    common = {key: value for key, value in manifests[0].items() if all(each.get(key) == value for each in manifests)}
    _write(result, common | _call(command) | {"sha256": manifests[0]["sha256"], "skipped": skipped, "merged": tables})


def _call(command: list[str]) -> dict:
    return {"command": ["./course", *command], "folder": os.getcwd(),
            "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}


def _write(result: Path, manifest: dict) -> None:
    manifest_of(result).write_text(json.dumps(manifest, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


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
