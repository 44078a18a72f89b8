"""Writes code that connects the tests of a chapter with a student's function in another process.

    functions.py asking REFERENCE HEADER RESULT WRAPS FUNCTION...
    functions.py answering REFERENCE HEADER RESULT FUNCTION...

REFERENCE is the archive with the right functions, HEADER the chapter's, FUNCTION the names of its exercises. `asking`
is linked with the tests: each function jumps through a slot, at first to the reference; WRAPS are the linker's options
that lead its callers there. `answering` is linked with the student's function, and calls it by the number that both
have given it.
"""

import re
import subprocess
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / folder) for folder in ("course", "mutation")]
from crowd import jump_through  # noqa: E402
from errors import CourseError  # noqa: E402
from symbols import functions_in  # noqa: E402


def instances(reference: Path, functions: list[str]) -> list[tuple[str, str, str]]:
    """Returns all definitions of each exercise: its name, the function's declaration in C++, and its symbol."""
    found = []
    for function in functions:
        symbols = sorted(functions_in(reference, function))
        readable = subprocess.run(["c++filt", *symbols], capture_output=True, text=True).stdout.splitlines()
        for symbol, text in zip(symbols, readable):
            name = re.search(rf"\bspook::{function}(<[^()]*>)?\(", text)
            found.append((function, f"spook::{function}{name[1] or ''}", symbol))
    return found


def asking(header: str, found: list[tuple[str, str, str]]) -> str:
    lines = [f'#include "{header}"', '#include "asking.hpp"', ""]
    table = []
    for number, (exercise, function, symbol) in enumerate(found):
        slot = f"spook_slot_{number}"
        lines += [f'extern decltype({function}) reference_{number} __asm__("__real_{symbol}");',
                  f'extern "C" {{ void (*{slot})() = reinterpret_cast<void (*)()>(reference_{number}); }}',
                  jump_through(slot, f"__wrap_{symbol}")]
        table.append(f'    {{"{exercise}", &{slot}, reinterpret_cast<void (*)()>('
                     f"spook::remote::Asked<{number}, decltype({function})>::call), reinterpret_cast<void (*)()>("
                     f"spook::remote::Idle<decltype({function})>::call)}},")
    return "\n".join([*lines, "", "namespace spook::remote {", "extern const Graded graded_functions[] = {", *table,
                      "};", f"extern const int graded_count = {len(found)};", "}  // namespace spook::remote", ""])


def answering(header: str, found: list[tuple[str, str, str]]) -> str:
    cases = [f"    case {number}: return answered({function}, reader);"
             for number, (_, function, _) in enumerate(found)]
    return "\n".join([f'#include "{header}"', '#include "answering.hpp"', "", "namespace spook::remote {",
                      "Message answer_call(int number, Reader& reader) {", "  switch (number) {", *cases, "  }",
                      "  throw Nonsense{};", "}", "}  // namespace spook::remote", ""])


def wraps(found: list[tuple[str, str, str]]) -> str:
    return "".join(f"--wrap={symbol}\n" for _, _, symbol in found)


def write(file: Path, text: str) -> None:
    """Writes a file only if its text has changed, so that it is not compiled again."""
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def main(words: list[str]) -> int:
    what, reference, header, result, *functions = words
    try:
        if what == "asking":
            options, *functions = functions
            found = instances(Path(reference), functions)
            write(Path(options), wraps(found))
            write(Path(result), asking(header, found))
        else:
            write(Path(result), answering(header, instances(Path(reference), functions)))
    except CourseError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
