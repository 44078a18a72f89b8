"""Writes code by which a program records the exercises' functions that a run has called.

    noting.py REFERENCE RESULT WRAPS FUNCTION...

REFERENCE is the archive with the right functions. FUNCTION gives the names of exercises; others have no function there,
and are left out. RESULT has a function before each of theirs, which records the call and jumps on; WRAPS are the
linker's options that lead callers there. At its end the program writes the names of the called functions, a line each,
to the file that SPOOK_CALLS names. Calls within one file are not recorded.
"""

import platform
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent / folder) for folder in ("course", "remote")]
from errors import CourseError  # noqa: E402
from functions import instances, wraps, write  # noqa: E402

# Notes a call in byte {n}, changes no register that holds an argument, and jumps on.
_NOTE = {"x86_64": "movb $1, spook_called+{n}(%rip)\\n jmp {real}",
         "aarch64": "adrp x16, spook_called+{n}\\n add x16, x16, :lo12:spook_called+{n}\\n mov w17, #1\\n "
                    "strb w17, [x16]\\n b {real}"}

_TELL = """
__attribute__((destructor)) static void tell() {
  const char* const name = std::getenv("SPOOK_CALLS");
  std::FILE* const file = name ? std::fopen(name, "w") : nullptr;
  if (!file) return;
  for (unsigned k = 0; k < sizeof spook_called; ++k)
    if (spook_called[k]) std::fprintf(file, "%s\\n", names[k]);
  std::fclose(file);
}
"""


def noting(found: list[tuple[str, str, str]], machine: str) -> str:
    if machine not in _NOTE:
        raise CourseError(f"calls can't be noted on {machine}")
    lines = ["#include <cstdio>", "#include <cstdlib>", "",
             f'extern "C" {{ unsigned char spook_called[{len(found)}]; }}']
    for n, (_, _, symbol) in enumerate(found):
        note = _NOTE[machine].format(n=n, real=f"__real_{symbol}")
        lines.append(f'__asm__(".pushsection .text\\n.globl __wrap_{symbol}\\n__wrap_{symbol}:\\n {note}\\n'
                     '.popsection");')
    names = ", ".join(f'"{exercise}"' for exercise, _, _ in found)
    return "\n".join([*lines, f"static const char* const names[] = {{{names}}};"]) + "\n" + _TELL


def main(words: list[str]) -> int:
    reference, result, options, *functions = words
    try:
        found = instances(Path(reference), functions)
        write(Path(result), noting(found, platform.machine()))
        write(Path(options), wraps(found))
    except CourseError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
