"""Parts of the course command that can be tested alone."""

import contextlib
import fcntl
import io
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import sandbox  # also finds the course's modules

import board
import check
import crash
import diagnostics
import everything
import files
import install
import last_verdicts
import mine
import mutants
import needs
import process
import speed_error
import terminal
import text_encoding
import tree
import verdict
import version
from errors import BadInput, CourseError
from manifest import all_exercises, numbered_items
from marker import code_of, is_empty, is_stub, marker_line
from needs import NEEDS, Need
from pick import as_list, chapters_of, pick_list


class Marker(unittest.TestCase):
    def test_calls(self):
        for source in ('not_implemented("1.1 kick");', "  spook::not_implemented (x)",
                       '"//"; not_implemented()', "'\"'; not_implemented();",
                       "1'000; not_implemented(); 2'000"):
            self.assertTrue(is_stub(source), source)

    def test_mentions(self):
        for source in ("// not_implemented()", "/* not_implemented() */", "/* \n not_implemented()",
                       '"not_implemented()"', 'R"x(not_implemented())x"', "really_not_implemented()",
                       '#include "common/not_implemented.hpp"', "", r'"\"not_implemented()"'):
            self.assertFalse(is_stub(source), source)

    def test_a_string_without_an_end_is_looked_through_once(self):
        """Else each quote in it would begin another look, up to the end."""
        for text in ('"' + 99 * '\\"', "'" + 99 * "\\'", 'R"(' * 99):
            self.assertEqual(code_of(f"x = {text}").split(), ["x", "="])
        # In a process of its own with 5 s: with a look to the end from each beginning it would take hours.
        many = ("import resource; resource.setrlimit(resource.RLIMIT_CPU, (5, 5)); from marker import code_of; "
                "assert code_of('x = ' + 'R\"(' * 200_000).split() == ['x', '=']")
        result = subprocess.run([sys.executable, "-c", many], capture_output=True, text=True,
                                cwd=sandbox.TOOLS / "course")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(is_stub('"\\"\nnot_implemented();'))

    def test_a_file_without_code_is_empty(self):
        for source in ("", " \t\r\n", "\ufeff", "// kick\n", "/* Vec3 kick() {}\n*/\n// x", "/* no end",
                       "// a \\\nint x;", "/\\\n/ int x;", "/\\ \r\n* int x; */"):
            self.assertTrue(is_empty(source), source)
        for source in ("x", '#include "a.hpp"', "namespace spook {}", "// a\nint x;", "/* */ ;", "/* *\\\n/ int x;"):
            self.assertFalse(is_empty(source), source)

    def test_line(self):
        self.assertEqual(marker_line("/* \n */\n\nnot_implemented();"), 4)


class Lists(unittest.TestCase):
    """Lists of chapters and exercises, as --chapters takes them."""

    def test_a_list_is_written_and_read(self):
        for text, ids, short in (("1-2", 12, "1-2"), ("1.2", 1, "1.2"), ("kick,drift", 2, "1.1-1.2"),
                                 ("2,1.1-1.3", 10, "1.1-1.3,2"), ("1.4-2.1", 3, "1.4-1.5,2.1"), ("01_leapfrog,1.1", 5, "1"),
                                 ("1.1-1.5", 5, "1"), ("8.9-8.12 , 8.1-8.4", 8, "8.1-8.4,8.9-8.12"),
                                 ("1-3,5", 24, "1-3,5"), ("kick-1.3", 3, "1.1-1.3")):
            with self.subTest(text):
                found = pick_list(text)
                self.assertEqual((len(found), as_list(found)), (ids, short))
                self.assertEqual(pick_list(short), found)
                self.assertEqual([one for one in all_exercises() if one in found], list(found))

    def test_every_chapter_of_an_exercise_is_whole(self):
        self.assertEqual([(one.number, len(one.exercises)) for one in chapters_of(pick_list("1.2,3.1"))], [(1, 5), (3, 5)])

    def test_what_is_no_list_is_named(self):
        for text, told in (("", "''"), ("5-2", "'5-2' ends before it begins"), ("1-", "'1-'"), ("1,,2", "''"),
                           ("77", "no chapter 77"), ("8.99", "'8.99'"), ("1-x", "'x'")):
            with self.subTest(text), self.assertRaisesRegex(BadInput, told):
                pick_list(text)


class Crash(unittest.TestCase):
    VECTOR = ("/usr/include/c++/12/bits/stl_vector.h:1123: std::vector<_Tp, _Alloc>::reference std::vector<_Tp, "
              "_Alloc>::operator[](size_type) [with _Tp = int]: Assertion '__n < this->size()' failed.")
    EIGEN = ("check_kick: /usr/include/eigen3/Eigen/src/Core/DenseCoeffsBase.h:410: Scalar& operator[](Eigen::Index): "
             "Assertion `index >= 0 && index < size()' failed.")

    def test_an_assertion_is_told_as_what_it_means(self):
        for said, told in ((self.VECTOR, "An index is past the end of a std::vector."),
                           (self.EIGEN, "An index or a block is outside its vector or matrix."),
                           ("a.cpp:3: int f(): Assertion `mass > 0' failed.", "The assertion mass > 0 failed"),
                           ("h is 3", "That is most often")):
            self.assertIn(told, crash.explained("SIGABRT", f"before\n{said}\n", None))
        self.assertEqual(crash.without_assertion(f"h is 3\n{self.EIGEN}\n").strip(), "h is 3")

    def test_clang_s_library_and_macos_assert_in_other_words(self):
        vector = ("/opt/llvm/include/c++/v1/vector:1393: assertion __n < size() failed: vector[] index out of bounds",
                  "fails an assertion of the C++ library", "An index is past the end of a std::vector.")
        optional = ("/opt/llvm/include/c++/v1/optional:808: assertion this->has_value() failed: no value",
                    "fails an assertion of the C++ library", "The value of an empty optional is read")
        eigen = ("Assertion failed: (index >= 0 && index < size()), function operator[], file DenseCoeffsBase.h, "
                 "line 410.", "fails an assertion", "An index or a block is outside its vector or matrix.")
        for said, ending, told in (vector, optional, eigen):
            with self.subTest(said):
                self.assertEqual(crash.ending("SIGABRT", f"before\n{said}\n"), ending)
                self.assertIn(told, crash.explained("SIGABRT", f"before\n{said}\n", None))
                self.assertEqual(crash.without_assertion(f"h is 3\n{said}\n").strip(), "h is 3")
        # The last one has ended the program.
        self.assertIn("optional", crash.explained("SIGABRT", f"{self.VECTOR}\n{optional[0]}\n", None))

    def test_an_assertion_names_its_library(self):
        clamp = ("/usr/include/c++/12/bits/stl_algo.h:3623: constexpr const _Tp& std::clamp(const _Tp&, const _Tp&, "
                 "const _Tp&) [with _Tp = double]: Assertion '!(__hi < __lo)' failed.")
        for signal, said, told in (("SIGABRT", self.VECTOR, "fails an assertion of the C++ library"),
                                   ("SIGABRT", clamp, "fails an assertion of the C++ library"),
                                   ("SIGABRT", self.EIGEN, "fails an assertion of Eigen"),
                                   ("SIGABRT", "a.cpp:3: int f(): Assertion `mass > 0' failed.", "fails an assertion"),
                                   ("SIGABRT", "h is 3", "crashed (SIGABRT)"),
                                   ("SIGSEGV", self.VECTOR, "crashed (SIGSEGV)")):
            self.assertEqual(crash.ending(signal, f"before\n{said}\n"), told)
        self.assertEqual(crash.explained("SIGABRT", clamp, None),
                         "The lower bound of std::clamp is above its upper bound.")

    def test_a_signal_is_told_as_what_it_means(self):
        self.assertIn("divided by 0", crash.explained("SIGFPE", "", None))

    def test_without_a_trace_there_is_no_place(self):
        self.assertIsNone(crash.place(Path("/nowhere"), Path("/nowhere"), []))


class Done(unittest.TestCase):
    def test_the_last_right_answer_is_told_as_such(self):
        exercises = board.all_exercises()
        for wrong, told in ((0, "Every exercise is right. Well done!"), (1, f"Next: {exercises[-1].label}")):
            verdicts = [check.Verdict(exercise, "done") for exercise in exercises]
            if wrong:
                verdicts[-1].state = "wrong"
            with contextlib.redirect_stdout(io.StringIO()) as said:
                board.show_board(board.read_chapters(), verdicts)
            self.assertIn(told, said.getvalue())

    def test_check_tells_it_too(self):
        with mock.patch.object(check, "judge_all", lambda exercises, seed: [check.Verdict(exercise, "done")
                                                                             for exercise in exercises]), \
             mock.patch.object(check, "remember"), \
             mock.patch.object(board.Exercise, "started", lambda exercise: True), \
             contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(check._check_started(None), 0)
        self.assertIn("Every exercise is right. Well done!", said.getvalue())


class Length(unittest.TestCase):
    def test_the_board_fits_a_screen(self):
        """At the start, and with half of a chapter done."""
        chapters, exercises = board.read_chapters(), board.all_exercises()
        for chapter in (0, 7):
            verdicts = [check.Verdict(exercise, "not started") for exercise in exercises]
            for verdict in verdicts:
                if verdict.exercise in chapters[chapter].exercises[:4] and chapter:
                    verdict.state = "done"
            with mock.patch.object(board, "guesses", lambda asked: {}), \
                    contextlib.redirect_stdout(io.StringIO()) as said:
                board.show_board(chapters, verdicts)
            self.assertLessEqual(len(said.getvalue().splitlines()), 50, said.getvalue())


class LinesWritten(unittest.TestCase):
    def test_comments_and_blank_lines_do_not_count(self):
        self.assertEqual(board.lines_of("// one\n\nint f() {\n  /* two\n     lines */\n  return 1;  // three\n}\n"), 3)

    def test_the_board_tells_them_of_what_is_right(self):
        chapters, exercises = board.read_chapters(), board.all_exercises()
        verdicts = [check.Verdict(exercise, "not started") for exercise in exercises]
        with mock.patch.object(board.Exercise, "source", lambda exercise: "int f() {\n  return 1;\n}\n"):
            for done, told in ((0, ""), (1, "an engine of 3 lines, in 1 function."), (3, "9 lines, in 3 functions.")):
                for each in verdicts[:done]:
                    each.state = "done"
                with contextlib.redirect_stdout(io.StringIO()) as said:
                    board.show_board(chapters, verdicts)
                self.assertEqual("You have written" in said.getvalue(), bool(told))
                self.assertIn(told, said.getvalue())

    def test_the_last_lesson_says_how_long_the_reference_is(self):
        """To a hundred lines or so."""
        lesson = board.read_chapters()[-1].exercises[0].lesson.read_text(encoding="utf-8")
        told = int(re.search(r"The reference has some (\d+)\s+lines", lesson)[1])
        references = [exercise.reference for exercise in board.all_exercises()]
        if not references[0].exists():
            self.skipTest("this repository has no sources of the answers")
        self.assertAlmostEqual(sum(board.lines_of(file.read_text(encoding="utf-8")) for file in references), told, delta=100)


class Next(unittest.TestCase):
    """The first that is wrong, then the first that is not right: the same for the board and for every check."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.state = Path(scratch.name, "state")
        self.three = board.all_exercises()[:3]
        for module, name, value in ((last_verdicts.remembered, "STATE", self.state),
                                    (board, "all_exercises", lambda: self.three),
                                    (board, "own_step", lambda folder: ""),  # whose exercise is not one of the three
                                    (check, "all_exercises", lambda: self.three)):
            patch = mock.patch.object(module, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        self.texts = {}
        for name, method in (("source", lambda exercise: self.texts.get(exercise, "stub")),
                             ("started", lambda exercise: self.texts.get(exercise, "stub") != "stub")):
            patch = mock.patch.object(board.Exercise, name, method)
            patch.start()
            self.addCleanup(patch.stop)

    def test_what_is_wrong_comes_first(self):
        first, second, third = self.three
        for states, told in ((("done", "not started", "wrong"), (third, "wrong")),
                             (("wrong", "not started", "wrong"), (first, "wrong")),
                             (("done", "not started", "not started"), (second, "not started")),
                             (("done", "begun", "not started"), (second, "begun")),
                             (("done", "done", "done"), None)):
            self.assertEqual(board.first_left(list(zip(self.three, states))), told)

    def found(self, exercise: board.Exercise, state: str) -> board.Verdict:
        return board.Verdict(exercise, state, source=exercise.source())

    def test_a_text_that_is_saved_during_its_test_is_not_judged_by_it(self):
        first, second, _ = self.three

        def build(exercises):
            self.texts |= dict.fromkeys(exercises, self.saved["build"])
            return verdict.Built(True, "")

        def test(exercise, *_):
            self.texts[exercise] = self.saved["test"]
            return board.Verdict(exercise, "done")

        for judge in (lambda exercise: [verdict.judge(exercise)], lambda exercise: verdict.judge_all([exercise])):
            for build_saves, test_saves, states in (("b", "b", ("begun", "begun")), ("a", "b", ("begun", "begun")),
                                                    ("a", "a", ("done", "begun"))):
                self.texts = dict.fromkeys((first, second), "a")
                self.saved = {"build": build_saves, "test": test_saves}
                (self.state / "verdicts.json").unlink(missing_ok=True)
                with mock.patch.object(verdict, "_build", build), \
                     mock.patch.object(verdict, "without_building", return_value=None), \
                     mock.patch.object(verdict.CHECK, "failed", return_value=False), \
                     mock.patch.object(verdict, "_judge_built", test):
                    last_verdicts.remember(judge(first))
                for text, state in zip("ab", states):
                    self.texts[first] = text
                    self.assertEqual(last_verdicts.last_state(first), state, (build_saves, test_saves, text))

    def test_what_a_check_found_is_remembered_for_this_text(self):
        first, second, third = self.three
        self.assertEqual(board.next_of_all(), (first, "not started"))
        self.texts = {first: "right", third: "no"}
        self.assertEqual(board.next_of_all(), (first, "begun"))
        last_verdicts.remember([self.found(first, "done"), self.found(third, "wrong"), self.found(second, "not started")])
        self.assertEqual(board.next_of_all(), (third, "wrong"))
        self.texts[third] = "another"
        self.assertEqual(board.next_of_all(), (second, "not started"))
        self.assertEqual([last_verdicts.last_state(each) for each in self.three], ["done", "not started", "begun"])
        (self.state / "verdicts.json").write_text("[]")
        self.assertEqual(last_verdicts.last_state(first), "begun")

    def test_the_last_pass_of_a_chapter_shows_it_whichever_command_passed_it(self):
        first, second, third = self.three
        judged = []

        def judge_all(exercises, seed):
            judged.extend(exercises)
            return [self.found(exercise, "done") for exercise in exercises]

        def said(which: str | None) -> str:
            with mock.patch.object(check, "judge", lambda exercise, seed: self.found(exercise, "done")), \
                 mock.patch.object(check, "judge_all", judge_all), \
                 contextlib.redirect_stdout(io.StringIO()) as text:
                self.assertEqual(check.check_which(which, None), 0)
            return text.getvalue()

        self.texts = {first: "right", third: "right"}
        self.assertNotIn("See it move", said(first.id))
        self.texts[second] = "right"
        for which in (second.id, third.id):
            self.assertIn("See it move, on your functions:", said(which))
        self.assertEqual(judged, [third])  # no check had seen it; then it is known
        self.assertIn("See it move, on your functions:", said(None))
        last_verdicts.remember([self.found(first, "wrong")])
        told = said(second.id)
        self.assertNotIn("See it move", told)
        self.assertIn(f"Next: {first.label}, which is wrong", told)


class Milestone(unittest.TestCase):
    def test_an_own_step_is_offered_by_its_exercise_as_long_as_that_is_a_stub(self):
        for folder, begun, told in (("01_leapfrog", True, "By your own step:\n  ./course view orbit"),
                                    ("07_impacts", False, "By your own step, once you have written 7.9 step_impacts:\n"),
                                    ("12_stiff_wires", False, "By your own step, once you have written 9.9 step_rows:\n"),
                                    ("12_stiff_wires", True, "By your own step:\n  ./course view stiff_wire")):
            with self.subTest(folder), mock.patch.object(board.Exercise, "started", lambda _: begun), \
                 contextlib.redirect_stdout(io.StringIO()) as text:
                board.show_milestone(folder)
            self.assertIn(told, text.getvalue())


class Mine(unittest.TestCase):
    def test_many_functions_are_named_by_the_first_and_the_last_in_a_row(self):
        chapter = [exercise for exercise in board.all_exercises() if exercise.folder < "03"]
        self.assertEqual(mine.told(chapter), f"Yours, right or wrong: 1.1 to {chapter[-1].id}; the rest is the reference.")
        some = [chapter[k] for k in (0, 1, 3, 4, 5)]
        self.assertIn("1.1, 1.2, 1.4 to 2.1;", mine.told(some))
        self.assertIn("Yours, too, but not called: 1.2, 1.4 to 2.1.", mine.told(some, {some[0].function}))


class Causes(unittest.TestCase):
    """Messages of compilers about mistakes that readers made, shortened, and the cause that is added."""
    exercise = board.all_exercises()[0]
    place = f"chapters/{exercise.folder}/{exercise.file.name}"

    def told(self, *output: str) -> list[str]:
        return diagnostics.first_error("\n".join(output), self.exercise)

    def test_the_innermost_line_of_the_student_is_shown_before_an_error_in_a_library(self):
        error = "/usr/include/eigen3/Eigen/src/Core/util/StaticAssert.h:177:5: error: static assertion failed: " \
                "YOU_MIXED_MATRICES_OF_DIFFERENT_SIZES"
        gcc = self.told("/usr/include/eigen3/Eigen/src/Core/CwiseBinaryOp.h: In instantiation of ‘Eigen::CwiseBinaryOp’:",
                        "/usr/include/eigen3/Eigen/src/plugins/Ops.h:27:1:   required from ‘const Eigen::CwiseBinaryOp’",
                        f"{self.place}:9:14:   required from ‘double spook::f(double) [with int Dof = 6]’",
                        f"{self.place}:31:17:   required from here", error)
        clang = self.told(error, f"{self.place}:9:14: note: in instantiation of member function 'operator+' requested here",
                          f"{self.place}:31:17: note: in instantiation of function template 'f<6>' requested here")
        for said in (gcc, clang):
            self.assertIn(f"{self.place}:9:14:", said[0])
            self.assertEqual(said[-1], "Cause: two parts of one expression have different sizes, such as a Vec3 and a "
                                       "Twist<6>; see chapters/EIGEN.md.")

    def test_other_causes(self):
        for line, code, cause in (
                ("error: expected primary-expression before ‘)’ token", "  return row.Gj.tail<3>().norm();",
                 ".template tail<3>()"),
                ("error: use 'template' keyword to treat 'tail' as a dependent template name", "  return row.Gj.tail<3>();",
                 ".template tail<3>()"),
                ("error: ‘require_positive’ was not declared in this scope", "  require_positive(h);", "common/require.hpp"),
                ("error: use of undeclared identifier 'require_positive'", "  require_positive(h);", "common/require.hpp"),
                ("error: static assertion failed: INVALID_VECTOR_VECTOR_PRODUCT__IF_YOU_WANTED_A_DOT", "  a * b;", "a.dot(b)")):
            with self.subTest(line):
                said = self.told(f"{self.place}:5:25: {line}", f"    5 | {code}", "      |   ^")
                self.assertTrue(said[-1].startswith("Cause: "), said)
                self.assertIn(cause, said[-1])

    def test_no_cause_is_made_up(self):
        for line, code in (("error: expected primary-expression before ‘)’ token", "  f(a, );"),
                           ("error: expected primary-expression before ‘)’ token", "  return G.template tail<3>(+);"),
                           ("error: ‘oops’ was not declared in this scope", "  oops();"),
                           ("error: expected ‘;’ before ‘}’ token", "  return G.tail<3>()")):
            self.assertNotIn("Cause:", "".join(self.told(f"{self.place}:5:25: {line}", f"    5 | {code}", "      |   ^")))

    def test_a_division_of_whole_numbers_is_named_where_it_drops_a_fraction(self):
        said = verdict.whole_division("// 1 / 2\ndouble f(double h) {\n  return 1 / 2 * h;\n}\n")
        self.assertEqual(said, "Line 3 has 1 / 2. C++ divides whole numbers without the fraction, so this is 0: write 1.0 / 2.")
        for right in ("return h * 1 / 2;", "return 1.0 / 2;", "return 1 / 2.0;", "return h / 2;", "return 4 / 2 * h;",
                      "return x2 / 3;", "return 1'000 / 2;", 'say("1 / 2");', "return 1 / n;", "return 1 / 0;"):
            self.assertEqual(verdict.whole_division(right), "", right)


class Hints(unittest.TestCase):
    def test_items_keep_paragraphs_and_code(self):
        text = ("\nBefore.\n\n1. One\n   more\n\n   and more\n"
                "2. Two:\n\n   ```cpp\n   1. no item\n   ```\n3. Three\n")
        self.assertEqual(numbered_items(text.splitlines()),
                         ["One\nmore\n\nand more", "Two:\n\n```cpp\n1. no item\n```", "Three"])

    def test_paragraphs_are_filled_and_code_is_not(self):
        folded = terminal.fold("word " * 40 + "\n\n```\n" + "x" * 100 + "\n```", "  ")
        self.assertLessEqual(max(len(line) for line in folded.split("```")[0].splitlines()), terminal.WIDTH)
        self.assertIn("x" * 100, folded)


class Table(unittest.TestCase):
    def test_fits_the_width(self):
        error = {"name": "a name that is quite a bit longer than anyone would like it to be, " * 2,
                 "value": 1.2345e-300, "unit": "relative"}
        result = {"scene": "resting_sphere", "asked": ["ratio=1000", "heavy=bottom", "100000 its"],
                  "solver": "projected_gauss_seidel", "h": 1 / 600, "us_per_step": 123456.789, "error": error}
        with contextlib.redirect_stdout(io.StringIO()) as out:
            speed_error.show_table([result, result | {"error": error | {"value": None, "unit": ""}}])
        self.assertLessEqual(max(map(len, out.getvalue().splitlines())), 80)
        self.assertIn("1/600", out.getvalue())


class BeforeAnythingIsInstalled(unittest.TestCase):
    def test_the_command_begins_with_the_standard_library_alone(self):
        # -S: without site-packages, as on a machine where `start` has yet to install NumPy.
        course = sandbox.ROOT / "tools" / "course"
        done = subprocess.run([sys.executable, "-S", course, "--help"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Installing(unittest.TestCase):
    def refused(self, *, root: bool, there=(), yes=False, apt_works=False) -> str:
        """Returns the message of install() when it cannot continue."""
        stream = mock.Mock(return_value=(0 if apt_works else 100, "E: no network\n"))
        with mock.patch.object(Need, "there", return_value=False), \
             mock.patch.object(install, "_is_root", return_value=root), \
             mock.patch.object(install.shutil, "which", lambda name: name if name in there else None), \
             mock.patch.object(install, "stream", stream), contextlib.redirect_stderr(io.StringIO()), \
             mock.patch("sys.stdin", io.StringIO("")):
            with self.assertRaises(CourseError) as caught:
                install.install((Need("cmake", "command", "cmake"), Need("g++", "command", "c++")), yes)
        self.commands = [" ".join(call.args[0]) for call in stream.call_args_list]
        return str(caught.exception)

    def test_nothing_to_install_calls_nothing(self):
        with mock.patch.object(Need, "there", return_value=True), \
             mock.patch.object(Need, "version", return_value="99"), \
             mock.patch.object(install, "stream", side_effect=AssertionError):
            install.install(NEEDS, yes=False)

    def test_without_apt_the_line_is_printed(self):
        self.assertIn("apt-get update && apt-get install -y --no-install-recommends cmake g++",
                      self.refused(root=True))
        self.assertEqual(self.commands, [])

    def test_without_sudo_the_line_is_printed(self):
        said = self.refused(root=False, there=["apt-get"], yes=True)
        self.assertIn("sudo apt-get update && sudo apt-get install", said)
        self.assertEqual(self.commands, [])

    def test_without_an_answer_nothing_is_installed(self):
        self.assertIn("install with:", self.refused(root=False, there=["apt-get", "sudo"]))
        self.assertEqual(self.commands, [])

    def test_a_failure_prints_the_line(self):
        said = self.refused(root=False, there=["apt-get", "sudo"], yes=True)
        self.assertIn("install with:  sudo apt-get update", said)
        self.assertEqual(self.commands, ["sudo env DEBIAN_FRONTEND=noninteractive apt-get update"])

    def test_what_is_installed_must_be_there(self):
        self.assertIn("still missing", self.refused(root=True, there=["apt-get"], apt_works=True))
        self.assertEqual(self.commands[1], "env DEBIAN_FRONTEND=noninteractive apt-get install -y "
                                           "--no-install-recommends cmake g++")

    def test_sanitizers_are_there_where_a_program_links_with_them(self):
        self.assertTrue(Need("", "sanitizers", "c++").there())
        with tempfile.TemporaryDirectory() as folder:
            without = Path(folder, "clang++")
            without.write_text("#!/bin/sh\necho cannot find libclang_rt.asan.a >&2\nexit 1\n")
            without.chmod(0o755)
            self.assertFalse(Need("", "sanitizers", str(without)).there())

    def test_what_is_too_old_is_named_with_both_versions(self):
        with mock.patch.object(Need, "there", return_value=True), \
             mock.patch.object(Need, "version", return_value="3.9.9"), self.assertRaises(CourseError) as caught:
            install.install((Need("cmake", "command", "cmake", "3.22"), Need("numpy", "module", "numpy", "1.21"),
                             Need("old", "command", "old", "3.10")), yes=True)
        self.assertEqual(str(caught.exception), "cmake 3.9.9 was found, and the course needs 3.22 or newer; "
                                                "old 3.9.9 was found, and the course needs 3.10 or newer")


class BusyTree(unittest.TestCase):
    def test_a_wait_for_another_build_is_told(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said:
            busy = tree.Tree("check")
            busy.path = Path(folder)
            with open(busy.path / "course.lock", "w") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                timer = threading.Timer(0.2, fcntl.flock, (lock, fcntl.LOCK_UN))
                timer.start()
                with busy.alone():
                    timer.join()
            self.assertRegex(said.getvalue(), r"^waiting for another \./course command that builds in .*\n$")
            with busy.alone():
                pass
            self.assertEqual(said.getvalue().count("waiting"), 1)


class FailedTree(unittest.TestCase):
    def test_a_cmake_that_failed_runs_again(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(tree._LINKS, clear=True):
            failing = tree.Tree("check")
            failing.path = Path(folder)
            (failing.path / "build.ninja").touch()  # of an earlier run, which succeeded
            (failing.path / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={sandbox.ROOT}\n"
                                                         f"Python3_EXECUTABLE:STRING={sys.executable}\n")
            for settings, fails, runs in (([], False, 1), ([], False, 0), (["-DNEW=ON"], True, 1), ([], True, 1),
                                          ([], False, 1), ([], False, 0)):
                with mock.patch.object(tree, "stream", return_value=(int(fails), "no compiler")) as cmake, \
                     self.assertRaises(CourseError) if fails else contextlib.nullcontext():
                    failing.configure(*settings)
                self.assertEqual(cmake.call_count, runs)


class Ended(unittest.TestCase):
    def test_a_tool_ends_with_the_command(self):
        """A command that is told to end, by SIGTERM, ends what it has begun."""
        with tempfile.TemporaryDirectory() as folder:
            tool = f"echo $$ > {folder}/pid; echo begun; exec sleep 60"
            with self.assertRaises(SystemExit):
                process.stream(["sh", "-c", tool], lambda line: sys.exit(143))
            with self.assertRaises(ProcessLookupError):
                os.kill(int(Path(folder, "pid").read_text()), 0)

    def test_sigterm_ends_both(self):
        course = sandbox.ROOT / "tools" / "course"
        with tempfile.TemporaryDirectory() as folder:
            code = f"""import board, process, runpy, sys
tool = ["sh", "-c", "echo $$ > {folder}/pid; echo begun; exec sleep 60"]
board.progress = lambda arguments: process.stream(tool, lambda line: print(line, end="", flush=True))
sys.argv = ["course", "progress"]
runpy.run_path("{course / '__main__.py'}", run_name="__main__")"""
            with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                                  env=os.environ | {"PYTHONPATH": str(course)}) as command:
                self.assertEqual(command.stdout.readline(), "begun\n")
                command.terminate()
                self.assertEqual(command.wait(10), 143)
            with self.assertRaises(ProcessLookupError):
                os.kill(int(Path(folder, "pid").read_text()), 0)


class MovedTree(unittest.TestCase):
    def said(self, home: str) -> str:
        """Returns the output while a tree is configured that CMake once configured for this folder."""
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said, \
             mock.patch.object(tree, "stream", return_value=(0, "")), mock.patch.dict(tree._LINKS, clear=True):
            moved = tree.Tree("check")
            moved.path = Path(folder)
            (moved.path / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
            moved.configure()
        return said.getvalue()

    def test_why_it_is_built_anew_is_said_in_one_line(self):
        said = self.said("/old/place")
        self.assertIn(f"was built for /old/place, and the course is in {sandbox.ROOT} now: it is built anew.\n", said)
        self.assertEqual(said.count("\n"), 1)

    def test_one_that_was_not_moved_says_nothing(self):
        self.assertEqual(self.said(str(sandbox.ROOT)), "")


class Encoding(unittest.TestCase):
    def test_what_a_compiler_reads(self):
        for content in (b"", "λ\n".encode(), b"\xef\xbb\xbfint x;", b"\xe9"):
            self.assertEqual(text_encoding.encoding_of(content), "", content)

    def test_what_it_does_not(self):
        for content, name in (("int kick;\n".encode("utf-16"), "UTF-16"), (("a" * 50).encode("utf-16-le"), "UTF-16"),
                              ("a".encode("utf-32"), "UTF-32"), (("a" * 50).encode("utf-32-be"), "UTF-32"),
                              (b"int a;\0", "bytes with zeros")):
            self.assertEqual(text_encoding.encoding_of(content), name)


class Versions(unittest.TestCase):
    def header_version(self, need: Need, **files: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                Path(folder, name).write_text(text)
            with mock.patch.object(needs, "_HEADER_FOLDERS", (folder,)):
                return need.version()

    def test_of_headers(self):
        digits = Need("eigen", "header", "Core", "3.4", ("Version", "Macros.h"), "E_(?:WORLD|MAJOR)")
        self.assertEqual(self.header_version(digits, **{"Macros.h": "#define E_WORLD 3\n#define E_MAJOR 4\n"}), "3.4")
        self.assertEqual(self.header_version(digits, Version="#define E_WORLD 3\n#define E_MAJOR 5\n"), "3.5")
        self.assertEqual(self.header_version(digits, Version="#define OTHER 3\n"), "")
        text = Need("cli", "header", "CLI", "2.1", ("Version",), "V")
        self.assertEqual(self.header_version(text, Version='#define V "2.1.2"\n'), "2.1.2")

    def test_of_commands(self):
        for line, version in (("c++ (Ubuntu 11.4.0-1ubuntu1~22.04) 11.4.0", "11.4.0"), ("1.11.1", "1.11.1"),
                              ("Debian clang version 19.1.7 (3)", "19.1.7"), ("cmake version 3.31.6", "3.31.6"),
                              ("v20.5.1", "20.5.1"),
                              ("no number", "")):
            self.assertEqual(needs._number(line), version)

    def test_all_that_the_course_needs_say_their_version(self):
        for need in NEEDS:
            if need.least and need.there():
                with self.subTest(need.package):
                    self.assertRegex(need.version(), r"^\d+\.\d+")
                    self.assertEqual(need.too_old(), "")


class WhatSomeTestsWant(unittest.TestCase):
    def said(self, offered: bool, error: CourseError | None = None) -> tuple[str, bool]:
        """Returns the output, and whether a package was to be installed."""
        with mock.patch.object(Need, "there", return_value=False), \
             mock.patch.object(everything, "is_offered", return_value=offered), \
             mock.patch.object(everything, "install", side_effect=error) as installing, \
             contextlib.redirect_stdout(io.StringIO()) as out:
            everything._install_if_offered((Need("chromium", "command", "chromium"),), "browser", yes=True)
        return out.getvalue(), installing.called

    def test_it_is_installed_where_the_system_has_it(self):
        self.assertEqual(self.said(offered=True), ("", True))
        self.assertEqual(self.said(offered=False), ("", False))

    def test_tests_go_on_without_it(self):
        said, _ = self.said(offered=True, error=CourseError("no network"))
        self.assertIn("no network", said)


class FilesByGit(unittest.TestCase):
    """The course's files and its commit, in a small folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="files-")
        self.addCleanup(folder.cleanup)
        self.outer = Path(folder.name).resolve()
        self.root = self.outer / "course"
        self.root.mkdir()
        (self.root / "README.md").write_text("# A course\n")
        for module in (files, version):
            patch = mock.patch.object(module, "ROOT", self.root)
            patch.start()
            self.addCleanup(patch.stop)

    def git(self, folder: Path, *words: str) -> None:
        subprocess.run(["git", "-C", str(folder), "-c", "user.name=S", "-c", "user.email=s@localhost", *words], check=True)

    def committed(self, folder: Path) -> None:
        self.git(folder, "init", "-q")
        self.git(folder, "add", "-A")
        self.git(folder, "commit", "-q", "--allow-empty", "-m", "One")

    def test_new_files_are_not_the_course_s(self):
        self.committed(self.root)
        (self.root / "class.csv").write_text("Ann")
        self.assertEqual((files.course_files(), files.new_files()), ([Path("README.md")], [Path("class.csv")]))
        self.assertRegex(version.commit(), "^[0-9a-f]{7,}$")

    def test_a_larger_repository_that_ignores_the_course_does_not_name_its_commit(self):
        (self.outer / ".gitignore").write_text("course/\n")
        self.committed(self.outer)
        self.assertEqual((files.course_files(), files.new_files()), ([Path("README.md")], []))
        self.assertEqual(version.commit(), "")

    def test_without_git(self):
        with mock.patch.object(files.subprocess, "run", side_effect=FileNotFoundError("git")):
            self.assertEqual((files.course_files(), version.commit()), ([Path("README.md")], ""))
            (self.root / ".git").mkdir()
            self.assertRaisesRegex(CourseError, "git is missing", files.course_files)
            self.assertEqual(version.commit(), "")
        self.assertRaisesRegex(CourseError, "git does not read", files.course_files)

    def test_a_name_that_is_not_utf_8(self):
        self.committed(self.root)
        with open(os.fsencode(self.root) + b"/caf\xe9.txt", "w", encoding="utf-8"):
            name = Path(os.fsdecode(b"caf\xe9.txt"))
        self.assertEqual(files.new_files(), [name])
        self.assertEqual(mutants._changed_files(self.root), {self.root / name})

    def test_at_most_three_are_named(self):
        names = [Path(name) for name in "abcd"]
        self.assertEqual(files.left_out([]), "")
        for count, told in ((1, "1 untracked file was left out: a ("), (3, "3 untracked files were left out: a, b, c ("),
                            (4, "4 untracked files were left out: a, b, c, ... (")):
            self.assertTrue(files.left_out(names[:count]).startswith(told))


class Totals(unittest.TestCase):
    CLOSING = ("1/3 Test #1: a ....   Passed    0.01 sec\n\n67% tests passed, 1 tests failed out of 3\n\n"
               "Total Test time (real) =   0.02 sec\n\nThe following tests FAILED:\n"
               "\t  2 - mutant.kick.half (Failed)\nErrors while running CTest\n")

    def test_failed_tests_are_named(self):
        with mock.patch.object(everything, "stream", return_value=(8, self.CLOSING)), \
             contextlib.redirect_stdout(io.StringIO()):
            outcome = everything._run(SimpleNamespace(preset="check", path=Path("nowhere")))
        self.assertEqual(outcome, everything.Outcome("check", 3, ["mutant.kick.half (Failed)"], [], False))

    def test_each_reason_to_skip_is_said_once(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write("test_a (__main__.A.test_a) ... skipped 'no browser is installed'\ntest_b ... ok\n"
                      "test_c (__main__.A.test_c)\nWith words. ... skipped 'no browser is installed'\n"
                      "test_d ... skipped \"clang-format 14 isn't installed\"\n")
            log.flush()
            self.assertEqual(everything._skipped(Path(log.name)),
                             ["no browser is installed", "clang-format 14 isn't installed"])


if __name__ == "__main__":
    unittest.main()
