"""A student's file, compiled in isolation, checked, and linked into the program that answers calls.

Of its symbols only the exercise's functions stay visible: a `sqrt` or a `main` of the student's own replaces nothing,
and a helper may have any name. `ld -r` comes first, to dissolve groups of inline functions: the linker keeps one copy
of each, and it must not be the student's.
"""

import os
import re
import shlex
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

import diagnostics
from grading.allowed import REMOVED, REPLACED, not_allowed, shown, tampering
from grading.complaints import ASSEMBLER, compiler_says
from grading.confined import Ended, Limits
from grading.elf import Object, TooLarge, Unreadable, read_object
from grading.isolation import GRADER, Isolation, User
from grading.submission import Source
from grading.workshop import Workshop
from manifest import Exercise
from marker import is_stub

# A compiler does not sleep: its limit is processor time, and the clock is far enough away that load cannot decide a mark.
_COMPILING = Limits(cpu=20, wall=600, memory=3 << 30, files=256 << 20, processes=32, output=4 << 20)
_TOOK = "took"
# A namespace of processes tells nobody outside what its processes have used, so the shell inside writes it.
_TIMED = ["/bin/sh", "-c", f'"$@"; code=$?; times > {_TOOK}; exit $code', "sh"]
_MEMORY = 900 << 20  # bytes of an object, of the 1 GiB that its process may have: with more it would not start
# Clang before 16 knows no SOURCE_DATE_EPOCH, by which GCC takes the date.
_CLANGS_OWN = ["-fno-caret-diagnostics", "-Wno-builtin-macro-redefined", '-D__DATE__="Jan  1 1970"',
               '-D__TIME__="00:00:00"', '-D__TIMESTAMP__="Thu Jan  1 00:00:00 1970"']
_STUB = "_ZTIN5spook14NotImplementedE"  # what a stub throws: not in an object whose call is in a comment or in #if 0
STILL_A_STUB = "The file still calls not_implemented()."
_NAMES, _NAME, _MOST_NAMES = 1 << 16, 500, 20  # characters of all names that are shown, and of one
_NOT_AVAILABLE = "not available in grading"
_NOT_NEEDED = ("{} calls {}(), which is not available in grading, and no exercise needs it. An answer may call the C++ "
               "library, mathematics, text, memory, and what the chapters' headers declare.")


@dataclass(frozen=True)
class Made:
    """A program, or the common verdict of all tests of the exercise."""

    program: Path | None
    verdict: str = ""
    reason: str = ""
    message: str = ""
    notes: tuple[str, ...] = ()
    used: float = 0.0  # seconds of processor time that it took to compile


def make(exercise: Exercise, source: Source, workshop: Workshop, isolation: Isolation, user: User,
         folder: Path) -> Made:
    compiling, linking = folder / "compile", folder / "link"
    for path in (compiling, linking):
        path.mkdir(mode=0o755)
    file = Path("chapters", exercise.folder, exercise.file.name)
    (compiling / file).parent.mkdir(parents=True)
    (compiling / file).write_bytes(source.content)
    os.utime(compiling / file, (0, 0))  # which __TIMESTAMP__ would tell
    user.own(compiling)

    command, reads = workshop.compile_command(exercise, str(file), "student.o"), [workshop.headers]
    command += options_of(command[0])
    if source.is_reference:
        command.append(f"-I{workshop.reference_headers}")
        reads.append(workshop.reference_headers)
    ended = isolation.run([*_TIMED, *command], _COMPILING, user, tuple(reads), (compiling,), compiling)
    made = (_not_compiled(exercise, source, file, ended) if ended.code != 0 else
            _from_object(exercise, source, file, workshop, isolation, compiling / "student.o", linking))
    took = _COMPILING.wall if ended.timed_out else _seconds_in(compiling / _TOOK)
    return replace(made, used=round(took, 1))


def _seconds_in(file: Path) -> float:
    """Returns the processor seconds of the compiler; all that it may have if it was stopped before they were written."""
    told = file.read_text(encoding="utf-8", errors="replace") if file.is_file() and not file.is_symlink() else ""
    times = re.findall(r"(\d+)m(\d+\.\d+)s", told)
    return sum(60 * int(minutes) + float(seconds) for minutes, seconds in times) if times else _COMPILING.cpu


def options_of(compiler: str) -> list[str]:
    """Returns the options of a compiler for all submissions: it quotes no file, and tells one date to all."""
    return _CLANGS_OWN if "clang" in compiler else ["-fno-diagnostics-show-caret"]


_STOPPED = "the compiler was stopped by a limit on its time, memory or output"
_WORDLESS = "The compiler gave up, and named no line of the file: it may have needed more memory than there is."


def _not_compiled(exercise: Exercise, source: Source, file: Path, ended: Ended) -> Made:
    said = compiler_says(ended.output, exercise, str(file), source.text)
    if (ended.timed_out or ended.too_much or ended.code in (-9, 137, -24, 152)
            or "signal terminated program" in ended.output):
        # What the assembler says then is not why it ended.
        said = _STOPPED if said in ("", ASSEMBLER) else f"{_STOPPED}\n{said}"
    return Made(None, "does not compile", message=said or _WORDLESS)


def _from_object(exercise: Exercise, source: Source, file: Path, workshop: Workshop, isolation: Isolation,
                 student: Path, linking: Path) -> Made:
    wanted = workshop.functions[exercise.function]
    try:
        found = read_object(student)
    except TooLarge as error:
        return Made(None, "does not compile", "too large", f"{file} compiles to {error}, more than an answer needs.")
    except Unreadable as error:
        return Made(None, "tampered", "no object", f"{file} does not compile to an object file of this machine: {error}.")
    if is_stub(source.text) and any(symbol.name == _STUB for symbol in found.symbols):
        return Made(None, "not started", message=STILL_A_STUB)
    if found.memory > _MEMORY:
        return Made(None, "out of memory", "before it starts", f"{file} has arrays outside its functions of "
                    f"{found.memory >> 20} MiB, and a test has 1024 MiB for everything.")
    refused = "" if source.is_reference else tampering(found)
    if refused:
        return Made(None, "tampered", refused, f"{file} {refused}. No exercise needs that, so it is not run.")
    stranger = "" if source.is_reference else not_allowed(found, workshop.reference.callable_symbols(exercise))
    if owner := _owner(stranger, workshop):
        return Made(None, "does not compile", _NOT_AVAILABLE, _not_yet(file, owner, exercise))
    if stranger.startswith("_Z"):
        return Made(None, "does not compile", "does not link", f"undefined reference to `{_readable(stranger)}'")
    if stranger:
        return Made(None, "does not compile", _NOT_AVAILABLE, _NOT_NEEDED.format(file, shown(stranger)))
    missing = sorted(name for name in wanted if not found.binding_of(name))
    if missing:
        return Made(None, "does not compile", "function not defined", _not_defined(file, missing))
    weak = [name for name in wanted if found.binding_of(name) == "WEAK" and name not in workshop.reference.weak]
    if weak and not source.is_reference:
        return Made(None, "does not compile", "defined as weak or inline", _weak(file, weak))
    return _link(exercise, workshop, isolation, student, linking, wanted, _notes(found))


def _link(exercise: Exercise, workshop: Workshop, isolation: Isolation, student: Path, folder: Path,
          wanted: set[str], notes: tuple[str, ...]) -> Made:
    script = [["ld", "-r", "--force-group-allocation", str(student), "-o", "whole.o"],
              ["objcopy", *(f"--keep-global-symbol={name}" for name in sorted(wanted)),
               *(f"--redefine-sym={old}={new}" for old, new in REPLACED.items()), "whole.o", "local.o"],
              workshop.link_command(exercise, "local.o", "answer")]
    shell = ["/bin/sh", "-c", "set -e; " + "; ".join(shlex.join(words) for words in script)]
    # The linker runs none of the student's code, but reads what the student may not: the reference. So it
    # runs as the grader, and where there are no namespaces to put it into, without isolation.
    if isolation.namespaces:
        ended = isolation.run(shell, _COMPILING, GRADER, (workshop.answers, student), (folder,), folder)
        code, output = ended.code, ended.output
    else:
        limited = ["prlimit", f"--cpu={_COMPILING.cpu}", f"--as={_COMPILING.memory}", "--", *shell]
        result = subprocess.run(limited, capture_output=True, text=True, errors="replace", cwd=folder)
        code, output = result.returncode, result.stdout + result.stderr
    if code != 0:
        return _not_linked(output)
    if elsewhere := _defined_elsewhere(output, wanted):
        return Made(None, "tampered", "not its own function",
                    f"The linker does not take {elsewhere} from the submission.")
    program = folder / "answer"
    program.chmod(0o755)
    return Made(program, notes=notes)


def _not_linked(told: str) -> Made:
    """Shows no words of the linker but a missing or doubled name: others have our own paths and functions."""
    if "relocation truncated to fit" in told:
        return Made(None, "does not compile", "too large", "Its arrays outside functions have more than 2 GiB together.")
    found = diagnostics.linker_error(told) or "The linker cannot join it with the program that calls it."
    return Made(None, "does not compile", "does not link", found[:_NAME])


def _defined_elsewhere(told: str, wanted: set[str]) -> str:
    """Returns a required function whose origin, by the linker, is not the submission only."""
    origins: dict[str, list[str]] = {name: [] for name in wanted}
    for found in re.finditer(r"^(?:.*: )?(\S+): definition of (\S+)$", told, re.MULTILINE):
        origins.setdefault(found[2], []).append(found[1])
    return next((name for name in sorted(wanted) if origins[name] != ["local.o"]), "")


def _owner(symbol: str, workshop: Workshop) -> str:
    """Returns the exercise of a function; empty if there is none."""
    return next((function for function, symbols in workshop.functions.items() if symbol in symbols), "")


def _not_yet(file: Path, called: str, exercise: Exercise) -> str:
    return (f"{file} calls {called}(), which is not available in grading where {exercise.label} is asked for: an "
            "answer may call functions of earlier exercises, except one that already does the whole task.")


def _weak(file: Path, names: list[str]) -> str:
    return "\n".join([f"{file} defines as weak or inline:", *(f"  {name}" for name in _readable(*names).splitlines()),
                      "Define it as the chapter's header declares it."])


def _notes(found: Object) -> tuple[str, ...]:
    notes = {"its main is not used": bool(found.binding_of("main")),
             f"its call of {REMOVED}() is removed": found.calls(REMOVED)}
    return tuple(note for note, holds in notes.items() if holds)


def _readable(*symbols: str) -> str:
    """Shortens a demangled name: a short symbol may stand for megabytes, and a submission may have many."""
    shell = f"exec prlimit --cpu=5 --as={1 << 30} -- c++filt | head -c {_NAMES}"
    names = "\n".join(symbol[:_NAMES] for symbol in symbols[:_MOST_NAMES]) + "\n"
    told = subprocess.run(["/bin/sh", "-c", shell], input=names, capture_output=True, text=True,
                          errors="replace").stdout or names  # of one that takes too long nothing is printed
    return "\n".join(line[:_NAME] for line in told.splitlines())


def _not_defined(file: Path, missing: list[str]) -> str:
    names = _readable(*missing).splitlines()
    return "\n".join([f"{file} compiles, but does not define", *(f"  {name}" for name in names),
                      "Name, parameters and namespace must be as the chapter's header declares them."])
