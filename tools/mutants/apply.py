"""Makes the changes of a mutant in the reference, and refuses those whose lines are not there exactly once."""

from dataclasses import dataclass

from answer import Line, refused


@dataclass(frozen=True)
class Signed:
    """A line of a change; the sign is - for what goes, + for what comes, a space for what stays."""

    sign: str
    line: Line


Change = list[Signed]


def applied(name: str, changes: list[Change], right: list[Line]) -> tuple[Line, ...]:
    """The reference with the changes of this mutant made."""
    gone: set[int] = set()
    new: dict[int, list[Line]] = {}  # by the line of the reference that they stand before
    for change in changes:
        includes = [signed for signed in change if signed.sign == "+" and signed.line.code.startswith("#include")]
        new.setdefault(0, []).extend(signed.line for signed in includes)
        change = [signed for signed in change if signed not in includes]
        if not change:
            continue
        places = _places(name, change, right)
        here = places[0]
        for signed in change:
            if signed.sign == "+":
                new.setdefault(here, []).append(signed.line)
                continue
            place = places.pop(0)
            here = place + 1
            if signed.sign == "-":
                if place in gone:
                    raise refused(signed.line.file, signed.line.number, "this line is gone already", name)
                gone.add(place)
    return tuple(line for k in range(len(right) + 1)
                 for line in [*new.get(k, []), *(right[k:k + 1] if k not in gone else [])])


def _places(name: str, change: Change, right: list[Line]) -> list[int]:
    """Where in the reference the lines of before stand, comments and empty lines apart."""
    file, number = change[0].line.file, change[0].line.number
    before = [signed.line.code for signed in change if signed.sign != "+"]
    if not before:
        raise refused(file, number, "a change needs a line of the reference, with - or a space", name)
    if not all(before):
        raise refused(file, number, "comments do not count: leave their lines out", name)
    code = [k for k, line in enumerate(right) if line.code]
    windows = (code[k:k + len(before)] for k in range(len(code) - len(before) + 1))
    found = [places for places in windows if [right[k].code for k in places] == before]
    if len(found) != 1:
        there = ", ".join(str(right[places[0]].number) for places in found)
        raise refused(file, number, f"the lines of before are in {right[0].shown} "
                      + (f"{len(found)} times, at lines {there}: say what stays beside them" if found else "nowhere"),
                      name)
    return found[0]
