"""./course run --plot and --sweep: one run or several, as a table and as a figure."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from beside import require_distinct, require_free, value_of, with_changed, without
from curves import Table, draw, matching
from errors import BadInput
from extras import Extras
from grid import combinations, impossible_value, number, write_csv, write_parquet
from paths import BUILD, ROOT, shown
from provenance import manifest_of
from slurm import run_array
from sweep import Result, Sweep, as_json, as_text
from terminal import Bar, fold_lines


class Interrupted(Exception):
    """A sweep that was told to end, by Ctrl-C or SIGTERM, and the results that it has."""

    def __init__(self, results: list[Result], cause: BaseException):
        super().__init__()
        self.results, self.cause = results, cause


class Runs:
    """Runs of one scene: a figure of its columns, a table row for each combination of swept values, or both."""

    def __init__(self, words: list[str], extras: Extras, start: Callable[..., int],
                 parameters: Callable[[str], set[str]]):
        """`start` runs the program with the words, by subprocess or by the function `call`, and returns its exit code.
        `parameters` gives the names of a scene's parameters.
        """
        self._words, self._extras, self._start, self._parameters = words, extras, start, parameters
        self.skipped: list[Result] = []  # the combinations of a sweep that the program refuses, and why

    def all(self) -> int:
        with tempfile.TemporaryDirectory(prefix="course-") as folder:
            return self._sweep(Path(folder)) if self._extras.sweep else self._one(Path(folder))

    def _one(self, folder: Path) -> int:
        self._require(self._words, folder)
        words, file = self._words, value_of("--csv", self._words)
        if file is None:
            file = str(folder / "run.csv")
            words = [*words, "--csv", file]
        code = self._start(words)
        if code != 2:
            self._draw([Table.read(Path(file))])
        return code

    def _sweep(self, folder: Path) -> int:
        axes = self._extras.sweep
        require_table(self._words)
        plain = without([word for word in self._words if word != "--json"], "--csv")
        names = self._parameters(plain[0])
        require_distinct(axes, names)
        for name in axes:
            require_free(plain, name, names)
        index, count = self._extras.shard
        points = combinations(axes)[index - 1::count]
        if not points:
            raise BadInput(f"run: --shard {index}/{count} has no run: the sweep has {len(combinations(axes))}")
        each = [self._changed(plain, point, names) for point in points]
        refusals = [self._refusal(words, folder) for words in each]
        why = impossible_value(points, refusals) if count == 1 else ""
        if why or all(refusals) and count == 1:
            raise BadInput(f"run: {why or refusals[0]}")
        self.skipped = [Result(point, None, why) for point, why in zip(points, refusals) if why]
        asked = [(point, words) for point, words, why in zip(points, each, refusals) if not why]
        part = f"{index}/{count}" if count > 1 else ""
        try:
            results, tables, worst = self._results(asked, folder)
        except Interrupted as end:
            if end.results:
                put_out(Sweep(axes, end.results, self.skipped, part), self._words)
                if csv := value_of("--csv", self._words):  # an earlier table's manifest is not that of this one
                    manifest_of(Path(csv)).unlink(missing_ok=True)
            print(f"Interrupted. The table has {len(end.results)} of {len(asked)} runs." if end.results else
                  "Interrupted before a run ended.", file=sys.stderr)
            raise end.cause
        put_out(Sweep(axes, results, self.skipped, part), self._words)
        if tables:
            self._draw(tables)
        return worst

    def _changed(self, words: list[str], point: dict[str, str], names: set[str]) -> list[str]:
        for name, value in point.items():
            words = with_changed(words, name, value, names)
        return words

    def _results(self, asked: list[tuple[dict, list[str]]], folder: Path) -> tuple[list[Result], list[Table], int]:
        """Makes the runs. Returns their results, the tables of the drawn ones, and the worst exit code."""
        if self._extras.slurm:
            return self._on_slurm([point for point, _ in asked])
        bar, results, tables, worst = Bar("sweep", len(asked)), [], [], 0
        for point, words in asked:
            table = folder / "run.csv"
            try:
                code, out, err = self._captured([*words, "--json", *(["--csv", str(table)] if self._extras.plot else [])])
            except (KeyboardInterrupt, SystemExit) as end:
                bar.done()
                raise Interrupted(results, end) from None
            worst = max(worst, 1 if code < 0 else code)  # a signal's is negative
            run = json.loads(out) if out else None  # with --strict the program prints what is not sound, and fails
            results.append(Result(point, run, "" if out else _last_line(err) or "it failed"))
            if self._extras.plot:
                tables.append(Table.read(table, ", ".join(f"{name} = {value}" for name, value in point.items())))
            bar.step(" ".join(point.values()))
        bar.done()
        return results, tables, worst

    def _on_slurm(self, points: list[dict[str, str]]) -> tuple[list[Result], list[Table], int]:
        """Runs this command with --shard as each part, whose JSON is written beside its log."""
        if self._extras.plot or self._extras.shard != (1, 1):
            raise BadInput("run: --slurm goes with neither --plot nor --shard")
        folder = BUILD / "plots" / "run" / "slurm"
        axes = [f"{name}={','.join(values)}" for name, values in self._extras.sweep.items()]
        words = [str(ROOT / "course"), "run", *without(self._words, "--csv"), *["--mine"] * self._extras.mine, "--json",
                 "--sweep", *axes, "--shard", f"@I@/{self._extras.slurm}"]
        command = ["sh", "-c", 'out="$0"; "$@" > "$out"', str(folder / "@I@.json"), *words]
        failed = run_array(command, self._extras.slurm, folder, "sweep on Slurm")
        found = {}
        for part in range(1, self._extras.slurm + 1):
            file = folder / f"{part}.json"
            text = file.read_text(encoding="utf-8") if file.exists() else ""
            for run in json.loads(text)["runs"] if text else []:
                point, why, _ = run.pop("point"), run.pop("why") or "", run.pop("observed_order")
                found[tuple(point.items())] = Result(point, run if "error" in run else None, why)
            if part in failed and not text:
                print(fold_lines(f"part {part} of {self._extras.slurm} failed: {failed[part]}", "  "), file=sys.stderr)
        results = [found.get(tuple(point.items()), Result(point, None, "the Slurm part with this run failed"))
                   for point in points]
        return results, [], exit_code(results, self._words)

    def _refusal(self, words: list[str], folder: Path) -> str:
        """Returns why the program refuses a run, without a step; empty if it runs. Refuses unknown columns."""
        table = folder / "columns.csv"
        time = value_of("--time", words)
        for option in ("--csv", "--record", "--fps", "--time"):
            words = without(words, option)
        words = [word for word in words if word != "--strict"]  # which judges the run that is made
        if time is None or (number(time) or 0) > 0:
            time = "0"
        code, _, err = self._captured([*words, "--time", time, "--csv", str(table)])
        if code != 0:
            return _last_line(err) or "it failed"
        columns = Table.read(table).columns
        for wanted in self._extras.plot:
            matching(columns, wanted)
        return ""

    def _require(self, words: list[str], folder: Path) -> None:
        if why := self._refusal(words, folder):
            raise BadInput(f"run: {why}")

    def _captured(self, words: list[str]) -> tuple[int, str, str]:
        said: list[str] = []

        def call(command: list[str], **env: str) -> int:
            done = subprocess.run(command, env=os.environ | env, capture_output=True, text=True)
            said[:] = done.stdout, done.stderr
            return done.returncode

        return self._start(words, call), *said

    def _draw(self, tables: list[Table]) -> None:
        command = " ".join(["./course run", *(word for word in self._words if word != "--json")])
        if self._extras.sweep:
            axes = self._extras.sweep.items()
            command += " --sweep " + " ".join(f"{name}={','.join(values)}" for name, values in axes)
        figure = draw(tables, self._extras.plot, self._words[0], command)
        print(f"figure: {shown(figure)}", file=sys.stderr if "--json" in self._words else sys.stdout)


def require_scene(words: list[str]) -> None:
    if not words or words[0].startswith("-"):
        raise BadInput("run: a scene is missing; name it first: ./course run SCENE [OPTION ...]")


def require_table(words: list[str]) -> None:
    """Refuses a --csv of a sweep that cannot be written, and options of a single run."""
    csv = value_of("--csv", words)
    for option in ("--record", "--positions", "--checkpoint", "--restart"):
        if value_of(option, words) is not None or option in words:
            raise BadInput(f"run: {option} is for one run, but --sweep makes several; leave one of them out")
    if sum(word == "--csv" or word.startswith("--csv=") for word in words) > 1:
        raise BadInput("run: --csv is given twice: leave one out")
    if csv is not None:
        _require_writable(csv)
        _require_other(csv, words[0])
        _require_format(csv)


def put_out(sweep: Sweep, words: list[str]) -> None:
    """Writes the table to --csv, and prints it."""
    csv = value_of("--csv", words)
    if csv is not None:
        (write_parquet if is_parquet(csv) else write_csv)(csv, sweep.table(), sweep.names())
    print((as_json if "--json" in words else as_text)(sweep))


def exit_code(results: Sequence[Result], words: list[str]) -> int:
    """Returns 1 if a run did not get to its end or, with --strict, is not sound."""
    strict = "--strict" in words
    return int(any(each.run is None or strict and each.run["state"]["name"] != "sound" for each in results))


def _last_line(err: str) -> str:
    return (err.strip().splitlines() or [""])[-1].removeprefix("spook: ")


def _require_writable(file: str) -> None:
    """Checks that the result can be written before time is spent on runs; nothing is changed yet."""
    path = Path(file)
    if path.is_dir() or not path.parent.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise BadInput(f'run: --csv must be a file in an existing folder that you may write, but is "{file}"')


def _require_other(csv: str, scene: str) -> None:
    """Refuses to replace the scene's file by the table."""
    if Path(csv).exists() and Path(scene).exists() and Path(csv).samefile(scene):
        raise BadInput(f'run: --csv must be another file than the scene, but is "{csv}"')


def is_parquet(file: str) -> bool:
    return file.endswith(".parquet")


def _require_format(file: str) -> None:
    """Refuses a Parquet file before time is spent on runs, if nothing can write it."""
    if is_parquet(file) and importlib.util.find_spec("pyarrow") is None:
        raise BadInput(f'run: csv "{file}" needs the Python package pyarrow; pip install pyarrow, or give a name that '
                       "ends in .csv")
