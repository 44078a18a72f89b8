"""Gradescope's download of submissions: folders submission_123, and submission_metadata.yml with their authors.

submission_123:
  :submitters:
  - :name: Ann Lee
    :sid: '1234'
    :email: ann@example.edu
"""

import json
import re
from pathlib import Path

from grading.names import Student

METADATA = "submission_metadata.yml"
_FOLDER = re.compile(r"(submission_\d+):\s*")
_FIELD = re.compile(r"  [- ] :(name|sid|email): (.*)")
_LARGEST = 64 << 20


def submitters(folder: Path) -> dict[str, list[Student]]:
    """Returns the students of each submission's folder, several for a group; empty without the file."""
    file = folder / METADATA
    if not file.is_file() or file.stat().st_size > _LARGEST:
        return {}
    found: dict[str, list[dict[str, str]]] = {}
    name, listed = "", False
    for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
        if of_folder := _FOLDER.fullmatch(line):
            name, listed = of_folder[1], False
            found[name] = []
        elif line.startswith("  :"):
            listed = line.strip() == ":submitters:"
        elif name and listed and (field := _FIELD.fullmatch(line)):
            if line.startswith("  -"):
                found[name].append({})
            if found[name]:
                found[name][-1][field[1]] = _unquoted(field[2].strip())
    return {name: [Student(one["name"], one.get("sid") or one.get("email", "")) for one in group if one.get("name")]
            for name, group in found.items()}


def _unquoted(text: str) -> str:
    if text.startswith("'") and text.endswith("'"):
        return text[1:-1].replace("''", "'")
    if text.startswith('"') and text.endswith('"'):
        try:
            return str(json.loads(text))
        except ValueError:
            return text[1:-1]
    return "" if text in ("~", "null") else text
