"""Makes the changes of a mutant in the reference, and refuses those whose lines are not there exactly once."""

from dataclasses import dataclass

from answer import Line, refused
from errors import CourseError


@dataclass(frozen=True)
class Signed:
    """A line of a change. The sign is - for a removed line, + for a new one, a space for one that stays."""

    sign: str
    line: Line

    @property
    def includes(self) -> bool:
        """Tells whether the line is an include, which goes to the top."""
        return self.sign == "+" and self.line.code.startswith("#include")


Change = list[Signed]


def applied(name: str, changes: list[Change], right: list[Line]) -> tuple[Line, ...]:
    """Returns the reference with the changes of this mutant made."""
    gone: set[int] = set()
    new: dict[int, list[Line]] = {}  # by the line of the reference that they stand before
    for change in changes:
        places = _places(name, change, right)
        here = places[0] if places else 0
        for signed in change:
            if signed.sign == "+":
                new.setdefault(0 if signed.includes else here, []).append(signed.line)
                continue
            place = places.pop(0)
            here = place + 1
            if signed.sign == "-":
                if place in gone:
                    raise _refused(name, signed.line, "this line is gone already")
                gone.add(place)
    return tuple(line for k in range(len(right) + 1)
                 for line in [*new.get(k, []), *(right[k:k + 1] if k not in gone else [])])


def _places(name: str, change: Change, right: list[Line]) -> list[int]:
    """Returns the places of the old lines in the reference, without regard to comments and empty lines."""
    before = [signed.line for signed in change if signed.sign != "+"]
    if not before and all(signed.includes for signed in change):
        return []
    if not before:
        raise _refused(name, change[0].line, "a change needs a line of the reference, with - or a space")
    code = [k for k, line in enumerate(right) if line.code]
    known = {right[k].code for k in code}
    for line in before:
        if not line.code:
            raise _refused(name, line, "comments do not count: leave this line out")
        if line.code not in known:
            raise _refused(name, line, f"this is not in {right[0].shown}: {line.code}")
    windows = (code[k:k + len(before)] for k in range(len(code) - len(before) + 1))
    wanted = [line.code for line in before]
    found = [places for places in windows if [right[k].code for k in places] == wanted]
    if not found:
        raise _refused(name, before[0], f"in {right[0].shown} these lines do not follow one another")
    if len(found) > 1:
        there = ", ".join(str(right[places[0]].number) for places in found)
        raise _refused(name, before[0], f"this is {len(found)} times in {right[0].shown}, at lines {there}: "
                       "say what stays beside it")
    return found[0]


def _refused(name: str, line: Line, reason: str) -> CourseError:
    return refused(line.file, line.number, reason, name)
