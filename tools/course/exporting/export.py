"""./course export: kits with which other platforms run the grader, and results in their forms."""

import sys
from collections.abc import Callable
from pathlib import Path

from errors import BadInput
from exporting import autolab, github, gradescope, junit, table, weights
from grading.merge import read_result, read_results

_KITS: dict[str, Callable] = {"gradescope": gradescope.write_kit, "github": github.write_kit,
                              "autolab": autolab.write_kit}
# What the results of several submissions can be written as, and what holds one submission only.
_OF_MANY = {"junit": junit.of_results, "csv": table.of_results}
_OF_ONE = {"gradescope": gradescope.of_result, "github": github.of_result, "autolab": autolab.of_result}


def export(arguments) -> int:
    what, out = arguments.what, arguments.out
    if what == "weights":
        return _write(weights.table(), out)
    if arguments.results:
        results = [result for path in arguments.results for result in _read(Path(path))]
        if what in _OF_MANY:
            return _write(_OF_MANY[what](results), out)
        if len(results) != 1:
            raise BadInput(f"export: {what} takes the results of one submission, but these are {len(results)}")
        return _write(_OF_ONE[what](results[0]), out)
    if what not in _KITS:
        raise BadInput(f"export: {what} needs results: a results.json, or a folder that ./course grade has written")
    written = _KITS[what](arguments)
    print(f"Written: {', '.join(map(str, written))}")
    return 0


def _read(path: Path) -> list[dict]:
    return list(read_results(path).values()) if path.is_dir() else [read_result(path)]


def _write(text: str, out: str | None) -> int:
    if out:
        Path(out).write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    return 0
