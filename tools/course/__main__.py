"""The course command: calls one file for each subcommand, and reports errors."""

import os
import sys

import terminal
from arguments import parse
from board import progress
from book import book
from check import check
from errors import CourseError
from everything import test
from exam import exam
from exporting.export import export
from grading.grade import grade
from hint import hint
from importing.command import import_model
from play import play
from playground import playground
from plot import plot
from predict import predict
from python import python
from reset import reset
from run import run, scenes
from slides import slides
from solution import solution
from start import start
from update import update
from version import show_version
from view import view
from watch import watch

COMMANDS = {"progress": progress, "check": check, "watch": watch, "plot": plot, "hint": hint, "solution": solution,
            "reset": reset, "start": start, "test": test, "grade": grade, "export": export, "view": view,
            "play": play, "predict": predict, "book": book, "try": playground, "python": python,
            "import": import_model, "update": update, "slides": slides, "exam": exam, "version": show_version}
FORWARDED = {"run": run, "scenes": scenes}


def main(words: list[str]) -> int:
    terminal.prepare()
    try:
        arguments = parse(words)
        if arguments.command in FORWARDED:
            return FORWARDED[arguments.command](arguments.words)
        code = COMMANDS[arguments.command](arguments)
        sys.stdout.flush()
        return code
    except CourseError as error:
        sys.stdout.flush()
        if error.details:
            print(error.details, file=sys.stderr)
        print(f"course: {error}", file=sys.stderr)
        return error.code
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # Whoever read the output has gone; nothing may be flushed into it at exit, either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        print(f"course: {error.strerror}: {error.filename}", file=sys.stderr)
        return 1


sys.exit(main(sys.argv[1:]))
