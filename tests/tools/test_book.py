"""./course book: the content of the site, and refused pages."""

import html
import re
import shutil
import subprocess
import tempfile
import unittest
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from sandbox import ROOT, Sandbox, all_exercises, our_files

from binding.code import code_in_text, highlighted
from binding.glossary import linked, terms, with_anchors
from binding.typography import typeset
from needs import BOOK_NEEDS

LESSON = "chapters/01_leapfrog/README.md"
TAG = re.compile(r"\\tag\{([0-9.]+[a-z]?)\}")


def bound(add_cleanup: Callable) -> Sandbox:
    """Makes a sandbox; skips its tests where the book cannot be made."""
    missing = [need.package for need in BOOK_NEEDS if not need.there()]
    if missing:
        raise unittest.SkipTest(f"no book: {', '.join(missing)} not installed")
    box = Sandbox()
    add_cleanup(box.close)
    return box


class Site(HTMLParser):
    """One page: its links, its anchors, and its text without code, formulas and links."""

    _VOID = {"meta", "link", "img", "input", "br", "hr", "source"}
    _QUIET = {"code", "pre", "a", "script", "template", "title"}

    def __init__(self, page: Path):
        super().__init__()
        self.addresses: list[str] = []
        self.ids: set[str] = set()
        self.text, self._quiet = "", []
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.addresses += [found[name] for name in ("href", "src") if found.get(name)]
        self.addresses += [part.split()[0] for part in found.get("srcset", "").split(",") if part]
        if "id" in found:
            self.ids.add(found["id"])
        if tag not in self._VOID and (self._quiet or tag in self._QUIET or found.get("class") == "formula"):
            self._quiet.append(tag)

    def handle_endtag(self, tag):
        if self._quiet and tag not in self._VOID:
            self._quiet.pop()

    def handle_data(self, data):
        self.text += "" if self._quiet else data


class Book(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        box = bound(cls.addClassCleanup)
        cls.result = box.course("book", "--films")
        cls.folder = box.root / "build" / "book"
        cls.pages = {page: Site(page) for page in sorted(cls.folder.rglob("*.html"))}

    def test_it_is_made(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.assertIn("build/book/index.html", self.result.stdout)

    def test_every_page_of_the_course_is_in_it(self):
        sources = [name for name in our_files() if name.suffix == ".md" and name.name not in ("hints.md", "try.md")]
        self.assertGreater(len(sources), 15)
        for name in sources:
            stem = "manual" if name == Path("README.md") else "index" if name.name == "README.md" else name.stem
            self.assertIn(self.folder / name.with_name(f"{stem}.html"), self.pages)

    def test_it_begins_with_a_picture_a_sentence_and_the_chapters(self):
        text = (self.folder / "index.html").read_text(encoding="utf-8").partition("<article>")[2]
        self.assertLess(text.index("plots/film.webp"), text.index("<h1>"))
        self.assertIn("<p>In this course you write a rigid-body physics engine in C++, one idea at a time.</p>", text)
        self.assertIn('<a class="begin" href="chapters/01_leapfrog/index.html">Begin</a>', text)
        self.assertIn('<a href="manual.html">', text)
        cards = re.findall(r'<li><a href="([^"]+)"><img src="([^"]+)"', text)
        lessons = sorted(path.parent.name for path in ROOT.glob("chapters/[0-9][0-9]_*/README.md"))
        self.assertEqual([page for page, _ in cards], [f"chapters/{name}/index.html" for name in lessons])
        self.assertLess(sum((self.folder / still).stat().st_size for _, still in cards), 150_000)

    def test_every_link_leads_somewhere(self):
        count = 0
        for page, content in self.pages.items():
            for address in content.addresses:
                if address.startswith(("https:", "http:", "mailto:", "data:")):
                    continue
                count += 1
                path, _, fragment = address.partition("#")
                target = (page.parent / unquote(path)).resolve() if path else page
                self.assertTrue(target.is_file(), f"{page}: {address}")
                if fragment:
                    self.assertIn(unquote(fragment), self.pages[target].ids, f"{page}: {address}")
        self.assertGreater(count, 1000)

    def test_every_equation_has_its_place_and_every_reference_its_link(self):
        for lesson in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md")):
            page = self.pages[self.folder / lesson.relative_to(ROOT).with_name("index.html")]
            tags = TAG.findall(lesson.read_text(encoding="utf-8"))
            self.assertTrue(tags)
            for tag in tags:
                self.assertIn(f"eq-{tag}", page.ids)
        for page, content in self.pages.items():
            self.assertEqual(re.findall(r"\([0-9]+\.[0-9]+[a-z]?\)", content.text), [], page)

    def test_pictures_keep_their_place_and_wait(self):
        text = (self.folder / "plots/index.html").read_text(encoding="utf-8")
        first, *others = re.findall(r"<img\b[^>]*>", text)
        self.assertGreater(len(others), 10)
        self.assertNotIn("loading=", first)
        for image in others:
            self.assertIn('loading="lazy"', image)
        for page in self.pages:
            text = page.read_text(encoding="utf-8")
            for image in re.findall(r'<img\b[^>]*src="[^"]+\.(?:png|svg|webp)"[^>]*>', text):
                self.assertRegex(image, r'width="[0-9]+" height="[0-9]+"', page)

    def test_fonts_are_small_and_do_not_hold_up_the_text(self):
        fonts = [file for file in (self.folder / "assets/fonts").iterdir()]
        self.assertEqual({file.suffix for file in fonts}, {".woff2"})
        self.assertLess(sum(file.stat().st_size for file in fonts), 150_000)
        faces = re.findall(r"@font-face \{[^}]*\}", (self.folder / "assets/book.css").read_text(encoding="utf-8"))
        self.assertEqual(len(faces), len(fonts))
        for face in faces:
            self.assertIn("font-display: swap", face)

    def test_an_exercise_shows_its_declaration_its_hints_and_its_tests(self):
        for exercise in all_exercises():
            text = (self.folder / "chapters" / exercise.folder / "index.html").read_text(encoding="utf-8")
            text = text.replace("\u00a0", " ")
            part = re.split(r"<h[23]", text.partition(f"{exercise.label}</h3>")[2])[0]
            shown = html.unescape(re.sub(r"<[^>]*>", "", part))
            header = next((ROOT / "chapters" / exercise.folder).glob("*.hpp")).read_text(encoding="utf-8")
            comment = re.search(rf"^/// Exercise {re.escape(exercise.id)}\. (\w+)", header, re.MULTILINE)
            self.assertRegex(part, rf"^\s*<p>(?:<a [^>]*>)?{comment[1]}\b")
            self.assertIn(f"{exercise.function}(", shown)
            self.assertIn(f"Hint {len(exercise.hints)} of {len(exercise.hints)}", shown)
            folded = part.partition("<summary>Tests</summary>")[2].partition("</details>")[0]
            self.assertGreater(len(re.findall(r"<code>[A-Z]\w+</code>", folded)), 1, exercise.label)

    def test_an_exercise_links_to_its_stub(self):
        for exercise in all_exercises():
            folder, file = self.folder / "chapters" / exercise.folder, exercise.file.name
            text = (folder / "index.html").read_text(encoding="utf-8")
            part = re.split(r"<h[23]", text.partition(f'id="{exercise.id.replace(".", "")}-{exercise.function}"')[2])[0]
            self.assertIn(f'<a href="{file}.html"><code>{file}</code></a>', part, exercise.label)
            self.assertIn(exercise.function, (folder / f"{file}.html").read_text(encoding="utf-8"))

    def test_the_first_text_waits_for_no_script(self):
        for page in self.pages:
            head, _, text = page.read_text(encoding="utf-8").partition("<article>")
            for script in re.findall(r"<script\b[^>]*\bsrc=[^>]*>", head):
                self.assertIn(" defer ", script, page)
            self.assertNotIn("<script", text, page)

    def test_an_equation_of_another_page_is_brought_along(self):
        text = (self.folder / "chapters/04_gauss_seidel/index.html").read_text(encoding="utf-8")
        self.assertIn('href="../03_single_contact/index.html#eq-3.7"', text)
        self.assertIn('<template id="preview-3.7"><span class="katex-display">', text)
        self.assertNotIn('<template id="preview-4.2">', text)

    def test_terms_of_the_glossary(self):
        text = (self.folder / "chapters/04_gauss_seidel/index.html").read_text(encoding="utf-8")
        self.assertEqual(text.count('href="../SYMBOLS.html#term-residual"'), 1)
        self.assertIn('<template id="preview-term-residual"><strong>residual</strong>', text)
        self.assertIn("term-residual", self.pages[self.folder / "chapters/SYMBOLS.html"].ids)

    def test_one_page_leads_to_the_next(self):
        page, seen = self.folder / "index.html", []
        while page:
            seen.append(page)
            found = re.search(r'class="next" href="([^"]+)"', page.read_text(encoding="utf-8"))
            page = (page.parent / found[1]).resolve() if found else None
        self.assertEqual(len(seen), len(set(seen)))
        sources = (".hpp.html", ".cpp.html", ".py.html", ".pyi.html", ".cff.html", "LICENSE.html", "LICENSE-TEXT.html")
        self.assertEqual(set(seen), {page for page in self.pages if not page.name.endswith(sources)})

    def test_nothing_comes_from_the_network(self):
        for page in self.pages:
            for tag in re.findall(r"<(?:script|link|img|source)\b[^>]*>", page.read_text(encoding="utf-8")):
                self.assertNotRegex(tag, r"""["' ](?:https?:)?//""", page)
        for file in [*self.folder.rglob("*.css"), *(self.folder / "assets").glob("*.js")]:
            if file.name != "index.js":
                self.assertNotRegex(file.read_text(encoding="utf-8"), r"""https?://|\bfetch\(|XMLHttpRequest""", file)


class AnotherFolder(unittest.TestCase):
    """The other files in the folder of a book that is made again."""

    @classmethod
    def setUpClass(cls):
        cls.box = bound(cls.addClassCleanup)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="book-")
        self.addCleanup(scratch.cleanup)
        self.site = Path(scratch.name, "site")

    def make(self) -> subprocess.CompletedProcess:
        return self.box.course("book", "--films", "--out", str(self.site))

    def made(self) -> set[str]:
        done = self.make()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {path.relative_to(self.site).as_posix() for path in self.site.rglob("*") if path.is_file()}

    def test_only_files_of_the_last_book_are_removed(self):
        first = self.made()
        kept = {".git/config": "[core]", "CNAME": "example.org", "syllabus.txt": "Monday", "old/mine.html": "mine"}
        for name, text in kept.items():
            (self.site / name).parent.mkdir(exist_ok=True)
            (self.site / name).write_text(text)
        for name in ("old/page.html", "gone/page.html"):  # of an older book
            (self.site / name).parent.mkdir(exist_ok=True)
            (self.site / name).write_text("an older page")
            with open(self.site / "assets" / "files.txt", "a", encoding="utf-8") as out:
                out.write(f"{name}\n")
        self.assertEqual(self.made(), first | set(kept))
        self.assertEqual({name: (self.site / name).read_text() for name in kept}, kept)
        self.assertFalse((self.site / "gone").exists())
        listed = (self.site / "assets" / "files.txt").read_text(encoding="utf-8").split()
        self.assertEqual(set(listed) | {"assets/files.txt"}, first)

    def test_an_interrupted_book_is_replaced(self):
        (self.site / "assets").mkdir(parents=True)
        (self.site / "assets" / "files.txt").write_text("index.html\nhalf.html\n")
        for name in ("index.html", "half.html"):
            (self.site / name).write_text("half a page")
        names = self.made()
        self.assertNotIn("half.html", names)
        self.assertNotIn("half a page", (self.site / "index.html").read_text(encoding="utf-8"))

    def test_a_book_without_a_list_loses_nothing(self):
        (self.site / "assets").mkdir(parents=True)
        for name in ("assets/index.js", "index.html", "CNAME"):
            (self.site / name).write_text("old")
        self.assertIn("CNAME", self.made())
        self.assertNotEqual((self.site / "index.html").read_text(encoding="utf-8"), "old")

    def test_somebody_elses_file_in_the_place_of_a_page_is_named(self):
        (self.site / "assets").mkdir(parents=True)
        (self.site / "assets" / "files.txt").write_text("")
        (self.site / "manual.html").write_text("mine")
        done = self.make()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("manual.html", done.stderr)
        self.assertEqual((self.site / "manual.html").read_text(), "mine")

    def test_untracked_pages_are_left_out_and_named(self):
        pages = ("exam/exam.md", "submissions/ann/README.md")
        for name in pages:
            (self.box.root / name).parent.mkdir(parents=True)
            (self.box.root / name).write_text("# Secret\n")
            self.addCleanup(shutil.rmtree, self.box.root / name.partition("/")[0])
        done = self.make()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 untracked file was left out: exam/exam.md (git add FILE takes one in)\n", done.stdout)
        self.assertEqual([path for path in self.site.rglob("*.html") if "Secret" in path.read_text(encoding="utf-8")], [])


class Text(unittest.TestCase):
    """Text as typed, and as typeset; ~ is a space at which no line breaks."""

    def test_typing(self):
        for typed, expected in {
                "x_n and ω_c, hω_k, S_kk, λ_1": "x<sub>n</sub> and ω<sub>c</sub>, hω<sub>k</sub>, S<sub>kk</sub>, "
                                                "λ<sub>1</sub>",
                "half_step, max_sweeps": "half_step, max_sweeps",
                "2^l of N^(5/3)": "2<sup>l</sup> of N<sup>5/3</sup>",
                "from -1 to n-1, (-q), 2 - d": "from −1 to n−1, (−q), 2~−~d",
                "first-order, UTF-8, 1e-9": "first-order, UTF-8, 1e−9",
                "the body's u' and bodies' \"own\"": "the body’s u′ and bodies’ “own”",
                "u_t', S' + k'": "u<sub>t</sub>′, S′ + k′",
                "for h = 1/60 and d &gt; 3": "for h~=~1/60 and d~&gt;~3",
                "5 N s in 3 per cent of chapter 09": "5~N~s in 3~per cent of chapter~09",
        }.items():
            self.assertEqual(typeset(typed).replace("\u00a0", "~"), expected)

    def test_a_hyphen_after_code_stays_one(self):
        self.assertEqual((typeset("-axis"), typeset("-a", begins_a_line=True)), ("-axis", "−a"))

    def test_an_option_stays_in_one_piece(self):
        self.assertEqual(code_in_text("--views"), '<code class="whole">--views</code>')
        self.assertEqual(code_in_text("./course run a --plot energy"),
                         '<code>./course run a <span class="whole">--plot</span> energy</code>')
        for line in ("./course run a --set b=2 --iterations 9", "./course run a --iterations 9"):
            self.assertIn('<span class="whole">--iterations</span>', highlighted(line, ""))


class Glossary(unittest.TestCase):
    """The first use of a term in each lesson is a link, and its entry is beside the link."""

    PAGE = ('<ul><li><strong>W</strong> (03): a letter.</li></ul><h2 id="terms">Terms</h2><ul>'
            "<li><strong>active set</strong> (04): rows at a bound.</li>\n"
            "<li><strong>stick, slide</strong> (05): without slip, and with it. Also: <em>roll</em>.</li>\n"
            "<li><strong>round-off</strong>: an error.</li></ul>")

    def linked(self, lesson: str, chapter: int = 5) -> str:
        return linked(lesson, chapter, terms(self.PAGE), "../SYMBOLS.html")

    def test_names_and_chapters(self):
        self.assertEqual([(term.name, term.anchor, term.chapter) for term in terms(self.PAGE)],
                         [("active set", "term-active-set", 4), ("stick", "term-stick", 5), ("slide", "term-stick", 5),
                          ("roll", "term-stick", 5), ("round-off", "term-round-off", 0)])
        self.assertEqual(re.findall(r'<li id="([^"]+)">', with_anchors(self.PAGE)),
                         ["term-active-set", "term-stick", "term-round-off"])

    def test_the_first_use_is_a_link(self):
        said = self.linked("<p>An active\nset. An active set. It sticks.</p>")
        self.assertIn('<a class="term" data-tag="term-active-set" href="../SYMBOLS.html#term-active-set">active\nset</a>',
                      said)
        self.assertEqual(re.findall(r"<a [^>]*>([^<]*)</a>", said), ["active\nset", "sticks"])
        self.assertEqual(re.findall(r'<template id="preview-([^"]+)">', said), ["term-active-set", "term-stick"])

    def test_words_in_headings_links_code_and_formulas_stay(self):
        for quiet in ("<h2>Round-off</h2>", '<a href="x">round-off</a>', "<pre><code>round-off</code></pre>",
                      '<span class="katex"><span>round-off</span> round-off</span>', "a round-offer"):
            self.assertEqual(re.findall(r"<a class[^>]*>([^<]*)</a>", self.linked(quiet + "<p>Round-off</p>")),
                             ["Round-off"], quiet)

    def test_a_single_word_has_its_everyday_meaning_before_its_chapter(self):
        self.assertEqual(re.findall(r"<a [^>]*>([^<]*)</a>", self.linked("<p>Slide an active set.</p>", 1)),
                         ["active set"])


class Markdown(unittest.TestCase):
    """Markdown as GitHub shows it."""

    PAGE = r"""# A page

Inline $\lambda_k \le h$ and a price of 5 and 6 $. Code `a $x$ b`. See (1.3), `(1.3)`, [Kick](../01_leapfrog/README.md).
A remark[^why], and [further down](#with-code-c).

[^why]: Because of *this*.

$$
E = mc^2 \tag{99.1}
$$

<details>
<summary>Derivation of (99.1), by (3.7)</summary>

Inside, **Markdown** and (99.1).

```math
x = \frac{1}{2} \tag{99.2}
```

</details>

<picture>
  <source media="(prefers-color-scheme: dark)" srcset="../01_leapfrog/film.webp">
  <img alt="two" src="../01_leapfrog/film.webp">
</picture>

*Its caption, with `code`.*

> [!NOTE]
> Mind this.

## With code: `c++`

| a | b |
|---|---|
| `x` | (99.2) |

```cpp
int main() {}  // comment
```
"""

    @classmethod
    def setUpClass(cls):
        box = bound(cls.addClassCleanup)
        (box.root / "chapters" / "98_more").mkdir()
        (box.root / "chapters" / "98_more" / "README.md").write_text(cls.PAGE, encoding="utf-8")
        subprocess.run(["git", "-C", str(box.root), "add", "chapters/98_more"], check=True)
        result = box.course("book", "--films")
        if result.returncode:
            raise AssertionError(result.stderr)
        cls.html = (box.root / "build/book/chapters/98_more/index.html").read_text(encoding="utf-8")

    def test_all_of_it(self):
        for part in ('<span class="katex">', "6 $. Code <code class=\"whole\">a $x$ b</code>", "<code>(1.3)</code>",
                     '<a class="eqref" data-tag="1.3" href="../01_leapfrog/index.html#eq-1.3">(1.3)</a>',
                     '<a href="../01_leapfrog/index.html">Kick</a>', '<div class="equation" id="eq-99.1">',
                     '<a class="tag" href="#eq-99.2"',
                     '<summary>Derivation of <a class="eqref" data-tag="99.1" href="#eq-99.1">(99.1)</a>, by '
                     '<a class="eqref" data-tag="3.7" href="../03_single_contact/index.html#eq-3.7">(3.7)</a>',
                     "<strong>Markdown</strong>",
                     '<a class="eqref" data-tag="99.1" href="#eq-99.1">(99.1)</a>', "Because of <em>this</em>.",
                     'srcset="../01_leapfrog/film.webp"',
                     "<figcaption>Its caption, with <code>code</code>.</figcaption></figure>",
                     '<blockquote class="callout note">', '<strong class="title">Note</strong>',
                     '<h2 id="with-code-c">With code: <code>c++</code></h2>', '<span class="kt">int</span>',
                     '<div class="table" tabindex="0"><table>'):
            self.assertIn(part, self.html)
        self.assertNotIn("[^why]", self.html)
        self.assertNotIn("tag{", re.sub(r"<annotation.*?</annotation>", "", self.html))


class Refused(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = bound(cls.addClassCleanup)

    def refused(self, *planted: tuple[str, str]) -> None:
        """Expects that each piece of text, at the end of a lesson, is reported with its line."""
        lesson = self.box.root / LESSON
        before = lesson.read_text(encoding="utf-8")
        text, wanted = before, []
        for piece, told in planted:
            line = text.count("\n") + 2 + piece[:piece.index("@")].count("\n")
            wanted.append((line, told))
            text += "\n" + piece.replace("@", "") + "\n"
        lesson.write_text(text, encoding="utf-8")
        try:
            result = self.box.course("book", "--films")
        finally:
            lesson.write_text(before, encoding="utf-8")
        self.assertEqual((result.returncode, result.stdout), (1, ""), result.stderr)
        *found, last = result.stderr.splitlines()
        self.assertRegex(last, r"^course: book: .* in its pages$")
        self.assertEqual(len(found), len(wanted), result.stderr)
        for (line, told), said in zip(wanted, found):
            self.assertTrue(said.startswith(f"{LESSON}:{line}: "), said)
            self.assertIn(told, said)

    def test_what_leads_nowhere(self):  # an @ marks the line that is to be named
        self.refused(("A [link@](nowhere.md) in text.", "'nowhere.md'"),
                     ("Two lines,\nand an [anchor@](../02_quaternions/README.md#nowhere).", "no heading #nowhere"),
                     ("An [anchor@](#nowhere) of its own.", "no heading #nowhere"),
                     ("[Up@](../../../elsewhere.md)", "elsewhere.md"),
                     ("[Root@](/etc/passwd)", "/etc/passwd"),
                     ("An equation,\n\nEq. @(1.99).", "no lesson has an equation (1.99)"),
                     ("![no picture@](nowhere.png)", "'nowhere.png' does not exist"),
                     ("![network@](https://example.org/x.png)", "on another machine"),
                     ("<details>\n<summary>x</summary>\n<img alt='x@' src='gone.svg'>\n</details>", "'gone.svg'"),
                     ("<details>\n<summary>Where @(1.98) comes from</summary>\n</details>",
                      "no lesson has an equation (1.98)"),
                     ("| a |\n|---|\n| [x@](gone.md) |", "'gone.md'"),
                     ("A footnote[^gone@].", "[^gone]"))

    def test_what_can_not_be_read(self):
        self.refused(("Inline $\\notamacro@$ formula.", "\\notamacro"),
                     ("@```math\nx = \\frac{1 \\tag{1.98}\n```", "KaTeX parse error"),
                     ("@```math\nx \\tag{1.96} \\tag{1.97}\n```", "2 tags"),
                     ("@```math\nx = y \\tag{1.1}\n```", "equation (1.1) occurs twice"))

    def test_a_live_figure_that_can_not_be_read(self):
        self.refused(("<!-- live: orbit@ -->", "a live figure must be"))

    def test_what_was_made_before_stays(self):
        self.assertEqual(self.box.course("book", "--films").returncode, 0)
        self.refused(("[x@](gone.md)", "gone.md"))
        self.assertTrue((self.box.root / "build/book/index.html").exists())

    def test_where_it_can_not_go(self):
        (self.box.root / "mine").mkdir(exist_ok=True)
        (self.box.root / "mine" / "work.txt").write_text("weeks of it")
        self.box.assert_refused(self, ["book", "--out", "mine"], ["mine", "holds files and no book"])
        self.assertEqual((self.box.root / "mine" / "work.txt").read_text(), "weeks of it")
        self.box.assert_refused(self, ["book", "--out", "no/where"], ["no/where", "no is not a folder"])
        self.box.assert_refused(self, ["book", "--publish", "nowhere"], ["'nowhere'", "git remote"])


if __name__ == "__main__":
    unittest.main()
