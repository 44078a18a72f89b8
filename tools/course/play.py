"""./course play: runs the engine; a page in the browser shows it and lets you drag bodies."""

import os
import queue
import signal
import sys
import tempfile
import threading
import webbrowser
from pathlib import Path

import crash
from engine import program
from errors import BadInput, CourseError
from install import install
from machine import has_desktop
from manifest import all_exercises
from mine import begun, checked_program, own_engine, signed, told
from needs import VIEW_NEEDS
from page import live
from playing.engine import PlayingEngine
from playing.hub import Hub, is_header
from playing.server import Server
from run import crashed
from terminal import fold
from watch import saved

_ALONE = 10  # seconds without a page, after which the run ends
_PERIOD = 0.2  # [s]


def play(arguments) -> int:
    if not arguments.words or arguments.words[0].startswith("-"):
        raise BadInput("play: a scene is missing; name it first: ./course play SCENE [OPTION ...]")
    install(VIEW_NEEDS, yes=False)
    signal.signal(signal.SIGTERM, lambda *_: signal.raise_signal(signal.SIGINT))
    with tempfile.TemporaryDirectory(prefix="course-") as folder:
        return _Session(arguments, Path(folder, "trace")).run()


class _Session:
    def __init__(self, arguments, trace: Path):
        own, words = own_engine(arguments.words)
        self._words, self._is_mine, self._opens = ["play", *words], own or arguments.mine, not arguments.no_open
        self._trace = trace
        self._hub = Hub()
        self._ended: queue.Queue[int] = queue.Queue()
        self._engine: PlayingEngine | None = None
        self._began = threading.Event()
        self._server = Server(arguments.port, live, self._hub, self._command)

    def run(self) -> int:
        try:
            self._mine = begun() if self._is_mine else []
            if self._is_mine:
                print(fold(told(self._mine)) if self._mine else
                      "You have written no exercise yet: everything is the reference until you save one.",
                      file=sys.stderr)
            seen = self._saved()
            self._start(self._program())
            if (code := self._first_line()) is not None:
                return code  # the program has said why
            print(f"{self._server.address}\nThis run ends with Ctrl-C, or when its page is left.", flush=True)
            if self._opens and has_desktop():
                webbrowser.open(self._server.address)
            return self._watch(seen)
        finally:
            if self._engine:
                self._engine.stop()
            self._server.close()

    def _watch(self, seen: list) -> int:
        """Waits until the page is closed, or the engine ends."""
        while self._hub.alone_for() < _ALONE:
            try:
                code = self._ended.get(timeout=_PERIOD)
            except queue.Empty:
                pass
            else:
                if not self._is_mine:
                    return code or 1
                self._hub.say(str(self._crashed(code)))
            if self._is_mine and (now := self._saved()) != seen:
                seen = now
                self._build_again()
        return 0

    def _build_again(self) -> None:
        """Builds the engine again, with the same start and settings. The old one continues if the new one does not
        compile."""
        self._hub.say("Building what you have saved ...")
        self._mine = begun()
        try:
            path = self._program()
        except CourseError as error:
            self._hub.say("\n".join(part for part in (str(error), error.details) if part))
            return
        self._engine.stop()
        self._start(path)
        for command in self._hub.settings.commands():
            self._engine.send(command)
        self._hub.say("")

    def _program(self) -> Path:
        return checked_program(self._mine) if self._mine else program("spook")

    def _start(self, path: Path) -> None:
        self._trace.unlink(missing_ok=True)
        self._engine = PlayingEngine([str(path), *self._words], self._line, self._ended.put,
                                     os.environ | {crash.VARIABLE: str(self._trace)})

    def _line(self, line: str) -> None:
        self._hub.take(signed(line, self._mine) if self._mine and is_header(line) else line)
        self._began.set()

    def _first_line(self) -> int | None:
        """Returns the exit code of an engine that ends before its first line."""
        while not self._began.wait(0.05):
            if not self._ended.empty():
                return self._ended.get() or 1
        self._engine.send({"pause": True})  # until somebody looks
        self._hub.on_first = self._go
        return None

    def _go(self) -> None:
        for command in ({"restart": True}, {"pause": False}):
            self._engine.send(command)

    def _command(self, command: dict) -> None:
        self._hub.settings.note(command)
        self._engine.send(command)

    def _crashed(self, code: int) -> CourseError:
        if code < 0 and self._mine:
            return crashed(code, self._engine.program, self._trace, self._mine)
        return CourseError(f"the run has ended, with exit code {code}")

    def _saved(self) -> list:
        return [saved(exercise.file) for exercise in all_exercises()] if self._is_mine else []
