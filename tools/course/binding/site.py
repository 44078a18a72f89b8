"""Writes the site: every page and the files that it needs."""

import html
import json
import re
import shutil
from pathlib import Path
from string import Template

from binding.code import highlighted, language_of
from binding.exercises import exercises_of
from binding.folder import Folder
from binding.formulas import files, rendered
from binding.front import front, stills
from binding.glossary import linked, terms, with_anchors
from binding.links import Links, code_page
from binding.live import ENGINE, PAGE
from binding.outline import FRONT, Page, between, pages
from binding.problems import Problem
from binding.reading import Draft, read
from binding.typefaces import typefaces
from binding.views import pages_of_films
from binding.writing import Equations, written
from errors import CourseError
from page import engine_file, figure
from paths import ROOT

BOOK = ROOT / "tools" / "book"
_ASSETS = Path("assets")
_GLOSSARY = Path("chapters/SYMBOLS.md")
_STYLES_AND_SCRIPTS = ("book.css", "copying.js", "figures.js", "preview.js", "reading.js", "running.js",
                       "search.js")


def build(folder: Path, views: bool = False, engine: Path | None = None, mine: bool = False) -> int:
    """Writes the site into the folder, in place of an earlier one; how many pages it has. With `views`, films are links
    to pages that binding.views makes; with the engine as WebAssembly, figures run in their place; `mine` says that it has a
    student's functions in it."""
    drafts = [read(page, exercises_of(page.source)) for page in pages()]
    equations = _equations(drafts)
    links = Links(drafts)
    bodies = _with_terms(drafts, [written(draft, links, equations, views, engine is not None, mine)
                                 for draft in drafts])
    _refuse([problem for draft in drafts for problem in draft.problems])
    site = Folder(folder)
    template = Template((BOOK / "page.html").read_text(encoding="utf-8"))
    outline = [FRONT, *(draft.page for draft in drafts)]
    bodies.append(front(outline, views, engine is not None))
    _write(site.place(FRONT.target), _page(template, FRONT, bodies[-1], outline))
    for place, content in stills(outline).items():
        site.place(Path(place)).write_bytes(content)
    for draft, body in zip(drafts, bodies):
        _write(site.place(draft.page.target), _page(template, draft.page, body, outline, _contents(draft)))
    for source in sorted(links.sources):
        _write(site.place(code_page(source)), _code(template, source, outline))
    for picture in links.pictures:
        shutil.copyfile(ROOT / picture, site.place(picture))
    for name in _STYLES_AND_SCRIPTS:
        shutil.copyfile(BOOK / name, site.place(_ASSETS / name))
    for place, file in files().items():
        shutil.copyfile(file, site.place(Path(place)))
    if engine:
        _write(site.place(PAGE), figure())
        _write(site.place(ENGINE), engine_file(engine))
    for place in pages_of_films() if views else ():  # which binding.views writes
        site.place(place)
    _write_typefaces(site, "".join([*bodies, *(page.title + page.group for page in outline)]))
    _write(site.place(_ASSETS / "index.js"), _index(drafts))
    _write(site.place(Path(".nojekyll")), "")  # for hosts that would leave out files whose names begin with _
    site.finish()
    return len(drafts)


def _equations(drafts: list[Draft]) -> Equations:
    equations = Equations()
    for draft in drafts:
        for tag in draft.equations:
            if tag in equations.home:
                draft.wrong(1, f"equation ({tag}) is also in {equations.home[tag].page.source}")
            equations.home[tag] = draft
    results = rendered([formula for draft in drafts for formula, _ in draft.formulas])
    for draft in drafts:
        for formula, line in draft.formulas:
            equations.html[formula], error = results[formula]
            if error:
                draft.wrong(line, error)
    return equations


def _with_terms(drafts: list[Draft], bodies: list[str]) -> list[str]:
    """Links each term from its first use in a lesson to the glossary."""
    home = next(k for k, draft in enumerate(drafts) if draft.page.source == _GLOSSARY)
    glossary = terms(bodies[home])
    bodies[home] = with_anchors(bodies[home])
    for k, draft in enumerate(drafts):
        if chapter := re.match(r"chapters/([0-9]{2})_", draft.page.source.as_posix()):
            address = between(draft.page.target, drafts[home].page.target)
            bodies[k] = linked(bodies[k], int(chapter[1]), glossary, address)
    return bodies


def _refuse(problems: list[Problem]) -> None:
    if problems:
        count = f"{len(problems)} errors" if len(problems) > 1 else "one error"
        raise CourseError(f"book: {count} in its pages", "\n".join(map(str, sorted(problems))))


def _contents(draft: Draft) -> str:
    inside = [section for section in draft.sections if section.level == 2]
    contents = "".join(f'<li><a href="#{section.anchor}">{html.escape(section.title)}</a></li>' for section in inside)
    return f"<ol>{contents}</ol>" if contents else ""


def _page(template: Template, page: Page, body: str, outline: list[Page], contents: str = "") -> str:
    here = outline.index(page)
    return _filled(template, page.target, page.title, body, outline, contents=contents,
                   before=outline[here - 1] if here else None,
                   after=outline[here + 1] if here + 1 < len(outline) else None)


def _code(template: Template, source: Path, outline: list[Page]) -> str:
    """Writes the page of a file that another page links to."""
    text = (ROOT / source).read_text(encoding="utf-8", errors="replace")
    body = f"<h1><code>{html.escape(str(source))}</code></h1>\n{highlighted(text, language_of(source))}"
    return _filled(template, code_page(source), str(source), body, outline)


def _filled(template: Template, target: Path, title: str, body: str, outline: list[Page], contents: str = "",
            before: Page | None = None, after: Page | None = None) -> str:
    def step(page: Page | None, name: str, word: str) -> str:
        if page is None:
            return ""
        return (f'<a rel="{name}" class="{name}" href="{between(target, page.target)}"><span>{word}</span> '
                f"{html.escape(page.title)}</a>")

    root = between(target, Path("index.html")).removesuffix("index.html")
    return template.substitute(
        title=html.escape(title), root=root, body=body, contents=_sidebar(outline, target, contents),
        before=step(before, "prev", "Previous"), after=step(after, "next", "Next"))


def _sidebar(outline: list[Page], target: Path, contents: str) -> str:
    parts, group = [], None
    for page in outline:
        if page.group != group:
            parts.append(("</ul>" if parts else "") + (f"<h2>{page.group}</h2>" if page.group else "") + "<ul>")
            group = page.group
        here = page.target == target
        current = ' aria-current="page"' if here else ""
        number, dot, name = page.title.partition(" · ")
        label = f'<span class="number">{number}</span> {html.escape(name)}' if dot else html.escape(page.title)
        address = between(target, page.target)
        parts.append(f'<li><a href="{address}"{current}>{label}</a>{contents if here else ""}</li>')
    return "".join(parts) + "</ul>"


def _index(drafts: list[Draft]) -> str:
    """Writes the index of the search: each section with its words. It is a script, since a page may not read other
    files."""
    entries = [{"url": f"{draft.page.target.as_posix()}{f'#{section.anchor}' if section.anchor else ''}",
                "page": draft.page.title, "section": section.title, "text": " ".join(" ".join(section.words).split())}
               for draft in drafts for section in draft.sections]
    kept = [entry for entry in entries if entry["text"] or entry["section"] != entry["page"]]
    return f"window.bookIndex = {json.dumps(kept, ensure_ascii=False)};\n"


def _write_typefaces(site: Folder, text: str) -> None:
    for place, content in typefaces(html.unescape(text)).items():
        site.place(Path(place)).write_bytes(content)


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
