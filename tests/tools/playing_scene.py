"""A scene of `spook play`, paused, and advanced by so many steps: its header and its last frame."""

import json
import os
import subprocess
from pathlib import Path


def native() -> Path:
    return Path(os.environ["COURSE_BUILD"], "release", "solutions", "spook")


def commands(steps: int) -> list[dict]:
    return [{"pause": True}, {"restart": True}, {"step": steps}]


def played(scene: str, settings: dict, steps: int) -> tuple[dict, dict]:
    """Plays the native program. Its output before the pause precedes the last header."""
    lines = [{"pause": True}, *([{"set": settings}] if settings else []), *commands(steps)]
    done = subprocess.run([native(), "play", scene], input="".join(f"{json.dumps(line)}\n" for line in lines),
                          capture_output=True, text=True)
    return last(done.stdout)


def refused(scene: str, settings: dict) -> str:
    """Returns why the native program refuses these settings; empty if it does not."""
    done = subprocess.run([native(), "play", scene], capture_output=True, text=True,
                          input="".join(f"{json.dumps(line)}\n" for line in ({"pause": True}, {"set": settings})))
    return next((line["refused"] for text in done.stdout.splitlines() if "refused" in (line := json.loads(text))), "")


def last(text: str) -> tuple[dict, dict]:
    lines = [json.loads(line) for line in text.splitlines()]
    if refused := [line["refused"] for line in lines if "refused" in line]:
        raise ValueError(refused[0])
    return [line for line in lines if "format" in line][-1], lines[-1]
