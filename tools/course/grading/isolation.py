"""Isolates a submission's code by the strongest of these ways that works here, which is found by trying.

    bubblewrap and a uid   as root: as below, and a user of its own for each worker
    bubblewrap             namespaces: no network, no process but its own, no file but those it needs, none to write
    uid                    as root where namespaces are forbidden (most containers): a user of its own, and limits
    limits                 not as root, without bubblewrap: limits only

As root a submission is never run with limits only.
"""

import contextlib
import fcntl
import os
import pwd
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from grading.choices import ISOLATIONS
from grading.confined import Ended, Limits, run

_WHAT_IT_DOES_NOT_DENY = {
    "bubblewrap and a uid": "",
    "bubblewrap": "",
    "uid": "the network, files that everyone may read, and writing where everyone may",
    "limits": "the network, and everything that the grading user may do, such as reading the reference",
}
_FIRST_UID, _LAST_UID = 61_000, 61_999
_SYSTEM = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
_PROBE = Limits(cpu=5, wall=20, memory=1 << 30, files=1 << 20, processes=16, output=1 << 16)
# With a date of its own for a compiler: __TIME__ and __TIMESTAMP__ are the same whenever and wherever a file is graded.
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "LC_ALL": "C", "TZ": "UTC0", "SOURCE_DATE_EPOCH": "0"}


class Isolation:
    def __init__(self, name: str):
        self.name = name
        self.uses_uid = name in ("bubblewrap and a uid", "uid")
        self.namespaces = name.startswith("bubblewrap")

    @property
    def does_not_deny(self) -> str:
        return _WHAT_IT_DOES_NOT_DENY[self.name]

    def run(self, command: list[str], limits: Limits, user: "User", reads: tuple[Path, ...] = (),
            writes: tuple[Path, ...] = (), folder: Path = Path("/")) -> Ended:
        """Runs the command in `folder`, with access to the system's programs and these paths."""
        try:
            return run(self.command(command, limits, user, reads, writes, folder), limits, ENVIRONMENT)
        finally:
            self.clear(user)

    def command(self, command: list[str], limits: Limits, user: "User", reads: tuple[Path, ...] = (),
                writes: tuple[Path, ...] = (), folder: Path = Path("/")) -> list[str]:
        """Returns the command line that runs it isolated."""
        words = []
        if user.uid is not None:
            words += [_which("setpriv"), f"--reuid={user.uid}", f"--regid={user.uid}", "--clear-groups",
                      "--no-new-privs", "--inh-caps=-all"]
        if self.namespaces:
            words += _namespaces(["--unshare-all"], reads, writes, folder)
        else:
            words += [_which("env"), f"--chdir={folder}"]
        # Without namespaces the processes of all that the grader does would count.
        own = self.uses_uid or self.namespaces
        return words + _limited(limits) + ([f"--nproc={limits.processes}"] if own else []) + ["--", *command]

    def command_of_tests(self, command: list[str], limits: Limits, reads: tuple[Path, ...]) -> list[str]:
        """Returns the command line of the tests. They are ours, but read data from hostile code: as the grader, without
        files and network."""
        alone = ["--unshare-user", "--unshare-ipc", "--unshare-net", "--unshare-uts"]
        return (_namespaces(alone, reads, (), Path("/")) if self.namespaces else []) + [
            *_limited(limits), "--", *command]

    def clear(self, user: "User") -> None:
        """Kills all processes of the user; a namespace does so by itself."""
        if self.name == "uid" and user.uid is not None:
            user.kill_all()


def _namespaces(kinds: list[str], reads, writes, folder: Path) -> list[str]:
    words = [_which("bwrap"), *kinds, "--die-with-parent", "--new-session", "--cap-drop", "ALL",
             "--ro-bind", "/usr", "/usr"]
    for path in map(Path, _SYSTEM):
        if path.is_symlink():
            words += ["--symlink", os.readlink(path), str(path)]
        elif path.is_dir():
            words += ["--ro-bind", str(path), str(path)]
    for path in reads:
        words += ["--ro-bind", str(path), str(path)]
    for path in writes:
        words += ["--bind", str(path), str(path)]
    return words + ["--remount-ro", "/", "--chdir", str(folder)]


@dataclass
class User:
    """The user who runs a worker's commands; the grader's own, if `uid` is None."""

    uid: int | None
    lock: object = None  # held as long as the user is in use

    def own(self, path: Path) -> None:
        if self.uid is not None:
            os.chown(path, self.uid, self.uid)

    def release(self) -> None:
        if self.lock:
            self.lock.close()

    def kill_all(self) -> None:
        subprocess.run([_which("setpriv"), f"--reuid={self.uid}", f"--regid={self.uid}", "--clear-groups",
                        "/bin/sh", "-c", "kill -KILL -1"], capture_output=True)


GRADER = User(None)


def choose(name: str = "") -> Isolation:
    """Returns the strongest isolation that works here, or the named one."""
    tried = []
    for candidate in [Isolation(name)] if name else map(Isolation, ISOLATIONS):
        problem = _problem(candidate)
        if not problem:
            return candidate
        tried.append(f"  {candidate.name}: {problem}")
    if name:
        raise CourseError(f"--isolation {name} does not work here; leave it out, install bubblewrap, or do not grade as root",
                          "\n".join(tried))
    raise CourseError("no way to isolate a submission works here; install bubblewrap, or do not grade as root",
                      "\n".join(tried))


def take_user(isolation: Isolation) -> User:
    """Returns a user whose number no account, process or other grader has."""
    if not isolation.uses_uid:
        return GRADER
    in_use = _users_of_processes()
    for uid in range(_FIRST_UID, _LAST_UID + 1):
        with contextlib.suppress(KeyError):
            pwd.getpwuid(uid)
            continue
        if uid not in in_use and (lock := _lock(uid)):
            return User(uid, lock)
    raise CourseError(f"every user id from {_FIRST_UID} to {_LAST_UID} is in use")


def _users_of_processes() -> set[int]:
    users = set()
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):  # it has ended
            if entry.name.isdecimal():
                users.add(entry.stat().st_uid)
    return users


def _lock(uid: int):
    name = f"/run/lock/spook-grade-{uid}" if os.path.isdir("/run/lock") else f"/tmp/.spook-grade-{uid}"
    file = open(os.open(name, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600), "w")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return file
    except BlockingIOError:
        file.close()
        return None


def _limited(limits: Limits) -> list[str]:
    return [_which("prlimit"), f"--cpu={limits.cpu}:{limits.cpu + 1}", f"--as={limits.memory}",
            f"--fsize={limits.files}", "--core=0", "--nofile=64",
            *([f"--stack={limits.stack}"] if limits.stack else [])]


def _problem(isolation: Isolation) -> str:
    """Returns the reason why it does not work here; empty if it does."""
    root = os.geteuid() == 0
    if isolation.uses_uid and not root:
        return "only root can change the user"
    if isolation.name == "limits" and root:
        return "not available to root, who has all permissions"
    needed = ["prlimit", *(["bwrap"] if isolation.name.startswith("bubblewrap") else []),
              *(["setpriv"] if isolation.uses_uid else [])]
    missing = [program for program in needed if not shutil.which(program)]
    if missing:
        return f"{missing[0]} is missing"
    user = take_user(isolation)
    ended = isolation.run(["/bin/sh", "-c", "exit 7"], _PROBE, user)
    user.release()
    return "" if ended.code == 7 else f"it was tried and failed: {ended.output.strip() or f'exit code {ended.code}'}"


def _which(program: str) -> str:
    return shutil.which(program) or program
