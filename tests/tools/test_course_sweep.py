"""./course run --plot and --sweep."""

import contextlib
import csv
import hashlib
import importlib.util
import io
import json
import math
import random
import re
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path
from statistics import NormalDist
from unittest import mock

from page_commands import commands, pages, words_of
from sandbox import ROOT, Sandbox, all_exercises

import arguments
import grid
import plot
import run
import runs
from beside import require_distinct, require_free, require_single, with_changed
from curves import matching
from errors import BadInput, CourseError
from extras import taken
from merging import Shard, merged, require_other
from run import Shared
from sweep import RESULTS, Result, Sweep, as_json, as_text

_LESSONS = sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md"))
_BLOCK = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
STILL = """#include "01_leapfrog/leapfrog.hpp"
namespace spook {
Vec3 kick(const Vec3& v, const Vec3&, double, double) { return v; }
}  // namespace spook
"""


def result(point: dict[str, str], error: float | None, **more) -> Result:
    return Result(point, {"scene": "s", "error": {"name": "gap", "unit": "m", "value": error}, "residual": None,
                          "state": {"name": "sound", "reason": ""}, "us_per_step": 1.0, "row_updates": 2, "steps": 3,
                          "time": 1.0, "h": 0.5} | more, "")


def row(error: float | None, state: str = "sound", end: float | None = None, round_off: float = 0, **point) -> grid.Row:
    return grid.Row(point, error, state, end, round_off)


def of_h(*values: str, error=lambda h: h) -> Sweep:
    return Sweep({"h": values}, [result({"h": h}, error(eval(h))) for h in values], [])


class Orders(unittest.TestCase):
    def test_of_powers(self):
        for power in (1, 2, 4, -1):
            found = [order for _, order in of_h("1/10", "1/20", "1/80", error=lambda h: 3 * h ** power).orders()]
            self.assertIsNone(found[0])
            for order in found[1:]:
                self.assertAlmostEqual(order, power, 12)

    def test_where_there_is_none(self):
        nothing = [(None, None)] * 2
        for first, second in ((("1", 1), ("2", 0)), (("a", 1), ("2", 1)), (("1", None), ("2", 1)), (("0", 1), ("2", 1)),
                              (("1", math.nan), ("2", 1)), (("1", 1), ("1.0", 1)), (("inf", 1), ("2", 1))):
            rows = [row(error, k=value) for value, error in (first, second)]
            self.assertEqual(grid.orders(rows, ["k"]), nothing)
        self.assertEqual(grid.orders([], ["h"]), [])
        rows = [row(n, bodies=str(n)) for n in (1, 2)]  # an error goes with a power of h, d and k alone
        self.assertEqual(grid.orders(rows, ["bodies"]), nothing)

    def test_a_lost_run_has_none(self):
        for states in (("lost", "sound"), ("sound", "lost"), ("sound", "blew up")):
            rows = [row(error, state, h=h) for h, error, state in zip(("2", "1"), (4, 1), states)]
            self.assertEqual(grid.orders(rows, ["h"]), [(None, None)] * 2, states)
        rows = [row(error, "unsolved", h=h) for h, error in (("2", 4), ("1", 1))]
        self.assertEqual(grid.orders(rows, ["h"])[1], (4, 2))

    def test_errors_at_round_off_have_none(self):
        floor = grid.round_off(100)  # 4 ε a step
        self.assertAlmostEqual(floor, 8.9e-14, delta=1e-15)
        rows = [row(error, round_off=floor, h=h) for h, error in (("4", 1e-3), ("2", 1e-14), ("1", 1e-15))]
        self.assertEqual(grid.orders(rows, ["h"]), [(None, None)] * 3)
        self.assertEqual(grid.fits(rows, ["h"]), [])
        said = as_text(of_h("1/10", "1/20", "1/40", error=lambda h: 1e-16 / h))
        self.assertIn("no order where an error is at round-off", said)
        self.assertNotIn("order p", said)
        self.assertNotIn("order of all runs", said)
        seeds = [row(error, round_off=floor, h=h, seed=k) for h, error in (("2", 1e-14), ("1", 2e-14)) for k in "12"]
        self.assertEqual(grid.mean_orders(grid.means(seeds, ["h", "seed"])), [None, None])

    def test_runs_that_end_at_different_times_have_none(self):
        ends = {"0.3": 0.9, "0.15": 1.05, "0.07": 0.98}
        rows = [row(grid.number(h), end=end, h=h) for h, end in ends.items()]
        self.assertEqual(grid.orders(rows, ["h"]), [(None, None)] * 3)
        self.assertEqual(grid.fits(rows, ["h"]), [])
        seeds = [row(grid.number(h), end=end, h=h, seed=k) for h, end in ends.items() for k in "12"]
        self.assertEqual(grid.mean_orders(grid.means(seeds, ["h", "seed"])), [None] * 3)
        said = as_text(Sweep({"h": tuple(ends)}, [result({"h": h}, eval(h), time=end) for h, end in ends.items()], []))
        self.assertIn("no order between runs that end at different times, from 0.9 to 1.05 s", " ".join(said.split()))
        self.assertNotIn("order p", said)
        alike = [row(h, end=7 * (1 / 7) + h * 1e-15, h=h) for h in (2, 1)]  # up to round-off
        self.assertAlmostEqual(grid.orders(alike, ["h"])[1][1], 1, 12)
        swept = [row(h * time, end=time, h=h, time=time) for time in (1, 2) for h in (2, 1)]  # on purpose
        self.assertEqual([order is None for _, order in grid.orders(swept, ["time", "h"])], [True, False] * 2)
        self.assertIsNone(grid.uneven(swept, ["time", "h"]))

    def test_of_a_product_compare_what_differs_in_one_value(self):
        axes = {"h": ["0.1", "0.05"], "scale": ["1", "7"], "d": ["2", "3"]}
        rows = [row(float(point["scale"]) * float(point["d"]) * float(point["h"]) ** 2, **point)
                for point in grid.combinations(axes)]
        found = grid.orders(rows, axes)
        self.assertEqual(found[:4], [(None, None)] * 4)
        for ratio, order in found[4:]:
            self.assertAlmostEqual(ratio, 4, 12)
            self.assertAlmostEqual(order, 2, 12)

    def test_in_the_table(self):
        swept = of_h("0.1", "0.05", error=lambda h: 800 * h ** 2)
        lost = Result({"h": "0.01"}, None, "blown up: body 3")
        table = as_text(Sweep({"h": ("0.1", "0.05", "0.01")}, [*swept.results, lost], []))
        self.assertIn("s: gap [m]", table)
        lines = [line.split() for line in table.splitlines()]
        self.assertIn(["0.05", "2", "4", "2.00", "1"], lines)
        self.assertIn("h = 0.01: blown up: body 3", table)
        starts = Sweep({"start": ("a", "b")}, [result({"start": "a"}, 8), result({"start": "b"}, 2)], [])
        self.assertNotIn("order", as_text(starts))

    def test_a_sweep_without_a_run_has_names_and_says_what_was_skipped(self):
        for axes in ({"a": ("1",)}, {"h": ("1",), "a": ("2",)}, {"time": ("1",)}):
            point = {name: values[0] for name, values in axes.items()}
            self.assertEqual(Sweep(axes, [], []).names(), list(Sweep(axes, [result(point, 1.0)], []).table()[0]))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "a.csv")
            grid.write_csv(str(file), [], ["a", "h"])
            self.assertEqual(file.read_text(), "a,h\n")
        skipped = [Result({"a": "1"}, None, "no a")]
        self.assertEqual(as_text(Sweep({"a": ("1",)}, [], skipped)), "1 combination skipped: no a")
        said = as_text(Sweep({"a": ("1", "2")}, [Result({"a": "2"}, None, "blew up")], skipped))
        self.assertEqual(said, "a = 2: blew up\n\n1 combination skipped: no a")

    def test_a_run_that_blew_up_keeps_its_step(self):
        for point, others, h in (({"h": "1/2"}, [], 0.5), ({"d": "1"}, [result({"d": "2"}, 1.0)], 0.5), ({"d": "1"}, [], None)):
            cells = Sweep({name: (value,) for name, value in point.items()},
                          [Result(point, None, "blew up"), *others], []).table()[0]
            self.assertEqual((cells["h"], cells["why"]), (h, "blew up"))

    def test_a_sound_run_without_an_answer_is_not_lost(self):
        table = as_text(Sweep({"d": ("2",)}, [result({"d": "2"}, None)], []))
        self.assertRegex(table, r"\n2 +none")
        self.assertNotIn("lost", table)


class Grid(unittest.TestCase):
    def test_combinations_are_all_and_the_last_name_changes_fastest(self):
        self.assertEqual(grid.combinations({"a": [1, 2], "b": "xy"}),
                         [{"a": 1, "b": "x"}, {"a": 1, "b": "y"}, {"a": 2, "b": "x"}, {"a": 2, "b": "y"}])

    def test_a_value_is_refused_if_no_combination_takes_it(self):
        points = grid.combinations({"a": ["1", "2"], "b": ["x", "y"]})
        self.assertEqual(grid.impossible_value(points, ["", "", "", "no"]), "")  # one of four is skipped
        self.assertEqual(grid.impossible_value(points, ["", "no y", "", "nor here"]),
                         "b=y is refused in every combination: no y")
        self.assertEqual(grid.impossible_value(points, [""] * 4), "")
        self.assertEqual(grid.impossible_value(points, ["no"] * 4), "no")  # it is not the value's fault

    def test_a_swept_name_keeps_apart_from_a_result_of_its_name(self):
        """The printed table, its means and its fits, the file and what is read from it."""
        for name in (*RESULTS, "ratio", "runs", "lost", "unsolved", "scene", "point", "seconds_of_h"):
            points = grid.combinations({name: ("5", "10"), "h": ("1/10", "1/20", "1/40"), "seed": ("1", "2")})
            errors = [float(point[name]) * grid.number(point["h"]) ** 2 for point in points]
            swept = Sweep({name: ("5", "10"), "h": ("1/10", "1/20", "1/40"), "seed": ("1", "2")},
                          [result(point, error, h=grid.number(point["h"])) for point, error in zip(points, errors)], [])
            with self.subTest(name):
                self.assertEqual([mean.point[name] for mean in swept.means()], ["5"] * 3 + ["10"] * 3)
                self.assertEqual([fit.point for fit in swept.fits()], [{name: "5"}, {name: "10"}])
                self.assertEqual([round(fit.order, 9) for fit in swept.fits()], [2, 2])
                cells = swept.table()
                column = f"{name}=" if name in RESULTS else name
                self.assertEqual([row[column] for row in cells], [point[name] for point in points])
                self.assertEqual([row["error"] for row in cells], errors)
                heads = [re.split(" {2,}", line) for line in as_text(swept).splitlines()
                         if re.match(f"{name}=? +(h|runs)  ", line)]
                self.assertEqual([len(head) - len(set(head)) for head in heads], [0] * 3, heads)

    def test_values_are_the_same_as_typed(self):
        for one, other in (("1/60", 1 / 60), ("1e-3", 0.001), (Fraction(1, 60), "1/60"), ("direct", "direct"), (True, True)):
            self.assertTrue(grid.same(one, other), (one, other))
        for one, other in (("1/60", 1 / 61), ("on", 1), ("direct", "auto"), (True, "1")):
            self.assertFalse(grid.same(one, other), (one, other))

    def test_students_distribution_against_its_closed_forms(self):
        # ν = 1: P = 2/π atan t. ν = 2: P = t/√(2 + t²). ν -> ∞: the normal distribution, to O(1/ν).
        self.assertAlmostEqual(grid.student_t(1), math.tan(0.95 * math.pi / 2), 8)
        self.assertAlmostEqual(grid.student_t(2), math.sqrt(2 * 0.95 ** 2 / (1 - 0.95 ** 2)), 8)
        normal = NormalDist().inv_cdf(0.975)
        self.assertAlmostEqual(grid.student_t(10 ** 6), normal, delta=normal * (normal ** 2 + 1) / 4e6 + 1e-6)

    def test_an_interval_holds_the_mean_as_often_as_it_says(self):
        draws = random.Random(1)
        trials, held = 1000, 0
        for _ in range(trials):
            rows = [row(draws.gauss(3, 2), seed=k) for k in range(4)]
            (mean,) = grid.means(rows, ["seed"])
            held += abs(mean.mean - 3) <= mean.half_width
        # Four standard deviations of a binomial count: one in 16,000 seeds is further off.
        self.assertAlmostEqual(held, 950, delta=4 * math.sqrt(trials * 0.95 * 0.05), msg="seed 1")

    def test_means_leave_out_what_has_no_error(self):
        rows = [row(1.0, a="x", seed="1"), row(None, a="x", seed="2"), row(math.nan, a="y", seed="1"),
                row(3.0, a="x", seed="3")]
        x, y = grid.means(rows, ["a", "seed"])
        self.assertEqual((x.point, x.runs, x.mean), ({"a": "x"}, 2, 2.0))
        self.assertAlmostEqual(x.half_width, grid.student_t(1) * math.sqrt(2) / math.sqrt(2), 8)
        self.assertEqual((y.runs, y.mean, y.half_width), (0, None, None))

    def test_means_leave_out_lost_runs_and_count_unsolved_ones(self):
        states = {"1": "sound", "2": "lost", "3": "unsolved", "4": "blew up"}
        rows = [row(float(seed), state, seed=seed) for seed, state in states.items()]
        (mean,) = grid.means(rows, ["seed"])
        self.assertEqual((mean.runs, mean.unsolved, mean.lost, mean.mean), (2, 1, 2, 2.0))
        state = {"2": {"state": {"name": "lost", "reason": "r"}}}
        swept = Sweep({"seed": tuple("123")}, [result({"seed": k}, float(k), **state.get(k, {})) for k in "123"], [])
        said = as_text(swept)
        self.assertIn("lost runs are left out", said)
        self.assertIn(["2", "2", "13", "1"], [line.split() for line in said.splitlines()])  # runs, mean, ±, lost
        self.assertEqual(json.loads(as_json(swept))["means"][0]["lost"], 1)


    def test_means_have_orders_too(self):
        rows = [row(value * float(h), h=h, seed=k) for h in ("0.2", "0.1") for k, value in enumerate((1, 3))]
        found = grid.means(rows, ["h", "seed"])
        first, second = grid.mean_orders(found)
        self.assertIsNone(first)
        self.assertAlmostEqual(second, 1, 12)
        self.assertEqual(grid.mean_orders([]), [])

    def test_an_order_is_fitted_to_all_runs_and_its_interval_holds_as_often_as_it_says(self):
        steps = ("1/10", "1/20", "1/40", "1/80")
        exact = [row(3 * grid.number(h) ** 2, h=h, a=a) for a in "xy" for h in steps]
        exact.append(row(1e99, "lost", h="1", a="x"))
        self.assertEqual([(fit.point, fit.runs) for fit in grid.fits(exact, ["h", "a"])], [({"a": "x"}, 4), ({"a": "y"}, 4)])
        for fit in grid.fits(exact, ["h", "a"]):
            self.assertAlmostEqual(fit.order, 2, 12)
            self.assertLess(fit.half_width, 1e-12)
        self.assertEqual(grid.fits(exact[:2], ["h", "a"]), [])  # two values give no uncertainty
        self.assertEqual(grid.fits([row(1, bodies="2")] * 3, ["bodies"]), [])
        draws, trials, held = random.Random(2), 1000, 0
        for _ in range(trials):
            rows = [row(grid.number(h) * math.exp(draws.gauss(0, 0.5)), h=h, seed=k) for h in steps for k in range(2)]
            (fit,) = grid.fits(rows, ["h", "seed"])
            held += abs(fit.order - 1) <= fit.half_width
        # Four standard deviations of a binomial count: one in 16,000 seeds is further off.
        self.assertAlmostEqual(held, 950, delta=4 * math.sqrt(trials * 0.95 * 0.05), msg="seed 2")
        said = as_text(of_h("1/10", "1/20", "1/40", error=lambda h: 3 * h ** 2))
        self.assertIn("order of all runs", said)
        self.assertEqual(json.loads(as_json(of_h("0.4", "0.2", "0.1")))["fits"][0]["runs"], 3)
        self.assertNotIn("-0.00", as_text(of_h("0.2", "0.1", error=lambda h: 1 + 1e-5 / h)))


class Words(unittest.TestCase):
    def test_lists_of_several_options(self):
        extras, words = taken(["pile", "--set", "bodies=5,10", "mu=0.3", "--sweep", "seed=1,2", "h=1/60,1/120", "--json"])
        self.assertEqual(extras.sweep, {"bodies": ("5", "10"), "seed": ("1", "2"), "h": ("1/60", "1/120")})
        self.assertEqual(words, ["pile", "--set", "mu=0.3", "--json"])
        self.assertEqual(taken(["pile", "--set=bodies=5,10", "--shard", "2/3"])[0].shard, (2, 3))

    def test_a_parameter_goes_before_an_option_of_its_name(self):
        words = ["pile", "--set", "seed=7", "mu=1"]
        self.assertEqual(with_changed(words, "seed", "3", {"seed", "mu"}), ["pile", "--set", "mu=1", "--set", "seed=3"])
        self.assertEqual(with_changed(["orbit"], "seed", "3", {"m"}), ["orbit", "--seed", "3"])

    def test_a_value_of_what_is_swept_has_no_effect(self):
        for name, words, parameters in (("h", ["s", "--h", "1/30"], {"m"}), ("h", ["s", "--h=1/30"], ()),
                                        ("row_order", ["s", "--row-order", "up"], ()),
                                        ("warm_start", ["s", "--warm-start"], ()),
                                        ("seed", ["s", "--set", "mu=1", "seed=2"], {"seed", "mu"}),
                                        ("seed", ["s", "--set=seed=2"], {"seed"})):
            with self.subTest(words), self.assertRaisesRegex(BadInput, f"{name} is swept, so .* has no effect"):
                require_free(words, name, parameters)
        require_free(["s", "--seed", "3", "--set", "mu=1"], "seed", {"seed", "mu"})  # the option is that of a random order
        require_free(["s", "--time", "3"], "h", ())

    def test_a_list_is_for_a_sweep(self):
        for option in ("h", "solver", "friction-model", "row-order", "tangents", "engine", "integrator-order", "accuracy"):
            for words in (["s", f"--{option}", "a,b"], ["s", f"--{option}=a,b"]):
                with self.assertRaisesRegex(BadInput, f'{option} must be one value, but is "a,b": a sweep of {option} takes'):
                    require_single(words)
        require_single(["s", "--h", "1/60", "--csv", "a,b.csv", "--set", "m=1"])

    def test_a_misspelled_option_is_told_with_the_nearest_name(self):
        for name, words in (("iteratons", "did you mean iterations?"), ("solvr", "did you mean solver?"),
                            ("rato", "did you mean ratio?"), ("zzz", "there are: ratio, ")):
            with self.assertRaisesRegex(BadInput, f"'{name}' is neither a parameter of stack nor an option of run; {re.escape(words)}"):
                with_changed(["stack"], name, "3", {"ratio"})


    def test_an_option_is_swept_under_one_name(self):
        for names, told in ((["max_parts", "max-parts"], "max-parts is swept twice, also as max_parts"),
                            (["warm-start", "h", "warm_start"], "warm_start is swept twice, also as warm-start"),
                            (["h", "h"], "h is swept twice$")):
            with self.subTest(names), self.assertRaisesRegex(BadInput, f"^run: {told}"):
                require_distinct(names, {"m"})
        require_distinct(["max_parts", "max-parts"], {"max_parts"})  # a parameter, and an option
        require_distinct(["my_a", "my-a"], {"my_a", "my-a"})


class Merging(unittest.TestCase):
    CALL = ["s", "--sweep", "a=1,2", "--time", "1", "--set", "m=2", "g=3"]

    def shard(self, *words: str, file: str = "1.csv", skipped: tuple = (), **sha256: str) -> Shard:
        cells = [{name: "" if value is None else str(value) for name, value in row.items()}
                 for row in Sweep({"a": ("1",)}, [result({"a": "1"}, 2.0)], []).table()]
        manifest = {"command": ["./course", "run", *words], "sha256": {"spook": "p"} | sha256}
        manifest["skipped"] = [{"point": point, "why": why} for point, why in skipped]
        return Shard(file, cells, manifest, "t")

    def merge(self, *shards: Shard, call: list[str] = CALL) -> Sweep:
        extras, words = taken(call)
        return merged(words, extras, shards)

    def test_tables_of_the_same_call_are_joined_whatever_its_order(self):
        other = self.shard("s", "--set", "g=3", "--time=1", "--sweep", "a=1", "--set", "m=2", "--json", "--csv", "x.csv",
                           skipped=[({"a": "2.0"}, "no a")])
        sweep = self.merge(self.shard(*self.CALL, "--shard", "1/2"), other)
        self.assertEqual([one.run["error"]["value"] for one in sweep.results], [2.0])
        self.assertEqual(sweep.skipped, [Result({"a": "2"}, None, "no a")])
        self.assertEqual((sweep.results[0].run["steps"], sweep.results[0].run["row_updates"]), (3, 2))
        self.assertIsInstance(sweep.results[0].run["steps"], int)

    def test_what_is_in_no_table_is_an_error(self):
        call = ["s", "--sweep", "a=1,2,3,4", *self.CALL[3:]]
        with self.assertRaisesRegex(CourseError, "--merge lacks 2 of 4 combinations, the first with a = 3") as caught:
            self.merge(self.shard(*call, skipped=[({"a": "2"}, "no a")]), call=call)
        self.assertEqual(caught.exception.code, 1)

    def test_a_manifest_of_before_it_had_what_was_skipped(self):
        shard = self.shard(*self.CALL)
        del shard.manifest["skipped"]
        self.assertEqual(len(self.merge(shard, call=["s", "--sweep", "a=1", *self.CALL[3:]]).results), 1)

    def test_a_merged_table_is_not_replaced(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file in ("1.csv", "2.csv", "2.csv.manifest.json", "old.csv"):
                (folder / file).write_text("")
            (folder / "soft.csv").symlink_to("2.csv")
            (folder / "hard.csv").hardlink_to(folder / "1.csv")
            (folder / "here").symlink_to(".")
            tables = [str(folder / "1.csv"), str(folder / "2.csv")]
            for file in ("1.csv", "2.csv", "./2.csv", "here/1.csv", "soft.csv", "hard.csv", "2.csv.manifest.json"):
                with self.subTest(file), self.assertRaisesRegex(BadInput, f'--csv must be another .*, but is "{name}/{file}"'):
                    require_other(f"{name}/{file}", tables)
            for file in ("old.csv", "new.csv"):
                require_other(f"{name}/{file}", tables)

    def test_tables_of_other_calls_are_refused(self):
        for words, told in ((["t", *self.CALL[1:]], "with the scene t, but this call has s"),
                            ([*self.CALL, "--solver", "direct"], "with --solver direct, but this call has none"),
                            ([*self.CALL[:3], "--time", "2", "--set", "m=2", "g=3"], "with --time 2, but this call has 1"),
                            ([*self.CALL[:-1], "g=4"], "with --set g=4 m=2, but this call has g=3 m=2"),
                            ([*self.CALL, "--mine"], "with --mine on, but this call has none"),
                            (["s", "--sweep", "a=1", "b=1,2", *self.CALL[3:]], "with swept names a b, but this call has a")):
            with self.subTest(words), self.assertRaisesRegex(BadInput, re.escape(told)):
                self.merge(self.shard(*self.CALL), self.shard(*words, file="2.csv"))
        with self.assertRaisesRegex(BadInput, '"2.csv" and "1.csv" were computed by different programs'):
            self.merge(self.shard(*self.CALL), self.shard(*self.CALL, file="2.csv", spook="q"))


class OneProgram(unittest.TestCase):
    def test_what_changes_between_the_runs_of_a_sweep_ends_it(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder, "spook")
            program.write_text("one")
            shared = Shared([program, Path(folder, "none")])
            self.assertEqual(shared.hashes, {str(program): hashlib.sha256(b"one").hexdigest()})
            shared.require_unchanged()
            program.write_text("another")
            with self.assertRaisesRegex(CourseError, "has changed since the first run"):
                shared.require_unchanged()

    def test_a_sweep_builds_its_program_once(self):
        with tempfile.TemporaryDirectory() as folder:
            spook = Path(folder, "spook")
            spook.write_text("#!/bin/sh\n[ \"$1\" = scenes ] && exit 1\n"
                             f"echo '{json.dumps(result({}, 1.0).run)}'\n"
                             'while [ $# -gt 0 ]; do [ "$1" = --csv ] && echo "time [s]" > "$2"; shift; done; exit 0\n')
            spook.chmod(0o755)
            with mock.patch.object(run, "program", return_value=spook) as built, \
                    contextlib.redirect_stdout(io.StringIO()) as out:
                self.assertEqual(run.run(["s", "--sweep", "h=0.1,0.2", "--json"]), 0)
        self.assertEqual(built.call_count, 1)
        self.assertEqual(len(json.loads(out.getvalue())["runs"]), 2)


class Strict(unittest.TestCase):
    def sweep(self, *words: str) -> tuple[int, list[dict]]:
        """Returns the exit code and the runs of a sweep: one ends sound, one unsolved, and one by a signal."""
        runs_of = {"a=1": ("sound", 0), "a=2": ("unsolved", 1)}

        def start(asked, call):
            if "--time" in asked:  # for its columns
                Path(asked[asked.index("--csv") + 1]).write_text("time [s]\n")
                return call(["true"])
            if "a=3" in asked:
                return call(["sh", "-c", "kill -9 $$"])
            state, code = next(run for name, run in runs_of.items() if name in asked)
            run = result({}, 1.0, state={"name": state, "reason": "r"}).run
            return call(["sh", "-c", f"echo '{json.dumps(run)}'; exit {code}"])

        with contextlib.redirect_stdout(io.StringIO()) as out:
            code = runs.Runs(["s", "--json", "--strict"], taken(["s", "--sweep", *words])[0], start, lambda scene: {"a"}).all()
        return code, json.loads(out.getvalue())["runs"]

    def test_a_run_that_is_not_sound_has_its_numbers(self):
        code, found = self.sweep("a=1,2")
        self.assertEqual([(run["state"]["name"], run["error"]["value"], run["why"]) for run in found],
                         [("sound", 1.0, None), ("unsolved", 1.0, None)])
        self.assertEqual(code, 1)
        self.assertEqual(self.sweep("a=1")[0], 0)

    def test_a_run_that_a_signal_ends_is_lost(self):
        code, found = self.sweep("a=1,3")
        self.assertEqual((code, [run["why"] for run in found]), (1, [None, "it failed"]))

    def test_the_exit_code_of_results(self):
        unsolved, lost = result({}, 1.0, state={"name": "unsolved", "reason": "r"}), Result({}, None, "blew up")
        for results, words, code in (([result({}, 1.0)], ["--strict"], 0), ([unsolved], [], 0), ([unsolved], ["--strict"], 1),
                                     ([lost], [], 1), ([], ["--strict"], 0)):
            self.assertEqual(runs.exit_code(results, words), code)


class Interrupted(unittest.TestCase):
    def test_what_ended_before_is_kept(self):
        for cause in (KeyboardInterrupt, SystemExit):
            def start(asked, call):
                if "--time" in asked:  # for its columns
                    Path(asked[asked.index("--csv") + 1]).write_text("time [s]\n")
                    return call(["true"])
                if "a=3" in asked:
                    raise cause
                return call(["echo", json.dumps(result({}, 1.0).run)])

            with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out, \
                 contextlib.redirect_stderr(io.StringIO()) as err:
                table, manifest = Path(folder, "t.csv"), Path(folder, "t.csv.manifest.json")
                manifest.write_text("{}")  # of an earlier table
                words = ["s", "--json", "--csv", str(table)]
                with self.assertRaises(cause):
                    runs.Runs(words, taken(["s", "--sweep", "a=1,2,3,4"])[0], start, lambda scene: {"a"}).all()
                with open(table, newline="") as file:
                    self.assertEqual([row["a"] for row in csv.DictReader(file)], ["1", "2"])
                self.assertFalse(manifest.exists())
                self.assertEqual(len(json.loads(out.getvalue())["runs"]), 2)
                self.assertIn("Interrupted. The table has 2 of 4 runs.", err.getvalue())
                with self.assertRaises(cause):
                    runs.Runs(words, taken(["s", "--sweep", "a=3,4"])[0], start, lambda scene: {"a"}).all()
                self.assertIn("Interrupted before a run ended.", err.getvalue())


class OnSlurm(unittest.TestCase):
    """An imitation of Slurm that runs each part at once: only the division of a sweep is tested."""

    def test_parts_are_put_together_in_order(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        with mock.patch.object(runs, "BUILD", Path(folder.name)), mock.patch.object(runs, "run_array", self.array), \
                contextlib.redirect_stdout(io.StringIO()) as out:
            code = runs.Runs(["s", "--json"], taken(["s", "--slurm", "2", "--sweep", "a=1,2", "b=x,y"])[0], self.start,
                             lambda scene: {"a", "b"}).all()
        told = json.loads(out.getvalue())
        self.assertEqual([(run["point"], run["why"]) for run in told["runs"]],
                         [({"a": "1", "b": "x"}, None), ({"a": "1", "b": "y"}, "blew up"), ({"a": "2", "b": "x"}, None)])
        self.assertEqual([one["point"] for one in told["skipped"]], [{"a": "2", "b": "y"}])
        self.assertEqual(code, 1)

    def start(self, words, call):
        """Refuses one combination; the columns of another are requested."""
        Path(words[words.index("--csv") + 1]).write_text("time [s]\n")
        refused = "a=2" in words and "b=y" in words
        return call(["sh", "-c", f"echo no >&2; exit {2 * refused}"])

    def array(self, command, count, folder, what):
        folder.mkdir(parents=True)
        for part in range(1, count + 1):
            words = [word.replace("@I@", str(part)) for word in command]
            self.assertEqual(words[words.index("--shard") + 1], f"{part}/{count}")
            points = grid.combinations({"a": "12", "b": "xy"})[part - 1::count]
            results = [Result(point, None, "blew up") if point == {"a": "1", "b": "y"} else result(point, 1.0)
                       for point in points if point != {"a": "2", "b": "y"}]
            Path(words[3]).write_text(as_json(Sweep({"a": "12", "b": "xy"}, results, [])))
        return {2: "exit code 1"}


class Refused(unittest.TestCase):
    def test_what_is_refused_leaves_the_last_results(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "table.csv").write_text("old")
            with self.assertRaises(BadInput), plot._results_set_aside(folder):
                self.assertFalse((folder / "table.csv").exists())
                raise BadInput("a typo")
            self.assertEqual([path.name for path in folder.iterdir()], ["table.csv"])
            self.assertEqual((folder / "table.csv").read_text(), "old")
            with plot._results_set_aside(folder):
                (folder / "claims.json").write_text("new")
            self.assertEqual([path.name for path in folder.iterdir()], ["claims.json"])
            with plot._results_set_aside(folder):  # a shard, which leaves a part
                (folder / "parts").mkdir()
            self.assertEqual((folder / "claims.json").read_text(), "new")

    def test_what_an_experiment_refuses_is_printed_once(self):
        def refusing(command, on_line):
            for line in ("[1/2] a\n", "told\n", "shard must be i/n\n"):
                on_line(line)
            return 2, "told\nshard must be i/n\n"

        asked = mock.Mock(merge=None, more=[], quick=False, shard=None)
        with tempfile.TemporaryDirectory() as name, mock.patch.object(plot, "stream", refusing), \
                mock.patch.object(plot, "Live"), contextlib.redirect_stdout(io.StringIO()) as out:
            with self.assertRaisesRegex(BadInput, "^plot: shard must be i/n$"):
                plot._compute(mock.Mock(), asked, Path("program"), Path(name), False)
        self.assertEqual(out.getvalue().split(), ["told"])

    def test_an_experiment_takes_a_sweep_by_the_grammar_of_run(self):
        with mock.patch.object(plot, "parameters_of", lambda scene: {"stack": {"ratio"}, "pile": {"seed"}}[scene]):
            for more, words in ((["--quick"], ["--quick"]),
                                (["--sweep", "h=1/60,1/120", "ratio=1,10", "--time", "2"],
                                 ["--time", "2", "--h", "1/60,1/120", "--set", "ratio=1,10"]),
                                (["--sweep", "accuracy=1e-3,1e-6"], ["--accuracy", "1e-3,1e-6"]),
                                (["--sweep=soft_steps=1,4", "warm-start=off,on"], ["--soft-steps", "1,4", "--warm-start=off,on"]),
                                (["--scene", "pile", "--sweep", "seed=1,2"], ["--scene", "pile", "--set", "seed=1,2"]),
                                (["--scene", "stack", "--sweep", "seed=1,2"], ["--scene", "stack", "--seed", "1,2"])):
                self.assertEqual(plot.without_sweep(more), words)
            for more, told in ((["--sweep", "rato=1,2"], "'rato' is neither a parameter of stack nor an option of run; did you mean ratio?"),
                               (["--sweep"], "plot: --sweep needs a value"),
                               (["--sweep", "max_parts=1,2", "max-parts=4"],
                                "plot: max-parts is swept twice, also as max_parts"),
                               (["--sweep", "h=1", "h=2"], "plot: h is swept twice"),
                               (["--h", "1/30", "--sweep", "h=1,2"],
                                "plot: h is swept, so --h has no effect: leave one of them out"),
                               (["--sweep", "h=1,,2"], "plot: --sweep must be NAME=VALUE,VALUE, but is 'h=1,,2'")):
                with self.assertRaises(BadInput) as caught:
                    plot.without_sweep(more)
                self.assertEqual(str(caught.exception), told)

    def test_an_option_of_an_experiment_is_told_its_place(self):
        with self.assertRaisesRegex(BadInput, "unknown option '--scene'; options of an experiment go after --"):
            arguments.parse(["plot", "work_precision", "--scene", "wire"])
        with self.assertRaisesRegex(BadInput, "unknown option '--quik'; did you mean --quick"):
            arguments.parse(["plot", "work_precision", "--quik"])

    def test_an_option_of_plot_is_taken_after_the_dashes_too(self):
        known = arguments.parse(["plot", "energy", "--", "--out", "a", "--h", "1/60", "--quick", "--set", "m=-1"])
        self.assertEqual((known.out, known.quick, known.shard, known.more),
                         ("a", True, None, ["--h", "1/60", "--set", "m=-1"]))
        with self.assertRaisesRegex(BadInput, "plot: --out is given twice"):
            arguments.parse(["plot", "energy", "--out", "a", "--", "--out=b"])


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


class Pages(unittest.TestCase):
    """Each command that a reader copies from a page runs, for a time of zero."""

    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)

    def assert_runs(self, words: list[str]) -> str:
        """Expects nothing on the standard error; returns what is printed."""
        words = [word for word in words if word != "--mine"]
        if "--time" in words:
            del words[words.index("--time"):words.index("--time") + 2]
        result = self.box.course(*words, *(["--time", "0"] if words[0] == "run" else []))
        said = result.stderr.removeprefix("sweep ...\n")  # what takes long says that it is at work
        if "mine" in words:
            said = said.removeprefix("You have written no exercise yet: everything is the reference.\n")
        self.assertEqual((result.returncode, said), (0, ""))
        return result.stdout

    def test_the_commands_of_all_lessons(self):
        lines = [(lesson.parent.name, line) for lesson in _LESSONS
                 for block in _BLOCK.findall(lesson.read_text(encoding="utf-8"))
                 for line in block.splitlines() if line.startswith("./course run ")]
        self.assertGreater(len(lines), 40)
        for chapter, line in lines:
            with self.subTest(chapter, line=line):
                self.assert_runs(words_of(line))

    def test_the_commands_of_all_other_pages(self):
        """In their order: one may read what another writes."""
        lines = [(page, line) for page in pages() if page not in _LESSONS for line in commands(page)
                 if words_of(line)[:1] in (["run"], ["scenes"])]
        self.assertGreater(len(lines), 12)
        for page, line in lines:
            with self.subTest(str(page.relative_to(ROOT)), line=line):
                told = self.assert_runs(words_of(line))
                if written := re.search(r" > (\S+)", line):
                    (self.box.root / written[1]).write_text(told)


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
        self.assertEqual([run["point"] for run in runs], [{"h": "1/60"}, {"h": "1/120"}, {"h": "1/240"}])
        alone = json.loads(self.run_scene("orbit", "--h", "1/120", "--json"))
        self.assertEqual(runs[1]["error"], alone["error"])
        self.assertIsNone(runs[0]["observed_order"])
        for run in runs[1:]:  # leapfrog's, whose next term is (hω)² of it, and ω of the nearest point is below 4
            self.assertAlmostEqual(run["observed_order"], 2, delta=2 * (4 / 60) ** 2 / math.log(2))
        table = self.run_scene(*call)
        for part in ("semi-major axis", "order", "2.00", "1/240"):
            self.assertIn(part, table)

    def test_a_sweep_of_parameters_and_switches(self):
        runs = json.loads(self.run_scene("orbit", "--set", "start=unshifted", "--sweep", "eccentricity=0.2,0.3",
                                         "--json"))["runs"]
        self.assertEqual([(run["parameters"]["eccentricity"], run["parameters"]["start"]) for run in runs],
                         [(0.2, "unshifted"), (0.3, "unshifted")])
        runs = json.loads(self.run_scene("stack", "--time", "0.1", "--sweep", "warm_start=off,on", "--json"))["runs"]
        self.assertEqual([run["warm_start"] for run in runs], [False, True])

    def test_a_product_with_means_over_seeds_as_a_file(self):
        call = ["pile", "--time", "0.1", "--set", "bodies=5,10", "--sweep", "seed=1,2,3", "--csv", "sweep.csv", "--json"]
        told = json.loads(self.run_scene(*call))
        self.assertEqual([run["parameters"]["seed"] for run in told["runs"]], [1, 2, 3, 1, 2, 3])
        for mean, bodies in zip(told["means"], ("5", "10")):
            errors = [run["error"]["value"] for run in told["runs"] if run["point"]["bodies"] == bodies]
            self.assertEqual((mean["point"], mean["runs"]), ({"bodies": bodies}, 3))
            self.assertAlmostEqual(mean["mean"], sum(errors) / 3, delta=1e-12 * max(errors))
        rows = list(csv.DictReader(io.StringIO((self.box.root / "sweep.csv").read_text())))
        self.assertEqual([(row["bodies"], row["seed"], float(row["error"])) for row in rows],
                         [(run["point"]["bodies"], run["point"]["seed"], run["error"]["value"]) for run in told["runs"]])
        manifest = json.loads((self.box.root / "sweep.csv.manifest.json").read_text())
        self.assertEqual(manifest["command"], ["./course", "run", *call])
        self.assertTrue(all(manifest[key] for key in ("version", "commit", "compiler", "flags", "machine", "processors", "date")),
                        manifest)
        shards = [json.loads(self.run_scene(*call, "--shard", f"{k}/2"))["runs"] for k in (1, 2)]
        self.assertEqual([run["point"] for run in told["runs"]],
                         [run["point"] for pair in zip(*shards) for run in pair])
        parts = [word for word in call if word not in ("--csv", "sweep.csv", "--json")]
        for k in (1, 2):
            self.assertIn(f"mean over seeds of shard {k}/2", self.run_scene(*parts, "--shard", f"{k}/2", "--csv", f"{k}.csv"))
        sweep = ["pile", "--sweep", "seed=1,2,3", "--set", "bodies=5,10", "--time=0.1"]  # in any order
        merged = json.loads(self.run_scene(*sweep, "--merge", "1.csv", "2.csv", "--json"))
        self.assertEqual(merged["means"], told["means"])
        names = [{run["error"]["name"] for run in of["runs"]} for of in (merged, told)]
        self.assertEqual(*names)
        self.assertNotEqual(names[0], {"error"})
        self.assertEqual([run["error"]["value"] for run in merged["runs"]], [run["error"]["value"] for run in told["runs"]])
        half = self.box.course("run", *sweep, "--merge", "1.csv", "--csv", "half.csv")
        self.assertEqual((half.returncode, half.stdout), (1, ""))
        self.assertIn("--merge lacks 3 of 6 combinations, the first with bodies = 5, seed = 2", half.stderr)
        self.assertFalse(list(self.box.root.glob("half.csv*")))
        before = (self.box.root / "1.csv").read_bytes()
        self.box.assert_refused(self, ["run", *sweep, "--merge", "1.csv", "2.csv", "--csv", "./1.csv"],
                                ["--csv must be another file than the merged tables", '"./1.csv"'])
        self.assertEqual((self.box.root / "1.csv").read_bytes(), before)
        self.run_scene(*sweep, "--merge", "1.csv", "2.csv", "--csv", "all.csv")
        joined = list(csv.DictReader(io.StringIO((self.box.root / "all.csv").read_text())))
        self.assertEqual(list(joined[0]), list(rows[0]))
        for name in ("bodies", "seed", "h", "error", "steps", "row_updates"):
            self.assertEqual([row[name] for row in joined], [row[name] for row in rows], name)
        of_all, of_one = (json.loads((self.box.root / f"{name}.csv.manifest.json").read_text()) for name in ("all", "1"))
        self.assertEqual(of_all["command"][-1], "all.csv")
        self.assertEqual((of_all["sha256"], of_all["commit"]), (of_one["sha256"], of_one["commit"]))
        self.assertEqual([table["sha256"] for table in of_all["merged"]],
                         [hashlib.sha256((self.box.root / f"{k}.csv").read_bytes()).hexdigest() for k in (1, 2)])
        self.assertEqual(of_all["merged"][0]["manifest"], of_one)
        self.run_scene(*sweep, "--merge", "all.csv")  # and once more
        for words, told in ((["--solver", "direct"], "with --solver none, but this call has direct"),
                            (["--h", "1/120"], "with --h none, but this call has 1/120")):
            self.box.assert_refused(self, ["run", *sweep, *words, "--merge", "1.csv", "2.csv"], ['"1.csv"', told])

    def test_combinations_that_are_refused_are_counted(self):
        said = self.run_scene("stack", "--time", "0.1", "--sweep", "solver=direct,gauss_seidel", "row_order=given,random")
        self.assertEqual(len(re.findall(r"^(?:direct|gauss_seidel) ", said, re.MULTILINE)), 3)
        why = "1 combination skipped: with a row order, solver must be gauss_seidel"
        self.assertIn(why, said)
        call = ["stack", "--time", "0.1", "--sweep", "solver=direct,gauss_seidel", "row_order=given,random"]
        parts = [self.run_scene(*call, "--shard", f"{k}/4", "--csv", f"part{k}.csv") for k in range(1, 5)]
        self.assertEqual([why in part for part in parts], [False, True, False, False])
        self.assertEqual((self.box.root / "part2.csv").read_text(), (self.box.root / "part1.csv").read_text().split("\n")[0] + "\n")
        self.assertIn(why, self.run_scene(*call, "--merge", *(f"part{k}.csv" for k in range(1, 5)), "--csv", "all.csv"))
        self.assertIn(why, self.run_scene(*call, "--merge", "all.csv"))
        manifest = self.box.root / "part2.csv.manifest.json"
        manifest.write_text(json.dumps(json.loads(manifest.read_text()) | {"skipped": [1]}))
        self.box.assert_refused(self, ["run", *call, "--merge", "part2.csv"], ['"part2.csv" needs its manifest'])

    def test_what_is_strict_has_the_numbers_of_all_runs(self):
        told = json.loads(self.run_scene("stack", "--sweep", "ratio=1,10", "--strict", "--json", code=1))
        self.assertEqual([run["state"]["name"] for run in told["runs"]], ["sound", "unsolved"])
        self.assertTrue(all(run["error"]["value"] > 0 for run in told["runs"]))
        self.assertNotIn("lost", self.run_scene("stack", "--sweep", "ratio=1,10", "--strict", "--csv", "strict.csv", code=1))
        self.run_scene("stack", "--sweep", "ratio=1,10", "--strict", "--merge", "strict.csv", code=1)

    def test_a_file_sweeps_as_a_scene_does(self):
        (self.box.root / "tower.json").write_text(self.box.course("scenes", "tower", "--set", "boxes=2", "--export").stdout)
        said = self.run_scene("tower.json", "--time", "0.1", "--sweep", "solver=gauss_seidel,auto", "h=1/60,1/120")
        self.assertEqual(len(re.findall(r"^(?:gauss_seidel|auto) ", said, re.MULTILINE)), 4)
        self.assertNotIn("lost", said)  # it has no answer
        self.run_scene("tower.json", "--time", "0.1", "--sweep", "h=1/60,1/120", "--csv", "tower.csv")
        hashes = json.loads((self.box.root / "tower.csv.manifest.json").read_text())["sha256"]
        self.assertEqual(hashes["tower.json"], hashlib.sha256((self.box.root / "tower.json").read_bytes()).hexdigest())
        self.assertEqual({Path(name).name for name in hashes}, {"spook", "tower.json"})
        sweep = ["run", "tower.json", "--time", "0.1", "--sweep", "h=1/60,1/120", "--merge", "tower.csv"]
        self.assertEqual(self.box.course(*sweep).returncode, 0)
        text = (self.box.root / "tower.json").read_text()
        (self.box.root / "tower.json").write_text(text + "\n")
        self.box.assert_refused(self, sweep, ['"tower.csv" was computed from another content of "tower.json"'])
        (self.box.root / "tower.json").write_text(text)
        before = (self.box.root / "tower.json").read_text()
        self.box.assert_refused(self, ["run", "tower.json", "--sweep", "h=0.1,0.2", "--csv", "./tower.json"],
                                ["--csv must be another file than the scene"])
        self.assertEqual((self.box.root / "tower.json").read_text(), before)

    def test_every_name_sweeps_as_any_other(self):
        """A built-in scene's ratio, an option of the name of a result, and a file's names; as a file and merged."""
        scene = {"format": "spook scene", "version": 2, "model": "point", "h": 0.01, "time": 0.1, "half_step_start": True,
                 "parameters": {"error": {"default": 0}, "a,b": {"default": 0}},
                 "bodies": [{"x": ["$error", "$a,b", 0], "mass": 1}],
                 "expected": [{"body": 0, "time": 0.1, "x": [0, 0, -0.04905], "tolerance": 1}]}
        (self.box.root / "named.json").write_text(json.dumps(scene))
        rows = self.swept(["named.json", "--sweep", "h=0.01,0.005", "error=3,6", "a,b=4,8"])
        self.assertEqual([(row["error="], row["a,b"]) for row in rows], [("3", "4"), ("3", "8"), ("6", "4"), ("6", "8")] * 2)
        for row in rows:
            self.assertAlmostEqual(float(row["error"]), math.hypot(float(row["error="]), float(row["a,b"])), 9)
        rows = self.swept(["stack", "--set", "bodies=3", "--solver", "gauss_seidel", "--time", "0.1", "--sweep", "ratio=1,10", "h=1/60,1/120"])
        self.assertEqual([row["ratio"] for row in rows], ["1", "1", "10", "10"])
        told = json.loads(self.run_scene("wire", "--row-order", "random", "--set", "links=10", "--time", "0.1", "--sweep",
                                         "ratio=5,10", "seed=1,2", "--json"))
        self.assertEqual([mean["point"] for mean in told["means"]], [{"ratio": "5"}, {"ratio": "10"}])
        rows = self.swept(["free_fall", "--sweep", "time=0.1,0.25", "h=0.1,0.05"])
        self.assertEqual([(row["time="], round(float(row["time"]), 9)) for row in rows],
                         [("0.1", 0.1), ("0.1", 0.1), ("0.25", 0.3), ("0.25", 0.25)])

    def swept(self, call: list[str]) -> list[dict[str, str]]:
        """Returns the table of a sweep, which is also that of its shards."""
        self.run_scene(*call, "--csv", "whole.csv")
        for k in (1, 2):
            self.run_scene(*call, "--shard", f"{k}/2", "--csv", f"part{k}.csv")
        self.run_scene(*call, "--merge", "part1.csv", "part2.csv", "--csv", "joined.csv")
        whole, joined = (list(csv.DictReader(io.StringIO((self.box.root / f"{name}.csv").read_text())))
                         for name in ("whole", "joined"))
        for one in whole + joined:
            one.pop("us_per_step")  # which is measured
        self.assertEqual(whole, joined)
        return whole

    def test_a_file_has_parameters_that_sweep(self):
        scene = {"format": "spook scene", "version": 2, "model": "point", "h": 0.01, "time": 1, "parameters": {
                     "g": {"default": "-981/100", "unit": "m/s²", "meaning": "pull of the planet"},
                     "height": {"default": 0}},
                 "settings": {"gravity": [0, 0, "$g"]}, "half_step_start": True,
                 "bodies": [{"x": [0, 0, "$height"], "mass": 1}],
                 "expected": [{"body": 0, "time": 1, "x": [0, 0, -4.905], "tolerance": 1e-9}]}
        (self.box.root / "fall.json").write_text(json.dumps(scene))
        told = json.loads(self.run_scene("fall.json", "--sweep", "g=-9.81,0", "height=0,1", "--json"))
        self.assertEqual([run["parameters"]["g"] for run in told["runs"]], [-9.81, -9.81, 0, 0])
        errors = [run["error"]["value"] for run in told["runs"]]  # in tolerances of 1e-9 m
        self.assertLess(errors[0], 1)
        for error, off in zip(errors[1:], (1, 4.905, 5.905)):
            self.assertAlmostEqual(error * 1e-9, off, places=8)
        self.assertIn("pull of the planet", self.box.course("scenes", "fall.json").stdout)
        for change, words in (({"h": "$step"}, ["h must be a number, which --h changes"]),
                              ({"settings": {"gravity": [0, 0, "$q"]}}, ['gravity[2] names no parameter of the file: "$q"']),
                              ({"settings": {"gravity": [0, 0, "$heigth"]}}, ['did you mean "height"']),
                              ({"bodies": [{"x": [0, 0, 0]}]}, ["parameters.height is used nowhere"]),
                              ({"parameters": {"h": {"default": 1}}}, ["parameters.h must have another name"]),
                              ({"parameters": {"g": {"defautl": 1}}}, ["parameters.g.defautl is unknown"]),
                              ({"parameters": {"g": {"default": "much"}}}, ["parameters.g.default", "much"]),
                              ({"parameters": []}, ["parameters must be an object"])):
            (self.box.root / "bad.json").write_text(json.dumps(scene | change))
            self.box.assert_refused(self, ["run", "bad.json"], words)
        self.box.assert_refused(self, ["run", "fall.json", "--set", "height=high"], ["height", "high"])

    def test_the_residual_is_a_column(self):
        self.run_scene("stack", "--time", "0.1", "--iterations", "2", "--csv", "stack.csv", "--json")
        rows = list(csv.DictReader(io.StringIO((self.box.root / "stack.csv").read_text())))
        self.assertEqual(float(rows[0]["residual [m/s]"]), 0)  # no step yet
        told = json.loads(self.run_scene("stack", "--time", "0.1", "--iterations", "2", "--json"))
        self.assertEqual(float(rows[-1]["residual [m/s]"]), told["residual"])
        self.assertTrue((self.box.root / "stack.csv.manifest.json").exists())
        self.run_scene("orbit", "--time", "0.1", "--csv", "orbit.csv")  # which has nothing to solve
        self.assertNotIn("residual", (self.box.root / "orbit.csv").read_text())

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

    @unittest.skipIf(importlib.util.find_spec("pyarrow"), "pyarrow is installed")
    def test_parquet_without_what_writes_it(self):
        self.box.assert_refused(self, ["run", "orbit", "--sweep", "h=0.1,0.2", "--csv", "a.parquet"],
                                ["a.parquet", "pyarrow", "ends in .csv"])

    def test_parquet_has_the_columns_of_csv(self):
        """By a pyarrow that writes what it is given."""
        with tempfile.TemporaryDirectory() as folder:
            package = Path(folder, "pyarrow")
            package.mkdir()
            (package / "__init__.py").write_text("def table(columns):\n    return columns\n")
            (package / "parquet.py").write_text("import json\n\n\ndef write_table(table, file):\n"
                                                "    with open(file, 'w') as out:\n        json.dump(table, out)\n")
            call = ["run", "orbit", "--time", "0.5", "--sweep", "h=1/10,1/20", "warm_start=true,false"]
            for name in ("a.parquet", "a.csv"):
                done = self.box.course(*call, "--csv", name, PYTHONPATH=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
        columns = json.loads((self.box.root / "a.parquet").read_text())
        rows = list(csv.DictReader(io.StringIO((self.box.root / "a.csv").read_text())))
        self.assertEqual(list(columns), list(rows[0]))
        self.assertEqual(columns["h"], [0.1, 0.1, 0.05, 0.05])
        self.assertEqual(columns["warm_start"], [row["warm_start"] for row in rows])
        self.assertEqual(columns["error"], [float(row["error"]) for row in rows])

    def test_what_makes_no_sense(self):
        for words, told in ((["orbit", "--plot", "enrgy"], ["'enrgy'", "the columns are x, y, energy, angular momentum"]),
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
                            (["orbit", "--sweep", "h=0.1,0.2", "--csv", "no/a.csv"], ["no/a.csv", "that you may write"]),
                            (["orbit", "--csv", "a.parquet"], ["a.parquet", "--sweep"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "h=1,2"], ["h is swept twice"]),
                            (["stack", "--sweep", "max_parts=1,2", "max-parts=4,8"],
                             ["max-parts is swept twice, also as max_parts"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--shard", "3/2"], ["'3/2'"]),
                            (["orbit", "--sweep", "h=0.1", "--shard", "2/2"], ["the sweep has 1"]),
                            (["orbit", "--shard", "1/2"], ["--shard needs --sweep"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--csv", "a", "--csv=b"], ["--csv is given twice"]),
                            (["orbit", "--merge", "a.csv"], ["--merge needs --sweep"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--merge", "no.csv"], ['--merge "no.csv" cannot be read']),
                            (["orbit", "--sweep", "h=0.1,0.2", "--merge", "README.md"], ["is no table of a sweep", "column error"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--h", "0.3"], ["h is swept, so --h has no effect"]),
                            (["orbit", "--sweep", "m=1,2", "--set", "m=3"], ["m is swept, so m=3 has no effect"]),
                            (["stack", "--friction-model", "box,cone"], ['"box,cone"', "a sweep of friction-model takes a list"]),
                            (["stack", "--sweep", "row-order=up,random", "seed=1,2"],
                             ["row-order=up is refused in every combination: seed has no effect"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--merge", "a", "--shard", "1/2"], ["leave out --shard"]),
                            (["orbit", "--sweep", "h=0.1,0.2", "--record=a"], ["--record is for one run"])):
            self.box.assert_refused(self, ["run", *words], told)

    def test_help_has_them(self):
        said = self.run_scene("--help")
        for option in ("--iterations", "--mine", "--plot", "--sweep"):
            self.assertIn(option, said)


if __name__ == "__main__":
    unittest.main()
