"""All first-order mutants of a file."""

from calls import calls
from constants import constants, indices
from cpp_source import Source
from mutant import Mutant
from names import names
from operators import added_signs, operators
from statements import conditions, loops, statements

_KINDS = (operators, added_signs, constants, indices, names, calls, statements, conditions, loops)


def mutants_of(text: str) -> list[Mutant]:
    """In the order of the lines; what reads the same is one mutant."""
    source = Source(text)
    found: dict[str, Mutant] = {}
    for kind in _KINDS:
        for mutant in kind(source):
            found.setdefault("".join(mutant.of(text).split()), mutant)
    found.pop("".join(text.split()), None)
    return sorted(found.values(), key=lambda mutant: (mutant.start, mutant.end, mutant.kind, mutant.text))
