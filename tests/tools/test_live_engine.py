"""The engine of live figures, compiled to WebAssembly: every scene in node gives the native program's motion."""

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


def built() -> Path:
    """Builds it; skips the test without a compiler for it."""
    if not all(need.there() for need in LIVE_NEEDS) or not shutil.which("node"):
        raise unittest.SkipTest("emscripten or node is not installed")
    return program_of_pages()


def numbers(packed: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(packed), "<f4").astype(float)


class LiveEngine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        listed = subprocess.run([native(), "scenes", "--json"], capture_output=True, text=True, check=True)
        cls.scenes = [scene["name"] for scene in json.loads(listed.stdout)["scenes"]]
        done = subprocess.run(["node", IN_NODE, built(), str(STEPS)],
                              input="\n".join(cls.scenes), capture_output=True, text=True, check=True)
        cls.web = {(line := json.loads(text))["scene"]: line["text"] for text in done.stdout.splitlines()}

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


if __name__ == "__main__":
    unittest.main()
