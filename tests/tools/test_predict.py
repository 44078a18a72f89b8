"""./course predict: questions, right answers, and stored guesses."""

import json
import re
import subprocess
import unittest

from sandbox import ROOT, Sandbox

from manifest import read_chapters
from predictions import HEADING, Prediction, number, predictions_of


def _lesson(folder: str) -> str:
    return (ROOT / "chapters" / folder / "README.md").read_text(encoding="utf-8")


class Answers(unittest.TestCase):
    """chapters/predictions.ini and the lessons."""

    @classmethod
    def setUpClass(cls):
        cls.chapters = {chapter: predictions_of(chapter) for chapter in read_chapters()}

    def test_every_chapter_asks_and_every_answer_is_asked_for(self):
        asked = [each.id for predictions in self.chapters.values() for each in predictions]
        text = (ROOT / "chapters" / "predictions.ini").read_text(encoding="utf-8")
        self.assertEqual(asked, re.findall(r"^\[([\d.]+)\]$", text, re.MULTILINE))
        for chapter, predictions in self.chapters.items():
            self.assertGreaterEqual(len(predictions), 3, chapter.folder)
            self.assertIn(f"`./course predict {chapter.number}`", _lesson(chapter.folder))

    def test_each_is_complete(self):
        for predictions in self.chapters.values():
            for each in predictions:
                with self.subTest(each.id):
                    self.assertRegex(each.question, r"[?]|\w\?$")
                    self.assertGreater(len(each.why), 30)
                    self.assertNotEqual(bool(each.answer), bool(each.choices))
                    if each.choices:
                        self.assertIn(each.right, each.choices)
                        self.assertEqual(list(each.choices), list("abcdef")[: len(each.choices)])
                    right = each.right or each.answer
                    self.assertTrue(each.is_right(each.read(right)))
                    for guess in each.remarks:
                        self.assertIsNotNone(each.read(guess), guess)
                        self.assertFalse(each.is_right(each.read(guess)), f"{guess} is said to be wrong")
                        self.assertEqual(each.remark(each.read(guess)), each.remarks[guess])

    def test_no_lesson_gives_an_answer_away(self):
        """As far as a program can see it: a number of three digits or so stands nowhere but in the file of answers."""
        for chapter, predictions in self.chapters.items():
            above, _, below = _lesson(chapter.folder).partition(f"\n{HEADING}\n")
            for each in predictions:
                if len(each.answer.strip("-")) > 3:
                    with self.subTest(each.id):
                        self.assertNotRegex(above, rf"(?<![\d.]){re.escape(each.answer)}(?!\d)")
            self.assertNotRegex(below.partition("\n## ")[0].lower(), r"the tests (know|answer|have)|the first is")


class Guesses(unittest.TestCase):
    def test_numbers_as_people_write_them(self):
        for text, value in (("0.2", 0.2), (" 2e-3 ", 2e-3), ("1/60", 1 / 60), ("-1/6", -1 / 6), ("5 %", 0.05),
                            (".5", 0.5), ("\u22120.5", -0.5), ("+3", 3), ("20.", 20)):
            self.assertAlmostEqual(number(text), value, delta=1e-12, msg=text)
        self.assertEqual((number("0.2 s", "s"), number("0.2s", "s"), number("4 mm", "m")), (0.2, 0.2, None))
        for text in ("", "x", "nan", "inf", "1e999", "1/0", "0.2.1", "1,5", "1_0", "--1", "1/60/2", "٣"):
            self.assertIsNone(number(text), text)

    def test_near_enough_is_right(self):
        about = Prediction("1.1", "?", "why", answer="0.002", within=5)
        self.assertTrue(about.is_right("0.00205"))
        self.assertFalse(about.is_right("0.0022"))
        self.assertFalse(about.is_right("-0.002"))
        nothing = Prediction("1.2", "?", "why", answer="0")
        self.assertTrue(nothing.is_right("0"))
        self.assertFalse(nothing.is_right("0.001"))

    def test_letters(self):
        choice = Prediction("1.1", "?", "why", choices={"a": "this", "b": "that"}, right="b")
        self.assertEqual([choice.read(text) for text in (" B ", "b)", "a.", "c", "", "ab")],
                         ["b", "b", "a", None, None, None])


class Asking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox()

    @classmethod
    def tearDownClass(cls):
        cls.box.close()

    def setUp(self):
        (self.box.root / ".course" / "predictions.json").unlink(missing_ok=True)

    def ask(self, *words: str, lines: str, code: int) -> subprocess.CompletedProcess:
        """Answers with lines, without a terminal."""
        result = subprocess.run([self.box.root / "course", "predict", *words], input=lines, capture_output=True,
                                text=True, cwd=self.box.root)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines()), default=0), 80)
        return result

    def test_right_wrong_and_later(self):
        said = " ".join(self.ask("1", lines="0.002\nA\n\n0.02\n", code=0).stdout.split())
        for text in ("4 predictions, 4 left", "✓ Right: 0.002.", "✗ No: it is b) twice as large.",
                     "the error is of first order", "Left for later.", "No: it is 0.2 s.", "did you use k/m for ω?",
                     "3 of 4 made, 1 right.", "The others: ./course predict 1"):
            self.assertIn(text, said)

    def test_what_is_no_answer_is_asked_for_again(self):
        said = self.ask("1", lines="soon\n0.002\nz\nb\na\n0.2 s\n", code=0).stdout
        self.assertIn("'soon' is not a number.", said)
        self.assertIn("'z' is not one of a, b or c.", said)
        self.assertIn("4 of 4 made, 4 right.", said)

    def test_what_was_answered_is_remembered_and_can_be_asked_again(self):
        self.ask("1", lines="0.002\nb\n\n\n", code=0)
        said = self.ask("01_leapfrog", lines="a\n0.2\n", code=0).stdout
        self.assertIn("4 predictions, 2 left", said)
        self.assertIn("4 of 4 made, 4 right.", said)
        said = self.ask("1", lines="", code=0).stdout
        self.assertIn("0 left", said)
        self.assertIn("./course predict 1 --again", said)
        said = self.ask("1", "--again", lines="0.5\n\n\n\n", code=0).stdout
        self.assertIn("4 of 4 made, 3 right.", said)

    def test_the_end_of_input_keeps_what_was_answered(self):
        result = self.ask("1", lines="0.002\n", code=1)
        self.assertEqual(result.stderr,
                         "course: the input ended at question 2 of 4; earlier answers are kept\n")
        self.assertIn("3 left", self.ask("1", lines="", code=1).stdout)

    def test_without_any_input_and_with_what_is_no_text(self):
        for line in ("./course predict 1 <&-", "printf '\\377\\n' | PYTHONUTF8=1 ./course predict 1"):
            result = subprocess.run(line, shell=True, capture_output=True, text=True, cwd=self.box.root)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn("the input ended at question 1 of 4", result.stderr)

    def test_a_spoilt_memory_is_none(self):
        for text in ("", "[]", '{"predictions": 3}', '{"predictions": {"1.1": {}, "1.2": "z", "1.4": "0.2"}}'):
            (self.box.root / ".course").mkdir(exist_ok=True)
            (self.box.root / ".course" / "predictions.json").write_text(text, encoding="utf-8")
            self.assertIn("left", self.ask("1", lines="", code=1).stdout)

    def test_the_board(self):
        self.ask("1", lines="0.002\na\na\n0.2\n", code=0)
        self.ask("2", lines="4.17\n\n\n", code=0)
        board = self.box.course().stdout
        self.assertRegex(board, r"01 · [^\n]+\n  ✓ +predictions +3 of 4 right\n")
        self.assertRegex(board, r"02 · [^\n]+\n  · +predictions +1 of 3 made\n")
        self.assertRegex(board, r"03 · [^\n]+done\n04 · ")  # not begun: a line
        told = json.loads(self.box.course("--json").stdout)["predictions"]
        self.assertEqual(told[0], {"chapter": 1, "made": 4, "right": 3, "total": 4})

    def test_refused(self):
        for words, told in ((["predict"], ["required: N"]), (["predict", "15"], ["15", "1 to 14"]),
                            (["predict", "4.2"], ["4.2", "not a chapter"]),
                            (["predict", "04_gauss"], ["04_gauss_seidel"]), (["predict", "1", "2"], ["2"]),
                            (["predict", "1", "--agian"], ["--again"])):
            self.box.assert_refused(self, words, told)

    def test_a_file_of_answers_that_is_broken_is_named(self):
        answers = self.box.root / "chapters" / "predictions.ini"
        text = answers.read_text(encoding="utf-8")
        try:
            for broken, told in (("nonsense\n" + text, "predictions.ini"),
                                 (text.replace("[1.2]", "[1.9]"), "no answer [1.2]")):
                answers.write_text(broken, encoding="utf-8")
                result = self.ask("1", lines="", code=1)
                self.assertIn(told, result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        finally:
            answers.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    unittest.main()
