"""The mutants that are known to be right answers, from tests/mutants/equivalent.txt, each with the reason:

    solutions/07_impacts/impact_impulse.cpp  operator
    - if (u.dot(n) >= 0) return Vec3::Zero();
    + if (u.dot(n) > 0) return Vec3::Zero();
    = Without approach the impulse that stops it is zero, too.
"""

from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from manifest import Exercise
from exercise_run import Result
from mutate import SUBTLE_KINDS
from outcome import LISTED, SURVIVED
from paths import ROOT, shown

LIST = ROOT / "tests" / "mutants" / "equivalent.txt"


@dataclass(frozen=True)
class Equivalent:
    path: str
    kind: str
    before: str
    after: str
    reason: str
    line: int  # in the list


def read_equivalents(file: Path = LIST) -> list[Equivalent]:
    if not file.exists():
        return []
    found, entry = [], {}

    def finish() -> None:
        if not entry:
            return
        absent = [name for name in ("-", "+", "=") if not entry.get(name)]
        if absent or len(entry["head"].split()) != 2:
            raise CourseError(f"{shown(file)}:{entry['line']}: a path and a kind, "
                              "and then lines with -, + and = are needed")
        path, kind = entry["head"].split()
        found.append(Equivalent(path, kind, entry["-"], entry["+"], entry["="], entry["line"]))
        entry.clear()

    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            finish()
        elif line[0] in "-+=" and entry:
            entry[line[0]] = line[1:].strip()
        elif line[0] == " " and entry.get("="):
            entry["="] += " " + line.strip()
        else:
            finish()
            entry.update(head=line, line=number)
    finish()
    return found


def exempted(exercise: Exercise, results: list[Result],
             known: list[Equivalent], subtle: bool = False) -> tuple[list[Result], list[str]]:
    """Returns the results with the listed survivors marked, and the errors in the list."""
    text = exercise.reference.read_text(encoding="utf-8")
    path = str(exercise.reference.relative_to(ROOT))
    entries = {(entry.kind, entry.before, entry.after): entry for entry in known
               if entry.path == path and (entry.kind in SUBTLE_KINDS) == subtle}
    marked, used, wrong = [], set(), []
    for result in results:
        entry = entries.get((result.mutant.kind, result.mutant.before(text), result.mutant.after(text)))
        if entry:
            used.add(entry)
            if result.outcome == SURVIVED:
                result = Result(result.mutant, LISTED, entry.reason)
            else:
                said = f"{result.outcome} {result.by}".strip()
                wrong.append(f"{shown(LIST)}:{entry.line}: this mutant is no survivor: {said}")
        marked.append(result)
    wrong += [f"{shown(LIST)}:{entry.line}: no mutant of {path} reads so"
              for entry in entries.values() if entry not in used]
    return marked, wrong
