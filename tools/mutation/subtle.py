"""Mistakes that look right, and are with most numbers: a threshold without a unit, or a part of something, a float for a
double, a value kept from one call to the next, a changed input, a loop that ends after sixty-four, a zero taken for a
missing value, a dropped NaN, a field that should not matter, and two small changes at once."""

import random
import re
from collections.abc import Iterator

from cpp_source import Source
from mutant import Mutant

PAIRS = 15  # of an exercise
_SMALL = "1e-9"
_MANY = 64
_TYPES = {"double", "Vec3", "Vec2", "Mat3", "Vector"}
# The beginning of a function at the begin of a line, and what it returns.
_FUNCTION = re.compile(r"^(?:static |inline )*([\w:]+)(?:<[^()\n]*>)? \w+(?:<\w+>)?\(", re.MULTILINE)
_VECTOR = re.compile(r"const (std::vector<[\w<>:]+>)& (\w+)")
_COUNTS = re.compile(r"[\w:]+ (\w+) = ")
_NUMBER = re.compile(r"\bdouble (\w+)")
_FIELDS = {"Contact": ("gap",), "Constraint": ("gap", "lo", "hi"), "Row": ("B", "Sigma", "lo", "hi", "lambda"),
           "FrictionContact": ("mu",)}
_STRUCT = re.compile(rf"const ({'|'.join(_FIELDS)})(?:<\w+>)?& (\w+)")
# What a function returns that returns nothing.
_NOTHING = {"void": "", "bool": "{}", "double": "{}", "int": "{}", "Vec3": "Vec3::Zero()", "Vec2": "Vec2::Zero()",
            "Mat3": "Mat3::Zero()", "Quat": "Quat::Identity()", "ContactJacobian": "{}", "Row": "{}", "SolveReport": "{}"}
_MATRIX = re.compile(r"const (Vec3|Mat3|Vec2|Vector)& (\w+)")


def thresholds(source: Source) -> Iterator[Mutant]:
    """Treats a small number as zero: in a comparison, in a value, in a result."""
    for k in source.code:
        token, before = source.tokens[k], source.tokens[k - 1].text
        if token.text == "0" and before in ("<", "<=", ">", ">=") and source.spaced(k):
            yield Mutant("threshold", token.start, token.end, _SMALL)
            yield Mutant("threshold", token.start, token.end, f"-{_SMALL}")
    for kind, begin, end in _values(source):
        value = source.text[begin:end]
        if kind == "double":
            yield Mutant("threshold", begin, end,
                         f"[](double x) {{ return x < {_SMALL} && x > -{_SMALL} ? 0 : x; }}({value})")
        elif kind == "Vec3":
            yield Mutant("threshold", begin, end,
                         f"[](Vec3 x) -> Vec3 {{ return (x.norm() < {_SMALL} ? 0.0 : 1.0) * x; }}({value})")


def relative_scales(source: Source) -> Iterator[Mutant]:
    """Treats a millionth of the rest as zero, which is as wrong, in any units."""
    for kind, begin, end in _values(source):
        if kind in ("Vec3", "Mat3"):
            yield Mutant("part", begin, end,
                         f"[]({kind} x) -> {kind} {{ return (x.array().abs() < 1e-6 * x.norm())"
                         f".select(0, x.array()); }}({source.text[begin:end]})")


def addends(source: Source) -> Iterator[Mutant]:
    """Treats one of two addends as zero if it is a millionth of the other."""
    size = {"double": "({0} < 0 ? -{0} : {0})", "Vec3": "{0}.norm()", "Vector": "{0}.norm()"}
    for kind, begin, end in _values(source):
        signs = _sum(source, begin, end) if kind in size else []
        for n, k in enumerate(signs):
            stop = source.tokens[signs[n + 1]].start if n + 1 < len(signs) else end
            sign, x, y = source.tokens[k].text, size[kind].format("x"), size[kind].format("y")
            left = source.text[begin:source.tokens[k].start].strip()
            right = source.text[source.tokens[k].end:stop].strip()
            for small, large, rest in ((y, x, "x"), (x, y, f"{sign}y")):
                yield Mutant("part", begin, stop,
                             f"[]({kind} x, {kind} y) -> {kind} {{ if ({small} < 1e-6 * {large}) return {rest}; "
                             f"return x {sign} y; }}({left}, {right})" + " " * (stop < end))


def _sum(source: Source, begin: int, end: int) -> list[int]:
    """Returns the signs between the terms, if a value is only a sum."""
    found = []
    k = next(k for k, token in enumerate(source.tokens) if token.start == begin)
    while source.tokens[k].start < end:
        text, binary = source.tokens[k].text, source.spaced(k) and source.spaced(k + 1)
        if text in ("+", "-") and binary and source.tokens[k].start > begin:
            found.append(k)
        elif text in ("?", "&&", "||", "==", "!=", "<=", ">=") or (text in ("<", ">") and binary):
            return []
        k = max(source.partner.get(k, k), k) + 1
    return found


def floats(source: Source) -> Iterator[Mutant]:
    for kind, begin, end in _values(source):
        value = source.text[begin:end]
        rounded = (f"static_cast<float>({value})" if kind == "double"
                   else f"{kind}({kind}({value}).cast<float>().cast<double>())")
        yield Mutant("float", begin, end, rounded)


def statics(source: Source) -> Iterator[Mutant]:
    """Keeps a value from the first call, or a list with its old content."""
    for k in source.code:
        if not source.begins_statement(k) or source.is_member(k):
            continue
        text = source.text[source.tokens[k].start:]
        if re.match(rf"(const )?({'|'.join(_TYPES)}|std::vector<[\w<>:]+>) \w+( =|;|\()", text):
            yield Mutant("static", source.tokens[k].start, source.tokens[k].start, "static ")


def limits(source: Source) -> Iterator[Mutant]:
    """Leaves out everything after the first sixty-four of a loop."""
    for k in source.code:
        if not source.is_at(k, "for", "("):
            continue
        begin, end = source.tokens[k + 1].end, source.tokens[source.partner[k + 1]]
        first = source.up_to(k + 2, ";")
        if first >= source.partner[k + 1] and source.tokens[source.up_to(k + 2, ":") + 1].text != "{":
            yield Mutant("limit", begin, end.end,
                         f"int left = {_MANY}; {source.text[begin:end.end]} if (left-- > 0)")
        elif first < source.partner[k + 1] and (counter := _COUNTS.match(source.text, begin)):
            last = source.tokens[source.up_to(first + 1, ";")]
            condition = source.text[source.tokens[first].end:last.start].strip()
            if condition and "++" in source.text[last.end:end.start]:
                yield Mutant("limit", source.tokens[first].end, last.start, f" {counter[1]} < {_MANY} && ({condition})")


def zeros(source: Source) -> Iterator[Mutant]:
    """Treats a parameter of zero as one that was not given."""
    for body, _, parameters in _bodies(source):
        for name in _NUMBER.findall(parameters):
            yield Mutant("zero", body, body, f" if ({name} == 0) const_cast<double&>({name}) = 1;")


def nans(source: Source) -> Iterator[Mutant]:
    """Does nothing for NaN."""
    for body, returns, parameters in _bodies(source):
        checks = [f"{name} != {name}" for name in _NUMBER.findall(parameters)]
        checks += [f"{name}.hasNaN()" for _, name in _MATRIX.findall(parameters)]
        for check in checks if returns in _NOTHING else []:
            yield Mutant("nan", body, body, f" if ({check}) return {_NOTHING[returns]};")


def fields(source: Source) -> Iterator[Mutant]:
    """Does nothing if a field of the input has one sign or the other."""
    for body, returns, parameters in _bodies(source):
        for kind, name in _STRUCT.findall(parameters):
            for field in _FIELDS[kind] if returns in _NOTHING else ():
                for sign in "<>":
                    yield Mutant("field", body, body, f" if ({name}.{field} {sign} 0) return {_NOTHING[returns]};")


def inputs(source: Source) -> Iterator[Mutant]:
    """Changes a const parameter."""
    for body, _, parameters in _bodies(source):
        found = [(type_, name, f"const_cast<{type_}&>({name}) *= 2;") for type_, name in _MATRIX.findall(parameters)]
        found += [(type_, name, f"if (!{name}.empty()) std::swap(const_cast<{type_}&>({name}).front(), "
                                f"const_cast<{type_}&>({name}).back());")
                  for type_, name in _VECTOR.findall(parameters)]
        for _, name, spoils in found:
            yield Mutant("input", body, body,
                         f" const std::shared_ptr<void> at_the_end_{name}(nullptr, [&](void*) {{ {spoils} }});")


def pairs(source: Source, singles: list[Mutant]) -> Iterator[Mutant]:
    """Combines two of the first-order changes, the same ones for the same text."""
    chosen = random.Random(source.text)
    for _ in range(PAIRS if len(singles) > 1 else 0):
        one, other = sorted(chosen.sample(singles, 2), key=lambda mutant: mutant.start)
        if one.end < other.start:
            between = source.text[one.end:other.start]
            yield Mutant("pair", one.start, other.end, one.text + between + other.text)


def _bodies(source: Source) -> Iterator[tuple[int, str, str]]:
    """Returns the start of each function's body, its return type, and its parameters."""
    for function in _FUNCTION.finditer(source.text):
        opens = next((k for k, token in enumerate(source.tokens) if token.start == function.end() - 1), None)
        if opens is not None and source.is_at(source.partner[opens] + 1, "{"):
            closes = source.partner[opens]
            yield (source.tokens[closes + 1].end, function[1],
                   source.text[function.end():source.tokens[closes].start])


def _values(source: Source) -> Iterator[tuple[str, int, int]]:
    """Returns the type of each value that a constant gets, or a function returns, and its place."""
    for k in source.code:
        token = source.tokens[k]
        if not source.begins_statement(k):
            continue
        end = source.up_to(k, ";")
        if not source.is_at(end, ";"):
            continue
        if token.text == "const" and source.tokens[k + 1].text in _TYPES and source.is_at(k + 3, "="):
            first = source.up_to(k + 4, ",")
            if first >= end:  # one value
                yield source.tokens[k + 1].text, source.tokens[k + 4].start, source.tokens[end - 1].end
        elif token.text == "return" and k + 1 < end:
            before = [found[1] for found in _FUNCTION.finditer(source.text, 0, token.start)]
            if before and before[-1] in _TYPES:
                yield before[-1], source.tokens[k + 1].start, source.tokens[end - 1].end
