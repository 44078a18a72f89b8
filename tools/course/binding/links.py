"""Translates the links of a page to addresses in the site, and reports broken ones."""

import re
from pathlib import Path
from urllib.parse import quote, unquote

from binding.outline import between
from binding.reading import Draft
from binding.sizes import size_of
from files import course_files, new_files
from paths import ROOT

_ELSEWHERE = re.compile(r"^(?:https?|mailto):")
_PICTURES = (".png", ".svg", ".webp", ".jpg", ".gif")
_ATTRIBUTE = re.compile(r"""\b(src|srcset|href)=(["'])(.*?)\2""")


class Links:
    def __init__(self, drafts: list[Draft]):
        self._drafts = {draft.page.source: draft for draft in drafts}
        self._files = set(course_files())
        self._new = set(new_files())
        self.pictures: set[Path] = set()  # that the site needs
        self.sources: set[Path] = set()  # files of code that are shown as pages

    def link(self, draft: Draft, href: str, line: int) -> str:
        """Returns the address in the site; the unchanged link if it is broken."""
        if _ELSEWHERE.match(href):
            return href
        path, _, fragment = href.partition("#")
        target = self._source(draft, path)
        if target in self._drafts:
            there = self._drafts[target]
            if fragment and unquote(fragment) not in there.anchors:
                draft.wrong(line, f"the link {href!r} is broken: {target} has no heading #{fragment}")
            address = "" if there is draft and fragment else between(draft.page.target, there.page.target)
            return f"{address}#{fragment}" if fragment else address
        if target not in self._files:
            why = "git does not track it; git add it" if target in self._new else "there is no such page"
            draft.wrong(line, f"the link {href!r} is broken: {why}")
            return href
        if target.suffix in _PICTURES:
            self.pictures.add(target)
            return quote(between(draft.page.target, target))
        self.sources.add(target)
        return quote(between(draft.page.target, code_page(target))) + (f"#{fragment}" if fragment else "")

    def picture(self, draft: Draft, address: str, line: int) -> str:
        if _ELSEWHERE.match(address):
            draft.wrong(line, f"the picture {address!r} is on another machine")
            return address
        target = self._source(draft, address)
        if target not in self._files:
            why = "is not tracked by git; git add it" if target in self._new else "does not exist"
            draft.wrong(line, f"the picture {address!r} {why}")
            return address
        self.pictures.add(target)
        return quote(between(draft.page.target, target))

    def picture_size(self, draft: Draft, address: str) -> tuple[int, int] | None:
        target = self._source(draft, address)
        return size_of(ROOT / target) if target in self._files else None

    def in_html(self, draft: Draft, text: str, line: int) -> str:
        """Translates links and pictures in the HTML of a page."""
        def follow(found: re.Match) -> str:
            name, mark, value = found.groups()
            place = line + text.count("\n", 0, found.start())
            if name == "href":
                return f"{name}={mark}{self.link(draft, value, place)}{mark}"
            if name == "src":
                return f"{name}={mark}{self.picture(draft, value, place)}{mark}"
            parts = [part.split() for part in value.split(",")]
            new = ", ".join(" ".join([self.picture(draft, part[0], place), *part[1:]]) for part in parts if part)
            return f"{name}={mark}{new}{mark}"

        return _ATTRIBUTE.sub(follow, text)

    def _source(self, draft: Draft, path: str) -> Path | None:
        """Returns the source file in the course; a folder stands for its README.md."""
        if not path:
            return draft.page.source
        whole = (ROOT / draft.page.source).parent / unquote(path)
        whole = Path(*whole.parts[:1], *_normal(whole.parts[1:]))
        if path.startswith("/") or not whole.is_relative_to(ROOT):
            return None
        target = whole.relative_to(ROOT)
        return target / "README.md" if whole.is_dir() else target


def code_page(source: Path) -> Path:
    return source.with_name(f"{source.name}.html")


def _normal(parts: tuple[str, ...]) -> list[str]:
    kept: list[str] = []
    for part in parts:
        if part == "..":
            kept.pop()
        elif part != ".":
            kept.append(part)
    return kept
