"""./course progress: where the student is, and what comes next."""

import json

from films import milestone
from manifest import Chapter, Exercise, all_exercises, read_chapters
from paths import shown
from terminal import WIDTH, paint, symbol
from verdict import Verdict, judge_all


def progress(arguments) -> int:
    chapters = read_chapters()
    verdicts = judge_all([exercise for chapter in chapters for exercise in chapter.exercises])
    if arguments.json:
        print(json.dumps(as_json(verdicts), indent=2))
    else:
        show_board(chapters, verdicts)
    return 0


def as_json(verdicts: list[Verdict]) -> dict:
    return {
        "done": count_done(verdicts),
        "total": len(verdicts),
        "exercises": [{"id": verdict.exercise.id, "name": verdict.exercise.function, "state": verdict.state,
                       "reason": verdict.reason, "file": shown(verdict.exercise.file)}
                      for verdict in verdicts],
    }


def count_done(verdicts: list[Verdict]) -> int:
    return sum(verdict.state == "done" for verdict in verdicts)


def show_board(chapters: list[Chapter], verdicts: list[Verdict]) -> None:
    for chapter in chapters:
        own = [verdict for verdict in verdicts if verdict.exercise in chapter.exercises]
        count = f"{count_done(own)} of {len(own)} done"
        print(f"\n{paint(chapter.title, 'bold')}{count:>{WIDTH - len(chapter.title)}}")
        for verdict in own:
            print(board_line(verdict))
        if count_done(own) == len(own):
            show_milestone(chapter.folder)
    print(f"\n{count_done(verdicts)} of {len(verdicts)} done.")
    # What is begun and wrong comes before what is not begun.
    left = [verdict.exercise for state in ("wrong", "not started") for verdict in verdicts if verdict.state == state]
    if left:
        show_next(left[0])
    else:
        print("Every exercise is right. Well done!")


def show_milestone(folder: str) -> None:
    if command := milestone(folder):
        print(f"  See it move, on your functions:  {command}")


def board_line(verdict: Verdict) -> str:
    state = f"{verdict.state}: {verdict.reason}" if verdict.reason else verdict.state
    return f"  {symbol(verdict.state)} {verdict.exercise.id:>5} {verdict.exercise.function:<22} {state}"


def next_after(exercise: Exercise) -> Exercise | None:
    """The first that is not begun: from here on, and if there is none, of all."""
    exercises = all_exercises()
    here = exercises.index(exercise)
    return next((other for other in exercises[here:] + exercises[:here] if not other.started()), None)


def show_next(exercise: Exercise) -> None:
    print(f"\nNext: {paint(exercise.label, 'bold')}")
    for verb, what in (("read", shown(exercise.lesson)), ("write", shown(exercise.file)),
                       ("check", f"./course check {exercise.id}"), ("stuck", f"./course hint {exercise.id}")):
        print(f"  {verb:<7}{what}")
