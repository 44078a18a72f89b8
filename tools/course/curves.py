"""./course run --plot: columns of a run, or of several, over time."""

import csv
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput, CourseError
from paths import BUILD, ROOT, shown
from process import stream, tail

_DRAWING = ROOT / "plots" / "run" / "draw.py"
_TIME = "time"


@dataclass(frozen=True)
class Table:
    label: str  # of the run; empty for one alone
    columns: list[str]  # with their units: gap 0 [m]
    rows: list[list[float]]

    @classmethod
    def read(cls, file: Path, label: str = "") -> "Table":
        """Reads the columns; a run that blew up has fewer rows."""
        with file.open(encoding="utf-8", newline="") as lines:
            rows = list(csv.reader(lines))
        if not rows:
            return cls(label, [], [])
        return cls(label, rows[0], [[float(cell) for cell in row] for row in rows[1:] if len(row) == len(rows[0])])


def name_of(column: str) -> str:
    return re.sub(r" \[[^\]]*\]$", "", column)


def matching(columns: list[str], wanted: str) -> list[str]:
    """Returns the column of this name, or all columns whose names begin with these words. Refuses unknown names."""
    names = {name_of(column): column for column in columns}
    names.pop(_TIME, None)
    if wanted in names:
        return [names[wanted]]
    found = [column for name, column in names.items() if name.startswith(f"{wanted} ")]
    if not found:
        raise BadInput(f"run: --plot: unknown column {wanted!r}; the columns are {_listed(list(names))}")
    return found


def _listed(names: list[str]) -> str:
    most = 12
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def draw(tables: list[Table], wanted: tuple[str, ...], scene: str, command: str) -> Path:
    """Draws a part for each name, with a curve for each column and run."""
    parts = []
    for name in wanted:
        columns = matching(tables[0].columns, name)
        curves = [{"label": _label(table, column, len(columns)), "time": [row[0] for row in table.rows],
                   "values": [row[table.columns.index(column)] for row in table.rows]}
                  for table in tables for column in columns if column in table.columns]
        parts.append({"name": columns[0] if len(columns) == 1 else f"{name}{columns[0][len(name_of(columns[0])):]}",
                      "curves": curves})
    base = BUILD / "plots" / "run" / re.sub(r"[^\w.-]+", "_", f"{scene}_{'_'.join(wanted)}")
    base.parent.mkdir(parents=True, exist_ok=True)
    data = base.with_name(f"{base.name}.json")
    content = {"title": f"{scene}: {', '.join(wanted)}", "command": command, "parts": parts}
    data.write_text(json.dumps(content) + "\n", encoding="utf-8")
    figures = [base.with_name(f"{base.name}.{kind}") for kind in ("png", "svg")]
    outs = [word for figure in figures for word in ("--out", str(figure))]
    code, output = stream([sys.executable, str(_DRAWING), "--data", str(data), *outs], lambda line: None)
    if code != 0:
        raise CourseError(f"{shown(_DRAWING)} failed", tail(output))
    return figures[0]


def _label(table: Table, column: str, count: int) -> str:
    return ", ".join(part for part in (table.label, name_of(column) if count > 1 else "") if part)
