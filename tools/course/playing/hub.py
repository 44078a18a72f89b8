"""Sends lines from the engine to every listening page, and the present state to pages that open later."""

import json
import threading
import time
from collections import deque

_BACKLOG = 4  # frames kept for a slow page; older frames are dropped


def is_header(line: str) -> bool:
    return '"spook recording"' in line


class Listener:
    def __init__(self):
        self._lines: deque[tuple[str, bool]] = deque()
        self._there = threading.Condition()

    def put(self, line: str, is_frame: bool) -> None:
        with self._there:
            if is_frame and sum(frame for _, frame in self._lines) >= _BACKLOG:
                self._lines.remove(next(entry for entry in self._lines if entry[1]))
            self._lines.append((line, is_frame))
            self._there.notify()

    def get(self, seconds: float) -> str | None:
        """Returns the next line; None after the time-out."""
        with self._there:
            self._there.wait_for(lambda: self._lines, seconds)
            return self._lines.popleft()[0] if self._lines else None


class Hub:
    def __init__(self):
        self._lock = threading.Lock()
        self._listeners: list[Listener] = []
        self._header = self._frame = self._said = ""
        self._left = None  # the time at which the last listener left
        self.settings = Settings()
        self.on_first = lambda: None  # called when the first page connects

    def take(self, line: str) -> None:
        """Accepts a line of the engine."""
        header = is_header(line)
        is_frame = not header and '"energy"' in line
        with self._lock:
            if header:
                self._header, self._frame = line, ""
            elif is_frame:
                self._frame = line
            self._send(line, is_frame)

    def say(self, text: str) -> None:
        """Shows a message to the reader until another replaces it."""
        with self._lock:
            self._said = json.dumps({"said": text})
            self._send(self._said, False)

    def _send(self, line: str, is_frame: bool) -> None:
        for listener in self._listeners:
            listener.put(line, is_frame)

    def join(self) -> Listener:
        listener = Listener()
        self.on_first()
        self.on_first = lambda: None
        with self._lock:
            for line in (self.settings.clock(), self._header, self._frame, self._said):
                if line:
                    listener.put(line, False)
            self._listeners.append(listener)
        return listener

    def leave(self, listener: Listener) -> None:
        with self._lock:
            self._listeners.remove(listener)
            if not self._listeners:
                self._left = time.monotonic()

    def alone_for(self) -> float:
        """Returns the seconds since the last page closed; 0 while one is open, or before the first."""
        with self._lock:
            return 0 if self._listeners or self._left is None else time.monotonic() - self._left


class Settings:
    """The settings made by pages, for an engine that takes over."""

    def __init__(self):
        self._set: dict = {}
        self._rate, self._pause = 1, False

    def note(self, command: dict) -> None:
        if isinstance(command.get("set"), dict):
            self._set |= command["set"]
        if isinstance(command.get("rate"), (int, float)):
            self._rate = command["rate"]
        if isinstance(command.get("pause"), bool):
            self._pause = command["pause"]

    def commands(self) -> list[dict]:
        """Returns the commands that restore the settings from the start."""
        again = [{"set": self._set}, {"restart": True}] if self._set else []
        return [*again, {"rate": self._rate}, {"pause": self._pause}]

    def clock(self) -> str:
        return json.dumps({"clock": {"rate": self._rate, "pause": self._pause}})
