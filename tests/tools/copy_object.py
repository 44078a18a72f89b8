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

COMPILED = {"world.cpp", "kick.cpp"}  # in earnest: one of the engine, and one of the chapters


def objects(compile_commands: Path) -> dict[str, Path]:
    """By source: those that are there."""
    found = {}
    if not compile_commands.exists():
        return found
    for entry in json.loads(compile_commands.read_text(encoding="utf-8")):
        to = re.search(r" -o (\S*/spook_(?:engine|reference)\.dir/\S+)", entry["command"])
        if to and Path(entry["directory"], to[1]).exists():
            found[entry["file"]] = Path(entry["directory"], to[1])
    return found


def main(compile_commands: str, *command: str) -> int:
    if "-c" in command and "-o" in command:
        source, to = (command[command.index(option) + 1] for option in ("-c", "-o"))
        there = objects(Path(compile_commands)).get(source)
        if there and there.name.removesuffix(".o") not in COMPILED:
            shutil.copyfile(there, to)
            return 0
    return subprocess.run(command).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
