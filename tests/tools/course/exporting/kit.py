"""What every kit holds: the instructor's tree, as it is now, and the words with which its grader is called."""

import shlex
import subprocess
from pathlib import Path

from errors import BadInput, CourseError
from paths import ROOT

KITS = Path(__file__).resolve().parent / "kits"


def course_files() -> list[Path]:
    """What git knows of, and what is new and not ignored; relative to the root."""
    listing = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-coz", "--exclude-standard"],
                             capture_output=True, text=True)
    if listing.returncode != 0:
        raise CourseError(f"git can not list the files of {ROOT}: {listing.stderr.strip()}")
    return [Path(name) for name in sorted(set(listing.stdout.split("\0")))
            if name and (ROOT / name).is_file() and ".cpp.mine-" not in name]


def hidden_files(arguments) -> list[Path]:
    """The hidden tests and their table, relative to their folder."""
    if not arguments.hidden:
        return []
    folder = Path(arguments.hidden)
    files = sorted([*folder.glob("[0-9][0-9]_*/*.[ch]pp"), *folder.glob("weights.csv")])
    if not files:
        raise BadInput(f"export: no hidden tests in {folder}")
    return [file.relative_to(folder) for file in files]


def options(arguments, hidden_at: str) -> str:
    """Of ./course grade, for a shell."""
    words = []
    if arguments.chapters:
        words += ["--chapters", ",".join(map(str, sorted(arguments.chapters)))]
    if arguments.seed is not None:
        words += ["--seed", str(arguments.seed)]
    quoted = shlex.join(words)
    return f'{quoted} --hidden "{hidden_at}"'.strip() if arguments.hidden else quoted


def filled(name: str, **values: str) -> str:
    """A file of kits/, with each @NAME@ replaced."""
    text = (KITS / name).read_text(encoding="utf-8")
    for key, value in values.items():
        text = text.replace(f"@{key.upper()}@", value)
    return text
