"""Compiles many mutants as one file, each in a namespace of its own.

Most of a compiler's time is spent on common code, Eigen's templates. An environment variable chooses the mutant when
the program starts: each exercise's function jumps through a pointer.
"""

import platform
import re
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from errors import CourseError

VARIABLE = "SPOOK_MUTANT"
_BEGIN = re.compile(r"^namespace spook \{$", re.MULTILINE)
_END = "}  // namespace spook"
_PLACE = re.compile(r"crowd\.cpp:(\d+):\d+:")
_JUMP = {"x86_64": "jmp *{slot}(%rip)",
         "aarch64": "adrp x16, {slot}\\n ldr x16, [x16, :lo12:{slot}]\\n br x16"}


class Named(Protocol):
    """A mutant with a name, unique in the program, and a place in a file."""

    full_name: str
    place: str


@dataclass(frozen=True)
class Switched:
    """The functions of an exercise, given as symbols, and the numbers of the texts that define them."""

    symbols: frozenset[str]
    texts: tuple[int, ...]
    otherwise: int  # the number of the text that is called where none of them is chosen


class Crowd:
    """A set of texts by number."""

    def __init__(self, texts: dict[int, str], named: Mapping[int, Named] | None = None):
        """Compiler messages call those in `named` by their names."""
        self.texts, self._named = texts, named or {}

    @staticmethod
    def can_hold(text: str) -> bool:
        head, _, _ = text.partition("namespace spook {")
        return (len(_BEGIN.findall(text)) == 1 and text.count(_END) == 1
                and all(not line or line.startswith(("#include", "//")) for line in head.splitlines()))

    def source(self) -> str:
        return self._head() + "".join(self._bodies())

    def _head(self) -> str:
        """Returns the includes of all texts, each once."""
        lines = {line: None for text in self.texts.values() for line in _BEGIN.split(text)[0].splitlines()
                 if line.startswith("#include")}
        return "".join(f"{line}\n" for line in lines)

    def _bodies(self) -> list[str]:
        bodies = []
        for k, text in self.texts.items():
            body = _BEGIN.split(text)[1]
            bodies.append(f"namespace spook {{ namespace {self._namespace(k)} {{{body.replace(_END, '}}')}")
        return bodies

    def _namespace(self, k: int) -> str:
        """Returns the namespace of a text. Those without a name are all equally long."""
        return f"mutant_0_{self._named[k].full_name}" if k in self._named else f"mutant_{k:06d}"

    def _choice(self, k: int) -> str:
        """Returns the value of the variable that chooses a text."""
        return self._named[k].full_name if k in self._named else str(k)

    def culprits(self, errors: str) -> set[int]:
        """Returns the texts with compiler errors."""
        ends, line = [], self._head().count("\n") + 1
        for k, body in zip(self.texts, self._bodies()):
            line += body.count("\n")
            ends.append((line, k))
        found, mentioned = set(), None
        for text in errors.splitlines():
            place = _PLACE.search(text)
            if place and (" error: " in text or "required from" in text):
                mentioned = next((k for end, k in ends if int(place[1]) < end), None)
            if " error: " in text and mentioned is not None:
                found.add(mentioned)
                mentioned = None
        return found

    def switch(self, compiled: list[Path], exercises: list[Switched]) -> str:
        """Returns the source of the exercises' functions: each jumps to one of the texts in the objects `compiled`."""
        listing = subprocess.run(["nm", "-P", "--defined-only", *map(str, compiled)], capture_output=True, text=True)
        symbols = [line.split()[0] for line in listing.stdout.splitlines() if "mutant_0" in line]
        symbol = dict(zip(_readable(symbols), symbols))
        lines, entries, number = [], [], 0
        for exercise in exercises:
            wanted = sorted(exercise.symbols)
            for readable, mangled in zip(_readable(wanted), wanted):
                slot = f"spook_slot_{number}"
                for k in exercise.texts:
                    found = _inside(readable, self._namespace(k)) & symbol.keys()
                    if not found:
                        place = self._named[k].place if k in self._named else f"mutant {k}"
                        raise CourseError(f"{place}: it does not define {readable}")
                    lines.append(f'extern "C" void target_{number}_{k}() __asm__("{symbol[found.pop()]}");')
                    entries.append(f'  {{"{self._choice(k)}", &{slot}, target_{number}_{k}}},\n')
                lines.append(f'extern "C" {{ void (*{slot})() = target_{number}_{exercise.otherwise}; }}')
                lines.append(jump_through(slot, mangled))
                number += 1
        return ("#include <cstdlib>\n#include <cstring>\n"
                "struct Entry { const char* mutant; void (**slot)(); void (*target)(); };\n"
                + "\n".join(lines)
                + f"\nstatic const Entry entries[] = {{\n{''.join(entries)}}};\n"
                + "__attribute__((constructor(101))) static void choose() {\n"
                + f'  const char* chosen = std::getenv("{VARIABLE}");\n'
                + "  for (const Entry& entry : entries)\n"
                + "    if (chosen && std::strcmp(entry.mutant, chosen) == 0) *entry.slot = entry.target;\n}\n")


def jump_through(slot: str, symbol: str) -> str:
    """Returns the source of a function that jumps to the target of the pointer `slot`, with any arguments."""
    jump = _JUMP.get(platform.machine())
    if not jump:
        raise CourseError(f"functions can't be made to jump on {platform.machine()}")
    text = f".globl {symbol}\\n{symbol}:\\n {jump.format(slot=slot)}\\n"
    return f'__asm__(".pushsection .text\\n{text}.popsection");'


def _readable(symbols: list[str]) -> list[str]:
    listing = subprocess.run(["c++filt"], input="\n".join(symbols) + "\n", capture_output=True, text=True)
    return listing.stdout.splitlines()


def _inside(readable: str, namespace: str) -> set[str]:
    """Returns the call spook::kick(...) in the namespace."""
    return {readable[: found.end()] + f"{namespace}::" + readable[found.end():]
            for found in re.finditer(r"\bspook::", readable)}
