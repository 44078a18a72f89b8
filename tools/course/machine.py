"""Hides what differs between Linux and macOS: a function for each difference."""

import os
import platform
import re
import resource
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError

# Where Homebrew puts things on Apple's processors, and on Intel's.
_BREW_PREFIXES = ("/opt/homebrew", "/usr/local")


def is_mac() -> bool:
    return os.uname().sysname == "Darwin"


def require_linux(what: str) -> None:
    """Raises on another system; `what` begins the sentence."""
    if is_mac():
        raise CourseError(f"{what} needs Linux; use Debian, Ubuntu or a container")


def processors() -> int:
    """Counts the processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def processor_model() -> str:
    """Returns the name of the processor's model; empty if the system does not tell it."""
    if is_mac():
        try:
            return subprocess.run(["sysctl", "-n", "machdep.cpu.brand_string"], capture_output=True, text=True,
                                  errors="replace").stdout.strip()
        except FileNotFoundError:
            return ""
    try:
        told = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        told = ""
    found = re.search(r"^model name\s*: *(.+)$", told, re.MULTILINE)
    return found[1].strip() if found else platform.processor()


def has_command(name: str) -> bool:
    """Returns True if a command works. Some of Apple's only ask for its developer tools until those are installed."""
    path = shutil.which(name)
    if path and is_mac() and path.startswith("/usr/bin/") and name in ("c++", "clang++", "git"):
        return subprocess.run(["xcode-select", "-p"], capture_output=True).returncode == 0
    return path is not None


def has_desktop() -> bool:
    """Returns True if a browser can be opened."""
    return is_mac() or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def forwarded_host(port: int) -> str:
    """Returns the name under which a Codespace shows a local port to its owner; empty elsewhere."""
    name, domain = (os.environ.get(what) for what in ("CODESPACE_NAME", "GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN"))
    return f"{name}-{port}.{domain}" if name and domain else ""


def conda() -> Path | None:
    """Returns the active conda environment if it was made for the course: it has Eigen."""
    prefix = Path(os.environ.get("CONDA_PREFIX") or "/nowhere")
    return prefix if (prefix / "include" / "eigen3").is_dir() else None


def brew_prefix() -> Path:
    given = os.environ.get("HOMEBREW_PREFIX")
    return Path(given or next((prefix for prefix in _BREW_PREFIXES if Path(prefix, "bin", "brew").exists()),
                              _BREW_PREFIXES[0]))


def header_folders() -> tuple[str, ...]:
    """Lists the folders of libraries' headers."""
    if found := conda():
        prefixes = [found]
    elif is_mac():
        prefixes = [brew_prefix()]
    else:
        prefixes = [Path("/usr"), Path("/usr/local")]
    return tuple(str(prefix / folder) for folder in ("include", "include/eigen3") for prefix in prefixes)


@dataclass(frozen=True)
class Limits:
    processor: int  # seconds; a second later it is killed
    memory: int | None  # bytes; macOS does not enforce it
    file: int  # bytes, of what is written


def start_limited(command: list[str], limits: Limits, **options) -> subprocess.Popen:
    """Starts a process that ends with SIGXCPU once it has used up its processor time."""
    if not hasattr(resource, "prlimit"):
        # A shell sets them: between fork and exec of a program with threads, Python must not.
        return subprocess.Popen(["/bin/sh", "-c", _SHELL_LIMITS, "sh", str(limits.processor), str(limits.processor + 1),
                                 str(limits.file // 512), *command], **options)
    process = subprocess.Popen(command, **options)
    try:
        if limits.memory is not None:
            resource.prlimit(process.pid, resource.RLIMIT_AS, (limits.memory, limits.memory))
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limits.file, limits.file))
        resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (limits.processor, limits.processor + 1))
    except ProcessLookupError:
        pass  # it has ended already
    return process


_SHELL_LIMITS = 'ulimit -S -t "$1"; ulimit -H -t "$2"; ulimit -f "$3"; ulimit -c 0; shift 3; exec "$@"'


def lines_at(program: Path, distances: list[str]) -> list[tuple[str, int]]:
    """Finds the files and lines of addresses, given in hexadecimal from the program's start; inlined calls first.

    Returns none if the tool is missing.
    """
    if is_mac():
        command = ["atos", "-o", str(program), "-fullPath", "-i", "-offset", *(f"0x{at}" for at in distances)]
        line = re.compile(r"^.* \((/.+):(\d+)\)$", re.MULTILINE)
    else:
        command = ["addr2line", "-i", "-e", str(program), *distances]
        line = re.compile(r"^(\S.*):(\d+)(?: \(discriminator \d+\))?$", re.MULTILINE)
    try:
        told = subprocess.run(command, capture_output=True, text=True).stdout
    except FileNotFoundError:
        return []
    return [(file, int(number)) for file, number in line.findall(told)]


def chromedriver() -> str:
    return shutil.which("chromedriver") or "/usr/bin/chromedriver"


def fonts() -> Path:
    """Returns the folder of the book's typeface, Linux Libertine."""
    if is_mac():
        return Path.home() / "Library" / "Fonts"  # where brew's font-linux-libertine puts it
    return Path("/usr/share/fonts/opentype/linux-libertine")
