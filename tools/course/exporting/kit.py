"""The common part of kits: hidden tests, and the grader's command line."""

import shlex
from pathlib import Path

from errors import BadInput
from grading.weights import read_rows
from pick import as_list

KITS = Path(__file__).resolve().parent / "kits"


def hidden_files(arguments) -> list[Path]:
    """The hidden tests and their table, relative to their folder."""
    if not arguments.hidden:
        return []
    folder = Path(arguments.hidden)
    files = sorted([*folder.glob("[0-9][0-9]_*/*.[ch]pp"), *folder.glob("weights.csv")])
    if not files:
        raise BadInput(f"export: no hidden tests in {folder}")
    return [file.relative_to(folder) for file in files]


def check_weights(arguments) -> bytes | None:
    """Checks the table of weights for the platform, and returns it."""
    if not arguments.weights:
        return None
    read_rows(Path(arguments.weights))
    return Path(arguments.weights).read_bytes()


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
