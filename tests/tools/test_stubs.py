"""Every stub compiles, in the course's own checks without a warning, and passes no test: all are skipped.

The stubs of a chapter are compiled as one file, with the references that take their places where another is judged.
"""

import collections
import concurrent.futures
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT, Exercise, all_exercises

sys.path.insert(0, str(ROOT / "tools" / "mutation"))
from commands import commands  # noqa: E402
from crowd import VARIABLE, Crowd, Switched  # noqa: E402
from symbols import reference_functions  # noqa: E402
from tree import Tree, jobs  # noqa: E402
from trial import run_tests  # noqa: E402

CHECK = Tree("check")
STRICT = ["-Werror", "-Wno-subobject-linkage"] if CHECK.setting("SPOOK_WERROR") == "ON" else []


def pristine() -> dict[str, list[Exercise]]:
    """Returns by chapter the exercises that nobody has begun: others are not tested here."""
    exercises = all_exercises()
    begun = [exercise.label for exercise in exercises if exercise.started()]
    if begun:
        print(f"left out, since they are stubs no more: {', '.join(begun)}")
    chapters = collections.defaultdict(list)
    for exercise in exercises:
        if not exercise.started():
            chapters[exercise.folder].append(exercise)
    return dict(chapters)


def build(stubs: list[Exercise], folder: Path) -> str:
    """Builds the folder's `program` of the stubs of a chapter; returns what the compiler or linker says if it fails."""
    texts = [text for stub in stubs for text in (stub.reference.read_text(encoding="utf-8"), stub.source())]
    crowd = Crowd(dict(enumerate(texts)))
    source, compiled = folder / "stubs.cpp", folder / "stubs.o"
    source.write_text(crowd.source(), encoding="utf-8")
    tools = commands(CHECK, stubs[0])

    def run(*words: str) -> str:
        done = subprocess.run(words, cwd=tools.folder, capture_output=True, text=True)
        return done.stderr if done.returncode != 0 else ""

    if said := run(*tools.compiler, *STRICT, "-o", str(compiled), "-c", str(source)):
        return said
    (folder / "switch.cpp").write_text(crowd.switch([compiled], [
        Switched(frozenset(reference_functions(CHECK, stub)), (2 * k, 2 * k + 1), otherwise=2 * k)
        for k, stub in enumerate(stubs)]), encoding="utf-8")
    if said := run(tools.compiler[0], "-o", str(folder / "switch.o"), "-c", str(folder / "switch.cpp")):
        return said
    linked = tools.link([folder / "switch.o", compiled], folder / "program")
    return linked.stderr if linked.returncode != 0 else ""


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="stubs-")
        cls.addClassCleanup(scratch.cleanup)
        cls.chapters, cls.scratch = pristine(), Path(scratch.name)
        needed = ["spook_reference", "test_support", "crash_trace", *(f"tests_{folder}" for folder in cls.chapters)]
        built = CHECK.build(needed, "building the tests")
        if not built.ok:
            raise AssertionError(built.output)
        for folder in cls.chapters:
            (cls.scratch / folder).mkdir()
        with concurrent.futures.ThreadPoolExecutor(jobs()) as pool:
            cls.said = dict(zip(cls.chapters, pool.map(
                lambda folder: build(cls.chapters[folder], cls.scratch / folder), cls.chapters)))

    def test_they_compile(self):
        for folder, said in self.said.items():
            with self.subTest(folder):
                self.assertEqual(said, "")

    def test_each_includes_what_it_needs(self):
        """They are compiled together here, so that one would not miss what another includes. What its answer rejects, a
        stub can reject, too."""
        for folder, stubs in self.chapters.items():
            header = next((ROOT / "chapters" / folder).glob("*.hpp")).name
            for stub in stubs:
                with self.subTest(stub.label):
                    rejects = "common/require.hpp" in stub.reference.read_text(encoding="utf-8")
                    for name in (f"{folder}/{header}", "common/not_implemented.hpp", *["common/require.hpp"] * rejects):
                        self.assertIn(f'#include "{name}"\n', stub.source())

    def test_they_pass_nothing(self):
        for folder, stubs in self.chapters.items():
            for k, stub in enumerate(stubs):
                with self.subTest(stub.label):
                    trial = run_tests(self.scratch / folder / "program", f"{stub.suite}.*",
                                      more={VARIABLE: str(2 * k + 1)})
                    self.assertEqual(trial.exit_code, 0, trial.output)
                    self.assertGreater(len(trial.tests or []), 0, f"there are no tests {stub.suite}.*")
                    self.assertEqual([test.name for test in trial.tests if not test.skipped], [])

    def test_the_reference_defines_what_they_stand_for(self):
        for exercise in all_exercises():
            with self.subTest(exercise.label):
                self.assertNotEqual(reference_functions(CHECK, exercise), set())


if __name__ == "__main__":
    unittest.main()
