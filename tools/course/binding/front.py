"""The book's first page: README's film, which runs if an engine is available, a sentence, and a card for each
chapter."""

import html
import io
import re
from pathlib import Path

from binding.live import LiveFigure, attributes
from binding.outline import FRONT, MANUAL, Page, between
from binding.sizes import size_of
from binding.typography import typeset
from binding.views import page_of_film
from films import films
from paths import ROOT

_FILM = Path("plots/film.webp")
_ROW = re.compile(r"^\| [0-9]{2} \| \[[^\]]+\]\((chapters/[^)]+)\) \| (.+) \|$", re.MULTILINE)  # of README's chapters
_ALT = re.compile(rf"!\[([^\]]+)\]\({_FILM}\)")
_SENTENCE = re.compile(r"^# .+\n\n((?:.|\n)+?\.)\s", re.MULTILINE)
_WIDTH = 360  # of a card's picture [pixels]
_SAYS = "The engine runs in this page: drag a cube to pull it."


def front(outline: list[Page], views: bool, live: bool) -> str:
    """Returns the body of the page; `outline` has the lessons."""
    text = MANUAL.text()
    lessons = {page.source: page for page in outline if page.group == "Chapters"}
    first = next(iter(lessons.values()))
    cards = "".join(_card(lessons[Path(source)], wanted) for source, wanted in _ROW.findall(text))
    sentence = " ".join(_SENTENCE.search(text)[1].split())
    return (f'<div class="front">\n<div class="hero">{_film(_ALT.search(text)[1], views, live)}<div><h1>{_set(FRONT.title)}'
            f'</h1><p>{_set(sentence)}</p><p><a class="begin" href="{_way(first)}">Begin</a> '
            f'<a href="{_way(MANUAL)}">The manual</a></p></div></div>\n<ol class="cards">{cards}</ol>\n</div>\n')


def stills(outline: list[Page]) -> dict[Path, bytes]:
    """Returns the pictures of the cards, by their places in the site."""
    return {_still(page): _middle(page) for page in outline if page.group == "Chapters" and _film_of(page).exists()}


def _still(page: Page) -> Path:
    return page.source.with_name("still.webp")


def _film_of(page: Page) -> Path:
    return ROOT / page.source.with_name("film.webp")


def _middle(page: Page) -> bytes:
    """Returns the middle picture of a lesson's film."""
    from PIL import Image  # comes with matplotlib

    content = io.BytesIO()
    with Image.open(_film_of(page)) as film:
        film.seek(film.n_frames // 2)
        film.convert("RGB").resize((_WIDTH, _WIDTH * film.height // film.width)).save(content, "WEBP", quality=70)
    return content.getvalue()


def _film(alt: str, views: bool, live: bool) -> str:
    width, height = size_of(ROOT / _FILM)
    image = f'<img src="{_FILM}" alt="{html.escape(alt)}" width="{width}" height="{height}" decoding="async">'
    if views:
        image = f'<a href="{page_of_film(MANUAL.source)}">{image}</a>'
    runs = attributes([(hero(), _SAYS)], "README") if live else ""
    return f'<figure class="film"{runs}>{image}</figure>'


def hero() -> LiveFigure:
    """Returns the first figure, without sliders and graph."""
    film = films()["README"]
    settings = dict(option.split("=") for option in film["options"] if "=" in option)
    return LiveFigure(film["scene"], settings)


def _card(page: Page, wanted: str) -> str:
    number, _, name = page.title.partition(" · ")
    image = ""
    if _film_of(page).exists():
        width, height = size_of(_film_of(page))
        image = (f'<img src="{_still(page).as_posix()}" alt="" width="{_WIDTH}" height="{_WIDTH * height // width}" '
                 'loading="lazy" decoding="async">')
    return (f'<li><a href="{_way(page)}">{image}<strong><span class="number">{number}</span> {_set(name)}</strong>'
            f"<span>{_set(wanted)}</span></a></li>")


def _way(page: Page) -> str:
    return between(FRONT.target, page.target)


def _set(text: str) -> str:
    return typeset(html.escape(text, quote=False), begins_a_line=True)
