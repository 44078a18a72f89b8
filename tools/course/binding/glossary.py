"""The terms of SYMBOLS.md, and links to them from their first use in each lesson."""

import re
from dataclasses import dataclass

_ENTRY = re.compile(r"<li><strong>([^<]*)</strong>(?: \(([0-9, ]+)\))?:?(.*?)</li>", re.DOTALL)
_OTHER_NAME = re.compile(r"<em>([^<]*)</em>")
_PIECE = re.compile(r"(<!--.*?-->|<[^>]*>)", re.DOTALL)
_NAME_OF_TAG = re.compile(r"<(/?)([a-z][a-z0-9]*)")
_BETWEEN = re.compile(r"[\s-]+")
_HEADING = 'id="terms"'
_NO_LINKS = {"a", "h1", "h2", "h3", "h4", "code", "pre", "svg", "summary"}


@dataclass(frozen=True)
class Term:
    name: str
    anchor: str  # of its entry
    chapter: int  # in which it enters; 0: none
    entry: str  # as HTML

    def is_linked_in(self, chapter: int) -> bool:
        """Tells whether a term is linked in a chapter. Before its own chapter, a single word may have its everyday
        meaning."""
        return chapter >= self.chapter or " " in _plain(self.name)


def terms(page: str) -> list[Term]:
    """Returns all names of the entries below "Terms"; `page` is SYMBOLS.md as HTML."""
    found = []
    for entry in _ENTRY.finditer(page, page.index(_HEADING)):
        names = entry[1].split(", ")
        chapters = [int(chapter) for chapter in (entry[2] or "0").split(", ")]
        chapters += chapters[-1:] * (len(names) - len(chapters))
        others = [(name, chapters[0]) for name in _OTHER_NAME.findall(entry[3])]
        text = entry[0].removeprefix("<li>").removesuffix("</li>")
        found += [Term(name, _anchor(names[0]), chapter, text) for name, chapter in [*zip(names, chapters), *others]]
    return found


def with_anchors(page: str) -> str:
    """Adds an anchor to each entry of the glossary."""
    before, heading, after = page.partition(_HEADING)
    return before + heading + _ENTRY.sub(
        lambda entry: entry[0].replace("<li>", f'<li id="{_anchor(entry[1].split(", ")[0])}">', 1), after)


def linked(page: str, chapter: int, glossary: list[Term], address: str) -> str:
    """Links the first use of each term in a lesson to the glossary at `address`, and appends the entries to show beside
    the links."""
    left = {_plain(term.name): term for term in glossary if term.is_linked_in(chapter)}
    names = "|".join(name.replace(" ", _BETWEEN.pattern) for name in sorted(left, key=len, reverse=True))
    use = re.compile(rf"(?<![\w-])({names})(?:s|es)?(?![\w-])", re.IGNORECASE)
    used: dict[str, str] = {}

    def link(found: re.Match) -> str:
        term = left.pop(_plain(found[1]), None)
        if term is None:
            return found[0]
        used[term.anchor] = term.entry
        return f'<a class="term" data-tag="{term.anchor}" href="{address}#{term.anchor}">{found[0]}</a>'

    parts, inside, depth = [], "", 0
    for part in _PIECE.split(page):
        if tag := _NAME_OF_TAG.match(part):
            if inside == tag[2]:
                depth += -1 if tag[1] else 1
                inside = inside if depth else ""
            elif not inside and (tag[2] in _NO_LINKS or 'class="katex' in part):
                inside, depth = tag[2], 1
        parts.append(part if tag or inside else use.sub(link, part))
    return "".join(parts) + "".join(f'<template id="preview-{anchor}">{entry}</template>\n'
                                    for anchor, entry in sorted(used.items()))


def _plain(name: str) -> str:
    return _BETWEEN.sub(" ", name.lower())


def _anchor(name: str) -> str:
    return "term-" + _plain(name).replace(" ", "-")
