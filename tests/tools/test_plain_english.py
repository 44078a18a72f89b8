"""Lessons, pages and docstrings are in plain English: spelling, openings of docstrings, words, length of sentences."""

import ast
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
# Right words that codespell takes for others: a field's, an abbreviated journal's, half of "to and fro", an author's name.
RIGHT = "statics,numer,fro,bodin,precesses"
KNOWN_CODESPELL = 2, 4  # a newer one may take more right words for wrong ones
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
    """Returns the first line of each docstring. In tests of C++ this is any comment of a file, a function or a class:
    one that begins in the first column."""
    found, read = [], set(sources())
    for name in our_files():
        is_test = name.parts[0] == "tests"
        if name.suffix == ".py":
            lines = python_lines((ROOT / name).read_text(encoding="utf-8"))
        elif name in read or is_test and name.suffix in (".hpp", ".cpp"):
            lines = cpp_lines((ROOT / name).read_text(encoding="utf-8"), is_test)
        else:
            lines = []
        found += [(str(name), line) for line in lines]
    return found


def python_lines(text: str) -> list[str]:
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    told = [ast.get_docstring(node) for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]
    return [docstring.splitlines()[0] for docstring in told if docstring]


def cpp_lines(text: str, is_test: bool) -> list[str]:
    found, before = [], ""
    for line in text.splitlines():
        if not before.lstrip().startswith("//"):
            start = re.match(r"//+ (.*)| +/// (.*)" if is_test else r" */// (.*)", line)
            found += [re.sub(r"^Exercise [\d.]+\. ", "", start[start.lastindex])] if start else []
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
        version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip()
        if tuple(map(int, re.findall(r"\d+", version)[:2])) > KNOWN_CODESPELL:
            self.skipTest(f"codespell {version} may take right words for wrong ones; see KNOWN_CODESPELL")
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
    def test_finds_docstrings(self):
        text = '"""A file."""\nclass A:\n    """A class.\n\n    More."""\n    def f():\n        "A function."\n'
        self.assertEqual(python_lines(text), ["A file.", "A class.", "A function."])
        text = "// A file.\n// More.\n\n/// Exercise 1.2. Adds.\nint a();\n  // A line.\n  int b;  // An end.\n  /// A member.\n"
        self.assertEqual(cpp_lines(text, is_test=True), ["A file.", "Adds.", "A member."])
        self.assertEqual(cpp_lines(text, is_test=False), ["Adds.", "A member."])

    def test_counts_sentences_and_words(self):
        text = "One two. Three `a b` four?\n\n- Five six\n- seven\n\n```\nno. word. here.\n```\n"
        self.assertEqual([words(s) for s in sentences(text) if s], [2, 3, 2, 1])


if __name__ == "__main__":
    unittest.main()
