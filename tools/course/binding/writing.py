"""Writes a page's tokens as HTML, with links translated, formulas set, code marked, and captions for pictures."""

import html
import re
from dataclasses import dataclass, field

from binding.code import code_in_text, highlighted
from binding.formulas import Formula
from binding.links import Links
from binding.live import LiveFigure, attributes, is_live, live_figure
from binding.outline import between
from binding.reading import (REFERENCE, Draft, anchor_of, display_formula, inline_formula, is_display, line_of, parser, plain,
                             with_lines)
from binding.typography import typeset
from binding.views import page_of_film

_CALLOUT = re.compile(r"^\[!(NOTE|TIP|IMPORTANT|WARNING|CAUTION)\]$")
_TAG = re.compile(r"(<!--.*?-->|<[^>]*>)", re.DOTALL)
_PICTURE = re.compile(r"^\s*<(?:picture|img)\b")


@dataclass
class Equations:
    """Equations of all pages, as they are typeset."""
    home: dict[str, Draft] = field(default_factory=dict)
    html: dict[Formula, str] = field(default_factory=dict)

    def of(self, tag: str) -> str:
        return self.html[self.home[tag].equations[tag]]


@dataclass(frozen=True)
class Piece:
    """A block of a page: a heading, a paragraph, a figure with its caption."""
    kind: str  # h1 to h4, paragraph, list, code, equation, figure, table, quote, or folded
    html: str
    text: str  # without marks
    tags: tuple[str, ...] = ()  # of an equation


def written(draft: Draft, links: Links, equations: Equations, views: bool = False, live: bool = False,
            mine: bool = False) -> str:
    return _Writer(draft, links, equations).page(views, live, mine)


def pieces(draft: Draft, links: Links, equations: Equations) -> list[Piece]:
    """Returns the page's blocks in order, typeset for the book."""
    return _Writer(draft, links, equations).pieces()


class _Writer:
    def __init__(self, draft: Draft, links: Links, equations: Equations):
        self._draft, self._links, self._equations = draft, links, equations
        self._pictures = 0
        self._live: list[LiveFigure] = []
        self._from_elsewhere: set[str] = set()  # tags of equations that are shown here, and stand on another page

    def page(self, views: bool, live: bool, mine: bool) -> str:
        self._set(views, live, mine)
        body = _rendered(self._draft.tokens)
        return body + "".join(f'<template id="preview-{tag}">{self._equations.of(tag)}</template>\n'
                              for tag in sorted(self._from_elsewhere))

    def pieces(self) -> list[Piece]:
        outlined = _blocks(self._draft.tokens)  # before the tokens become what they are set as
        self._set(views=False, live=False, mine=False)
        found: list[Piece] = []
        for kind, first, end, text, tags in outlined:
            part = _rendered(self._draft.tokens[first:end])
            if found and found[-1].kind == "figure" and "</figure>" not in found[-1].html:  # and this is its caption
                found[-1] = Piece("figure", found[-1].html + part, text)
            elif part.strip():
                found.append(Piece("figure" if part.startswith("<figure") else kind, part, text, tags))
        return found

    def _set(self, views: bool, live: bool, mine: bool) -> None:
        tokens = self._draft.tokens
        for k, token in enumerate(tokens):
            if token.type == "inline":
                token.children = list(self._inline(token))
            elif is_display(token):
                _become(token, self._equation(token))
            elif token.type in ("fence", "code_block"):
                _become(token, highlighted(token.content, token.info.strip()))
            elif token.type == "html_block" and is_live(token.content):
                self._take_live(token)
            elif token.type == "html_block":
                inside = self._links.in_html(self._draft, token.content, line_of(token))
                inside = self._references_in_html(inside, line_of(token))
                _become(token, f"<figure>{inside}</figure>" if _PICTURE.match(inside) else inside)
            elif token.type == "table_open":
                _become(token, '<div class="table" tabindex="0"><table>\n')
            elif token.type == "table_close":
                _become(token, "</table></div>\n")
            elif token.type == "blockquote_open":
                _mark_callout(token, tokens[k + 1:k + 3])
        target = self._draft.page.target
        running = [(figure, figure.says(mine)) for figure in self._live] if live else []
        folder = self._draft.page.source.parent.name
        _set_figures(tokens, between(target, page_of_film(self._draft.page.source)) if views else "",
                     attributes(running, folder) if running else "")

    def _take_live(self, token) -> None:
        try:
            self._live += [live_figure(f"<!--{text}") for text in token.content.split("<!--")[1:]]
        except ValueError as error:
            self._draft.wrong(line_of(token), str(error))
        _become(token, "")

    def _inline(self, inline):
        linked, begins = 0, True
        for child, line in with_lines(inline):
            if child.type == "link_open":
                linked += 1
                child.attrSet("href", self._links.link(self._draft, str(child.attrGet("href")), line))
            elif child.type == "link_close":
                linked -= 1
            elif child.type == "image":
                self._place_picture(child, line)
            elif child.type == "math_inline":
                _become(child, self._equations.html[inline_formula(child)], "html_inline")
            elif child.type == "html_inline":
                child.content = self._links.in_html(self._draft, child.content, line)
            elif child.type == "text":
                self._look_for_footnotes(child.content, line)
                text = typeset(html.escape(child.content, quote=False), begins)
                _become(child, text if linked else self._with_references(text, line), "html_inline")
            elif child.type == "code_inline":
                _become(child, code_in_text(child.content), "html_inline")
            begins = child.type == "softbreak"
            yield child

    def _place_picture(self, image, line: int) -> None:
        """Places a picture. The first is at the top of the page; later ones load when they come near."""
        source = str(image.attrGet("src"))
        image.attrSet("src", self._links.picture(self._draft, source, line))
        if size := self._links.picture_size(self._draft, source):
            image.attrSet("width", str(size[0]))
            image.attrSet("height", str(size[1]))
        if self._pictures:
            image.attrSet("loading", "lazy")
        image.attrSet("decoding", "async")
        self._pictures += 1

    def _look_for_footnotes(self, text: str, line: int) -> None:
        for name in re.findall(r"\[\^[^\]\s]+\]", text):
            self._draft.wrong(line, f"the footnote {name} does not exist")

    def _with_references(self, text: str, line: int) -> str:
        def follow(found: re.Match) -> str:
            tag = found[1]
            home = self._equations.home.get(tag)
            if home is None:
                self._draft.wrong(line, f"the reference ({tag}) is broken: no lesson has an equation ({tag})")
                return found[0]
            if home is not self._draft:
                self._from_elsewhere.add(tag)
            page = "" if home is self._draft else between(self._draft.page.target, home.page.target)
            return f'<a class="eqref" data-tag="{tag}" href="{page}#{anchor_of(tag)}">({tag})</a>'

        return REFERENCE.sub(follow, text)

    def _references_in_html(self, text: str, line: int) -> str:
        """Links references in text between HTML tags, such as <summary>."""
        parts = []
        for part in _TAG.split(text):
            parts.append(part if part.startswith("<") else self._with_references(typeset(part), line))
            line += part.count("\n")
        return "".join(parts)

    def _equation(self, token) -> str:
        formula, tags = display_formula(token)
        number = "".join(f'<a class="tag" href="#{anchor_of(tag)}" aria-label="equation {tag}">({tag})</a>'
                         for tag in tags[:1])
        place = f' id="{anchor_of(tags[0])}"' if tags else ""
        return (f'<div class="equation"{place}><div class="formula" tabindex="0">{self._equations.html[formula]}</div>'
                f"{number}</div>\n")


def _rendered(tokens: list) -> str:
    return parser().renderer.render(tokens, parser().options, {})


_KINDS = {"bullet_list_open": "list", "ordered_list_open": "list", "table_open": "table", "blockquote_open": "quote",
          "paragraph_open": "paragraph"}


def _blocks(tokens: list) -> list[tuple[str, int, int, str, tuple[str, ...]]]:
    """Yields for each top-level block its kind, its first token and the one after its last, its text, and its
    equation's tags."""
    found: list[tuple[str, int, int, str, tuple[str, ...]]] = []
    k = 0
    while k < len(tokens):
        first, depth = k, tokens[k].nesting
        k += 1
        while depth > 0:
            depth += tokens[k].nesting
            k += 1
        kind = _KINDS.get(tokens[first].type, tokens[first].tag if tokens[first].type == "heading_open" else "code")
        if is_display(tokens[first]):
            kind = "equation"
        elif tokens[first].type == "html_block":
            kind = "html"
            if tokens[first].content.startswith("<details"):
                kind = "folded"
                while "</details>" not in tokens[k - 1].content:
                    k += 1
        text = " ".join(plain(token) for token in tokens[first:k] if token.type == "inline")
        tags = tuple(display_formula(tokens[first])[1]) if kind == "equation" else ()
        found.append((kind, first, k, text, tags))
    return found


def _become(token, content: str, kind: str = "html_block") -> None:
    token.type, token.content, token.tag, token.nesting, token.children = kind, content, "", 0, None


def _mark_callout(quote, following: list) -> None:
    """Marks GitHub's callouts, such as > [!NOTE]."""
    inline = following[-1]
    first = inline.children[0] if inline.type == "inline" and inline.children else None
    found = _CALLOUT.match(first.content) if first is not None and first.type == "text" else None
    if found:
        quote.attrSet("class", f"callout {found[1].lower()}")
        _become(first, f'<strong class="title">{found[1].capitalize()}</strong>', "html_inline")


def _set_figures(tokens: list, view: str, live: str) -> None:
    """Joins a picture with the emphasised paragraph below it, its caption. A film links to its view, if there is one,
    and has the attributes of the figure that runs in its place. Other pictures link to their full size."""
    for k, token in enumerate(tokens):
        if token.type == "paragraph_open" and _is_picture(tokens[k + 1]):
            address = str(tokens[k + 1].children[0].attrGet("src"))
            film = address.endswith("film.webp")
            link = view if film else address
            _become(token, f'<figure class="{"film" if film else "picture"}"{live if film else ""}>' + (f'<a href="{link}">' if link else ""))
            _become(tokens[k + 2], f"{'</a>' if link else ''}</figure>\n")
            _set_caption(tokens, k + 2)
        elif token.type == "html_block" and token.content.startswith("<figure>"):
            _set_caption(tokens, k)


def _set_caption(tokens: list, end: int) -> None:
    """Moves the caption that follows into the figure that ends here."""
    below = tokens[end + 1:end + 4]
    if len(below) == 3 and below[0].type == "paragraph_open" and _is_emphasised(below[1]):
        tokens[end].content = tokens[end].content.rsplit("</figure>", 1)[0]
        below[1].children = below[1].children[1:-1]
        _become(below[0], "<figcaption>")
        _become(below[2], "</figcaption></figure>\n")


def _is_picture(inline) -> bool:
    return bool(inline.children) and [child.type for child in inline.children] == ["image"]


def _is_emphasised(inline) -> bool:
    kinds = [child.type for child in inline.children]
    return (len(kinds) > 2 and kinds[0] == "em_open" and kinds[-1] == "em_close" and kinds.count("em_open") == 1
            and kinds.count("em_close") == 1)
