"""./course progress: the student's state, and the next step."""

import json

from films import milestones, not_shown, own_step
from last_verdicts import last_state, remember
from manifest import Chapter, Exercise, all_exercises, read_chapters
from marker import code_of
from paths import shown
from predict import count_right, guesses
from predictions import predictions_of
from terminal import WIDTH, fold, paint, symbol
from verdict import Verdict, judge_all


def progress(arguments) -> int:
    chapters = read_chapters()
    verdicts = judge_all([exercise for chapter in chapters for exercise in chapter.exercises])
    remember(verdicts)
    if arguments.json:
        print(json.dumps(as_json(verdicts) | {"predictions": predictions_as_json(chapters)}, indent=2))
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
        line = f"{paint(chapter.title, 'bold')}{count:>{WIDTH - len(chapter.title)}}"
        if not is_open(chapter, own, verdicts):
            print(line)
            continue
        print(f"\n{line}")
        print(prediction_line(chapter))
        for verdict in own:
            print(board_line(verdict))
        if count_done(own) == len(own):
            show_milestone(chapter.folder)
        print()
    print(f"\n{count_done(verdicts)} of {len(verdicts)} done.")
    if written := [verdict.exercise for verdict in verdicts if verdict.state == "done"]:
        lines = lines_of("\n".join(exercise.source() or "" for exercise in written))
        print(f"You have written an engine of {lines} lines, in {len(written)} {'function' if len(written) == 1 else 'functions'}.")
    waiting = first_left([(verdict.exercise, verdict.state) for verdict in verdicts])
    if waiting:
        show_next(*waiting)
    else:
        print("Every exercise is right. Well done!")


def lines_of(source: str) -> int:
    """The number of lines of code, without comments and blank lines."""
    return sum(1 for line in code_of(source).splitlines() if line.strip())


def is_open(chapter: Chapter, own: list[Verdict], verdicts: list[Verdict]) -> bool:
    """Tells whether the board lists the chapter's exercises: a chapter that is begun, else the next one to begin. A
    finished chapter stays open until the next one is begun, to show its film."""
    asked = predictions_of(chapter)
    states = {verdict.state for verdict in own}
    if states != {"not started"}:
        return states != {"done"} or len(guesses(asked)) < len(asked) or _is_last_begun(own, verdicts)
    return bool(guesses(asked)) or own[0] == next(each for each in verdicts if each.state == "not started")


def _is_last_begun(own: list[Verdict], verdicts: list[Verdict]) -> bool:
    begun = [verdict for verdict in verdicts if verdict.state != "not started"]
    return begun[-1] in own


def show_milestone(folder: str) -> None:
    commands = milestones(folder)
    if not commands:
        return
    print("  See it move, on your functions:")
    for command in commands:
        print(f"  {command}")
    if command := own_step(folder):
        step = _step_of(folder)
        print("  By your own step:" if step.started() else f"  By your own step, once you have written {step.label}:")
        print(f"  {command}")
    left_out = [exercise.id for exercise in all_exercises()
                if exercise.folder == folder and exercise.function in not_shown(folder)]
    if left_out:
        print(fold(f"The commands above do not call {', '.join(left_out)}; to run it: ./course try {left_out[0]}.", "  "))


def _step_of(folder: str) -> Exercise:
    """Returns the exercise whose step `--engine mine` runs after this chapter: its own, or that of a chapter before.

    All are named step_..., but for 1.4 leapfrog_step.
    """
    return [exercise for exercise in all_exercises()
            if exercise.folder <= folder and (exercise.function.startswith("step_") or exercise.id == "1.4")][-1]


def board_line(verdict: Verdict) -> str:
    state = f"{verdict.state}: {verdict.reason}" if verdict.reason else verdict.state
    return f"  {symbol(verdict.state)} {verdict.exercise.id:>5} {verdict.exercise.function:<22} {state}"


def prediction_line(chapter: Chapter) -> str:
    asked = predictions_of(chapter)
    made = len(guesses(asked))
    state = f"{made} of {len(asked)} made" if made < len(asked) else f"{count_right(asked)} of {len(asked)} right"
    mark = symbol("done" if made == len(asked) else "not started")
    return f"  {mark} {'':>5} {'predictions':<22} {state}"


def predictions_as_json(chapters: list[Chapter]) -> list[dict]:
    return [{"chapter": chapter.number, "made": len(guesses(asked)), "right": count_right(asked), "total": len(asked)}
            for chapter in chapters for asked in [predictions_of(chapter)]]


def first_left(states: list[tuple[Exercise, str]]) -> tuple[Exercise, str] | None:
    """Returns the next exercise and its state: the first wrong one; then the first that is not started or not checked."""
    wrong = [pair for pair in states if pair[1] == "wrong"]
    left = [pair for pair in states if pair[1] != "done"]
    return next(iter(wrong + left), None)


def next_of_all() -> tuple[Exercise, str] | None:
    """Returns the next of all exercises and its state, by the last check of each."""
    return first_left([(exercise, last_state(exercise)) for exercise in all_exercises()])


def show_next(exercise: Exercise, state: str = "not started") -> None:
    told = {"wrong": ", which is wrong", "begun": ", which you have begun and not checked"}.get(state, "")
    print(f"\nNext: {paint(exercise.label, 'bold')}{told}")
    for verb, what in (("read", shown(exercise.lesson)), *_to_predict(exercise), ("write", shown(exercise.file)),
                       ("check", f"./course check {exercise.id}"), ("stuck", f"./course hint {exercise.id}")):
        print(f"  {verb:<8}{what}")


def _to_predict(exercise: Exercise) -> list[tuple[str, str]]:
    """Returns the chapter's open questions, if none of its exercises is begun."""
    if exercise.number != 1:
        return []
    chapter = next(chapter for chapter in read_chapters() if chapter.number == exercise.chapter)
    asked = predictions_of(chapter)
    return [("predict", f"./course predict {chapter.number}")] if len(guesses(asked)) < len(asked) else []
