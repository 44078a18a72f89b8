"""Runs a command as a Slurm array, waits, and reports the result of each part.

Nothing is copied: the course, its build trees and the folder of results must be visible to every node under the same
path. Sbatch reads queue, time and account from SBATCH_PARTITION, SBATCH_TIMELIMIT and SBATCH_ACCOUNT.
"""

import os
import re
import shlex
import shutil
import subprocess
import time
from pathlib import Path

from errors import CourseError
from paths import BUILD, ROOT, shown
from process import tail
from terminal import Live

_ENDED_BADLY = 5.0  # seconds that an exit code may take to be seen across a network's file system


def run_array(command: list[str], count: int, folder: Path, what: str) -> dict[int, str]:
    """Runs `command` count times, with @I@ in its words replaced by 1 to count; logs and exit codes go to `folder`.

    Returns the failed parts with their reasons. A part whose node dies is not run again; the others continue.
    """
    for program in ("sbatch", "squeue", "scancel"):
        if not shutil.which(program):
            raise CourseError(f"--slurm: {program} is missing, so this machine cannot submit to Slurm")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    script = folder / "part.sh"
    words = " ".join('"$SLURM_ARRAY_TASK_ID"'.join(shlex.quote(part) if part else "" for part in word.split("@I@"))
                     or "''" for word in command)
    script.write_text(f"#!/bin/sh\n{words}\necho $? > {shlex.quote(str(folder))}/$SLURM_ARRAY_TASK_ID.code\n"
                      f"exit $(cat {shlex.quote(str(folder))}/$SLURM_ARRAY_TASK_ID.code)\n", encoding="utf-8")
    job = _submit(script, count, folder)
    print(f"Slurm has job {job}, an array of {count}. Its nodes must see {_shared(folder)}.", flush=True)
    live = Live(what, delay=0)
    try:
        while left := _waiting(job):
            live.update(f"{count - left} of {count} parts")
            time.sleep(1)
    except (KeyboardInterrupt, SystemExit):
        subprocess.run(["scancel", job], capture_output=True)
        raise
    finally:
        live.done()
    return {part: why for part in range(1, count + 1) if (why := _failure(job, part, folder))}


def _shared(folder: Path) -> str:
    """Returns the fewest folders that contain everything."""
    needed = sorted({ROOT, BUILD, folder.parent.absolute()})
    return ", ".join(str(path) for path in needed if not any(other in path.parents for other in needed))


def _submit(script: Path, count: int, folder: Path) -> str:
    command = ["sbatch", "--parsable", f"--array=1-{count}", "--no-requeue", "--job-name=course", f"--chdir={ROOT}",
               f"--output={folder}/%a.log", str(script)]
    told = subprocess.run(command, capture_output=True, text=True, env=_environment())
    if told.returncode != 0:
        raise CourseError(f"--slurm: sbatch refuses the job; its script is {shown(script)}", tail(told.stderr))
    return told.stdout.strip().split(";")[0]


def _environment() -> dict[str, str]:
    """Returns the environment variables that this command needs, without those of a surrounding job."""
    return {name: value for name, value in os.environ.items() if not name.startswith("SLURM_") or name == "SLURM_CONF"}


def _waiting(job: str) -> int:
    """Returns the number of unfinished parts. Asks again if the controller does not answer."""
    told = subprocess.run(["squeue", "--noheader", "--array", f"--jobs={job}", "--format=%T"], capture_output=True,
                          text=True)
    if told.returncode != 0:
        return 0 if "Invalid job id" in told.stderr else 1
    return len(told.stdout.split())


def _failure(job: str, part: int, folder: Path) -> str:
    """Returns the reason of a failure; empty for a part that succeeded."""
    code, deadline = folder / f"{part}.code", time.monotonic() + _ENDED_BADLY
    while not code.exists() and time.monotonic() < deadline:
        time.sleep(0.2)
    if code.exists():
        number = code.read_text(encoding="ascii").strip()
        return "" if number == "0" else f"exit code {number}; the end of its log:\n{_log(folder, part)}"
    told = subprocess.run(["scontrol", "show", "job", f"{job}_{part}"], capture_output=True, text=True).stdout
    state = re.search(r"JobState=(\S+)", told)
    node = re.search(r"BatchHost=(\S+)", told)
    return (f"{state[1] if state else 'gone'} on {node[1] if node else 'an unknown node'}, before it ended"
            + (f"; the end of its log:\n{_log(folder, part)}" if _log(folder, part) else ""))


def _log(folder: Path, part: int) -> str:
    try:
        return tail((folder / f"{part}.log").read_text(encoding="utf-8", errors="replace"), 5)
    except FileNotFoundError:
        return ""
