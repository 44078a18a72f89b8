"""A compiler's messages about a submission, without content that it may have read elsewhere.

A compiler quotes the file that it reports on, and a submission can include, or claim to be, any file that the compiler
may read. So its quotations are turned off. Messages are shown about the submission and headers only, and the line is
quoted from the submitted text.
"""

import re

import diagnostics
from manifest import Exercise

_PLACE = re.compile(r"(?P<file>[^\s:]+):(?P<line>\d+):(?P<column>\d+): ")
_OURS = re.compile(r"\S*?/headers/(?=chapters/)")
_OF_COMPILER = re.compile(r"(?:cc1plus|as|ld|collect2|g\+\+|c\+\+|clang\+*)(?:-[\d.]+)?: ")
_ELSEWHERE = "The first error is in a file that is neither the submission nor a header: its words are not shown."
ASSEMBLER = "The assembler refuses an asm statement."
_TOO_LARGE = re.compile(r"file too large|file size limit exceeded", re.IGNORECASE)
_TOO_MUCH_DATA = "It compiles to more than 256 MiB. Is an array with values that large?"
_LONGEST = 400  # characters of a line
_LOOKED_AT = 4 * _LONGEST  # of one, before our own paths are taken out of it


def compiler_says(output: str, exercise: Exercise, file: str, source: str) -> str:
    lines = [_OURS.sub("", line[:_LOOKED_AT])[:_LONGEST] for line in diagnostics.first_error(output, exercise)]
    places = [_PLACE.match(line) for line in lines]
    if not any(places):
        if _TOO_LARGE.search(output):
            return _TOO_MUCH_DATA
        return ASSEMBLER if "Assembler messages" in output else "\n".join(filter(_OF_COMPILER.match, lines))
    kept = []
    for line, place in zip(lines, places):
        if place and not _may_be_shown(place["file"], file):
            return "\n".join([*kept, _ELSEWHERE])
        kept += [line] if place else []
        if place and place["file"] == file:
            kept += _quoted(source, int(place["line"]), int(place["column"]))
    return "\n".join(kept)


def _may_be_shown(name: str, file: str) -> bool:
    return name == file or (name.startswith(("/usr/include/", "/usr/lib/", "chapters/")) and ".." not in name)


def _quoted(source: str, line: int, column: int) -> list[str]:
    """Returns the submitted line, and a mark below the column."""
    lines = source.splitlines()
    if not 1 <= line <= len(lines):
        return []
    text = lines[line - 1].expandtabs(1)[:_LONGEST]
    return [f"  {text}", " " * (column + 1) + "^"] if column <= len(text) + 1 else [f"  {text}"]
