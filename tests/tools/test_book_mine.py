"""./course book --mine: figures on a student's own functions, where em++ is, and pages of the viewer where it is not.

Nothing here compiles WebAssembly: trees record what they are asked for, and a compiler in the place of em++ shows what
would be linked.
"""

import argparse
import contextlib
import io
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from sandbox import ROOT, all_exercises

import book
import install
import mine
from binding.live import live_figure
from errors import CourseError
from needs import Need

_NOT_THERE = Need("emscripten", "command", "no-such-compiler")
_FAKE = '#!/bin/sh\nfor word; do shift; case $word in -fwasm-exceptions | -s[A-Z]* | --no-entry) ;; *) set -- "$@" "$word" ;; ' \
        'esac; done\nexec c++ "$@"\n'


class FakeTree:
    """A tree that builds nothing; `fails` names a target that does not compile."""

    def __init__(self, fails: str = ""):
        self.settings, self.built, self.fails, self.path = {}, [], fails, Path("tree")

    def build(self, targets, what, keep_going=False):
        self.built += targets
        ok = self.fails not in targets
        return argparse.Namespace(ok=ok, output="" if ok else f"FAILED: {self.fails}\nkick.cpp:7:3: error: no such name\n")

    def setting(self, name):
        return self.settings.get(name, "")

    def configure(self, setting):
        name, _, value = setting.removeprefix("-D").partition("=")
        self.settings[name] = value

    def failed(self, built, *names):
        return not built.ok and self.fails in names


class BookMine(unittest.TestCase):
    def setUp(self):
        self.exercises = [exercise for exercise in all_exercises() if exercise.function in ("kick", "drift")]
        self.native, self.web = FakeTree(), FakeTree()
        self.asked = {}
        for module, name, value in (
                (mine, "RELEASE", self.native), (mine, "WEB", self.web), (mine, "drop_if_stale", lambda *_: None),
                (mine, "program", lambda target: Path(target)), (mine, "missing_functions", lambda *_: []),
                (mine, "program_of_pages", lambda target: self.web.build([target], "") and Path(f"{target}.js")),
                (book, "begun", lambda: self.exercises), (book, "install", lambda *_, **__: None),
                (book, "LIVE_NEEDS", ()), (book, "VIEW_NEEDS", ()),
                (book, "program_of_pages", lambda: Path("spook_live.js")),
                (book, "build", self.build), (book, "film_pages", self.film_pages)):
            patched = mock.patch.object(module, name, value)
            patched.start()
            self.addCleanup(patched.stop)

    def build(self, folder, views, engine, mine):
        self.asked |= {"views": views, "engine": engine, "mine": mine}
        return 1

    def film_pages(self, folder, mine):
        self.asked["films of mine"] = mine

    def book(self, **options) -> str:
        said = io.StringIO()
        words = {"out": None, "publish": None, "films": False, "views": False, "mine": True}
        with contextlib.redirect_stdout(said):
            self.assertEqual(book.book(argparse.Namespace(**words | options)), 0)
        return said.getvalue()

    def test_figures_have_the_student_s_functions(self):
        said = self.book()
        self.assertEqual(self.web.settings, {"SPOOK_MINE": "kick;drift"})
        self.assertEqual(self.web.built, ["spook_live_mine"])
        self.assertEqual(self.native.built, ["exercise_kick", "exercise_drift"])
        self.assertEqual(self.asked, {"views": False, "engine": Path("spook_live_mine.js"), "mine": True})
        self.assertIn("Yours, right or wrong: 1.1, 1.2", said)

    def test_without_the_option_they_have_none(self):
        self.book(mine=False)
        self.assertEqual(self.asked, {"views": False, "engine": Path("spook_live.js"), "mine": False})
        self.assertEqual(self.web.built, [])

    def test_what_does_not_compile_is_told_before_a_long_build(self):
        self.native.fails = "exercise_kick"
        with self.assertRaisesRegex(CourseError, "kick does not compile"):
            self.book()
        self.assertEqual(self.web.built, [])

    def test_without_em_films_become_pages_of_the_viewer(self):
        with mock.patch.object(book, "LIVE_NEEDS", (_NOT_THERE,)):
            said = self.book()
        self.assertEqual(self.asked, {"views": True, "engine": None, "mine": True, "films of mine": True})
        self.assertIn("emscripten", said)

    def test_em_is_offered_on_a_terminal_with_what_it_costs(self):
        there = [False]
        need = mock.Mock(package="emscripten", there=lambda: there[0], too_old=lambda: "")
        installed = mock.Mock(side_effect=lambda *_: there.__setitem__(0, True))
        for answer, wanted in (("n", None), ("", Path("spook_live_mine.js"))):
            with self.subTest(answer), mock.patch.object(book, "LIVE_NEEDS", (need,)), \
                    mock.patch.object(install, "_install", installed), \
                    mock.patch.object(install, "is_offered", lambda _: True), \
                    mock.patch.object(install.machine, "conda", lambda: False), \
                    mock.patch.object(install, "_is_root", lambda: True), \
                    mock.patch("sys.stdin", mock.Mock(isatty=lambda: True)), \
                    mock.patch("builtins.input", lambda question: answer):
                said = self.book()
                self.assertIn("Missing: emscripten (so that figures run in their pages: a download of 110 MB", said)
                self.assertEqual(self.asked["engine"], wanted)
        installed.assert_called_once_with(["emscripten"], True)

    def test_with_nothing_written_it_is_the_reference_s(self):
        self.exercises = []
        self.assertIn("You have written no exercise yet", self.book())
        self.assertEqual(self.asked, {"views": False, "engine": Path("spook_live.js"), "mine": False})


class Sentence(unittest.TestCase):
    def test_it_promises_nothing_of_a_student_s_functions(self):
        figure = live_figure("<!-- live: orbit h=0.02 | h | error | 0.0549 at 6.28 -->")
        self.assertEqual(figure.says(), "Before you change a setting, the graph shows 0.0549 after 6.28 s.")
        self.assertIn("With right functions the graph shows 0.0549 after 6.28 s", figure.says(mine=True))


class Linked(unittest.TestCase):
    def test_the_student_s_objects_come_before_the_reference(self):
        with tempfile.TemporaryDirectory() as folder:
            compiler = Path(folder, "em++")
            compiler.write_text(_FAKE)
            compiler.chmod(0o755)
            tree = Path(folder, "web")
            done = subprocess.run(["cmake", "--preset", "web", "-B", tree, "-DEMSCRIPTEN=ON",
                                   f"-DCMAKE_CXX_COMPILER={compiler}", "-DSPOOK_MINE=kick;drift"], cwd=ROOT,
                                  capture_output=True, text=True, env=os.environ | {"CMAKE_CXX_COMPILER_LAUNCHER": ""})
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            links = {}
            for target in ("spook_live", "spook_live_mine"):
                commands = subprocess.run(["ninja", "-C", tree, "-t", "commands", target], capture_output=True, text=True,
                                          check=True).stdout.splitlines()
                links[target] = commands[-1]
        self.assertNotIn("exercise_", links["spook_live"])
        self.assertRegex(links["spook_live_mine"], r"exercise_kick\S*\.o .*exercise_drift\S*\.o .*libspook_reference\.a")
        self.assertEqual(*(re.findall(r"live_figures\S*\.o", link) for link in links.values()))


if __name__ == "__main__":
    unittest.main()
