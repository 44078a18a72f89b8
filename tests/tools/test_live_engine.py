"""The engine of live figures, compiled to WebAssembly: every scene in node gives the native program's motion over a few
steps, and some scenes its energies and numbers after a second."""

import base64
import json
import math
import shutil
import subprocess
import unittest
from pathlib import Path

import numpy as np
from playing_scene import last, native, played
from sandbox import ROOT

from engine import program_of_pages
from needs import LIVE_NEEDS

STEPS = 10
IN_NODE = ROOT / "tests" / "tools" / "web_engine.js"
KINDS = ("x", "v", "q", "omega")
# The two compilers differ in the order of sums and in sin and cos, each by a rounding of 2^-53. Within so few steps a
# scene may enlarge it by its stiffest ratio: k h²/m is below 1e7 everywhere. Recordings round to 2^-24, which is more.
ROUNDING = 2.0**-53 * 1e7 + 2.0**-23
# After a second only energies and the scene's own numbers are compared. Roundings of 2^-53 in a hundred operations of each
# of at most 2000 steps are about as much as a relative change of gravity, or of the cradle's velocity, by CHANGE. The
# tolerance is SAFETY times what this change makes of a number in the native program, and at least LEAST of its size.
SECOND = {"pile": "g", "tower": "g", "cradle": "v0", "cloth": "g", "governor": "g"}
CHANGE, SAFETY, LEAST = 2e-11, 10, 1e-10
ROUGHEST = 0.1  # a tolerance above this part of a number's size would compare nothing


def built() -> Path:
    """Builds it; skips the test without a compiler for it."""
    if not all(need.there() for need in LIVE_NEEDS) or not shutil.which("node"):
        raise unittest.SkipTest("emscripten or node is not installed")
    return program_of_pages()


def invariants(header: dict, frame: dict) -> dict[str, float]:
    """Returns the total energy and the scene's own numbers."""
    return {"total energy [J]": sum(frame["energy"].values())} | dict(zip(header["columns"], frame["sample"], strict=True))


def after_a_second(scene: str, change: float = 0) -> tuple[int, dict[str, float]]:
    """Returns the number of steps, and the native program's numbers after them, with the parameter of SECOND changed by
    this part."""
    header, _ = played(scene, {}, 1)
    steps, name = round(1 / header["method"]["h"]), SECOND[scene]
    return steps, invariants(*played(scene, {name: header["parameters"][name] * (1 + change)} if change else {}, steps))


def tolerances(scene: str, right: dict[str, float]) -> dict[str, float]:
    changed = [after_a_second(scene, change)[1] for change in (CHANGE, -CHANGE)]
    return {name: LEAST * max(1.0, abs(value)) + SAFETY * max(abs(one[name] - value) for one in changed)
            for name, value in right.items()}


def in_node(scenes: list[str], steps: int) -> dict[str, str]:
    """Returns what the compiled engine writes for each scene."""
    done = subprocess.run(["node", IN_NODE, built(), str(steps)], input="\n".join(scenes), capture_output=True, text=True,
                          check=True)
    return {(line := json.loads(text))["scene"]: line["text"] for text in done.stdout.splitlines()}


def numbers(packed: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(packed), "<f4").astype(float)


class LiveEngine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        listed = subprocess.run([native(), "scenes", "--json"], capture_output=True, text=True, check=True)
        cls.scenes = [scene["name"] for scene in json.loads(listed.stdout)["scenes"]]
        cls.web = in_node(cls.scenes, STEPS)

    def test_every_scene_runs_as_the_native_program_runs_it(self):
        for scene in self.scenes:
            with self.subTest(scene):
                header, frame = last(self.web[scene])
                wanted_header, wanted = played(scene, {}, STEPS)
                self.assertEqual([control["name"] for control in header["controls"]],
                                 [control["name"] for control in wanted_header["controls"]])
                self.assertEqual(frame["step"], STEPS)
                self.assertEqual(len(header["bodies"]), len(wanted_header["bodies"]))
                for kind in KINDS:
                    if kind not in wanted:
                        continue
                    got, right = numbers(frame[kind]), numbers(wanted[kind])
                    self.assertEqual(got.shape, right.shape)
                    size = max(1.0, abs(right).max(initial=0))
                    self.assertLess(abs(got - right).max(initial=0) / size, ROUNDING, kind)
                energy, right = (sum(line["energy"].values()) for line in (frame, wanted))
                parts = max(1.0, *(abs(part) for part in wanted["energy"].values()))
                self.assertTrue(math.isclose(energy, right, rel_tol=0, abs_tol=ROUNDING * parts), (energy, right))

    def test_what_makes_no_sense_is_refused_as_by_the_native_program(self):
        script = IN_NODE
        done = subprocess.run(["node", script, built(), "1"], input="orbitt\n", capture_output=True, text=True)
        said = [json.loads(line) for line in json.loads(done.stdout)["text"].splitlines()]
        self.assertTrue(all("refused" in line for line in said), said)


class AfterASecond(unittest.TestCase):
    def assert_agree(self, got: dict[str, float], right: dict[str, float], within: dict[str, float]) -> None:
        self.assertEqual(list(got), list(right))
        for name, value in right.items():
            self.assertLessEqual(abs(got[name] - value), within[name], (name, got[name], value))

    def test_energies_and_numbers_are_those_of_the_native_program(self):
        built()  # or skips
        for scene in SECOND:
            with self.subTest(scene):
                steps, right = after_a_second(scene)
                header, frame = last(in_node([scene], steps)[scene])
                self.assertEqual(frame["step"], steps)
                self.assertEqual(frame.get("state", "sound"), "sound")
                self.assert_agree(invariants(header, frame), right, tolerances(scene, right))

    def test_the_tolerances_pass_roundings_and_nothing_larger(self):
        """Without a compiler for pages: a change by a few roundings agrees, and one by a thousandth does not."""
        for scene in SECOND:
            with self.subTest(scene):
                _, right = after_a_second(scene)
                within = tolerances(scene, right)
                for name, value in right.items():
                    self.assertLess(within[name], ROUGHEST * max(1.0, abs(value)), name)
                for change in (2.0**-50, -(2.0**-50)):
                    self.assert_agree(after_a_second(scene, change)[1], right, within)
                changed = after_a_second(scene, 1e-3)[1]["total energy [J]"]
                self.assertGreater(abs(changed - right["total energy [J]"]), within["total energy [J]"])


if __name__ == "__main__":
    unittest.main()
