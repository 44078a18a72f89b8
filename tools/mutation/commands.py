"""The build tree's commands to compile and link an exercise."""

import json
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from exercise_object import object_file
from manifest import Exercise
from tree import Tree


@dataclass(frozen=True)
class Commands:
    """CMake's commands for `check_<function>`: the compiler's and the linker's."""

    folder: Path
    compiler: tuple[str, ...]  # ends where the object and the source have to be named
    linker: tuple[str, ...]
    own: str  # the object that stands for the exercise in the linker's command

    def compile(self, source: Path, result: Path) -> subprocess.CompletedProcess:
        # Whether a mutant would be warned about is not asked.
        return self._run([*self.compiler, "-w", "-o", str(result), "-c", str(source)])

    def link(self, objects: list[Path], result: Path) -> subprocess.CompletedProcess:
        words = [*self.linker, "-Wl,--strip-debug"]
        words[words.index("-o") + 1] = str(result)
        at = words.index(self.own)
        return self._run([*words[:at], *map(str, objects), *words[at + 1:]])

    def inputs(self) -> list[Path]:
        """Returns the files linked with the exercise."""
        return [self.folder / word for word in self.linker
                if word.endswith((".o", ".a")) and word != self.own]

    def _run(self, words: list[str]) -> subprocess.CompletedProcess:
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, errors="replace")


def commands(tree: Tree, exercise: Exercise) -> Commands:
    own = object_file(tree, exercise)
    entries = json.loads((tree.path / "compile_commands.json").read_text(encoding="utf-8"))
    entry = next((entry for entry in entries if Path(entry["file"]) == exercise.file), None)
    listing = subprocess.run(["ninja", "-C", str(tree.path), "-t", "commands", f"check_{exercise.function}"],
                             capture_output=True, text=True)
    if not entry or listing.returncode != 0:
        raise CourseError(f"the build tree does not know how to build {exercise.label}")
    compiler = shlex.split(entry["command"])
    linker = shlex.split(listing.stdout.splitlines()[-1])
    # `: && c++ ... && :`
    linker = [word for word in linker if word not in (":", "&&")]
    return Commands(tree.path, tuple(compiler[: compiler.index("-o")]), tuple(linker),
                    str(own.relative_to(tree.path)))
