"""Installs missing packages of the course: by apt on Debian and Ubuntu, by Homebrew on macOS."""

import importlib
import os
import shlex
import shutil
import subprocess
import sys

import machine
import packages
from errors import CourseError
from javascript import NPM_FOLDER
from needs import Need
from paths import BUILD, ROOT, STATE, shown
from process import stream, tail
from terminal import Live

ENVIRONMENT = STATE / "python"  # of the course's own; the command `course` takes its Python where it is there
_CONDA_LINE = "conda env create -f environment.yml && conda activate spook-course"
_CONDA_UPDATE = "conda env update -f environment.yml"


def install(needs: tuple[Need, ...], yes: bool) -> None:
    """Returns when everything is present and new enough. Asks first, unless root or told not to."""
    lacking = [need for need in needs if not need.there()]
    if lacking:
        _install([need.package for need in lacking], yes)
        importlib.invalidate_caches()
        still = [need.package for need in lacking if not need.there()]
        if still:
            raise CourseError(f"still missing after installing: {' '.join(still)}; try:  {install_line(still)}")
    too_old = [said for need in needs if (said := need.too_old())]
    if too_old:
        raise CourseError("; ".join(too_old))


def offer(needs: tuple[Need, ...], cost: str) -> bool:
    """Offers to install what a command can do without, and says what it costs. Asks root, too; without a terminal it
    installs nothing. Returns True if everything is present."""
    lacking = [need.package for need in needs if not need.there()]
    if not lacking:
        return True
    if machine.conda() or not all(map(is_offered, lacking)):
        return False
    by = "brew, pip and npm" if machine.is_mac() else "apt-get" if _is_root() else "sudo apt-get"
    if not _agreed([*lacking, f"({cost})"], by):
        return False
    install(needs, yes=True)
    return True


def _install(lacking: list[str], yes: bool) -> None:
    instead = CourseError(f"missing: {' '.join(lacking)}; install with:  {install_line(lacking)}{_without_root()}")
    if machine.conda():
        _install_beside_conda(lacking, yes, instead)
        return
    if machine.is_mac():
        _install_on_mac(lacking, yes, instead)
        return
    if not shutil.which("apt-get") or not (_is_root() or shutil.which("sudo")):
        raise instead
    if not (_is_root() or yes or _agreed(lacking, "sudo apt-get")):
        raise instead
    _run(_apt("update"), "updating the list of packages", "apt-update", instead)
    _run(_apt("install", "-y", "--no-install-recommends", *lacking), f"installing {' '.join(lacking)}", "apt-install",
         instead)


def _install_beside_conda(lacking: list[str], yes: bool, instead: CourseError) -> None:
    """Installs npm's libraries only: the user manages the environment."""
    npm, rest = packages.split(lacking, packages.NPM)
    if rest or not shutil.which("npm") or not (yes or _agreed(lacking, "npm")):
        raise instead
    _run(_npm(npm), "installing with npm", "npm-install", instead)


def _npm(names: list[str]) -> list[str]:
    return ["npm", "install", "--prefix", str(NPM_FOLDER), *names]


def _install_on_mac(lacking: list[str], yes: bool, instead: CourseError) -> None:
    commands, unknown = _mac_commands(lacking)
    if unknown or any(package in packages.APPLE for package in lacking) or not shutil.which("brew"):
        raise instead
    if not (yes or _agreed(lacking, "brew, pip and npm")):
        raise instead
    for command in commands:
        tool = os.path.basename(command[0])
        _run(command, f"installing with {tool}", f"{tool}-install", instead)
    if any(package in packages.PIP for package in lacking):
        _go_on_with_our_python()


def _mac_commands(lacking: list[str]) -> tuple[list[list[str]], list[str]]:
    """Lists the commands that install these, Apple's compiler first, Python's modules last; and the packages that no
    table has."""
    brew, rest = packages.split(lacking, packages.BREW)
    npm, rest = packages.split(rest, packages.NPM)
    modules, rest = packages.split(rest, packages.PIP)
    brew += ["node"] if npm and "node" not in brew and not shutil.which("npm") else []
    unknown = [package for package in rest if package not in packages.APPLE]
    commands = [["xcode-select", "--install"]] if len(unknown) < len(rest) else []
    commands += [["brew", "install", *brew]] if brew else []
    commands += [_npm(npm)] if npm else []
    if modules:
        commands += [[sys.executable, "-m", "venv", str(ENVIRONMENT)],
                     [str(ENVIRONMENT / "bin" / "pip"), "install", *modules]]
    return commands, unknown


def _go_on_with_our_python() -> None:
    """Runs the same command again, by the Python that has the modules."""
    sys.stdout.flush()
    python = str(ENVIRONMENT / "bin" / "python3")
    os.execv(python, [python, *sys.argv])


def is_offered(package: str) -> bool:
    """Returns True if the system's packages include it."""
    if machine.is_mac():
        return any(package in names for names in (packages.BREW, packages.PIP, packages.NPM))
    return bool(shutil.which("apt-cache")) and subprocess.run(
        ["apt-cache", "show", package], capture_output=True).returncode == 0


def _is_root() -> bool:
    return os.geteuid() == 0


def install_line(lacking: list[str]) -> str:
    """Writes the command that a person types to get these."""
    if machine.conda():
        npm, rest = packages.split(lacking, packages.NPM)
        return " && ".join(([_CONDA_UPDATE] if rest else []) + ([shlex.join(_npm(npm))] if npm else []))
    if machine.is_mac():
        commands, unknown = _mac_commands(lacking)
        return "  ".join(([" && ".join(map(shlex.join, commands))] if commands else []) +
                         ([f"(not in Homebrew: {' '.join(unknown)})"] if unknown else []))
    sudo = "" if _is_root() else "sudo "
    return (f"{sudo}apt-get update && {sudo}apt-get install -y --no-install-recommends {' '.join(lacking)}")


def _without_root() -> str:
    """Names a way for users who may not install for the whole machine."""
    if machine.conda():
        return ""
    if machine.is_mac():
        return "" if shutil.which("brew") else "  (brew is the command of Homebrew)"
    return "" if _is_root() else f"; without root, in your own space:  {_CONDA_LINE}"


def _agreed(lacking: list[str], by: str) -> bool:
    if not sys.stdin.isatty():
        return False
    print(f"Missing: {' '.join(lacking)}")
    try:
        answer = input(f"Install them with {by}? [Y/n] ").strip().lower()
    except EOFError:
        return False
    if answer not in ("", "y", "yes"):
        return False
    # sudo asks for the password before the live line starts; the others ask for none.
    return by != "sudo apt-get" or subprocess.run(["sudo", "-v"]).returncode == 0


def _apt(*words: str) -> list[str]:
    return [*([] if _is_root() else ["sudo"]), "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", *words]


def _run(command: list[str], what: str, name: str, instead: CourseError) -> None:
    live = Live(what, delay=0)
    live.update()
    log = BUILD / f"{name}.log"
    code, output = stream(command, lambda line: live.update(line.strip()), log, cwd=ROOT)
    live.done()
    if code != 0:
        raise CourseError(f"{what} failed (log: {shown(log)}); {instead}",
                          tail(output, 5))
