"""./course check: the first failure in full, the others by name, and the verdict."""

import textwrap

from board import board_line, count_done, next_of_all, show_milestone, show_next
from grading.choices import TABLE
from grading.weights import defaults, read_rows
from last_verdicts import last_state, remember
from manifest import Exercise, all_exercises
from paths import shown
from pick import pick
from terminal import fold, fold_lines, paint, symbol
from verdict import Verdict, judge, judge_all

_PRINTED_LINES = 20
_SHOWN = 4  # tests that are named after a pass


def check(arguments) -> int:
    return check_which(arguments.which, arguments.seed)


def check_which(which: str | None, seed: int | None) -> int:
    if which is None:
        return _check_started(seed)
    exercises = pick(which)
    if len(exercises) == 1:
        verdict = judge(exercises[0], seed)
        remember([verdict])
        show(verdict)
        if verdict.state != "done":
            return 1
        if _completes_its_chapter(exercises[0], seed):
            print(f"\nChapter {exercises[0].chapter} is done.")
            show_milestone(exercises[0].folder)
        _show_what_follows()
        return 0
    verdicts = _judged(exercises, seed)
    _show_many(verdicts)
    print(f"\nChapter {exercises[0].chapter}: {count_done(verdicts)} of {len(verdicts)} done.")
    if count_done(verdicts) < len(verdicts):
        return 1
    show_milestone(exercises[0].folder)
    _show_what_follows()
    return 0


def _judged(exercises: list[Exercise], seed: int | None) -> list[Verdict]:
    verdicts = judge_all(exercises, seed)
    remember(verdicts)
    return verdicts


def _completes_its_chapter(exercise: Exercise, seed: int | None) -> bool:
    """Tells whether all exercises of the chapter are right. Only those that no check has seen as they are now are
    checked."""
    own = [other for other in all_exercises() if other.folder == exercise.folder]
    if any(last_state(other) in ("wrong", "not started") for other in own):
        return False
    unseen = [other for other in own if last_state(other) == "begun"]
    return all(verdict.state == "done" for verdict in _judged(unseen, seed)) if unseen else True


def _show_what_follows() -> None:
    waiting = next_of_all()
    if waiting:
        show_next(*waiting)
    else:
        print("\nThat was the last exercise; ./course shows the board.")


def _check_started(seed: int | None) -> int:
    """Checks the first started exercise that is wrong; if all are right, names the next one."""
    exercises = all_exercises()
    verdicts = _judged([exercise for exercise in exercises if exercise.started()], seed)
    wrong = [verdict for verdict in verdicts if verdict.state != "done"]
    if wrong:
        _show_many(verdicts[: verdicts.index(wrong[0]) + 1])
        return 1
    _show_many(verdicts)
    waiting = [exercise for exercise in exercises if not exercise.started()]
    if verdicts and not any(exercise.folder == verdicts[-1].exercise.folder for exercise in waiting):
        show_milestone(verdicts[-1].exercise.folder)
    if not waiting:
        print("\nEvery exercise is right. Well done!")
    elif verdicts:
        print("\nAll exercises that you have started are right.")
        show_next(waiting[0])
    else:
        print("Nothing is started yet.")
        show_next(waiting[0])
    return 0 if verdicts else 1


def _show_many(verdicts: list[Verdict]) -> None:
    """Shows one line for each exercise, and the first wrong one in full below."""
    for verdict in verdicts:
        print(board_line(verdict))
    wrong = [verdict for verdict in verdicts if verdict.state == "wrong"]
    if wrong:
        print()
        show(wrong[0])


def show(verdict: Verdict) -> None:
    exercise = verdict.exercise
    print(f"{paint(exercise.label, 'bold')}   {shown(exercise.file)}\n")
    if verdict.details:
        print(fold_lines(verdict.details, "  ") + "\n")
    if verdict.printed:
        print("  Your code printed:")
        print(textwrap.indent(_shortened(verdict.printed), "    ") + "\n")
    for name in verdict.others:
        print(f"  {symbol('wrong')} {name} fails, too")
    for warning in verdict.warnings:
        print(fold_lines(warning, "  "))
    if verdict.note:
        print(fold(verdict.note, "  "))
    if verdict.others or verdict.warnings or verdict.note:
        print()
    print(fold(f"{symbol(verdict.state)} {exercise.label} {_summary(verdict)}"))
    if verdict.state == "done":
        print(fold(_what_was_shown(exercise), "  "))


def _what_was_shown(exercise: Exercise) -> str:
    """Names the first few tests by their titles."""
    rows = read_rows(TABLE)
    titles = [rows.get(test, default).title for test, default in defaults([exercise]).items()]
    titles = [title[:1].lower() + title[1:] if title[1:2].islower() else title for title in titles]
    more = [f"and {len(titles) - _SHOWN} more"] if len(titles) > _SHOWN else []
    return f"What was tested: {'; '.join(titles[:_SHOWN] + more)}." if titles else ""


def _shortened(text: str) -> str:
    lines = text.splitlines()
    surplus = len(lines) - _PRINTED_LINES
    left_out = [f"({surplus} earlier lines left out)"] if surplus > 0 else []
    return "\n".join(left_out + lines[-_PRINTED_LINES:])


def _summary(verdict: Verdict) -> str:
    if verdict.state == "done":
        return f"is done: {verdict.tests} {'test passes' if verdict.tests == 1 else 'tests pass'}."
    if verdict.state == "not started":
        return f"is not started. The lesson: {shown(verdict.exercise.lesson)}"
    failing = 1 + len(verdict.others)
    count = f" ({failing} of {verdict.tests} tests)" if verdict.tests else ""
    return f"is wrong: {verdict.reason}{count}."
