"""./course hint: shows one more hint at each call."""

import remembered
from manifest import Exercise
from pick import pick_one
from terminal import fold, paint

_FILE, _TABLE = "state.json", "hints"


def hint(arguments) -> int:
    exercise = pick_one(arguments.which)
    given = _read()
    before = 0 if arguments.again else min(given.get(exercise.id, 0), len(exercise.hints))
    number = min(before + 1, len(exercise.hints))
    remembered.write(_FILE, _TABLE, given | {exercise.id: number})
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
    """Reads how many hints of each exercise were shown."""
    return {key: value for key, value in remembered.read(_FILE, _TABLE).items() if type(value) is int and value >= 0}
