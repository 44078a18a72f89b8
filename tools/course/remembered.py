"""The course's memory of its student, in .course/: a table for each purpose, in a JSON file."""

import json
import os

from paths import STATE


def read(file: str, table: str) -> dict:
    """Reads a table; empty if the file is not valid."""
    try:
        found = json.loads((STATE / file).read_text(encoding="utf-8"))[table]
        return {str(key): value for key, value in found.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def write(file: str, table: str, values: dict) -> None:
    STATE.mkdir(exist_ok=True)
    new = STATE / f"{file}.new"
    new.write_text(json.dumps({table: values}, indent=2) + "\n", encoding="utf-8")
    os.replace(new, STATE / file)
