"""similarity.html: pairs of unusually similar works, side by side, with their common parts marked."""

import html
from pathlib import Path

from grading.similarity import MOST_ALONE, Pair, Similarity, Work, similar
from grading.text import clean
from manifest import Exercise
from marker import is_stub
from reset import stub_of

_HEAD = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>Similarity</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<style>
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1500px; padding: 0 1em; color: #222 }
table { border-collapse: collapse } td, th { padding: .2em .8em; text-align: left; border-bottom: 1px solid #ddd }
.side { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 1em }
pre { background: #f6f6f4; padding: .8em; overflow-x: auto; font-size: 12.5px; margin: 0 }
mark { background: #ffd98a } h2 { margin-top: 2em }
</style>
"""


def write_similarity(folder: Path, exercises: list[Exercise]) -> Similarity:
    """Writes the page, from the works that a grading has kept in its folder."""
    works = {exercise.label: _works(folder, exercise) for exercise in exercises}
    given = {exercise.label: [_stub(exercise), exercise.reference.read_text(encoding="utf-8")]
             for exercise in exercises}
    found = similar({label: of for label, of in works.items() if of}, given)
    (folder / "similarity.html").write_text(_page(found), encoding="utf-8")
    return found


def _works(folder: Path, exercise: Exercise) -> dict[str, str]:
    files = (folder / "submissions").glob(f"*/taken/{exercise.function}.cpp")
    return {file.parents[1].name: file.read_text(encoding="utf-8", errors="replace") for file in sorted(files)}


def _stub(exercise: Exercise) -> str:
    """Returns the stub. Without git's history, as in a kit, the file in the tree is still the stub."""
    source = exercise.source() or ""
    return source if is_stub(source) else stub_of(exercise).decode("utf-8", errors="replace")


def _page(found: Similarity) -> str:
    parts = [_HEAD, "<h1>Submissions that share more than chance explains</h1>",
             "<p>Compared are fingerprints of tokens: names, comments and spaces do not count, and neither does what "
             "the stubs and the reference have. Rare fingerprints count more. A pair is shown when its "
             f"likeness is above {found.threshold:.1f}, far from what the pairs of this class usually have, or when the two "
             f"have more than {MOST_ALONE:.0%} of their rare fingerprints in common. Copies count as one work, so what "
             "a large group has in common is rare, too. It is a reason to read both, and proves nothing.</p>"]
    if not found.pairs:
        parts.append("<p>No pair shares unusually much.</p>")
    else:
        parts.append("<table><tr><th>pair</th><th>likeness</th><th>exercises</th></tr>")
        for number, pair in enumerate(found.pairs):
            parts.append(f'<tr><td><a href="#pair{number}">{_text(pair.first)} and {_text(pair.second)}</a></td>'
                         f"<td>{pair.likeness:.1f}</td><td>{_text(', '.join(pair.shared))}</td></tr>")
        parts.append("</table>")
    if found.references:
        parts += ["<h2>Copies of the reference, possibly renamed</h2>", "<ul>",
                  *(f"<li>{_text(name)}: {_text(exercise)}, {share} % of the work</li>"
                    for name, exercise, share in found.references), "</ul>"]
    parts += [_side_by_side(number, pair, found.works) for number, pair in enumerate(found.pairs)]
    return "\n".join(parts) + "\n</html>\n"


def _side_by_side(number: int, pair: Pair, works: dict[str, dict[str, Work]]) -> str:
    parts = [f'<h2 id="pair{number}">{_text(pair.first)} and {_text(pair.second)}</h2>']
    for exercise, shared in pair.shared.items():
        sides = "".join(f"<div><b>{_text(name)}</b><pre>{_marked(works[exercise][name], shared)}</pre></div>"
                        for name in (pair.first, pair.second))
        parts.append(f'<h3>{_text(exercise)}</h3><div class="side">{sides}</div>')
    return "\n".join(parts)


def _marked(work: Work, shared: set[int]) -> str:
    parts, at = [], 0
    for start, end in work.spans(shared):
        parts += [_text(work.source[at:start]), "<mark>", _text(work.source[start:end]), "</mark>"]
        at = end
    return "".join([*parts, _text(work.source[at:])])


def _text(text: str) -> str:
    return html.escape(clean(text))
