"""Reads a page's Markdown: its tokens, and the places that other pages refer to."""

import re
from dataclasses import dataclass, field

from binding.formulas import Formula
from binding.outline import Page
from binding.problems import Problem

_TAG = re.compile(r"\\tag\{([^}]*)\}")
_ID = re.compile(r"""\b(?:id|name)=["']([^"']+)["']""")
_STUB = re.compile(r"^(### [0-9]+\.[0-9]+ (\w+)\n\n)`\2\.cpp`", re.MULTILINE)  # an exercise begins with its file's name
REFERENCE = re.compile(r"\(([0-9]{1,2}\.[0-9]{1,2}[a-z]?)\)")


@dataclass
class Section:
    level: int
    anchor: str
    title: str
    words: list[str] = field(default_factory=list)  # of its text, for the search


@dataclass
class Draft:
    page: Page
    tokens: list
    sections: list[Section] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)
    equations: dict[str, Formula] = field(default_factory=dict)  # by their tags, which the formulas leave out
    formulas: list[tuple[Formula, int]] = field(default_factory=list)  # with their lines
    problems: list[Problem] = field(default_factory=list)

    def wrong(self, line: int, what: str) -> None:
        self.problems.append(Problem(self.page.source, line, what))


def parser():
    """Returns a parser with GitHub's rules: CommonMark with tables, footnotes and formulas."""
    from markdown_it import MarkdownIt
    from mdit_py_plugins.dollarmath import dollarmath_plugin
    from mdit_py_plugins.footnote import footnote_plugin

    return (MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"])
            .use(dollarmath_plugin, allow_labels=False, allow_space=False, allow_digits=False).use(footnote_plugin))


def read(page: Page, added: dict[str, tuple[str, str]] | None = None) -> Draft:
    """Reads a page. `added` is Markdown to insert below headings, by their text, and before the next heading. With it,
    an exercise links to its file."""
    text = _STUB.sub(r"\1[`\2.cpp`](\2.cpp)", page.text()) if added else page.text()
    draft = Draft(page, _with(added or {}, parser().parse(text)))
    draft.sections.append(Section(1, "", page.title))
    heading = None
    for token in draft.tokens:
        line = line_of(token)
        if token.type == "heading_open":
            heading = token
        elif token.type == "inline":
            if heading:
                _begin_section(draft, heading, plain(token))
                heading = None
            else:
                draft.sections[-1].words.append(plain(token))
            for child, place in with_lines(token):
                if child.type == "math_inline":
                    draft.formulas.append((inline_formula(child), place))
        elif is_display(token):
            _add_equation(draft, token, line)
        elif token.type in ("fence", "code_block"):
            draft.sections[-1].words.append(token.content)
        elif token.type == "html_block":
            draft.sections[-1].words.append(re.sub(r"<[^>]*>", " ", token.content))
        if token.type == "html_block" or token.type == "inline":
            draft.anchors.update(_ID.findall(token.content))
    return draft


def _with(added: dict[str, tuple[str, str]], tokens: list) -> list:
    found, waiting = [], []
    for k, token in enumerate(tokens):
        if token.type == "heading_open":
            found += waiting
            waiting = []
        found.append(token)
        if token.type == "heading_close" and (texts := added.get(tokens[k - 1].content)):
            below, waiting = (_on_line(tokens[k - 1].map, parser().parse(text)) for text in texts)
            found += below
    return found + waiting


def _on_line(place: list, tokens: list) -> list:
    """Gives inserted tokens the line of their heading, for messages."""
    for token in tokens:
        token.map = place
    return tokens


def line_of(token) -> int:
    return token.map[0] + 1 if token.map else 1


def with_lines(inline):
    """Yields each child with its first line."""
    line = line_of(inline)
    for child in inline.children:
        yield child, line
        line += child.type in ("softbreak", "hardbreak") or child.content.count("\n")


def plain(inline) -> str:
    return "".join(" " if child.type == "softbreak" else child.content
                   for child in inline.children if child.type != "html_inline")


def is_display(token) -> bool:
    return token.type == "math_block" or token.type == "fence" and token.info.strip() == "math"


def display_formula(token) -> tuple[Formula, list[str]]:
    """Returns a formula without its tags, and the tags."""
    return Formula(_TAG.sub("", token.content).strip(), True), _TAG.findall(token.content)


def inline_formula(token) -> Formula:
    return Formula(token.content.strip("`"), False)


def _begin_section(draft: Draft, heading, title: str) -> None:
    anchor = slug = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
    count = 0
    while anchor in draft.anchors:
        count += 1
        anchor = f"{slug}-{count}"
    draft.anchors.add(anchor)
    heading.attrSet("id", anchor)
    draft.sections.append(Section(int(heading.tag[1:]), anchor, title))


def _add_equation(draft: Draft, token, line: int) -> None:
    formula, tags = display_formula(token)
    draft.formulas.append((formula, line))
    if len(tags) > 1:
        draft.wrong(line, f"one formula has {len(tags)} tags, ({') and ('.join(tags)}); give each equation its own formula")
    for tag in tags[:1]:
        if tag in draft.equations:
            draft.wrong(line, f"equation ({tag}) occurs twice; give it a new number")
        draft.equations[tag] = formula
        draft.anchors.add(anchor_of(tag))
        draft.sections[-1].words.append(f"({tag})")


def anchor_of(tag: str) -> str:
    return f"eq-{tag}"
