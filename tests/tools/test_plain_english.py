"""Lessons, pages and docstrings are in plain English: spelling, openings of docstrings, words, length of sentences."""

import re
import shutil
import subprocess
import unittest
from pathlib import Path

from sandbox import ROOT, our_files

LONG = 35  # words; from here on a reader goes back to the beginning of a sentence
# Counted when this test was written; shorten a sentence and lower the number. A new one must not raise it.
MOST_LONG = 0
# Openings that make a docstring's first sentence one without a subject. Only first lines count.
OPENING = re.compile(r"^(?:What|Whether|How|Those|Of)\b")
MOST_OPENINGS = 0
# Right words that codespell takes for others: a field's, an abbreviated journal's, half of "to and fro".
RIGHT = "statics,numer,fro"
# Riddles and persons that numbers are not, by the field's word for each.
WORDS = {
    r"\bthat nothing moves\b": "static",
    r"\bfeel(?:s|ing)? (?:each other|one another)\b": "are coupled",
    r"\bup to roundings\b": "up to round-off",
    r"\bto roundings\b": "up to round-off",
    r"\bcan not\b": "cannot",
    r"\bis its word\b": "selects",
    r"\bdoes not mind\b": "is robust to",
    r"\bbefore anybody looks\b": "before it is detected",
}
# Numbers and functions are no persons.
PERSON = re.compile(r"\b(?:rows?|solvers?|contacts?|joints?|bod(?:y|ies)|impulses?|sweeps?|steps?|scenes?) "
                    r"(?:wants?|asks?|feels?|minds?|promises?|knows?|sees?|remembers?)\b", re.IGNORECASE)
CODE = re.compile(r"^ *```.*?^ *```[^\n]*$|\$[^$\n]*\$|`[^`\n]*`|<!--.*?-->", re.MULTILINE | re.DOTALL)


def lessons() -> list[Path]:
    return sorted(name for name in our_files() if name.suffix == ".md")


def prose(text: str) -> str:
    """The text without code, formulas, tables and headings; what was code counts as a word."""
    text = CODE.sub(lambda found: "" if "\n" in found[0] else "x", text)
    lines = [line for line in text.splitlines() if not line.lstrip().startswith(("|", "#", "![", "<"))]
    return "\n".join(re.sub(r"^(\s*)(?:[-*]|\d+\.) ", r"\n\1", line) for line in lines)


def sentences(text: str) -> list[str]:
    """Sentences as a reader counts them: a full stop, question mark or colon at the end of a paragraph ends one."""
    found = []
    for paragraph in re.split(r"\n\s*\n", prose(text)):
        found += re.split(r"(?<=[.!?:;])[)*\"”]*\s+(?=\S)", " ".join(paragraph.split()))
    return found


def words(sentence: str) -> int:
    return len([word for word in sentence.split() if any(letter.isalpha() for letter in word)])


def sources() -> list[Path]:
    """C++ that people read; most tests are left out."""
    return sorted(name for name in our_files() if name.suffix in (".hpp", ".cpp", ".ipp")
                  and (name.parts[0] in ("chapters", "solutions", "plots") or name.parts[:2] == ("tests", "support")))


def first_lines() -> list[tuple[str, str]]:
    """The first line of each docstring."""
    found = []
    for name in sources():
        before = ""
        for line in map(str.strip, (ROOT / name).read_text(encoding="utf-8").splitlines()):
            if line.startswith("/// ") and not before.startswith("/// "):
                found.append((str(name), re.sub(r"^Exercise [\d.]+\. ", "", line[4:])))
            before = line
    return found


def texts() -> list[tuple[str, str]]:
    """Pages, and the comments of sources, each as one line."""
    comments = [(name, " ".join(re.findall(r"//+<? ?(.*)$", (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)))
                for name in sources()]
    pages = [(name, (ROOT / name).read_text(encoding="utf-8")) for name in lessons()]
    return [(str(name), " ".join(text.split())) for name, text in [*pages, *comments]]


class PlainEnglish(unittest.TestCase):
    def test_spelling(self):
        program = shutil.which("codespell")
        if not program:
            self.skipTest("codespell is not installed: apt install codespell")
        names = [str(name) for name in [*lessons(), *sources()]]
        result = subprocess.run([program, "-L", RIGHT, *names], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_words_of_the_field_stand_for_riddles(self):
        found = []
        for name, text in texts():
            for banned, word in WORDS.items():
                found += [f"{name}: “{text[max(0, m.start() - 30):m.end() + 20]}”: say “{word}”"
                          for m in re.finditer(banned, text)]
        self.assertEqual(found, [], "\n".join(found))

    def test_numbers_are_no_persons(self):
        found = [f"{name}: “{text[max(0, m.start() - 30):m.end() + 30]}”"
                 for name, text in texts() for m in PERSON.finditer(text)]
        self.assertEqual(found, [], "\n".join(found))

    def test_docstrings_open_with_a_verb_or_a_noun(self):
        found = [f"{name}: {line}" for name, line in first_lines() if OPENING.match(line)]
        self.assertLessEqual(len(found), MOST_OPENINGS, "\n".join(found))

    def test_few_sentences_are_long(self):
        found = [f"{name}, {words(sentence)} words: {sentence}" for name in lessons()
                 for sentence in sentences((ROOT / name).read_text(encoding="utf-8")) if words(sentence) > LONG]
        self.assertLessEqual(len(found), MOST_LONG, "\n".join(found))


class TheGateItself(unittest.TestCase):
    def test_counts_sentences_and_words(self):
        text = "One two. Three `a b` four?\n\n- Five six\n- seven\n\n```\nno. word. here.\n```\n"
        self.assertEqual([words(s) for s in sentences(text) if s], [2, 3, 2, 1])


if __name__ == "__main__":
    unittest.main()
