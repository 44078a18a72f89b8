"""The number of a chapter's mutants that its checks detect."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from exercise_run import Result
from outcome import CRASHED, EQUIVALENT, KILLED, LISTED, NOT_COMPILED, SURVIVED, TIMED_OUT

NEEDED = 95.0  # per cent
HEADINGS = ("mutants", "killed", "crashed", "timed out", "survived", "equivalent", "not C++", "score")


@dataclass(frozen=True)
class Score:
    counts: Counter

    @property
    def detected(self) -> int:
        """Counts detected mutants. A crash or an endless loop is detected, too, but teaches less than a failed
        check."""
        return self.counts[KILLED] + self.counts[CRASHED] + self.counts[TIMED_OUT]

    @property
    def percent(self) -> float:
        all_that_count = self.detected + self.counts[SURVIVED]
        return 100 * self.detected / all_that_count if all_that_count else 100.0

    def row(self) -> list[str]:
        counts = self.counts
        return [str(count) for count in (
            self.detected + counts[SURVIVED] + counts[EQUIVALENT] + counts[LISTED], counts[KILLED],
            counts[CRASHED], counts[TIMED_OUT], counts[SURVIVED])] + [
                f"{counts[EQUIVALENT]}+{counts[LISTED]}", str(counts[NOT_COMPILED]), f"{self.percent:.1f} %"]

    def __str__(self) -> str:
        return ", ".join(f"{count} {what}" for what, count in sorted(self.counts.items()))


def score(results: Iterable[Result]) -> Score:
    return Score(Counter(result.outcome for result in results))


def table(rows: list[tuple[str, Score]]) -> str:
    cells = [["", *HEADINGS], *([name, *found.row()] for name, found in rows)]
    widths = [max(len(row[k]) for row in cells) for k in range(len(cells[0]))]
    lines = [[row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:]))]
             for row in cells]
    return "\n".join("  ".join(line) for line in lines)
