"""./course hint: one more each time."""

import json
import os

from manifest import Exercise
from paths import STATE
from pick import pick_one
from terminal import fold, paint

_FILE = STATE / "state.json"


def hint(arguments) -> int:
    exercise = pick_one(arguments.which)
    given = _read()
    before = 0 if arguments.again else min(given.get(exercise.id, 0), len(exercise.hints))
    number = min(before + 1, len(exercise.hints))
    _write(given | {exercise.id: number})
    _show(exercise, number, repeated=before == number)
    return 0


def _show(exercise: Exercise, number: int, repeated: bool) -> None:
    count = len(exercise.hints)
    print(f"{paint(exercise.label, 'bold')}, hint {number} of {count}\n")
    print(fold(exercise.hints[number - 1], "  ") + "\n")
    if repeated:
        print(f"That was the last one. From the first: ./course hint {exercise.id} --again\n"
              f"The reference: ./course solution {exercise.id} --spoil")
    elif number == count:
        print("That was the last hint.")


def _read() -> dict[str, int]:
    """How many hints of each exercise were given; none, if the file is not what was written."""
    try:
        given = json.loads(_FILE.read_text(encoding="utf-8"))["hints"]
        return {str(key): value for key, value in given.items() if type(value) is int and value >= 0}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _write(given: dict[str, int]) -> None:
    STATE.mkdir(exist_ok=True)
    new = _FILE.with_suffix(".new")
    new.write_text(json.dumps({"hints": given}, indent=2) + "\n", encoding="utf-8")
    os.replace(new, _FILE)
