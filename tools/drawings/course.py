"""The whole course: the chapters that each chapter needs."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "course"))

from manifest import read_chapters  # noqa: E402
from pen import Drawing  # noqa: E402
from syllabus import calls_of, closure, needs_of  # noqa: E402

_COLUMNS = {1: 2, 2: 2, 3: 2, 4: 2, 8: 4, 7: 0, 11: 1, 6: 2, 5: 3, 10: 4, 12: 1.5, 13: 2.5, 9: 3.5, 14: 4}
_WIDTH, _HEIGHT, _STEP = 132, 46, 76


def needs() -> Drawing:
    """Each chapter is below those named in its lesson's head, without those that these name in turn."""
    chapters = read_chapters()
    named = {chapter.number: needs_of(chapter) for chapter in chapters}
    depth: dict[int, int] = {}
    for number in sorted(named):
        depth[number] = 1 + max((depth[one] for one in named[number]), default=-1)
    d = Drawing(40 + _STEP * max(depth.values()) + _HEIGHT + 34, "Which chapter needs which")
    place = {number: (80 + 140 * _COLUMNS[number], 20 + _STEP * depth[number]) for number in named}
    for chapter in chapters:
        number = chapter.number
        below = place[number]
        implied = set().union(*(closure(named, one) for one in named[number]))
        for one in sorted(named[number] - implied):
            d.arrow(_foot(place[one]), below, "ink")
        for one in sorted(calls_of(chapter) - closure(named, number)):
            d.line((place[one][0] + _WIDTH / 4, place[one][1]), (below[0] - _WIDTH / 4, below[1] + _HEIGHT), "soft dash")
    for chapter in chapters:
        x, y = place[chapter.number]
        d.box((x - _WIDTH / 2, y), _WIDTH, _HEIGHT, "body fill", 6)
        title = chapter.title.partition(" · ")[2].partition(":")[0].partition(",")[0]
        d.text((x, y + 18), f"{chapter.number:02}", "ink", size="small")
        d.text((x, y + 36), title, "ink", size="small")
    d.text((20, 40 + _STEP * max(depth.values()) + _HEIGHT + 16), "dashed: the reference calls it, and a reader need not "
           "know it", "soft", anchor="start", size="small")
    return d


def _foot(top: tuple[float, float]) -> tuple[float, float]:
    return top[0], top[1] + _HEIGHT
