"""A compiler launcher: an object of the engine that the release has is copied, and all else is compiled.

    copy_object.py COMPILE_COMMANDS COMPILER ARGUMENTS...

A test of how the engine is taken into another project asks which files are compiled, how, and whether they make a
library: compiling a hundred of them once more would tell nothing new.
"""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

COMPILED = {"unity_0_cxx.cxx.o", "kick.cpp.o"}  # in earnest: a group of the engine's sources, and one of the chapters
_OURS = re.compile(r"\bspook_(?:engine|reference)\.dir/\S+")


def objects(compile_commands: Path) -> dict[str, Path]:
    """Returns the objects that are there, by their places in the library."""
    found = {}
    if not compile_commands.exists():
        return found
    for entry in json.loads(compile_commands.read_text(encoding="utf-8")):
        to = re.search(r" -o (\S+)", entry["command"])
        ours = to and _OURS.search(to[1])
        if ours and Path(entry["directory"], to[1]).exists():
            found[ours[0]] = Path(entry["directory"], to[1])
    return found


def main(compile_commands: str, *command: str) -> int:
    if "-c" in command and "-o" in command:
        to = command[command.index("-o") + 1]
        ours = _OURS.search(to)
        there = objects(Path(compile_commands)).get(ours[0]) if ours else None
        if there and there.name not in COMPILED:
            shutil.copyfile(there, to)
            return 0
    return subprocess.run(command).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
