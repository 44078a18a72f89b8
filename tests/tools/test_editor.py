"""The files for editors are right: .vscode/ for VS Code, .clangd for editors with clangd."""

import json
import re
import shlex
import shutil
import subprocess
import unittest

from sandbox import ROOT, all_exercises

from arguments import parse
from paths import BUILD
from pick import pick
from tree import Tree

CHECK = Tree("check")
EXERCISE = all_exercises()[0]
_BUILD = re.compile(r"cmake --preset (\w+) && ninja -C build/(\w+) (\w+)")


def read(name: str) -> dict:
    return json.loads((ROOT / ".vscode" / name).read_text(encoding="utf-8"))


def filled_in(text: str, settings: dict) -> str:
    """Fills in variables as VS Code does, with the first exercise open and the default answer to each question."""
    values = {"workspaceFolder": str(ROOT), "fileBasenameNoExtension": EXERCISE.function,
              "fileDirnameBasename": EXERCISE.folder}
    values |= {f"input:{question['id']}": question["default"] for question in settings["inputs"]}
    return re.sub(r"\$\{(.*?)\}", lambda found: values[found[1]], text)


def ninja_makes(what: str) -> bool:
    """Tells whether build/debug would have the target. It has those of both other trees."""
    return any(subprocess.run(["ninja", "-C", str(Tree(preset).path), "-t", "query", what],
                              capture_output=True).returncode == 0 for preset in ("check", "release"))


class VisualStudioCode(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        CHECK.configure()
        cls.tasks, cls.launch = read("tasks.json"), read("launch.json")

    def test_tasks_call_what_there_is(self):
        for task in self.tasks["tasks"]:
            with self.subTest(task["label"]):
                command = filled_in(task["command"], self.tasks)
                building = _BUILD.fullmatch(command)
                if building:
                    self.check_building(*building.groups())
                else:
                    course, *words = shlex.split(command)
                    self.assertEqual(course, "./course")
                    self.check_words(words)

    def check_building(self, preset: str, folder: str, target: str):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        self.assertIn(preset, [known["name"] for known in presets])
        self.assertEqual(folder, preset)
        self.assertTrue(ninja_makes(target), f"no target {target}")

    def check_words(self, words: list[str]):
        arguments = parse(words)
        if arguments.command == "run":
            self.assertTrue((ROOT / f"solutions/scenes/{arguments.words[0]}.cpp").exists(), words)
        else:
            self.assertIn(EXERCISE, pick(arguments.which))

    def test_what_is_launched_is_built_before(self):
        labels = {task["label"]: task for task in self.tasks["tasks"]}
        for launch in self.launch["configurations"]:
            with self.subTest(launch["name"]):
                program = filled_in(launch["program"], self.launch)
                before = filled_in(labels[launch["preLaunchTask"]]["command"], self.tasks)
                _, folder, target = _BUILD.fullmatch(before).groups()
                self.assertTrue(program.startswith(f"{ROOT}/build/{folder}/"), program)
                self.assertTrue(program.endswith(f"/{target}"), program)
                self.assertTrue(ninja_makes(program.removeprefix(f"{ROOT}/build/{folder}/")), program)

    def test_errors_are_found_in_what_is_printed(self):
        for label in ("check this exercise", "watch this exercise"):
            matcher = next(task["problemMatcher"] for task in self.tasks["tasks"] if task["label"] == label)
            pattern = matcher["pattern"]
            found = re.match(pattern["regexp"], "  chapters/01_leapfrog/kick.cpp:8:10: error: expected ';'")
            self.assertEqual([found[pattern[part]] for part in ("file", "line", "column", "severity", "message")],
                             ["chapters/01_leapfrog/kick.cpp", "8", "10", "error", "expected ';'"])

    def test_watching_begins_and_ends_with_these_lines(self):
        watching = next(task["problemMatcher"]["background"] for task in self.tasks["tasks"] if task.get("isBackground"))
        self.assertRegex("\r1.1 kick   chapters/01_leapfrog/kick.cpp", watching["beginsPattern"])
        self.assertRegex("Watching; Ctrl-C ends.", watching["endsPattern"])
        self.assertIn(r"\nWatching; Ctrl-C ends.", (ROOT / "tools/course/watch.py").read_text(encoding="utf-8"))

    def test_the_other_files_are_json_too(self):
        self.assertTrue(read("extensions.json")["recommendations"])
        self.assertTrue(read("settings.json"))


@unittest.skipUnless(shutil.which("clangd"), "clangd is not installed")
class Clangd(unittest.TestCase):
    """clangd's own check of a file, without its search for refactorings at every word (--check-lines)."""

    def setUp(self):
        if BUILD != ROOT / "build":
            self.skipTest(".clangd looks into build/, and what is built here is elsewhere")
        CHECK.configure()

    def test_a_stub(self):
        stubs = [exercise for exercise in all_exercises() if not exercise.started()]
        if not stubs:
            self.skipTest("no stub is left")
        self.has_no_errors(f"chapters/{stubs[0].folder}/{stubs[0].function}.cpp")

    def test_a_header(self):
        self.has_no_errors("chapters/04_gauss_seidel/gauss_seidel.hpp")

    def test_what_another_tree_compiles(self):
        self.has_no_errors("solutions/engine/bodies/bodies.cpp")
        self.has_no_errors("plots/11_direct/direct_wire.cpp")

    def has_no_errors(self, name: str):
        done = subprocess.run(["clangd", f"--check={name}", "--check-lines=1-1"], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("All checks completed, 0 errors", done.stderr)
        self.assertIn("Loaded compilation database from", done.stderr)
        self.assertNotIn("Generic fallback command", done.stderr)


if __name__ == "__main__":
    unittest.main()
