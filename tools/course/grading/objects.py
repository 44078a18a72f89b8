"""A student's file, compiled and linked with the instructor's tests inside the isolation; what its object may hold.

Of its symbols only the exercise's functions stay visible: a `sqrt` or a `main` of the student's own reaches no test,
and a helper may have any name. `ld -r` comes first, to dissolve groups of inline functions: the linker keeps one copy
of each, and it must not be the student's.
"""

import re
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

import diagnostics
from grading.confined import Limits
from grading.isolation import GRADER, Isolation, User
from grading.submission import Source
from grading.workshop import Workshop
from manifest import Exercise

_COMPILING = Limits(cpu=60, wall=240, memory=3 << 30, files=256 << 20, processes=32, output=4 << 20)
_OF_GOOGLETEST = re.compile(r"NK?(?:5spook)?7testing")
_EARLY = re.compile(r"\.(preinit_array|init_array\.\S+|fini_array\.\S+|ctors\S*|dtors\S*)")
# No exercise starts a process, looks into one, opens the net, or loads code; each has its reason to be refused.
_REACHING_OUT = frozenset(
    "fork vfork clone clone3 daemon posix_spawn posix_spawnp system popen execl execle execlp execv execve execvp "
    "execvpe kill killpg tgkill pthread_kill sigqueue ptrace process_vm_readv process_vm_writev prctl syscall mprotect "
    "dlopen dlmopen dlsym dlvsym dl_iterate_phdr socket connect setrlimit prlimit prlimit64 unshare setns".split())


@dataclass(frozen=True)
class Made:
    """A program, or the verdict that all of the exercise's tests get."""

    program: Path | None
    verdict: str = ""
    reason: str = ""
    message: str = ""
    notes: tuple[str, ...] = ()


def make(exercise: Exercise, source: Source, workshop: Workshop, isolation: Isolation, user: User,
         folder: Path) -> Made:
    compiling, linking = folder / "compile", folder / "link"
    for path in (compiling, linking):
        path.mkdir(mode=0o755)
    file = Path("chapters", exercise.folder, exercise.file.name)
    (compiling / file).parent.mkdir(parents=True)
    (compiling / file).write_bytes(source.content)
    user.own(compiling)

    command, reads = workshop.compile_command(str(file), "student.o"), [workshop.headers]
    if source.is_reference:
        command.append(f"-I{workshop.reference_headers}")
        reads.append(workshop.reference_headers)
    ended = isolation.run(command, _COMPILING, user, tuple(reads), (compiling,), compiling)
    if ended.code != 0:
        stopped = "the compiler was stopped by a limit on its time, memory or output\n" if (
            ended.timed_out or ended.too_much or ended.code in (-9, 137, -24, 152)
            or "signal terminated program" in ended.output) else ""
        return Made(None, "does not compile", message=stopped + "\n".join(
            diagnostics.first_error(ended.output, exercise)))
    student = compiling / "student.o"
    symbols = _symbols(student)
    refused = _tampering(symbols, student)
    if refused:
        return Made(None, "tampered", refused, f"{file} {refused}. No exercise needs that; it is not run.")
    wanted = workshop.functions[exercise.function]
    missing = sorted(wanted - {name for name, kind in symbols if kind in "TW"})
    if missing:
        return Made(None, "does not compile", "function not defined", _not_defined(file, missing))
    return _link(exercise, workshop, isolation, student, linking, wanted, _notes(symbols))


def _link(exercise: Exercise, workshop: Workshop, isolation: Isolation, student: Path, folder: Path,
          wanted: set[str], notes: tuple[str, ...]) -> Made:
    script = [["ld", "-r", "--force-group-allocation", str(student), "-o", "whole.o"],
              ["objcopy", *(f"--keep-global-symbol={name}" for name in sorted(wanted)), "whole.o", "local.o"],
              workshop.link_command(exercise, "local.o", "graded")]
    shell = ["/bin/sh", "-c", "set -e; " + "; ".join(shlex.join(words) for words in script)]
    # The linker runs none of the student's code, but reads what the student may not: the tests and the reference. So it
    # runs as the grader, and where there are no namespaces to put it into, without isolation.
    if isolation.namespaces:
        ended = isolation.run(shell, _COMPILING, GRADER, (workshop.answers, student), (folder,), folder)
        code, output = ended.code, ended.output
    else:
        result = subprocess.run(shell, capture_output=True, text=True, errors="replace", cwd=folder)
        code, output = result.returncode, result.stdout + result.stderr
    if code != 0:
        return Made(None, "does not compile", "does not link", "\n".join(diagnostics.first_error(output, exercise)))
    program = folder / "graded"
    program.chmod(0o755)
    return Made(program, notes=notes)


def _symbols(file: Path) -> list[tuple[str, str]]:
    listing = subprocess.run(["nm", "-P", str(file)], capture_output=True, text=True, errors="replace")
    return [(words[0], words[1]) for line in listing.stdout.splitlines() if len(words := line.split()) >= 2]


def _tampering(symbols: list[tuple[str, str]], file: Path) -> str:
    """What in the object has no place in an answer; empty if nothing."""
    for name, kind in symbols:
        if _OF_GOOGLETEST.search(name):
            return "names GoogleTest's or the tests' own functions"
        if kind == "U" and name.split("@")[0] in _REACHING_OUT:
            return f"calls {name.split('@')[0]}()"
        if kind == "i":
            return "has a function that the loader resolves"
    sections = subprocess.run(["objdump", "-h", str(file)], capture_output=True, text=True, errors="replace").stdout
    early = _EARLY.search(sections)
    return f"has code that runs before main, in {early[0]}" if early else ""


def _notes(symbols: list[tuple[str, str]]) -> tuple[str, ...]:
    if ("main", "T") in symbols:
        return ("its main is not used",)
    return ()


def _not_defined(file: Path, missing: list[str]) -> str:
    readable = subprocess.run(["c++filt", *missing], capture_output=True, text=True).stdout.splitlines()
    return "\n".join([f"{file} compiles, but does not define", *(f"  {name}" for name in readable),
                      "Name, parameters and namespace must be as the chapter's header declares them."])
