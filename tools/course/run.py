"""./course run and ./course scenes: the spook program, built when needed."""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import crash
from beside import require_single, value_of
from engine import parameters_of, program
from errors import BadInput, CourseError
from extras import HELP, Extras, taken
from manifest import Exercise
from merging import merged, read_shard, require_other
from mine import CALLS, begun, checked_program, told
from paths import shown
from provenance import hashes_of, write_manifest, write_merged_manifest
from runs import Runs, exit_code, is_parquet, put_out, require_scene, require_table
from sweep import skipped_points
from terminal import fold

_CHECKS = "All chapters' functions run with checks, as in ./course check, so the run is slower than usual."


def run(arguments: list[str]) -> int:
    extras, words = taken(arguments)
    if "--help" in words:
        code = _call([str(program("spook")), "run", *words])
        print(HELP, end="")
        return code
    require_single(words)
    csv = value_of("--csv", words)
    if csv and is_parquet(csv) and not extras.sweep:
        raise BadInput(f'run: csv "{csv}": Parquet is for the table of a --sweep; the steps of one run are CSV')
    if not (extras.mine or extras.plot or extras.sweep or csv):
        return _become(["run", *words])
    require_scene(words)
    if extras.merge:
        return _merge(arguments, words, extras)
    mine, called = begun() if extras.mine else [], Called()
    path = checked_program(mine) if mine else program("spook")  # once: all runs of a sweep are of one program
    shared = Shared([path, *_inputs(words)])

    def start(words: list[str], call=None) -> int:
        shared.require_unchanged()
        return _guarded(path, ["run", *words], mine, called, call) if mine else (call or _call)([str(path), "run", *words])

    several = Runs(words, extras, start, lambda scene: parameters_of(scene, path))
    code = several.all() if extras.plot or extras.sweep else start(words)
    if code != 2 and csv and Path(csv).is_file():
        write_manifest(Path(csv), ["run", *arguments], shared.hashes,
                       skipped_points(several.skipped) if extras.sweep else None)
    if code == 0 and extras.mine:  # an error stands alone
        print(fold(f"{told(mine, called.names)} {_CHECKS}") if mine else
              "You have written no exercise yet: everything is the reference.", file=sys.stderr)
    return code


def _merge(arguments: list[str], words: list[str], extras: Extras) -> int:
    require_table(words)
    csv = value_of("--csv", words)
    if csv:
        require_other(csv, extras.merge)
    shards = [read_shard(file) for file in extras.merge]
    sweep = merged(words, extras, shards)
    put_out(sweep, words)
    if csv:
        write_merged_manifest(Path(csv), ["run", *arguments], [
            {"file": shard.file, "sha256": shard.sha256, "manifest": shard.manifest} for shard in shards],
            skipped_points(sweep.skipped))
    return exit_code(sweep.results, words)


class Shared:
    """The files that all runs of a command read, and their SHA-256 before the first."""

    def __init__(self, files: list[Path]):
        self._states = {file: self._state(file) for file in files}
        self.hashes = hashes_of(files)

    def require_unchanged(self) -> None:
        for file, before in self._states.items():
            if self._state(file) != before:
                raise CourseError(f"{shown(file)} has changed since the first run, so the runs do not belong together: "
                                  "start again")

    @staticmethod
    def _state(file: Path) -> tuple[int, ...] | None:
        try:
            now = file.stat()
        except OSError:
            return None
        return now.st_ino, now.st_size, now.st_mtime_ns


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


def with_yours(arguments: list[str], mine: list[Exercise], called: Called, call=None) -> int:
    """Returns the exit code. `call` starts the program, as _call does. Explains a crash."""
    return _guarded(checked_program(mine), arguments, mine, called, call)


def _guarded(path: Path, arguments: list[str], mine: list[Exercise], called: Called, call=None) -> int:
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
