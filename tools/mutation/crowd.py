"""Many mutants of a file as one: each in a namespace of its own, so that all are compiled at once.

Most of a compiler's time goes into what mutants share, Eigen's templates. Which of them is called is told by
a variable of the environment, when the program starts: the exercise's function jumps through a pointer.
"""

import platform
import re
import subprocess
from collections.abc import Mapping
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
    """A mutant that has a name, and a place in a file."""

    name: str
    place: str


class Crowd:
    """The texts by number."""

    def __init__(self, texts: dict[int, str], named: Mapping[int, Named] | None = None):
        """A complaint calls those in `named` by their names."""
        self.texts, self._named = texts, named or {}

    @staticmethod
    def can_hold(text: str) -> bool:
        head, _, _ = text.partition("namespace spook {")
        return (len(_BEGIN.findall(text)) == 1 and text.count(_END) == 1
                and all(not line or line.startswith(("#include", "//")) for line in head.splitlines()))

    def source(self) -> str:
        return self._head() + "".join(self._bodies())

    def _head(self) -> str:
        """What any of them includes, once."""
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
        """Of those without a name, all are as long as each other."""
        return f"mutant_{k:06d}" + (f"_{self._named[k].name}" if k in self._named else "")

    def culprits(self, errors: str) -> set[int]:
        """Which of the texts the compiler complains about."""
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

    def switch(self, compiled: Path, wanted: set[str]) -> str:
        """The source of the functions `wanted`, given as symbols: each jumps to one of the mutants."""
        functions = dict(zip(_readable(sorted(wanted)), sorted(wanted)))
        listing = subprocess.run(["nm", "-P", "--defined-only", str(compiled)],
                                 capture_output=True, text=True)
        symbols = [line.split()[0] for line in listing.stdout.splitlines() if "mutant_0" in line]
        symbol = dict(zip(_readable(symbols), symbols))
        lines, tables = [], []
        for number, (readable, mangled) in enumerate(functions.items()):
            slot, table = f"spook_slot_{number}", []
            for k in self.texts:
                found = _inside(readable, self._namespace(k)) & symbol.keys()
                if not found:
                    place = self._named[k].place if k in self._named else f"mutant {k}"
                    raise CourseError(f"{place}: it does not define {readable}")
                lines.append(f'extern "C" void target_{number}_{k}() __asm__("{symbol[found.pop()]}");')
                table.append(f"{{{k}, target_{number}_{k}}}")
            lines.append(f'extern "C" {{ void (*{slot})(); }}')
            lines.append(jump_through(slot, mangled))
            tables.append(f"  for (const Entry entry : {{{', '.join(f'Entry{one}' for one in table)}}})\n"
                          f"    if (entry.number == number) {slot} = entry.target;\n")
        return ("#include <cstdlib>\n#include <initializer_list>\n"
                "struct Entry { int number; void (*target)(); };\n"
                + "\n".join(lines)
                + "\n__attribute__((constructor(101))) static void choose() {\n"
                + f'  const char* chosen = std::getenv("{VARIABLE}");\n'
                + "  const int number = chosen ? std::atoi(chosen) : 0;\n" + "".join(tables) + "}\n")


def jump_through(slot: str, symbol: str) -> str:
    """The source of a function that goes on in whatever the pointer `slot` points to, whatever its arguments are."""
    jump = _JUMP.get(platform.machine())
    if not jump:
        raise CourseError(f"functions can't be made to jump on {platform.machine()}")
    text = f".globl {symbol}\\n{symbol}:\\n {jump.format(slot=slot)}\\n"
    return f'__asm__(".pushsection .text\\n{text}.popsection");'


def _readable(symbols: list[str]) -> list[str]:
    listing = subprocess.run(["c++filt"], input="\n".join(symbols) + "\n", capture_output=True, text=True)
    return listing.stdout.splitlines()


def _inside(readable: str, namespace: str) -> set[str]:
    """spook::kick(...) as it is called in the namespace."""
    return {readable[: found.end()] + f"{namespace}::" + readable[found.end():]
            for found in re.finditer(r"\bspook::", readable)}
