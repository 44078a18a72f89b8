"""./course solution: shows the reference once the exercise passes."""

from paths import shown
from pick import pick_one
from sources import need_sources
from terminal import paint
from verdict import judge


def solution(arguments) -> int:
    exercise = pick_one(arguments.which)
    need_sources("solution")
    if not arguments.spoil:
        state = judge(exercise).state
        if state != "done":
            print(f"{exercise.label} is {state}: try to make it pass before you read the reference. "
                  f"A hint: ./course hint {exercise.id}\n"
                  f"If you would rather see it now: ./course solution {exercise.id} --spoil")
            return 1
    print(paint(f"// {shown(exercise.reference)}", "dim"))
    print(exercise.reference.read_text(encoding="utf-8"), end="")
    return 0
