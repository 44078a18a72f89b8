"""The common part of kits: hidden tests, and the grader's command line."""

import contextlib
import os
import shlex
from collections.abc import Iterator
from pathlib import Path

from errors import BadInput
from grading.choices import TABLE
from grading.weights import defaults, read_weights
from manifest import all_exercises, tests_in
from pick import as_list

KITS = Path(__file__).resolve().parent / "kits"


def hidden_files(arguments) -> list[Path]:
    """The hidden tests and their table, relative to their folder."""
    if not arguments.hidden:
        return []
    folder = Path(arguments.hidden)
    files = sorted([*folder.glob("[0-9][0-9]_*/*.[ch]pp"), *folder.glob("weights.csv")])
    if not any(file.suffix == ".cpp" for file in files):
        raise BadInput(f"export: no hidden tests in {folder}")
    return [file.relative_to(folder) for file in files]


def check_weights(arguments) -> bytes | None:
    """Checks the tables of weights for the platform, and returns the instructor's own."""
    exercises = arguments.chapters or all_exercises()
    hidden = Path(arguments.hidden) if arguments.hidden else None
    folders = sorted({hidden / exercise.folder for exercise in exercises}) if hidden else []
    tests = [*defaults(exercises), *(test for folder in folders for test in tests_in(folder))]
    read_weights(Path(arguments.weights or TABLE), hidden).check_names(tests, {exercise.suite for exercise in exercises})
    return Path(arguments.weights).read_bytes() if arguments.weights else None


@contextlib.contextmanager
def replaced(*files: Path) -> Iterator[list[Path]]:
    """Gives places beside the files to write to, and renames what is written only if nothing raises."""
    beside = [file.with_name(f"{file.name}.part") for file in files]
    try:
        yield beside
        for written, file in zip(beside, files):
            os.replace(written, file)
    finally:
        for written in beside:
            written.unlink(missing_ok=True)


def options(arguments, hidden_at: str, weights_at: str) -> str:
    """Returns the options of ./course grade, quoted for a shell."""
    words = []
    if arguments.chapters:
        words += ["--chapters", as_list(arguments.chapters)]
    if arguments.seed is not None:
        words += ["--seed", str(arguments.seed)]
    if arguments.hidden_seed is not None:
        words += ["--hidden-seed", str(arguments.hidden_seed)]
    if arguments.time_limit is not None:
        words += ["--time-limit", str(arguments.time_limit)]
    if arguments.points:
        words += ["--points", arguments.points]
    quoted = [shlex.join(words)] if words else []
    quoted += [f'--weights "{weights_at}"'] if arguments.weights else []
    quoted += [f'--hidden "{hidden_at}"'] if arguments.hidden else []
    return " ".join(quoted)


def filled(name: str, **values: str) -> str:
    """Returns a file of kits/, with each @NAME@ replaced."""
    text = (KITS / name).read_text(encoding="utf-8")
    for key, value in values.items():
        text = text.replace(f"@{key.upper()}@", value)
    return text
