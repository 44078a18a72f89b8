"""The course command: calls one file for each subcommand, and reports errors."""

import importlib
import os
import signal
import sys
from collections.abc import Callable

import terminal
from arguments import parse
from errors import CourseError

# The file and the function of each command. Only the file of the called command is imported.
COMMANDS = {"progress": "board.progress", "check": "check.check", "watch": "watch.watch", "plot": "plot.plot",
            "hint": "hint.hint", "solution": "solution.solution", "reset": "reset.reset", "start": "start.start",
            "test": "everything.test", "grade": "grading.grade.grade", "export": "exporting.export.export",
            "view": "view.view", "play": "play.play", "predict": "predict.predict", "book": "book.book",
            "try": "playground.playground", "python": "python.python", "import": "importing.command.import_model",
            "update": "update.update", "slides": "slides.slides", "exam": "exam.exam", "version": "version.show_version"}
FORWARDED = {"run": "run.run", "scenes": "run.scenes"}


def _function(place: str) -> Callable:
    file, _, name = place.rpartition(".")
    return getattr(importlib.import_module(file), name)


def main(words: list[str]) -> int:
    terminal.prepare()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # an exception, so that what was begun is ended
    try:
        arguments = parse(words)
        if arguments.command in FORWARDED:
            return _function(FORWARDED[arguments.command])(arguments.words)
        code = _function(COMMANDS[arguments.command])(arguments)
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
