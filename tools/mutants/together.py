"""Puts the wrong answers to a chapter's exercises into one program, each in a namespace of its own.

    together.py source RESULT FILE...                                      their texts, to be compiled as one
    together.py switch RESULT REFERENCE --objects OBJECT... --files FILE...   the functions, each of which calls one

FILE is a .diff or one wrong answer: see answers.py. SPOOK_MUTANT=forgets_mass_of_kick in the environment of the
program chooses the answer `forgets_mass` to the exercise `kick`. All other functions are those of the reference.
REFERENCE is an archive whose symbols are read. Compiled one by one, mutants take five times as long.
"""

import argparse
import sys
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "mutation"), str(TOOLS / "course")]
from answer import Answer  # noqa: E402
from answers import by_exercise, exercise_of, read_answers, reference_of  # noqa: E402
from crowd import Crowd, Switched  # noqa: E402
from errors import CourseError  # noqa: E402
from symbols import functions_in  # noqa: E402


def together(files: list[Path]) -> tuple[Crowd, dict[str, range]]:
    """Returns the texts, and by each exercise's function their numbers, of which the reference's is the first."""
    answers: list[Answer] = []
    numbers: dict[str, range] = {}
    for some in by_exercise(files):
        exercise, first = exercise_of(some[0]), len(answers)
        answers += [reference_of(exercise), *read_answers(some)]
        numbers[exercise.function] = range(first, len(answers))
    for answer in answers:
        if not Crowd.can_hold(answer.source()):
            raise CourseError(f"{answer.place}: it must have one `namespace spook`, and nothing but comments and "
                              "includes before it")
    return Crowd({k: answer.source() for k, answer in enumerate(answers)}, dict(enumerate(answers))), numbers


def _write(file: Path, text: str) -> None:
    """Writes a file only if its text has changed, so that it is not compiled again."""
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    source, switch = (commands.add_parser(name) for name in ("source", "switch"))
    for command in (source, switch):
        command.add_argument("result", type=Path)
    source.add_argument("files", type=Path, nargs="+")
    switch.add_argument("reference", type=Path)
    for option in ("--objects", "--files"):
        switch.add_argument(option, type=Path, nargs="+", required=True)
    options = parser.parse_args(words)
    try:
        crowd, numbers = together(options.files)
        if options.command == "source":
            text = crowd.source()
        else:
            text = crowd.switch(options.objects, [
                Switched(frozenset(functions_in(options.reference, function)), tuple(texts), otherwise=texts[0])
                for function, texts in numbers.items()])
        _write(options.result, text)
    except CourseError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
