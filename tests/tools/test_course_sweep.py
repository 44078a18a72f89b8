"""./course run --plot and --sweep."""

import csv
import io
import json
import math
import re
import shlex
import unittest

from sandbox import ROOT, Sandbox, all_exercises

from curves import matching
from errors import BadInput
from sweep import Result, as_table, orders

_BLOCK = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
STILL = """#include "01_leapfrog/leapfrog.hpp"
namespace spook {
Vec3 kick(const Vec3& v, const Vec3&, double, double) { return v; }
}  // namespace spook
"""


def result(value: str, error: float | None, **more) -> Result:
    return Result(value, {"scene": "s", "error": {"name": "gap", "unit": "m", "value": error}, "residual": None,
                          "us_per_step": 1.0} | more, "")


class Orders(unittest.TestCase):
    def test_of_powers(self):
        for power in (1, 2, 4, -1):
            found = orders([result(h, 3 * eval(h) ** power) for h in ("1/10", "1/20", "1/80")])
            self.assertIsNone(found[0])
            for order in found[1:]:
                self.assertAlmostEqual(order, power, 12)

    def test_where_there_is_none(self):
        for first, second in ((result("1", 1), result("2", 0)), (result("a", 1), result("2", 1)),
                              (result("1", None), result("2", 1)), (result("1", 1), Result("2", None, "blown up")),
                              (result("0", 1), result("2", 1)), (result("1", 1), result("1.0", 1))):
            self.assertEqual(orders([first, second]), [None, None])
        self.assertEqual(orders([]), [])

    def test_in_the_table(self):
        table = as_table("h", [result("0.1", 8), result("0.05", 2), Result("0.01", None, "blown up: body 3")])
        self.assertIn("s: gap [m]", table)
        lines = [line.split() for line in table.splitlines()]
        self.assertIn(["0.05", "2", "4", "2.00", "1"], lines)
        self.assertIn("h = 0.01: blown up: body 3", table)
        self.assertNotIn("order", as_table("start", [result("a", 8), result("b", 2)]))


class Columns(unittest.TestCase):
    COLUMNS = ["time [s]", "gap 0 [m]", "gap 1 [m]", "gaps", "energy [J]"]

    def test_by_name_and_by_their_first_word(self):
        self.assertEqual(matching(self.COLUMNS, "gap"), ["gap 0 [m]", "gap 1 [m]"])
        self.assertEqual(matching(self.COLUMNS, "gap 1"), ["gap 1 [m]"])
        self.assertEqual(matching(self.COLUMNS, "gaps"), ["gaps"])

    def test_what_there_is_not(self):
        for wanted in ("ga", "time", "gap 2", ""):
            with self.assertRaisesRegex(BadInput, "gap 0, gap 1, gaps, energy"):
                matching(self.COLUMNS, wanted)


class Lessons(unittest.TestCase):
    """What a student copies from a lesson runs: each command, for no time at all."""

    def test_the_commands_of_all_lessons(self):
        box = Sandbox(built=True)
        self.addCleanup(box.close)
        commands = [(lesson.parent.name, line) for lesson in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md"))
                    for block in _BLOCK.findall(lesson.read_text(encoding="utf-8"))
                    for line in block.splitlines() if line.startswith("./course run ")]
        self.assertGreater(len(commands), 40)
        for chapter, line in commands:
            with self.subTest(chapter, line=line):
                _, _, *words = shlex.split(line, comments=True)
                words = [word for word in words if word != "--mine"]
                if "--time" in words:
                    del words[words.index("--time"):words.index("--time") + 2]
                result = box.course("run", *words, "--time", "0")
                said = result.stderr.removeprefix("sweep ...\n")  # what takes long says that it is at work
                self.assertEqual((result.returncode, said), (0, ""))


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")

    def tearDown(self):
        self.box.restore(self.kick)

    def run_scene(self, *words: str, code: int = 0) -> str:
        result = self.box.course("run", *words)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        if "--json" not in words:
            self.assertLessEqual(max(map(len, result.stdout.splitlines()), default=0), 80)
        return result.stdout

    def drawn(self, name: str) -> dict:
        base = self.box.root / "build/plots/run" / name
        self.assertEqual(base.with_suffix(".png").read_bytes()[:4], b"\x89PNG")
        return json.loads(base.with_suffix(".json").read_text())

    def test_a_column_over_time(self):
        said = self.run_scene("orbit", "--h", "0.1", "--csv", "orbit.csv", "--plot", "energy,x")
        self.assertIn("error", said)
        self.assertIn("figure: build/plots/run/orbit_energy_x.png", said)
        rows = list(csv.reader(io.StringIO((self.box.root / "orbit.csv").read_text())))
        energy, x = self.drawn("orbit_energy_x")["parts"]
        self.assertEqual((energy["name"], x["name"]), ("energy [J]", "x [m]"))
        k = rows[0].index("x [m]")
        self.assertEqual(x["curves"], [{"label": "", "time": [float(row[0]) for row in rows[1:]],
                                        "values": [float(row[k]) for row in rows[1:]]}])

    def test_all_columns_of_a_word(self):
        self.run_scene("stack", "--set", "bodies=3", "--plot=gap", "--time", "0.1")
        (gap,) = self.drawn("stack_gap")["parts"]
        self.assertEqual((gap["name"], [curve["label"] for curve in gap["curves"]]),
                         ("gap [m]", ["gap 0", "gap 1", "gap 2"]))

    def test_a_sweep_has_errors_and_orders(self):
        call = ["orbit", "--sweep", "h=1/60,1/120,1/240"]
        runs = json.loads(self.run_scene(*call, "--json"))["runs"]
        self.assertEqual([run["value"] for run in runs], ["1/60", "1/120", "1/240"])
        alone = json.loads(self.run_scene("orbit", "--h", "1/120", "--json"))
        self.assertEqual(runs[1]["error"], alone["error"])
        self.assertIsNone(runs[0]["observed_order"])
        for run in runs[1:]:  # leapfrog's, whose next term is (hω)² of it, and ω of the nearest point is below 4
            self.assertAlmostEqual(run["observed_order"], 2, delta=2 * (4 / 60) ** 2 / math.log(2))
        table = self.run_scene(*call)
        for part in ("semi-major axis", "order", "2.00", "1/240"):
            self.assertIn(part, table)

    def test_a_sweep_of_parameters_and_switches(self):
        runs = json.loads(self.run_scene("orbit", "--set", "start=unshifted", "eccentricity=0.1", "--sweep",
                                         "eccentricity=0.2,0.3", "--json"))["runs"]
        self.assertEqual([(run["parameters"]["eccentricity"], run["parameters"]["start"]) for run in runs],
                         [(0.2, "unshifted"), (0.3, "unshifted")])
        runs = json.loads(self.run_scene("stack", "--time", "0.1", "--sweep", "warm_start=off,on", "--json"))["runs"]
        self.assertEqual([run["warm_start"] for run in runs], [False, True])

    def test_a_sweep_that_is_drawn(self):
        self.run_scene("resting_sphere", "--time", "0.5", "--sweep", "d=2,5", "--plot", "gap")
        (gap,) = self.drawn("resting_sphere_gap")["parts"]
        self.assertEqual([curve["label"] for curve in gap["curves"]], ["d = 2", "d = 5"])
        self.assertNotEqual(gap["curves"][0]["values"], gap["curves"][1]["values"])

    def test_with_functions_of_a_student(self):
        self.box.file(self.kick).write_text(STILL)
        call = ["free_fall", "--sweep", "h=1/60,1/120", "--plot", "z", "--json"]
        runs = json.loads(self.run_scene(*call, "--mine"))["runs"]
        self.assertTrue(all(run["error"]["value"] > 0.1 for run in runs))  # what is never kicked does not fall
        values = self.drawn("free_fall_z")["parts"][0]["curves"][0]["values"]
        self.assertLess(max(values) - min(values), 1e-9)
        self.assertTrue(all(run["error"]["value"] < 1e-9 for run in json.loads(self.run_scene(*call))["runs"]))

    def test_a_run_that_blows_up_is_a_line_of_the_table(self):
        said = self.run_scene("oscillator", "--time", "2000", "--sweep", "h=0.1,3", code=1)  # 2/ω is 2 s
        self.assertRegex(said, r"\n0\.1 +[0-9.e-]+ ")
        self.assertRegex(said, r"\n3 +lost")
        self.assertRegex(said, r"\nh = 3: .*finite")

    def test_what_makes_no_sense(self):
        for words, told in ((["orbit", "--plot", "enrgy"], ["'enrgy'", "there are x, y, energy, angular momentum"]),
                            (["orbit", "--plot"], ["--plot needs a value"]), (["orbit", "--plot", "x,"], ["'x,'"]),
                            (["orbit", "--plot", "x", "--plot", "y"], ["--plot is given twice"]),
                            (["--plot", "x"], ["a scene is missing"]), (["obrit", "--plot", "x"], ["orbit"]),
                            (["orbit", "--h", "0", "--plot", "x"], ["h must be positive"]),
                            (["orbit", "--sweep", "h"], ["NAME=VALUE", "'h'"]),
                            (["orbit", "--sweep", "h=1,,2"], ["1,,2"]),
                            (["orbit", "--sweep", "h=0.1,0.1"], ["twice"]),
                            (["orbit", "--sweep", "h=0.1,0"], ["h must be"]),
                            (["orbit", "--sweep", "hh=0.1,1"], ["hh"]),
                            (["stack", "--sweep", "warm_start=1,2"], ["'2'"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--csv", "a.csv"], ["--csv is for one run"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--record=a"], ["--record is for one run"])):
            self.box.assert_refused(self, ["run", *words], told)

    def test_help_has_them(self):
        said = self.run_scene("--help")
        for option in ("--iterations", "--mine", "--plot", "--sweep"):
            self.assertIn(option, said)


if __name__ == "__main__":
    unittest.main()
