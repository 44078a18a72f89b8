"""The version of the course, which CMakeLists.txt states."""

import re
import subprocess

from errors import CourseError
from files import is_tracked
from paths import ROOT

_STATED = re.compile(r"^project\(\w+ VERSION (\d+\.\d+\.\d+)\b", re.MULTILINE)


def stated_in(lists: str) -> str:
    """Reads the version from the text of a CMakeLists.txt; empty if it states none."""
    found = _STATED.search(lists)
    return found[1] if found else ""


def version() -> str:
    stated = stated_in((ROOT / "CMakeLists.txt").read_text(encoding="utf-8", errors="replace"))
    if not stated:
        raise CourseError("CMakeLists.txt states no version, such as project(spook_course VERSION 1.0.0 ...)")
    return stated


def show_version(arguments) -> int:
    """Prints the version, and the commit if git knows one: a report of a mistake needs both."""
    named = commit()
    print(f"course {version()}" + (f" ({named})" if named else ""))
    return 0


def commit() -> str:
    """Names the checked-out commit, with -dirty if files differ from it; empty without git's history."""
    try:
        if not is_tracked():
            return ""
    except CourseError:
        return ""
    asked = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--exclude=*"],
                           capture_output=True, text=True)
    return asked.stdout.strip() if asked.returncode == 0 else ""
