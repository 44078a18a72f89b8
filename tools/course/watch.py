"""./course watch: checks at every save."""

import sys
import time

from check import check_which
from manifest import all_exercises
from pick import pick

_PERIOD = 0.3


def watch(arguments) -> int:
    exercises = pick(arguments.which) if arguments.which else all_exercises()
    seen = None
    while True:
        now = [saved(exercise.file) for exercise in exercises]
        if now != seen:
            seen = now
            if sys.stdout.isatty():
                print("\033[2J\033[3J\033[H", end="")
            check_which(arguments.which, arguments.seed)
            print("\nWatching; Ctrl-C ends.", flush=True)
        time.sleep(_PERIOD)


def saved(file) -> int | None:
    """Returns the time of the last save; None for a missing file."""
    try:
        return file.stat().st_mtime_ns
    except FileNotFoundError:
        return None
