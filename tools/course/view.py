"""./course view: a film of a scene, or of several runs of it, in one page that opens by itself."""

import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from beside import Run, label_of, variations
from engine import parameters_of, program
from errors import BadInput, CourseError
from frames import with_frames
from install import install
from manifest import Exercise
from mine import begun, own_engine, signed, told
from needs import VIEW_NEEDS
from page import film
from paths import BUILD, shown
from run import Called, with_yours
from terminal import fold

_LARGE = 50e6  # bytes; pages beyond it take long to open
_ENOUGH = 12  # lines of a recording that say how long the rest will be
_PERIOD = 0.1  # [s]


@dataclass(frozen=True)
class Recording:
    label: str
    content: bytes


def view(arguments) -> int:
    words = arguments.words
    if arguments.gltf and (arguments.out or arguments.beside):
        raise BadInput("view: --gltf writes one run instead of a page; leave out --out and --beside")
    out = Path(arguments.gltf or arguments.out) if arguments.gltf or arguments.out else None
    if not words or words[0].startswith("-"):
        raise BadInput("view: a scene is missing; name it first: ./course view SCENE [OPTION ...]")
    if out and out.exists() and any(out.resolve() == Path(word).resolve() for word in words):
        raise BadInput(f"view: {out} is read, so it cannot be written; choose another file")
    is_file = ("." in words[0] or "/" in words[0]) and not words[0].endswith(".json")  # which is a scene
    if is_file:
        recordings, code = _files(arguments), 0
        runs: list[Run] = []
    else:
        own, words = own_engine(words)
        arguments.mine |= own
        runs = variations(words, arguments, parameters_of)
    out = _target(out or BUILD / "views" / f"{Path(words[0]).stem}.html", made=out is None)
    if not arguments.gltf:
        install(VIEW_NEEDS, yes=False)
    if not is_file:
        recordings, code = _recorded(runs)
    if arguments.gltf:
        _write(out, _as_gltf(recordings))
        print(f"{shown(out.absolute())}: {_megabytes(out.stat().st_size)} of glTF.")
        return code
    _write(out, film([(recording.label, recording.content) for recording in recordings], arguments.back))
    count = f"{len(recordings)} runs, " if len(recordings) > 1 else ""
    print(f"{shown(out.absolute())}: {count}{_megabytes(out.stat().st_size)}. Open it in a browser.")
    return code


def _as_gltf(recordings: list[Recording]) -> str:
    if len(recordings) > 1:
        raise BadInput("view: --gltf takes one recording")
    from gltf import gltf  # NumPy, which is not there before `start` has run

    try:
        return gltf(recordings[0].content)
    except (ValueError, KeyError, IndexError, TypeError) as error:
        raise BadInput(f"view: the recording cannot be read: {error}") from None


def _files(arguments) -> list[Recording]:
    if arguments.mine or arguments.beside or arguments.fps:
        raise BadInput("view: --mine, --beside and --fps have no effect on a recording; leave them out")
    if option := next((word for word in arguments.words if word.startswith("-")), None):
        raise BadInput(f"view: {option} has no effect on a recording; leave it out")
    recordings = []
    for name in arguments.words:
        try:
            content = Path(name).read_bytes()
        except OSError as error:
            raise BadInput(f"view: {name}: {error.strerror}") from None
        if _header(content) is None:
            raise BadInput(f"view: {name} is not a recording; ./course run SCENE --record FILE makes one")
        recordings.append(Recording(Path(name).stem if len(arguments.words) > 1 else "", content))
    return recordings


def _header(content: bytes) -> dict | None:
    try:
        header = json.loads(content.split(b"\n", 1)[0])
    except ValueError:
        return None
    return header if isinstance(header, dict) and header.get("format") == "spook recording" else None


def _target(path: Path, made: bool) -> Path:
    """Returns the page's path; checked first, so that no run is wasted."""
    if made:
        path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir() or not path.parent.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise BadInput(f"view: {path} cannot be written")
    return path


def _recorded(runs: list[Run]) -> tuple[list[Recording], int]:
    """Returns the recordings, and the worst exit code. Ends the command after a run with invalid input."""
    code, recordings = 0, []
    mine, called = begun() if any(run.mine for run in runs) else [], Called()
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        for k, run in enumerate(runs):
            file = Path(folder, f"{k}.jsonl")
            words = ["run", *with_frames(run.words), "--record", str(file)]
            ended = (with_yours(words, mine, called, _Call(file)) if run.mine and mine
                     else _Call(file)([str(program("spook")), *words]))
            if ended == 2 or not file.exists():
                raise SystemExit(ended or 1)  # the program has said why
            code = max(code, ended)
            recordings.append(_signed(file.read_bytes(), mine if run.mine else []))
    if any(run.mine for run in runs):
        print(fold(told(mine, called.names)) if mine else
              "You have written no exercise yet: everything is the reference.", file=sys.stderr)
    headers = [_header(content) or {} for content in recordings]
    return [Recording(label_of(k, runs, headers), content) for k, content in enumerate(recordings)], code


def _signed(content: bytes, mine: list[Exercise]) -> bytes:
    if not mine or _header(content) is None:
        return content
    first, end, rest = content.partition(b"\n")
    return signed(first.decode(), mine).encode() + end + rest


class _Call:
    """Runs the program, and warns early if the recording will be large."""

    def __init__(self, file: Path):
        self._file, self._warned = file, False

    def __call__(self, command: list[str], **env: str) -> int:
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, env=os.environ | env) as process:
            while process.poll() is None:
                self._look()
                time.sleep(_PERIOD)
        return process.returncode

    def _look(self) -> None:
        if self._warned or not self._file.exists() or not (size := expected_size(self._file)) > _LARGE:
            return
        self._warned = True
        print(f"course: view: the page will have about {_megabytes(size)}; a lower --fps or a shorter --time "
              "makes it smaller", file=sys.stderr)


def expected_size(file: Path) -> float:
    """Estimates the size of the whole recording from its first frames; 0 before these."""
    with file.open("rb") as stream:
        lines = [line for _, line in zip(range(_ENOUGH), stream)]
    header = _header(lines[0]) if len(lines) == _ENOUGH else None
    try:
        return header["time"] / header["frame_time"] * max(map(len, lines[1:])) if header else 0
    except (KeyError, TypeError, ZeroDivisionError):
        return 0


def _write(out: Path, text: str) -> None:
    try:
        out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CourseError(f"view: {out}: {error.strerror}") from None


def _megabytes(size: float) -> str:
    if size < 1e5:
        return f"{size / 1e3:.0f} kB"
    return f"{size / 1e6:.1f} MB" if size < 1e7 else f"{size / 1e6:.0f} MB"
