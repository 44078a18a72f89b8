"""./course run and ./course scenes: the spook program, built when needed."""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import crash
from engine import RELEASE, parameters_of, program
from errors import BadInput, CourseError
from extras import HELP, taken
from manifest import Exercise
from mine import CALLS, begun, checked_program, told
from paths import shown
from provenance import write_manifest
from runs import Runs, is_parquet, value_of
from terminal import fold

_CHECKS = "All chapters' functions run with checks, as in ./course check, so the run is slower than usual."


def run(arguments: list[str]) -> int:
    extras, words = taken(arguments)
    if "--help" in words:
        code = _call([str(program("spook")), "run", *words])
        print(HELP, end="")
        return code
    csv = value_of("--csv", words)
    if csv and is_parquet(csv) and not extras.sweep:
        raise BadInput(f'run: csv "{csv}": Parquet is for the table of a --sweep; the steps of one run are CSV')
    if not (extras.mine or extras.plot or extras.sweep or csv):
        return _become(["run", *words])
    mine, called = begun() if extras.mine else [], Called()
    several = Runs(words, extras, lambda words, call=None: _started(["run", *words], mine, called, call),
                   parameters_of)
    code = several.all() if extras.plot or extras.sweep else _started(["run", *words], mine, called)
    if code != 2 and csv and Path(csv).is_file():
        write_manifest(Path(csv), ["run", *arguments], [RELEASE.program("spook_mine" if mine else "spook"), *_inputs(words)])
    if code == 0 and extras.mine:  # an error stands alone
        print(fold(f"{told(mine, called.names)} {_CHECKS}") if mine else
              "You have written no exercise yet: everything is the reference.", file=sys.stderr)
    return code


def _inputs(words: list[str]) -> list[Path]:
    """Returns the files that a run reads: a scene's file, and a checkpoint."""
    restart = value_of("--restart", words)
    return [Path(name) for name in (words[0], restart) if name and (name == restart or name.endswith(".json"))]


class Called:
    """The exercises' functions that runs have called; None if the program cannot record them."""

    def __init__(self):
        self.names: set[str] | None = None

    def add(self, file: Path) -> None:
        if file.exists():
            self.names = (self.names or set()) | set(file.read_text(encoding="ascii").split())


def _started(words: list[str], mine: list[Exercise], called: Called, call=None) -> int:
    return with_yours(words, mine, called, call) if mine else (call or _call)([str(program("spook")), *words])


def with_yours(arguments: list[str], mine: list[Exercise], called: Called, call=None) -> int:
    """Returns the exit code. `call` starts the program, as _call does. Explains a crash."""
    path = checked_program(mine)
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        trace, calls = Path(folder, "trace"), Path(folder, "calls")
        code = (call or _call)([str(path), *arguments], **{crash.VARIABLE: str(trace), CALLS: str(calls)})
        if code < 0:
            raise crashed(code, path, trace, mine)
        called.add(calls)
    return code


def crashed(code: int, path: Path, trace: Path, mine: list[Exercise]) -> CourseError:
    """Returns an error that names the student's function in which the program crashed, if the trace has one."""
    name, where = signal.Signals(-code).name, crash.place(path, trace, mine)
    if where:
        return CourseError(f"the run crashed ({name}) at {shown(where[0].file)}:{where[1]}; "
                           f"see ./course check {where[0].id}")
    return CourseError(f"the run crashed ({name}) in one of your functions; ./course check finds which")


def scenes(arguments: list[str]) -> int:
    return _become(["scenes", *arguments])


def _call(command: list[str], **env: str) -> int:
    sys.stdout.flush()
    return subprocess.run(command, env=os.environ | env).returncode


def _become(arguments: list[str]) -> int:
    """Replaces this process by the program, so that exit code, signals and terminal are its own."""
    path = str(program("spook"))
    sys.stdout.flush()
    os.execv(path, [path, *arguments])
