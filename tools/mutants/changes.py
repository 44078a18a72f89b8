"""Answers as changes to the reference: tests/mutants/04_gauss_seidel/update_row.diff.

    @@ forgets_sigma_lambda @@ leaves Σ λ out of what the row lacks.
    Killed by UpdateRow.CountsSigmaLambdaAndTheVelocitySoFar, which says "Σ λ is missing"
    -  const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    +  const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]);

The lines with - and with a space stand in the reference, one below another and only once; those with + are new.
An empty line ends a change: another of the same mutant may follow. A line with # is a comment. A right answer, of a
style that a test might refuse, says `Passes every test.` in place of the promise.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

from answer import Line, Answer, refused
from apply import Change, Signed, applied

_TITLE = re.compile(r"@@ (\w+) @@ (\S.*)")
_PROMISE = re.compile(r'(.*\S) (?:Killed by (\w+\.\w+), which says "(.+)"|Passes every test\.)')


@dataclass
class _Mutant:
    """A mutant, as read."""

    line: int
    name: str
    words: list[str]
    changes: list[Change] = field(default_factory=list)
    between: bool = True  # changes: the next line of one begins another


def read_changes(file: Path, reference: Path) -> list[Answer]:
    """Reads the answers of a .diff, in its order."""
    right = lines_of(reference)
    return [_answer(file, mutant, right) for mutant in _mutants(file)]


def lines_of(file: Path) -> list[Line]:
    return [Line(file, number, text)
            for number, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1)]


def _mutants(file: Path) -> list[_Mutant]:
    mutants: list[_Mutant] = []
    for line in lines_of(file):
        if line.text.startswith("@@"):
            title = _TITLE.fullmatch(line.text)
            if not title:
                raise refused(file, line.number, "'@@ name @@ what is wrong' is needed")
            mutants.append(_Mutant(line.number, title[1], [title[2]]))
        elif not line.text.startswith("#") and (mutants or line.text.strip()):
            if not mutants:
                raise refused(file, line.number, "'@@ name @@ what is wrong' must come first")
            _add(mutants[-1], line)
    return mutants


def _add(mutant: _Mutant, line: Line) -> None:
    if not line.text.strip():
        mutant.between = True
    elif line.text[0] in "+- ":
        if mutant.between or not mutant.changes:
            mutant.changes.append([])
        mutant.between = False
        mutant.changes[-1].append(Signed(line.text[0], Line(line.file, line.number, line.text[1:])))
    elif mutant.changes:
        raise refused(line.file, line.number, "a line of a change begins with -, + or a space", mutant.name)
    else:
        mutant.words.append(line.text)


def _answer(file: Path, mutant: _Mutant, right: list[Line]) -> Answer:
    promise = _PROMISE.fullmatch(" ".join(mutant.words))
    if not promise:
        raise refused(file, mutant.line, "'Killed by Suite.Test, which says \"text\"' is needed", mutant.name)
    if not mutant.changes:
        raise refused(file, mutant.line, "it has no change", mutant.name)
    about, test, says = promise.groups(default="")
    return Answer(file, mutant.line, mutant.name, about, test, says,
                       applied(mutant.name, mutant.changes, right))
