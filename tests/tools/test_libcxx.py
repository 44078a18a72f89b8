"""The build of macOS, as near as Linux comes to it: clang with its own library, libc++.

All that `./course test` builds on a Mac is built, and its compiled tests pass. An orbit has the error of the second
order. Skipped where clang++, libc++ or the sources of GoogleTest are not installed.
"""

import json
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from sandbox import ROOT

from paths import BUILD
from tree import Tree, jobs

PACKAGES = "clang, libc++-dev, libc++abi-dev and googletest"
GOOGLETEST = Path("/usr/src/googletest")
FLAGS = "-stdlib=libc++"
TARGETS = ["fast", "spook", "plot_energy"]  # plot_energy needs what every experiment does


def run(*command) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def has_libcxx() -> bool:
    if not shutil.which("clang++"):
        return False
    return subprocess.run(["clang++", FLAGS, "-x", "c++", "-", "-o", os.devnull], text=True, capture_output=True,
                          input="#include <vector>\nint main() { return std::vector<int>(0).size(); }\n").returncode == 0


def googletest() -> Path:
    """Builds GoogleTest for this library. An installed one is compiled for GCC's library, which has other strings."""
    folder = BUILD / "libcxx-googletest"
    prefix = folder / "installed"
    if not prefix.exists():
        settings = ("-DCMAKE_CXX_COMPILER=clang++", f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DBUILD_GMOCK=OFF")
        for command in (("cmake", "-G", "Ninja", "-S", GOOGLETEST, "-B", folder, *settings),
                        ("cmake", "--build", folder, "-j", jobs()),
                        ("cmake", "--install", folder, "--prefix", prefix)):
            done = run(*command)
            assert done.returncode == 0, done.stdout + done.stderr
    return prefix


class Libcxx(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not has_libcxx() or not GOOGLETEST.is_dir():
            raise unittest.SkipTest(f"clang with libc++ is not tried without {PACKAGES}")
        cls.tree = Tree("libcxx")
        if not cls.tree.setting("GTest_ROOT"):
            cls.tree.configure(f"-DGTest_ROOT={googletest()}")
        built = cls.tree.build(TARGETS, "building with clang and libc++", keep_going=True)
        assert built.ok, "\n".join(line for line in built.output.splitlines() if "error" in line or "FAILED" in line)

    def test_the_reference_the_engine_and_the_program_pass_their_tests(self):
        done = run("ctest", "--test-dir", self.tree.path, "-L", "^fast$", "-E", r"^tools[.]", "-j", jobs(),
                   "--no-tests=error", "--output-on-failure")
        self.assertEqual(done.returncode, 0, done.stdout[-20000:])
        for name in ("reference.01_leapfrog", "engine.0", "mechanisms", "stability", "spook.program"):
            self.assertRegex(done.stdout, rf"{re.escape(name)} \.+ +Passed")

    def test_the_program_computes_to_second_order(self):
        errors = []
        for h in ("1/60", "1/120"):
            done = run(self.tree.program("spook"), "run", "orbit", "--time", "2", "--h", h, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            errors.append(json.loads(done.stdout)["error"]["value"])
        # The next term is less by (ω h)²: at the nearest point of this orbit ω is 1/0.5^1.5 = 2.8 rad/s, so by 0.002.
        self.assertAlmostEqual(errors[0] / errors[1], 4, delta=4 * 0.01)


class Preset(unittest.TestCase):
    def test_it_builds_what_check_builds_by_another_library(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        flags = {preset["name"]: preset.get("cacheVariables", {}).get("CMAKE_CXX_FLAGS", "") for preset in presets}
        self.assertEqual(flags["libcxx"], f"{FLAGS} {flags['check'].replace(' -g1', '')}")


if __name__ == "__main__":
    unittest.main()
