"""What the course needs of the system, and how it gets there."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

from errors import CourseError
from paths import BUILD, shown
from process import stream, tail
from terminal import Live

_HEADER_FOLDERS = ("/usr/include", "/usr/local/include", "/usr/include/eigen3", "/usr/local/include/eigen3")

# Package of Debian and Ubuntu -> what shows that it, or the same thing from elsewhere, is there.
PACKAGES = {
    "cmake": "command cmake",
    "ninja-build": "command ninja",
    "g++": "command c++",
    "git": "command git",
    "libeigen3-dev": "header Eigen/Core",
    "libgtest-dev": "header gtest/gtest.h",
    "libcli11-dev": "header CLI/CLI.hpp",
    "nlohmann-json3-dev": "header nlohmann/json.hpp",
    "python3-numpy": "module numpy",
    "python3-matplotlib": "module matplotlib",
}
GRADE_PACKAGES = {"bubblewrap": "command bwrap"}
TEST_PACKAGES = GRADE_PACKAGES | {"clang-format": "command clang-format"}


def install(packages: dict[str, str], yes: bool) -> None:
    """Returns when everything is there; asks first, unless root or told not to."""
    needed = [package for package, sign in packages.items() if not _there(sign)]
    if not needed:
        return
    how = _command(needed)
    instead = CourseError(f"missing: {' '.join(needed)}; install with:  {how}")
    if not shutil.which("apt-get") or not (_is_root() or shutil.which("sudo")):
        raise instead
    if not (_is_root() or yes or _agreed(needed)):
        raise instead
    _apt(["update"], "updating the list of packages", instead)
    _apt(["install", "-y", "--no-install-recommends", *needed], f"installing {' '.join(needed)}", instead)
    importlib.invalidate_caches()
    still = [package for package in needed if not _there(packages[package])]
    if still:
        raise CourseError(f"still missing after installing: {' '.join(still)}; try:  {how}")


def _there(sign: str) -> bool:
    kind, name = sign.split()
    if kind == "command":
        return shutil.which(name) is not None
    if kind == "header":
        return any(Path(folder, name).exists() for folder in _HEADER_FOLDERS)
    return importlib.util.find_spec(name) is not None


def _is_root() -> bool:
    return os.geteuid() == 0


def _command(packages: list[str]) -> str:
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
