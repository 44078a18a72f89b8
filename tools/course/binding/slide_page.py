"""Slides as one self-contained HTML file, with styles, typefaces, pictures and formulas."""

import base64
import html
import re
from string import Template
from urllib.parse import unquote

from binding.deck import Slide, deck
from binding.formulas import rendered
from binding.links import Links
from binding.problems import Problem
from binding.reading import Draft
from binding.typefaces import typefaces
from binding.writing import Equations, pieces
from errors import CourseError
from manifest import Chapter
from needs import KATEX
from paths import ROOT

_BOOK = ROOT / "tools" / "book"
_KINDS = {".svg": "image/svg+xml", ".png": "image/png", ".webp": "image/webp", ".jpg": "image/jpeg", ".gif": "image/gif"}
_LINK = re.compile(r'<a\b([^>]*)>(.*?)</a>', re.DOTALL)
_SOURCE = re.compile(r'(<img\b[^>]*?\bsrc=")([^"]+)(")')
_FONT = re.compile(r"url\(\"?fonts/([\w-]+\.woff2)\"?\) format\(['\"]woff2['\"]\)(?:,url\([^)]*\) format\('\w+'\))*")


def slide_page(chapter: Chapter, drafts: list[Draft]) -> tuple[str, int]:
    """Returns the page and its number of slides. `drafts` are all pages as read; they are changed."""
    lesson = next(draft for draft in drafts if draft.page.source == chapter.exercises[0].lesson.relative_to(ROOT))
    equations = _equations(drafts, lesson)
    slides = deck(chapter, pieces(lesson, Links(drafts), equations))
    if lesson.problems:
        raise CourseError("slides: the lesson cannot be read", "\n".join(map(str, sorted(lesson.problems))))
    body = "".join(_section(slide, number) for number, slide in enumerate(slides, 1))
    body = body.replace(' loading="lazy"', "")  # what prints has all its pictures
    body = _SOURCE.sub(lambda found: found[1] + _embedded(lesson, found[2]) + found[3], _without_links(body))
    template = Template((_BOOK / "slides.html").read_text(encoding="utf-8"))
    letters = typefaces(html.unescape(body + chapter.title))
    style = _with_fonts((KATEX / "katex.min.css").read_text(encoding="utf-8"),
                        {font.name: font.read_bytes() for font in (KATEX / "fonts").glob("*.woff2")})
    own = _with_fonts((_BOOK / "slides.css").read_text(encoding="utf-8"),
                      {place.name: content for place, content in letters.items()})
    script = (_BOOK / "slides.js").read_text(encoding="utf-8")
    return template.substitute(title=html.escape(chapter.title), style=f"{style}\n{own}", script=script,
                               body=body), len(slides)


def _equations(drafts: list[Draft], lesson: Draft) -> Equations:
    """Numbers the equations of all pages, and sets those of the lesson."""
    equations = Equations({tag: draft for draft in drafts for tag in draft.equations})
    for formula, (text, error) in rendered([formula for formula, _ in lesson.formulas]).items():
        equations.html[formula] = text
        if error:
            lesson.problems.append(Problem(lesson.page.source, 1, error))
    return equations


def _section(slide: Slide, number: int) -> str:
    level = "h1" if slide.kind == "opening" else "h2"
    answer = f'<div class="answer">{slide.answer}</div>' if slide.answer else ""
    return (f'<section id="{number}"><div class="slide" data-number="{number}">'
            f"<{level}>{slide.title}</{level}>"
            f'<div class="body">{slide.body}{answer}</div></div><aside>{"".join(slide.notes)}</aside></section>\n')


def _without_links(text: str) -> str:
    """Replaces links to other pages by their words."""
    return _LINK.sub(lambda found: f'<span class="tag">{found[2]}</span>' if 'class="tag"' in found[1] else found[2], text)


def _embedded(lesson: Draft, address: str) -> str:
    file = (ROOT / lesson.page.source).parent / unquote(address)
    return _data(_KINDS[file.suffix], file.read_bytes())


def _with_fonts(style: str, fonts: dict[str, bytes]) -> str:
    return _FONT.sub(lambda found: f'url({_data("font/woff2", fonts[found[1]])}) format("woff2")', style)


def _data(kind: str, content: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"
