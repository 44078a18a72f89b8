"""./course run --plot and --sweep: one run or several, what they are in a table and in a figure."""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from beside import with_changed, without
from curves import Table, draw, matching
from errors import BadInput
from extras import Extras
from paths import shown
from sweep import Result, as_json, as_table
from terminal import Bar


class Runs:
    """Of one scene: its columns drawn, or a line of a table for each value that is swept, or both."""

    def __init__(self, words: list[str], extras: Extras, start: Callable[..., int]):
        """`start` runs the program with the words, by subprocess or by the function `call`, and gives its exit code."""
        if not words or words[0].startswith("-"):
            raise BadInput("run: a scene is missing; name it first: ./course run SCENE [OPTION ...]")
        self._words, self._extras, self._start = words, extras, start

    def all(self) -> int:
        with tempfile.TemporaryDirectory(prefix="course-") as folder:
            return self._sweep(Path(folder)) if self._extras.sweep else self._one(Path(folder))

    def _one(self, folder: Path) -> int:
        self._look_for_columns(self._words, folder)
        words, file = self._words, _value_of("--csv", self._words)
        if file is None:
            file = str(folder / "run.csv")
            words = [*words, "--csv", file]
        code = self._start(words)
        if code != 2:
            self._draw([Table.read(Path(file))])
        return code

    def _sweep(self, folder: Path) -> int:
        name, values = self._extras.sweep
        for option in ("--csv", "--record"):
            if _value_of(option, self._words) is not None:
                raise BadInput(f"run: {option} is for one run, but --sweep makes {len(values)}; leave one of them out")
        plain = [word for word in self._words if word != "--json"]
        each = [with_changed(plain, name, value) for value in values]
        for words in each:  # so that nothing is refused halfway
            self._look_for_columns(words, folder)
        bar, results, tables, worst = Bar("sweep", len(each)), [], [], 0
        for value, words in zip(values, each):
            table = folder / "run.csv"
            code, out, err = self._captured([*words, "--json", *(["--csv", str(table)] if self._extras.plot else [])])
            if code == 2:
                bar.done()
                sys.stderr.write(err)
                return code
            worst = max(worst, code)
            why = "" if code == 0 else (err.strip().splitlines() or ["it failed"])[-1].removeprefix("spook: ")
            results.append(Result(value, json.loads(out) if code == 0 else None, why))
            if self._extras.plot:
                tables.append(Table.read(table, f"{name} = {value}"))
            bar.step(value)
        bar.done()
        print((as_json if "--json" in self._words else as_table)(name, results))
        if tables:
            self._draw(tables)
        return worst

    def _look_for_columns(self, words: list[str], folder: Path) -> None:
        """Refuses what the program does, and columns that there are not, before time is spent on the runs."""
        table = folder / "columns.csv"
        for option in ("--csv", "--record", "--fps", "--time"):
            words = without(words, option)
        code, _, err = self._captured([*words, "--time", "0", "--csv", str(table)])
        if code != 0:
            sys.stderr.write(err)
            raise SystemExit(code)
        columns = Table.read(table).columns
        for wanted in self._extras.plot:
            matching(columns, wanted)

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
            name, values = self._extras.sweep
            command += f" --sweep {name}={','.join(values)}"
        figure = draw(tables, self._extras.plot, self._words[0], command)
        print(f"figure: {shown(figure)}", file=sys.stderr if "--json" in self._words else sys.stdout)


def _value_of(option: str, words: list[str]) -> str | None:
    for k, word in enumerate(words):
        if word.startswith(f"{option}="):
            return word.partition("=")[2]
        if word == option and k + 1 < len(words):
            return words[k + 1]
    return None
