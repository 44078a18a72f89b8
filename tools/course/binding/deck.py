"""A lesson as slides, with its prose as the speaker's notes.

Each figure, equation and table is a slide, with the line that introduces it. Other sentences of the lesson are in the
notes of the slide that they explain. Each section that is a list is a slide.
"""

import html
import re
from dataclasses import dataclass, field

from binding.typography import typeset
from binding.writing import Piece
from manifest import Chapter
from predictions import predictions_of

_SHOWN = ("figure", "equation", "table", "quote")
_LISTS = {"What you will be able to do": "", "Questions": ""}  # sections of which the list is the slide
_LEFT_OUT = ("Check", "Further", "Predict before you code", "Exercises")
_LONGEST_LEAD = 240  # characters; of a longer paragraph the last sentence leads
_LONGEST_TABLE = 12  # rows
_RUN_IN = re.compile(r".*<strong>([^<]{3,60}?)[.:]</strong>", re.DOTALL)  # **Gather.**, the last of a paragraph
_BOLD = re.compile(r"<strong>([^<]{3,60})</strong>")
_SENTENCE = re.compile(r"(?<=[.?!])\s+(?=[A-Z])")
_COLON = re.compile(r":\s*</figcaption>")  # in a lesson a command follows, and on a slide nothing does


@dataclass
class Slide:
    title: str  # HTML, as all of it
    body: str = ""
    answer: str = ""  # shown by the next key
    notes: list[str] = field(default_factory=list)
    kind: str = ""


def deck(chapter: Chapter, pieces: list[Piece]) -> list[Slide]:
    sections = _sections(pieces)
    opening, first = sections[0]
    slides = [_opening(opening, first)]
    for title, parts in sections[1:]:
        if title == "Predict before you code":
            slides += _predictions(chapter)
        elif title == "Exercises":
            slides.append(_exercises(chapter, parts))
        elif title in _LISTS:
            slides.append(_listed(title, parts))
        elif title not in _LEFT_OUT:
            slides += _of_section(title, parts)
    return slides


def _sections(pieces: list[Piece]) -> list[tuple[str, list[Piece]]]:
    found: list[tuple[str, list[Piece]]] = []
    for piece in pieces:
        if piece.kind in ("h1", "h2"):
            found.append((piece.text, []))
        elif found:
            found[-1][1].append(piece)
    return found


def _opening(title: str, parts: list[Piece]) -> Slide:
    film = _COLON.sub(".</figcaption>", "".join(piece.html for piece in parts if piece.kind == "figure"))
    notes = [piece.html for piece in parts if piece.kind != "figure"]
    return Slide(typeset(html.escape(title)), film, notes=notes, kind="opening")


def _listed(title: str, parts: list[Piece]) -> Slide:
    return Slide(title, "".join(piece.html for piece in parts if piece.kind == "list"),
                 notes=[piece.html for piece in parts if piece.kind != "list"])


def _predictions(chapter: Chapter) -> list[Slide]:
    slides = []
    for each in predictions_of(chapter):
        choices = "".join(f"<li>{_text(text)}</li>" for text in each.choices.values())
        said = f"<p><strong>{_text(each.wanted())}</strong></p><p>{_text(each.why)}</p>"
        remarks = [f"<p>To those who say {_text(answer)}: {_text(text)}</p>" for answer, text in each.remarks.items()]
        slides.append(Slide("Predict", f"<p>{_text(each.question)}</p>" + (f'<ol type="a">{choices}</ol>' if choices else ""),
                            said, remarks, "question"))
    return slides


def _text(text: str) -> str:
    """Returns the words of a line of Markdown."""
    return typeset(html.escape(re.sub(r"[*`]", "", " ".join(text.split())), quote=False), True)


def _exercises(chapter: Chapter, parts: list[Piece]) -> Slide:
    rows = "".join(f"<tr><td>{one.id}</td><td><code>{one.function}</code></td></tr>" for one in chapter.exercises)
    return Slide("Exercises", f"<table>{rows}</table><p><code>./course watch {chapter.number}</code></p>",
                 notes=[piece.html for piece in parts])


def _of_section(title: str, parts: list[Piece]) -> list[Slide]:
    slides: list[Slide] = []
    waiting: list[Piece] = []  # what comes before the section's next slide
    heading, shown_before = title, False
    for piece in parts:
        if piece.kind in ("h3", "h4"):
            heading = piece.text
        elif piece.kind in _SHOWN and not _is_long(piece):
            if shown_before and piece.kind == "equation" and slides[-1].kind == "equation":
                slides[-1].body += piece.html
                continue
            slide = Slide(typeset(html.escape(heading)), kind=piece.kind)
            _lead_to(slide, waiting, piece, slides)
            slides.append(slide)
            waiting = []
        else:
            waiting.append(piece)
        shown_before = piece.kind in _SHOWN
    if not slides:  # of code and words alone
        code = "".join(piece.html for piece in waiting if piece.kind in ("code", "list"))
        points = "".join(f"<li>{_first_sentence(piece)}</li>" for piece in waiting if piece.kind == "paragraph")
        slides.append(Slide(title, code or f"<ul>{points}</ul>"))
    slides[-1].notes += [piece.html for piece in waiting]
    return slides


def _first_sentence(piece: Piece) -> str:
    sentence = _SENTENCE.split(piece.html.strip().removeprefix("<p>").removesuffix("</p>"))[0]
    if sentence.count("<") == 2 * sentence.count("</"):
        return sentence
    return typeset(html.escape(_SENTENCE.split(piece.text)[0], quote=False), True)  # it ends within emphasis


def _is_long(piece: Piece) -> bool:
    return piece.kind == "table" and piece.html.count("<tr") > _LONGEST_TABLE


def _lead_to(slide: Slide, waiting: list[Piece], shown: Piece, before: list[Slide]) -> None:
    """Moves the last paragraph to the equation or table that it introduces. Those before it explain the slide
    before."""
    *explaining, last = waiting if waiting else [None]
    leads = last is not None and last.kind == "paragraph" and shown.kind in ("equation", "table")
    if last is not None and not leads:
        explaining.append(last)
    to = before[-1] if before else slide
    to.notes += [piece.html for piece in explaining]
    slide.body = shown.html
    if leads:
        whole = last.html.strip().removeprefix("<p>").removesuffix("</p>")
        slide.title, lead = _titled(slide.title, whole)
        slide.body = f"<p>{lead}</p>" + slide.body
        if lead != whole:
            slide.notes.insert(0, last.html)


def _titled(title: str, text: str) -> tuple[str, str]:
    """Returns a paragraph's own title and its content, from that title on, without the end of an earlier sentence."""
    if run_in := _RUN_IN.search(text):
        title, text = run_in[1], text[run_in.end():].strip()
    elif bold := _BOLD.search(text):
        title = bold[1][:1].upper() + bold[1][1:]
    sentences = _SENTENCE.split(text)
    if len(sentences) > 1 and sentences[0][:1].islower():
        sentences = sentences[1:]
    whole = " ".join(sentences)
    return title, whole if len(re.sub(r"<[^>]*>", "", whole)) <= _LONGEST_LEAD else _last(sentences)


def _last(sentences: list[str]) -> str:
    """Returns the last sentence, with those before it if it ends a parenthesis that they begin."""
    for k in reversed(range(len(sentences))):
        last = " ".join(sentences[k:])
        text = re.sub(r"<[^>]*>", "", last)
        if text.count(")") <= text.count("("):
            return last
    return sentences[-1]
