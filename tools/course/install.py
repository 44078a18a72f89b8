"""Installs what the course needs and the system lacks."""

import importlib
import os
import shutil
import subprocess
import sys

from errors import CourseError
from needs import Need
from paths import BUILD, shown
from process import stream, tail
from terminal import Live


def install(needs: tuple[Need, ...], yes: bool) -> None:
    """Returns when everything is there, and new enough; asks first, unless root or told not to."""
    lacking = [need for need in needs if not need.there()]
    if lacking:
        _install([need.package for need in lacking], yes)
        importlib.invalidate_caches()
        still = [need.package for need in lacking if not need.there()]
        if still:
            raise CourseError(f"still missing after installing: {' '.join(still)}; try:  {apt_line(still)}")
    too_old = [said for need in needs if (said := need.too_old())]
    if too_old:
        raise CourseError("; ".join(too_old))


def _install(packages: list[str], yes: bool) -> None:
    instead = CourseError(f"missing: {' '.join(packages)}; install with:  {apt_line(packages)}")
    if not shutil.which("apt-get") or not (_is_root() or shutil.which("sudo")):
        raise instead
    if not (_is_root() or yes or _agreed(packages)):
        raise instead
    _apt(["update"], "updating the list of packages", instead)
    _apt(["install", "-y", "--no-install-recommends", *packages], f"installing {' '.join(packages)}", instead)


def is_offered(package: str) -> bool:
    """Whether the system's packages have it at all."""
    return bool(shutil.which("apt-cache")) and subprocess.run(
        ["apt-cache", "show", package], capture_output=True).returncode == 0


def _is_root() -> bool:
    return os.geteuid() == 0


def apt_line(packages: list[str]) -> str:
    sudo = "" if _is_root() else "sudo "
    return (f"{sudo}apt-get update && {sudo}apt-get install -y --no-install-recommends {' '.join(packages)}")


def _agreed(packages: list[str]) -> bool:
    if not sys.stdin.isatty():
        return False
    print(f"Missing: {' '.join(packages)}")
    try:
        answer = input("Install them with sudo apt-get? [Y/n] ").strip().lower()
    except EOFError:
        return False
    if answer not in ("", "y", "yes"):
        return False
    return subprocess.run(["sudo", "-v"]).returncode == 0  # asks for the password before the live line starts


def _apt(arguments: list[str], what: str, instead: CourseError) -> None:
    command = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", *arguments]
    live = Live(what, delay=0)
    live.update()
    log = BUILD / f"apt-{arguments[0]}.log"
    if not _is_root():
        command.insert(0, "sudo")
    code, output = stream(command, lambda line: live.update(line.strip()), log)
    live.done()
    if code != 0:
        raise CourseError(f"apt-get {arguments[0]} failed (log: {shown(log)}); {instead}", tail(output, 5))
