"""Puts the wrong answers to an exercise into one program, each in a namespace of its own.

    together.py source RESULT FILE...                    their texts, to be compiled as one
    together.py switch RESULT REFERENCE OBJECT FILE...   the exercise's functions, which call one of them

FILE is a .diff or one wrong answer: see answers.py. SPOOK_MUTANT in the environment of the program chooses which, by
its number, from 1. REFERENCE is an archive with the right functions. Compiled one by one, mutants take five times as
long.
"""

import argparse
import sys
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "mutation"), str(TOOLS / "course")]
from answers import read_answers  # noqa: E402
from crowd import Crowd  # noqa: E402
from errors import CourseError  # noqa: E402
from symbols import functions_in  # noqa: E402


def together(files: list[Path]) -> Crowd:
    answers = dict(enumerate(read_answers(files), 1))
    texts = {k: answer.source() for k, answer in answers.items()}
    for k, answer in answers.items():
        if not Crowd.can_hold(texts[k]):
            raise CourseError(f"{answer.place}: it must have one `namespace spook`, and nothing but comments and "
                              "includes before it")
    return Crowd(texts, answers)


def _write(file: Path, text: str) -> None:
    """What reads the same is not compiled again."""
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, inputs in (("source", ()), ("switch", ("reference", "object"))):
        command = commands.add_parser(name)
        for argument in ("result", *inputs):
            command.add_argument(argument, type=Path)
        command.add_argument("files", type=Path, nargs="+")
    options = parser.parse_args(words)
    try:
        crowd = together(options.files)
        if options.command == "source":
            text = crowd.source()
        else:
            function = options.files[0].name.split(".")[0]
            text = crowd.switch(options.object, functions_in(options.reference, function))
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
