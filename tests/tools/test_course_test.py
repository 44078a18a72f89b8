"""./course test: its two sets are all tests; it lists those left out; changed mutants are judged."""

import contextlib
import io
import json
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from sandbox import ROOT

import everything
import mutants
import slowest_tests
from arguments import parse
from tree import Tree

CHECK = Tree("check")
CHAPTERS = mutants.chapters()


class Sets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        listing = subprocess.run(["ctest", "--test-dir", str(CHECK.path), "--show-only=json-v1"],
                                 capture_output=True, text=True, check=True).stdout
        cls.tests = {test["name"]: test for test in json.loads(listing)["tests"]}

    def labels(self, name: str) -> list[str]:
        found = [entry["value"] for entry in self.tests[name].get("properties", []) if entry["name"] == "LABELS"]
        return found[0] if found else []

    def test_the_fast_tests_and_the_mutants_are_disjoint_and_only_what_is_known_is_in_neither(self):
        for name in self.tests:
            with self.subTest(name):
                labels = self.labels(name)
                if name.startswith(("mutant.", "hidden.")):
                    self.assertEqual(labels, [f"mutants.{name.split('.')[1]}"])
                else:
                    self.assertIn(labels, ([], ["fast"]))
                    self.assertTrue(labels or name == "hidden" or name.startswith(("plot.", "seeds.", "tools.")))

    def test_what_is_promised_is_fast(self):
        tools = ("course_check", "course_run", "stubs", "grade_class", "lessons", "book", "format", "mutants")
        references = [f"reference.{chapter}" for chapter in CHAPTERS]
        for name in (*references, "engine.0", "stability", "mechanisms", "spook.program", "lessons.numbers",
                     *(f"tools.{tool}" for tool in tools)):
            with self.subTest(name):
                self.assertEqual(self.labels(name), ["fast"])

    def test_each_that_is_held_to_be_slow_exists(self):
        text = (ROOT / "tests" / "CMakeLists.txt").read_text(encoding="utf-8")
        slow = {f"tools.{name}" for name in re.search(r"set\(slow_tools ([^)]*)\)", text)[1].split()}
        self.assertEqual({name for name in self.tests if name.startswith("tools.") and not self.labels(name)}, slow)

    def test_ctest_chooses_by_whole_labels(self):
        first = CHAPTERS[0]
        chosen = everything.names(CHECK, everything.selection(["fast", f"mutants.{first}"]))
        self.assertEqual(sorted(chosen), sorted(name for name in self.tests
                                                if set(self.labels(name)) & {"fast", f"mutants.{first}"}))
        self.assertEqual(sorted(everything.names(CHECK)), sorted(self.tests))

    def test_what_the_fast_tests_run_is_built_for_them(self):
        for label in ("fast", f"mutants.{CHAPTERS[-1]}"):
            commands = subprocess.run(["ninja", "-C", str(CHECK.path), "-t", "commands", label],
                                      capture_output=True, text=True, check=True).stdout
            for name, test in self.tests.items():
                if label not in self.labels(name):
                    continue
                words = [Path(word) for word in test.get("command", [])]
                programs = [word for word in words if word.is_relative_to(CHECK.path) and not word.is_dir()]
                for script in (word for word in words if word.suffix == ".py"):
                    text = script.read_text(encoding="utf-8")
                    for program in re.findall(r'"release", "solutions", "(\w+)"', text):
                        self.assertIn(program, everything._IN_RELEASE, script)
                    opened = re.findall(r'"check", "solutions", "(\w+)"', text)
                    programs += [CHECK.path / "solutions" / program for program in opened]
                if label != "fast":
                    programs = [CHECK.path / "tests" / f"mutants_{name.split('.')[1]}"]
                for program in programs:
                    with self.subTest(name):
                        self.assertTrue(f"-o {program.relative_to(CHECK.path)} " in commands, program)

    def test_what_is_left_out_is_said(self):
        said = everything.left_out(["a", "hidden", "hidden.02", "mutant.01", "mutant.02", "plot.energy", "seeds.01", "tools.slurm"],
                                   ["a", "mutant.01"])
        self.assertEqual(said, "Left out: 1 mutant.* (nothing changed), 1 hidden.* (likewise), 1 plot.*, 1 seeds.*, hidden, tools.slurm, "
                               "all tests under sanitizers. ./course test --all runs them.")
        self.assertTrue(everything.left_out(["a", "tools.stubs"], ["a"], ["tools.stubs"]).startswith(
            "Left out: tools.stubs (nothing changed), all tests under sanitizers."))
        self.assertEqual(everything.left_out(["a"], ["a"]),
                         "Left out: all tests under sanitizers. ./course test --all runs them.")


class BuiltBesides(unittest.TestCase):
    def test_the_chapters_that_are_graded(self):
        self.assertEqual(everything._graded(1), [f"grade_{CHAPTERS[0]}", f"answer_{CHAPTERS[0]}"])
        self.assertEqual(len(everything._graded()), 2 * len(CHAPTERS))


class Command(unittest.TestCase):
    NOW = {"01_leapfrog": "a", "02_quaternions": "b"}
    SLOWEST = {"tools.stubs": "a", "tools.course_run": "b"}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_test(self, *words: str, ok: bool = True) -> tuple[list[tuple[str, list[str]]], list[list[str] | None], str]:
        """Returns the trees and targets that were built, the selection of each run, and the output."""
        built, chosen = [], []

        def build(tree, targets, _strict):
            built.append((tree.preset, targets))

        def run(tree, some=None):
            chosen.append(some)
            return everything.Outcome(tree.preset, 1, [], [], ok)

        with mock.patch.object(everything, "install"), mock.patch.object(everything, "_install_if_offered"), \
             mock.patch.object(everything, "Tree", lambda preset: SimpleNamespace(preset=preset, path=self.folder,
                                                                           setting=lambda name: "OFF")), \
             mock.patch.object(everything, "_build", build), \
             mock.patch.object(everything, "_run", run), \
             mock.patch.object(everything, "_graded", return_value=[]), \
             mock.patch.object(everything, "names", lambda tree, some=None: ["a"] if some else ["a", "tools.slurm"]), \
             mock.patch.object(mutants, "digests", return_value=dict(self.NOW)), \
             mock.patch.object(mutants, "_changed_files", return_value=None), \
             mock.patch.object(slowest_tests, "now", return_value=dict(self.SLOWEST)), \
             contextlib.redirect_stdout(io.StringIO()) as said:
            code = everything.test(parse(["test", *words]))
        self.assertEqual(code, 0 if ok else 1)
        return built, chosen, said.getvalue()

    def test_mutants_are_judged_until_all_are_killed_and_then_where_something_changed(self):
        every = ["fast", "mutants.01_leapfrog", "mutants.02_quaternions"]
        built, _, said = self.run_test(ok=False)
        self.assertIn(("check", every), built)
        self.assertIn("Left out: tools.slurm", said)
        self.assertIn(("check", every), self.run_test()[0])  # a red run is none to remember
        self.assertIn(("check", ["fast"]), self.run_test()[0])
        self.NOW = self.NOW | {"02_quaternions": "c"}
        built, chosen, _ = self.run_test()
        self.assertIn(("check", ["fast", "mutants.02_quaternions"]), built)
        self.assertEqual(chosen, [everything.selection(["fast", "mutants.02_quaternions"], list(self.SLOWEST))])

    def test_the_slowest_run_until_all_is_green_and_then_where_something_changed(self):
        every = ["fast", "mutants.01_leapfrog", "mutants.02_quaternions"]
        self.assertEqual(self.run_test(ok=False)[1], [everything.selection(every)])
        self.assertEqual(self.run_test()[1], [everything.selection(every)])
        self.assertEqual(self.run_test()[1], [everything.selection(["fast"], list(self.SLOWEST))])
        self.SLOWEST = self.SLOWEST | {"tools.stubs": "c"}
        self.assertEqual(self.run_test()[1], [everything.selection(["fast"], ["tools.course_run"])])
        self.assertEqual(self.run_test("--all", "--yes")[1], [None, None])

    def test_all_is_everything_in_every_tree(self):
        built, chosen, said = self.run_test("--all", "--yes")
        self.assertIn(("check", ["all"]), built)
        self.assertEqual(set(map(type, chosen)), {type(None)})
        self.assertNotIn("Left out", said)
        self.assertIn(("check", ["fast"]), self.run_test()[0])


class Slowest(unittest.TestCase):
    def test_each_is_a_fast_test_that_ctest_can_leave_out(self):
        slowest = list(slowest_tests.now(False))
        fast = everything.names(CHECK, everything.selection(["fast"]))
        self.assertLess(set(slowest), set(fast))
        self.assertEqual(everything.names(CHECK, everything.selection(["fast"], slowest)),
                         [name for name in fast if name not in slowest])

    def test_each_runs_again_if_one_of_its_files_has_changed(self):
        every = list(slowest_tests.now(False))
        with tempfile.TemporaryDirectory() as folder:
            root, tree = Path(folder), SimpleNamespace(path=Path(folder))
            for name, again in (("chapters/01_leapfrog/kick.cpp", every), ("solutions/04_gauss_seidel/sweep.cpp", every),
                                ("tests/support/checks.hpp", every), ("tools/course/grading/class.py", every),
                                ("tests/tools/sandbox.py", every), ("tests/submissions/a/kick.cpp", every),
                                ("tests/remote/answering.cpp", every),
                                ("solutions/engine/world/world.cpp", ["tools.course_run"]),
                                ("plots/run/draw.py", ["tools.course_run"]),
                                ("tests/tools/test_stubs.py", ["tools.stubs"]), ("tests/tools/test_plots.py", []),
                                ("tests/engine/world_test.cpp", []), ("README.md", [])):
                slowest_tests.remember(tree, slowest_tests.now(False, root))
                file = root / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text("new", encoding="utf-8")
                with self.subTest(name):
                    unchanged = slowest_tests.unchanged(tree, slowest_tests.now(False, root))
                    self.assertEqual([test for test in every if test not in unchanged], again)

    def test_each_runs_again_when_warnings_become_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = SimpleNamespace(path=Path(folder))
            slowest_tests.remember(tree, slowest_tests.now(False))
            self.assertEqual(slowest_tests.unchanged(tree, slowest_tests.now(True)), [])

    def test_grading_of_a_class_counts_what_its_programs_are_made_of(self):
        first = CHAPTERS[0]
        commands = subprocess.run(["ninja", "-C", str(CHECK.path), "-t", "commands", f"grade_{first}", f"answer_{first}"],
                                  capture_output=True, text=True, check=True).stdout
        sources = {Path(name) for name in re.findall(rf" ({re.escape(str(ROOT))}/\S+\.cpp)", commands)}
        self.assertTrue(sources)
        generated = {source for source in sources if source.is_relative_to(CHECK.path)}
        self.assertLessEqual(sources - generated, set(slowest_tests._files(ROOT, "tools.grade_class")))


class Digests(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = Path(folder.name)
        for name in ("chapters", "solutions", "tests", "tools", "CMakeLists.txt", "CMakePresets.json"):
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copyfile
            copy(ROOT / name, cls.root / name)

    def changed_by(self, name: str) -> list[str]:
        """Returns the chapters whose digest changes when this file has one line more."""
        before, file = mutants.digests(self.root), self.root / name
        text = file.read_bytes()
        file.write_bytes(text + b"\n")
        after = mutants.digests(self.root)
        file.write_bytes(text)
        self.assertEqual(mutants.digests(self.root), before)
        return [chapter for chapter in before if before[chapter] != after[chapter]]

    def test_every_chapter_has_one(self):
        self.assertEqual(list(mutants.digests(self.root)), CHAPTERS)
        self.assertEqual(len(set(mutants.digests(self.root).values())), len(CHAPTERS))

    def test_what_a_mutant_is_made_of(self):
        mutant = sorted((self.root / "tests" / "mutants" / "07_impacts").glob("*.diff"))[0].relative_to(self.root)
        self.assertEqual(self.changed_by(str(mutant)), ["07_impacts"])
        self.assertEqual(self.changed_by("tests/support/checks.hpp"), CHAPTERS)
        self.assertEqual(self.changed_by("tools/mutants/kill.py"), CHAPTERS)
        self.assertIn("09_better_friction", self.changed_by("solutions/09_better_friction/cone_rows.hpp"))

    def test_a_chapter_that_others_include_is_theirs_too(self):
        users = {path.parts[-2] for path in (self.root / "solutions").glob("[0-9]*/*.cpp")
                 if '#include "04_gauss_seidel/' in path.read_text(encoding="utf-8")}
        for name in ("chapters/04_gauss_seidel/gauss_seidel.hpp", "solutions/04_gauss_seidel/update_row.cpp"):
            found = set(self.changed_by(name))
            self.assertLessEqual(users | {"04_gauss_seidel"}, found)
            self.assertNotIn("01_leapfrog", found)

    def test_what_no_mutant_is_made_of_changes_none(self):
        for name in ("chapters/01_leapfrog/kick.cpp", "solutions/engine/README.md", "tools/course/view.py"):
            self.assertEqual(self.changed_by(name), [])

    def test_a_memory_that_is_not_what_was_written_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            tree, now = SimpleNamespace(path=Path(folder)), {"01_leapfrog": "a"}
            for text in ("", "[]", "{", '{"01_leapfrog": 1}'):
                Path(folder, "mutants-killed.json").write_text(text, encoding="utf-8")
                self.assertEqual(mutants.changed(tree, now, self.root), ["01_leapfrog"])  # there is no git
            mutants.remember(tree, now)
            self.assertEqual(mutants.changed(tree, now, self.root), [])

    def test_without_a_memory_the_last_commit_is_what_was_there(self):
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as tree_folder:
            root, tree = Path(folder).resolve() / "copy", SimpleNamespace(path=Path(tree_folder))
            shutil.copytree(self.root, root)
            now = mutants.digests(root)
            self.assertEqual(mutants.changed(tree, now, root), CHAPTERS)
            for words in (["init", "-q"], ["add", "-A"],
                          ["-c", "user.name=t", "-c", "user.email=t@localhost", "commit", "-qm", "All"]):
                subprocess.run(["git", *words], cwd=root, check=True)
            self.assertEqual(mutants.changed(tree, now, root), [])
            for name, expected in (("chapters/01_leapfrog/kick.cpp", []), ("solutions/engine/README.md", []),
                                   ("tests/mutants/13_mechanisms/a_new_one.diff", ["13_mechanisms"]),
                                   ("solutions/12_stiff_wires/new.cpp", ["12_stiff_wires"]),
                                   ("tests/support/checks.hpp", CHAPTERS)):
                file = root / name
                text = file.read_bytes() if file.exists() else None
                file.write_bytes((text or b"") + b"\n")
                with self.subTest(name):
                    self.assertEqual(mutants.changed(tree, now, root), expected)
                if text is None:
                    file.unlink()
                else:
                    file.write_bytes(text)
            (root / "tests" / "04_gauss_seidel" / "sweep_test.cpp").unlink()
            self.assertEqual(mutants.changed(tree, now, root), CHAPTERS)
            # In a clone, a change that is committed and not pushed counts, too.
            clone = Path(folder).resolve() / "clone"
            subprocess.run(["git", "clone", "-q", str(root), str(clone)], check=True)
            self.assertEqual(mutants.changed(tree, now, clone), [])
            (clone / "tests" / "mutants" / "13_mechanisms" / "a_new_one.diff").write_text("new")
            for words in (["add", "-A"], ["-c", "user.name=t", "-c", "user.email=t@localhost", "commit", "-qm", "New"]):
                subprocess.run(["git", *words], cwd=clone, check=True)
            self.assertEqual(mutants.changed(tree, now, clone), ["13_mechanisms"])


if __name__ == "__main__":
    unittest.main()
