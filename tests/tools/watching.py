"""A course command that runs until it is stopped, observed from outside."""

import os
import queue
import signal
import subprocess
import threading
import time


class Watching:
    def __init__(self, command: list[str], **options):
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                         stdin=subprocess.DEVNULL, start_new_session=True, **options)
        self._lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        self._process.stdout.close()
        self._process.stderr.close()

    def wait_for(self, text: str, seconds: float = 120) -> str:
        """Reads until a line holds the text, and returns it."""
        end = time.monotonic() + seconds
        seen = []
        while time.monotonic() < end:
            try:
                seen.append(self._lines.get(timeout=0.1))
            except queue.Empty:
                continue
            if text in seen[-1]:
                return seen[-1]
        raise AssertionError(f"no '{text}' in:\n{''.join(seen)}")

    def interrupt(self) -> tuple[int, str]:
        """Sends Ctrl-C; returns the exit code, and the output on stderr from the beginning."""
        os.killpg(self._process.pid, signal.SIGINT)  # as a terminal does it
        code = self._process.wait(30)
        return code, self._process.stderr.read()

    def end(self, seconds: float) -> int:
        """Waits for it to end by itself."""
        return self._process.wait(seconds)

    def _read(self) -> None:
        for line in self._process.stdout:
            self._lines.put(line)
