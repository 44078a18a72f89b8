"""Lessons, headers, stubs, solutions, hints and mutants agree about exercises and equations."""

import itertools
import re
import sys
import unittest
from collections import Counter
from pathlib import Path

from sandbox import ROOT, TOOLS, Exercise, all_exercises, our_files

sys.path.insert(0, str(TOOLS / "mutants"))

from answers import files_of, read_answers  # noqa: E402
from manifest import read_chapters  # noqa: E402

SECTIONS = ("What you will be able to do", "See it run", "The idea", "The equations",
            "Predict before you code", "Exercises", "Check", "Experiment", "Questions", "Further")
LEAST_HINTS, LEAST_MUTANTS = 2, 3

_TAG = re.compile(r"\\tag\{([0-9]+\.[0-9]+[a-z]?)\}")
# Eq. (4.2); Eq. (3.4), (3.5) and (3.7); Eq. (3.4)-(3.6)
_JOINED = r"\s*(?:,|and|or|to|-|–|…)?\s*"
_REFERENCE = re.compile(rf"\bEqs?\.\s*((?:\([0-9]+\.[0-9]+[a-z]?\)(?:{_JOINED}(?=\([0-9]))?)+)")
_NUMBER = re.compile(r"\(([0-9]+\.[0-9]+[a-z]?)\)")
_NEXT_LINE = re.compile(r"\n[ \t]*(?://[/!]?|\*|#|>)?[ \t]*")


def unwrapped(text: str) -> str:
    """Removes the line breaks of comments, so that a list may continue over them."""
    return _NEXT_LINE.sub(" ", text)


def references(text: str) -> list[str]:
    return [tag for found in _REFERENCE.finditer(unwrapped(text)) for tag in _NUMBER.findall(found[1])]


def lesson(exercise: Exercise) -> str:
    return exercise.lesson.read_text(encoding="utf-8") if exercise.lesson.exists() else ""


def section(text: str, title: str) -> str:
    """Returns the text under `## title`, down to the next heading of that level."""
    found = re.search(rf"^## +{title}\b.*?$(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL | re.IGNORECASE)
    return found[1] if found else ""


def entries(text: str) -> list[str]:
    """Returns the parts of a section that may describe one exercise: below a heading, a table's row, a paragraph."""
    return re.split(r"^#{3,} ", text, flags=re.MULTILINE) + text.splitlines() + text.split("\n\n")


def all_tags() -> list[str]:
    return [tag for path in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md"))
            for tag in _TAG.findall(path.read_text(encoding="utf-8"))]


def header_comment(exercise: Exercise) -> str:
    """Returns the docstring of the exercise's function in its chapter's header."""
    lines = [line for header in sorted(exercise.file.parent.glob("*.hpp"))
             for line in header.read_text(encoding="utf-8").splitlines()]
    for k, line in enumerate(lines):
        if line.startswith("///") and f"Exercise {exercise.id}." in line:
            below = lines[k:]
            comment = list(itertools.takewhile(lambda line: line.startswith("///"), below))
            declaration = " ".join(below[len(comment):]).split(";")[0]
            return "\n".join(comment) if re.search(rf"\b{exercise.function}\(", declaration) else ""
    return ""


class Lessons(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.exercises = all_exercises()
        cls.chapters = read_chapters()

    def test_every_folder_of_exercises_is_listed(self):
        listed = {(exercise.folder, exercise.function) for exercise in self.exercises}
        missing = [f"{place}/{folder}/{function}.cpp" for place in ("chapters", "solutions")
                   for folder, function in sorted(listed) if not (ROOT / place / folder / f"{function}.cpp").exists()]
        self.assertEqual(missing, [], "listed in hints.md, but not there")
        stubs = {(path.parent.name, path.stem) for path in ROOT.glob("chapters/[0-9][0-9]_*/*.cpp")
                 if "not_implemented(" in path.read_text(encoding="utf-8", errors="replace")}
        self.assertEqual(stubs - listed, set(), "a stub, but not listed in hints.md")

    def test_numbers_and_names(self):
        counts = Counter(exercise.function for exercise in self.exercises)
        self.assertEqual([name for name, count in counts.items() if count > 1], [])
        for chapter in self.chapters:
            with self.subTest(chapter.folder):
                self.assertEqual([exercise.id for exercise in chapter.exercises],
                                 [f"{chapter.number}.{k + 1}" for k in range(len(chapter.exercises))])
                self.assertRegex(chapter.title, rf"^{chapter.number:02} · \S")

    def test_every_chapter_has_the_same_sections(self):
        for chapter in self.chapters:
            with self.subTest(chapter.folder):
                text = lesson(chapter.exercises[0])
                headings = re.findall(r"^## +(.*)$", text, re.MULTILINE)
                known = [next((title for title in SECTIONS if heading.lower().startswith(title.lower())),
                              f"unknown section: {heading}") for heading in headings]
                self.assertEqual(known, list(SECTIONS))

    def test_every_lesson_begins_with_what_it_takes(self):
        for chapter in self.chapters:
            with self.subTest(chapter.folder):
                head = lesson(chapter.exercises[0]).partition("\n## ")[0]
                self.assertRegex(head, r"(?s)\n\n\*\*What it takes\.\*\* .*\bhours\b.*\bOn\s+first\s+reading\b")

    def test_what_is_folded_away_is_shown_as_markdown(self):
        """GitHub wants an empty line below the summary and above the end."""
        for chapter in self.chapters:
            with self.subTest(chapter.folder):
                text = lesson(chapter.exercises[0])
                whole = re.findall(r"^<details>\n<summary>[^\n]+</summary>\n\n(?:(?!<details>).)*?\n\n</details>$", text,
                                   re.MULTILINE | re.DOTALL)
                self.assertGreater(len(whole), 0)
                self.assertEqual((text.count("<details"), text.count("</details>")), (len(whole), len(whole)))

    def test_mathematics_in_a_line_is_whole(self):
        """GitHub takes a backslash before a sign, and an asterisk, for Markdown's own."""
        for chapter in self.chapters:
            text = re.sub(r"```.*?```|`[^`]*`", "", lesson(chapter.exercises[0]), flags=re.DOTALL)
            for formula in re.findall(r"\$[^$]*\$", text):
                with self.subTest(chapter.folder, formula=formula):
                    self.assertNotRegex(formula, r"\\[^A-Za-z]|[*\n]")

    def test_the_front_page_lists_every_chapter(self):
        page = (ROOT / "README.md").read_text(encoding="utf-8")
        for chapter in self.chapters:
            self.assertTrue(f"(chapters/{chapter.folder}/README.md)" in page, f"README.md does not list {chapter.folder}")

    def test_every_exercise_has_its_place_in_the_lesson(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                needed = (exercise.id, exercise.function, exercise.file.name)
                parts = [part for part in entries(section(lesson(exercise), "Exercises"))
                         if all(word in part for word in needed)]
                self.assertTrue(parts, f"no part of the section Exercises has {needed}")
                self.assertTrue(any(_NUMBER.search(part) for part in parts), "no equation is named there")

    def test_every_exercise_has_hints(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                self.assertGreaterEqual(len(exercise.hints), LEAST_HINTS, "too few numbered hints in hints.md")
                self.assertTrue(all(exercise.hints), "a hint in hints.md is empty")

    def test_headers_name_exercise_and_equation(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                comment = header_comment(exercise)
                self.assertTrue(comment, f"no header has 'Exercise {exercise.id}.' above {exercise.function}")
                self.assertTrue(references(comment), "no equation is named there")

    def test_stubs_name_themselves(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                if not exercise.started():
                    self.assertIn(f'not_implemented("{exercise.label}"', exercise.source())

    def test_tests_name_the_exercise(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                folder, line = f"tests/{exercise.folder}", f'EXERCISE({exercise.suite}, "{exercise.label}");'
                self.assertTrue(any(line in path.read_text(encoding="utf-8") for path in ROOT.glob(f"{folder}/*.cpp")),
                                f"no file of {folder}/ has {line}")

    def test_every_exercise_has_mutants(self):
        for exercise in self.exercises:
            with self.subTest(exercise.label):
                files = files_of(exercise)
                wrong = [answer for answer in (read_answers(files) if files else []) if not answer.is_right]
                self.assertGreaterEqual(len(wrong), LEAST_MUTANTS,
                                        f"too few mutants in tests/mutants/{exercise.folder}/{exercise.function}.diff")
                changes = [file for file in files if file.suffix == ".diff"]
                self.assertEqual([file.read_text(encoding="utf-8").splitlines()[0] for file in changes],
                                 [f"# {exercise.label}"] * len(changes))

    def test_equation_tags_are_unique_and_of_their_chapter(self):
        self.assertEqual([tag for tag, count in Counter(all_tags()).items() if count > 1], [])
        for chapter in self.chapters:
            tags = _TAG.findall(lesson(chapter.exercises[0]))
            foreign = [tag for tag in tags if not tag.startswith(f"{chapter.number}.")]
            self.assertEqual(foreign, [], chapter.folder)

    def test_every_equation_that_is_referred_to_exists(self):
        tags = set(all_tags())
        places = [name for name in our_files()
                  if name.parts[0] in ("chapters", "solutions", "tests", "tools", "plots")
                  and name.suffix in (".cpp", ".hpp", ".md", ".py") and name != self._this()]
        for name in places:
            text = (ROOT / name).read_text(encoding="utf-8", errors="replace")
            unknown = [tag for tag in references(text) if tag not in tags]
            with self.subTest(str(name)):
                self.assertEqual(unknown, [], "no lesson has these")

    def _this(self) -> Path:
        """Its own comments show how references are written."""
        return Path(__file__).resolve().relative_to(ROOT)


class References(unittest.TestCase):
    def test_single_lists_and_ranges(self):
        self.assertEqual(references("as Eq. (4.2) says (notes (16))"), ["4.2"])
        self.assertEqual(references("Eq. (3.4), (3.5) and (3.7); notes (28), (31)"), ["3.4", "3.5", "3.7"])
        self.assertEqual(references("Eq. (3.4)-(3.6)."), ["3.4", "3.6"])
        self.assertEqual(references("// Eq. (1.3),\n/// (1.4) of it"), ["1.3", "1.4"])
        self.assertEqual(references("no equation (1.5) here"), [])


if __name__ == "__main__":
    unittest.main()
