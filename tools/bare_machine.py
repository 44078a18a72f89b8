"""The README's first commands on a machine that has nothing but git.

    sudo python3 tools/bare_machine.py trixie                     # or bookworm, jammy, noble: what debootstrap knows
    sudo python3 tools/bare_machine.py trixie --compiler clang
    sudo python3 tools/bare_machine.py trixie --only start test   # without what --all adds
    sudo python3 tools/bare_machine.py bookworm --only container  # what .devcontainer runs, as its user does

Makes the machine with debootstrap, clones what is committed into it, and runs `./course start`, `./course test` and
`./course test --all` there, in namespaces of their own. Prints how long each took and whether it held. Exit code 1 if
one did not.
"""

import argparse
import contextlib
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parent / "course"))

from errors import BadInput, CourseError  # noqa: E402
from paths import BUILD, ROOT, shown  # noqa: E402
from process import stream, tail  # noqa: E402

UBUNTU = {"jammy", "noble"}  # most of what the course needs is in a section of its own there
COMPILERS = {"gcc": ("", ""), "clang": (",clang", "CXX=clang++")}  # what is there beside git; what CMake is told
CONTAINER = ROOT / ".devcontainer" / "devcontainer.json"
COMMANDS = {"start": "./course start", "test": "./course test --yes", "all": "./course test --all --yes"}
# Mounts that nobody else sees, and that are gone with the last process. The machine's folder becomes the root, and not
# by chroot, in which the kernel refuses namespaces to those who would isolate submissions.
ENTER = """mount --make-rprivate / && mount --bind "$0" "$0" && mount --rbind /dev "$0/dev" &&
mount -t proc proc "$0/proc" && mount -t tmpfs tmpfs "$0/tmp" && cd "$0" && pivot_root . . && umount -l . &&
exec env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb $2 sh -c "cd /course && $1" """


def make(release: str, compiler: str, folder: Path, log: Path) -> None:
    components = "main,universe" if release in UBUNTU else "main"
    _do(["debootstrap", "--variant=minbase", f"--components={components}",
         f"--include=git,ca-certificates{COMPILERS[compiler][0]}", release, str(folder)], log)
    _do(["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(folder / "course")], log)
    # debootstrap names no hosts; an installed system does, and who drives a browser asks for this one.
    (folder / "etc" / "hosts").write_text("127.0.0.1 localhost\n::1 localhost\n", encoding="utf-8")


def of_container() -> str:
    """Returns a command that does what makes a container, as a user who becomes root by sudo alone."""
    steps = json.loads(CONTAINER.read_text(encoding="utf-8"))
    as_user = " && ".join(["cd /course", steps["onCreateCommand"], steps["postCreateCommand"]])
    return ("apt-get update -qq && apt-get install -yqq --no-install-recommends sudo && useradd --create-home vscode && "
            "echo 'vscode ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/vscode && chown -R vscode /course && "
            f"su vscode -c {shlex.quote(as_user)}")


def run(command: str, compiler: str, folder: Path, log: Path) -> int:
    """Runs a command there, and returns its exit code."""
    code, _ = stream(["unshare", "--mount", "--pid", "--fork", "sh", "-c", ENTER, str(folder), command,
                      COMPILERS[compiler][1]], lambda line: print(line, end="", flush=True), log)
    return code


def _do(command: list[str], log: Path) -> None:
    code, output = stream(command, lambda line: None, log)
    if code != 0:
        raise CourseError(f"{command[0]} failed; its log is {shown(log)}", tail(output, 5))


@contextlib.contextmanager
def _place(parent: Path, keep: bool):
    folder = Path(tempfile.mkdtemp(prefix="bare-", dir=parent))
    folder.chmod(0o755)  # it is the machine's root, which every user may enter
    try:
        yield folder
    finally:
        if keep:
            print(f"kept: {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)


def _options(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("release", help="a release that debootstrap knows, such as trixie")
    parser.add_argument("--compiler", choices=COMPILERS, default="gcc")
    parser.add_argument("--only", nargs="+", choices=[*COMMANDS, "container"], default=list(COMMANDS),
                        help="some of the commands, or the steps of .devcontainer")
    parser.add_argument("--folder", type=Path, default=Path("/var/tmp"), help="where the machine is made")
    parser.add_argument("--keep", action="store_true", help="leave the machine there")
    options = parser.parse_args(words)
    lacking = [tool for tool in ("debootstrap", "unshare", "git") if not shutil.which(tool)]
    if lacking:
        raise BadInput(f"bare_machine: {' '.join(lacking)} is missing")
    if os.geteuid() != 0:
        raise BadInput("bare_machine: only root can make a machine; try it with sudo")
    return options


def _commit(course: Path) -> str:
    """Returns the cloned commit."""
    return subprocess.run(["git", "-C", str(course), "rev-parse", "--short", "HEAD"], capture_output=True,
                          text=True).stdout.strip()


def _report(release: str, compiler: str, commit: str, rows: list[tuple[str, int, float]]) -> str:
    lines = [f"{release}, {compiler}, {commit}:"]
    for what, code, seconds in rows:
        held = "held" if code == 0 else f"failed, exit code {code}"
        lines.append(f"  {what:<16} {int(seconds) // 60:3d} min {int(seconds) % 60:2d} s   {held}")
    return "\n".join(lines)


def main(words: list[str]) -> int:
    options = _options(words)
    logs = BUILD / "bare" / f"{options.release}-{options.compiler}"
    rows = []
    with _place(options.folder, options.keep) as folder:
        started = time.monotonic()
        make(options.release, options.compiler, folder, logs / "make.log")
        rows.append(("the machine", 0, time.monotonic() - started))
        commit = _commit(folder / "course")
        for name in options.only:
            started = time.monotonic()
            command = of_container() if name == "container" else COMMANDS[name]
            code = run(command, options.compiler, folder, logs / f"{name}.log")
            rows.append((COMMANDS.get(name, "the container"), code, time.monotonic() - started))
    print(f"\n{_report(options.release, options.compiler, commit, rows)}\n  logs in {shown(logs)}")
    return 0 if all(code == 0 for _, code, _ in rows) else 1


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except CourseError as error:
        print(*filter(None, (error.details, f"course: {error}")), sep="\n", file=sys.stderr)
        sys.exit(error.code)
