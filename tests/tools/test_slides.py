"""./course slides: the parts of a lesson on its slides and in its notes, in one self-contained file."""

import html
import re
import unittest

from sandbox import Sandbox
from test_book import TAG, bound

from binding.deck import _titled
from binding.outline import pages
from binding.reading import read
from binding.slide_page import slide_page
from manifest import read_chapters
from predictions import predictions_of

_PICTURE = re.compile(r"^!\[", re.MULTILINE)


class Slides(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        bound(cls.addClassCleanup)  # skips them where the book cannot be made
        drafts = [read(page) for page in pages()]
        cls.decks = {chapter: slide_page(chapter, drafts) for chapter in read_chapters()}

    def sections(self, chapter) -> list[tuple[str, str]]:
        """Returns for each slide its content and its notes."""
        return re.findall(r'<section\b[^>]*>(.*?)<aside>(.*?)</aside></section>', self.decks[chapter][0], re.DOTALL)

    def test_every_equation_and_picture_of_a_lesson_is_shown(self):
        for chapter in self.decks:
            with self.subTest(chapter.folder):
                lesson = chapter.exercises[0].lesson.read_text(encoding="utf-8")
                shown = "".join(slide for slide, _ in self.sections(chapter))
                unfolded = re.sub(r"<details>.*?</details>", "", lesson, flags=re.DOTALL)
                numbers = re.findall(r'<span class="tag">\(([0-9.]+[a-z]?)\)</span>', shown)
                self.assertEqual(sorted(numbers), sorted(TAG.findall(unfolded)))
                self.assertEqual(shown.count("<img "), len(_PICTURE.findall(unfolded)))

    def test_it_asks_and_answers_what_the_lesson_asks(self):
        for chapter in self.decks:
            slides = self.sections(chapter)
            asked = [slide for slide, _ in slides if 'class="answer"' in slide]
            self.assertEqual(len(asked), len(predictions_of(chapter)), chapter.folder)
            names = "".join(slide for slide, _ in slides)
            for exercise in chapter.exercises:
                self.assertIn(f"<td>{exercise.id}</td><td><code>{exercise.function}</code>", names)

    def test_the_notes_are_the_lesson(self):
        """No paragraph is lost: what a slide does not show is said beside it."""
        for chapter in self.decks:
            with self.subTest(chapter.folder):
                lesson = chapter.exercises[0].lesson.read_text(encoding="utf-8")
                page = _words(self.decks[chapter][0].partition("<body>")[2])
                for section in ("The idea", "The equations"):
                    text = re.search(rf"(?ms)^## {section}$(.*?)^## ", lesson)[1]
                    for paragraph in re.findall(r"(?m)(?:\A|\n\n)([A-Z][^\n|]{40,}(?:\n[^\n|]+)*)(?=\n\n)", text):
                        first = _words(re.split(r"[^A-Za-z0-9 ,.;:?!()\n]", paragraph)[0].rpartition(" ")[0])
                        self.assertIn(first, page)

    def test_no_slide_ends_with_a_colon(self):
        """As a caption does in a lesson, where a command follows it."""
        for chapter in self.decks:
            for slide, _ in self.sections(chapter):
                text = html.unescape(re.sub(r"<[^>]*>", "", slide)).strip()
                title = html.unescape(re.sub(r"<[^>]*>", "", re.search(r"<h[12]>(.*?)</h[12]>", slide, re.DOTALL)[1]))
                with self.subTest(f"{chapter.folder}: {title}"):
                    self.assertTrue(title.strip())
                    self.assertNotRegex(title, r"[:.,;(]\s*$")
                    self.assertNotRegex(text, r":$")

    def test_a_lead_is_not_cut_within_a_parenthesis(self):
        one = "An earlier sentence explains something else, at such length that all of it does not fit. "
        long = one * 3
        for text, lead in ((f"{long}Then this holds:", "Then this holds:"),
                           (f"{long}(It is exact. Chapter 08 shows it, (8.15).)",
                            f"{one}(It is exact. Chapter 08 shows it, (8.15).)"),
                           (f"{long}See (8.15). Then (3.2) holds:", "Then (3.2) holds:")):
            self.assertEqual(_titled("The equations", text), ("The equations", lead))

    def test_one_file_needs_no_other(self):
        for chapter, (page, count) in self.decks.items():
            with self.subTest(chapter.folder):
                self.assertEqual(page.count("<section "), count)
                self.assertGreater(count, 12)
                self.assertLess(len(page), 4 << 20)
                body = page.partition("<body>")[2]
                self.assertEqual(re.findall(r"\b(?:src|href)=[\"'](?!data:)[^\"']*", body), [])
                self.assertEqual(re.findall(r"url\((?!data:)[^)]*", page), [])
                self.assertNotRegex(body, r"\bloading=")


class Command(unittest.TestCase):
    def test_what_is_refused(self):
        box = Sandbox()
        self.addCleanup(box.close)
        box.assert_refused(self, ["slides", "99"], ["99"])
        box.assert_refused(self, ["slides", "4.1"], ["4.1"])
        box.assert_refused(self, ["slides", "4", "--out", "no/such/folder/x.html"], ["no/such/folder"])


def _words(text: str) -> str:
    return " ".join(re.sub(r"[^A-Za-z0-9 ]", "", html.unescape(re.sub(r"<[^>]*>", "", text)).replace("\u00a0", " ")
                           .replace("\n", " ")).split())


if __name__ == "__main__":
    unittest.main()
