"""Compiles and links mutants of an exercise, and keeps compiled files while nothing has changed."""

import hashlib
import json
import subprocess
from pathlib import Path

import crowd
from commands import Commands
from crowd import Crowd, Switched
from errors import CourseError
from manifest import Exercise
from paths import CHAPTERS, SOLUTIONS


class Building:
    def __init__(self, exercise: Exercise, text: str, commands: Commands, functions: set[str], folder: Path):
        """`functions` are the symbols of the exercise that the tests call."""
        self._exercise, self._text, self._commands = exercise, text, commands
        self._functions, self.folder = functions, folder
        self.made_from = content(text, *commands.compiler, *map(content_of, _headers(exercise.chapter)))

    def alone(self, name: str, text: str) -> Path | None:
        """Returns the object of a single file. Its name is the exercise's, since objects contain it. None if it is not
        C++."""
        folder = self.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        source = folder / self._exercise.reference.name
        compiled = source.with_suffix(".o")
        record = folder / "compiled.json"
        key = content(self.made_from, text)
        if read_json(record) != {"key": key}:
            source.write_text(text, encoding="utf-8")
            compiled.unlink(missing_ok=True)
            self._commands.compile(source, compiled)
            record.write_text(json.dumps({"key": key}))
        return compiled if compiled.exists() else None

    def together(self, folder: Path, texts: dict[int, str]) -> tuple[Path, set[int]]:
        """Returns a program with all texts that compile, and their numbers; 0 is the unchanged text."""
        compiled, record = folder / "crowd.o", folder / "compiled.json"
        good = {int(k) for k in read_json(record).get("good", [])} if compiled.exists() else set()
        if not good:
            good = self._compile_crowd(folder, {0: self._text} | texts)
            record.write_text(json.dumps({"good": sorted(good)}))
        program = folder / "program"
        self.link([folder / "switch.o", compiled], program)
        return program, good

    def link(self, objects: list[Path], program: Path) -> None:
        said = self._commands.link(objects, program)
        if said.returncode != 0:
            raise CourseError(f"mutants of {self._exercise.label} do not link", said.stderr[:2000])

    def _compile_crowd(self, folder: Path, texts: dict[int, str]) -> set[int]:
        """Compiles the texts together, and drops those with compiler errors until there are none."""
        source, compiled = folder / "crowd.cpp", folder / "crowd.o"
        while True:
            everyone = Crowd(texts)
            source.write_text(everyone.source(), encoding="utf-8")
            said = self._commands.compile(source, compiled)
            if said.returncode == 0:
                break
            culprits = everyone.culprits(said.stderr)
            if 0 in culprits or not culprits:
                raise CourseError(f"{self._exercise.label} does not compile in many namespaces",
                                  said.stderr[:2000])
            texts = {k: text for k, text in texts.items() if k not in culprits}
        switch = folder / "switch.cpp"
        functions = Switched(frozenset(self._functions), tuple(texts), otherwise=0)
        switch.write_text(everyone.switch([compiled], [functions]), encoding="utf-8")
        said = subprocess.run([self._commands.compiler[0], "-o", "switch.o", "-c", "switch.cpp"], cwd=folder,
                              capture_output=True, text=True)
        if said.returncode != 0:
            raise CourseError("the switch between mutants does not compile", said.stderr[:2000])
        return set(texts)


def stripped(compiled: Path) -> bytes:
    """Returns the object without line numbers."""
    result = compiled.with_suffix(".stripped")
    subprocess.run(["objcopy", "--strip-debug", str(compiled), str(result)], check=True)
    return result.read_bytes()


def content(*texts: str) -> str:
    whole = hashlib.sha256()
    for text in texts:
        whole.update(text.encode() + b"\0")
    return whole.hexdigest()


def content_of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def read_json(path: Path) -> dict:
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def _headers(chapter: int) -> list[Path]:
    """Returns the other inputs of the compiler: the headers, and the method of joining texts."""
    of_chapters = [*CHAPTERS.glob("[0-9]*/*.hpp"), *SOLUTIONS.glob("[0-9]*/*.hpp")]
    return sorted([*(path for path in of_chapters if int(path.parent.name[:2]) <= chapter),
                   *CHAPTERS.glob("common/*.hpp"), Path(crowd.__file__)])
