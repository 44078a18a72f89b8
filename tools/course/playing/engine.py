"""Runs `spook play` as a child process that ends with this one."""

import json
import subprocess
import threading
from collections.abc import Callable
from pathlib import Path

_PATIENCE = 2  # seconds for the program to end by itself


class PlayingEngine:
    """Calls `on_line` with each output line, then `on_end` with its exit code unless it was stopped."""

    def __init__(self, command: list[str], on_line: Callable[[str], None], on_end: Callable[[int], None],
                 env: dict[str, str] | None = None):
        self.program = Path(command[0])
        self._on_line, self._on_end = on_line, on_end
        self._stopped = False
        self._writing = threading.Lock()
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                         encoding="utf-8", errors="replace", env=env)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def send(self, command: dict) -> None:
        with self._writing:
            try:
                self._process.stdin.write(json.dumps(command) + "\n")
                self._process.stdin.flush()
            except (OSError, ValueError):
                pass  # the program has ended; on_end reports it

    def stop(self) -> None:
        self._stopped = True
        with self._writing:
            try:
                self._process.stdin.close()  # ends the program
            except OSError:
                pass
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if self._reader is not threading.current_thread():
            self._reader.join(_PATIENCE)

    def _read(self) -> None:
        for line in self._process.stdout:
            if not self._stopped:
                self._on_line(line.rstrip("\n"))
        self._process.stdout.close()
        code = self._process.wait()
        if not self._stopped:
            self._on_end(code)
