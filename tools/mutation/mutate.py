"""All mutants of a file: every small change, or those of subtle.py."""

from calls import calls
from constants import constants, indices
from cpp_source import Source
from mutant import Mutant
from names import names
from operators import added_signs, operators
from statements import conditions, loops, statements
from subtle import addends, fields, floats, inputs, limits, nans, pairs, relative_scales, statics, thresholds, zeros

_KINDS = (operators, added_signs, constants, indices, names, calls, statements, conditions, loops)
_SUBTLE = (thresholds, relative_scales, addends, floats, statics, inputs, limits, zeros, nans, fields)
SUBTLE_KINDS = {"threshold", "part", "float", "static", "input", "limit", "zero", "nan", "field", "pair"}


def mutants_of(text: str, subtle: bool = False) -> list[Mutant]:
    """Returns the mutants in the order of the lines, without repetition."""
    source = Source(text)
    made = [mutant for kind in (_SUBTLE if subtle else _KINDS) for mutant in kind(source)]
    if subtle:
        made += pairs(source, mutants_of(text))
    found: dict[str, Mutant] = {}
    for mutant in made:
        found.setdefault("".join(mutant.of(text).split()), mutant)
    found.pop("".join(text.split()), None)
    return sorted(found.values(), key=lambda mutant: (mutant.start, mutant.end, mutant.kind, mutant.text))
