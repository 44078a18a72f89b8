"""Scenes as files: reading, refusals with their place, and that an exported scene runs as the scene itself."""

import base64
import copy
import functools
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPOOK = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
PAGE = ROOT / "solutions" / "spook" / "SCENES.md"
EXAMPLE = json.loads(re.search(r"```json\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[1])
# Where something is put, or with None taken out, and what is said of it.
REFUSED = (
    ("bodies.3.mass", -1, "bodies[3].mass must be positive and finite, but is -1"),
    ("bodies.3.mass", "x", 'bodies[3].mass must be a finite number such as 0.02, 1e6 or 1/60, but is "x"'),
    ("bodies.3.mass", None, "bodies[3].mass is missing"),
    ("bodies.3.mas", 1, 'bodies[3].mas is unknown; did you mean "mass"?'),
    ("bodies.3.x", [1, 2], "bodies[3].x must be a list of 3 numbers, but is [1,2]"),
    ("bodies.3.x", [1, None, 2], "bodies[3].x[1] must be a number, but is null"),
    ("bodies.3.density", 1, "bodies[3].density must be left out where mass is given, but is 1"),
    ("bodies.3.q", [2, 0, 0, 0], "bodies[3]: length of q must be 1, but is 2"),
    ("bodies.2.radius", None, "bodies[2].density must be left out for a body that is no sphere, no capsule and no box, but is 1000"),
    ("bodies.3.name", "ball", 'bodies[3].name must be another name than those before, but is "ball"'),
    ("bodies.0.plane.n", [0, 0, 2], "bodies[0].plane: length of n must be 1, but is 2"),
    ("bodies.1.v", [1, "x", 0], 'bodies[1].v[1] must be'),
    ("bodies.1", {"name": "nail", "fixed": True, "x": [0, 0, 2], "v": [1, 0, 0], "surface_velocity": [1, 0, 0]},
     "bodies[1].surface_velocity must be left out where v or omega is given"),
    ("bodies.0.v", [0, 0, 1], 'bodies[0].v is unknown'),
    ("bodies.1.fixed", 1, "bodies[1].fixed must be true or false, but is 1"),
    ("bodies.3", {"x": [2, 0, 1], "mass": 1, "principal": [1, 1, 1], "corners": [[0, 0, 0]]},
     "bodies[3].corners are points, which pass through bodies[2]"),
    ("bodies", {}, "bodies must be a list, but is {}"),
    ("h", "$dt", 'h must be a number, which --h changes, but is "$dt"'),
    ("settings.integrator_order", "$T",
     'settings.integrator_order must be a number, which --integrator-order changes, but is "$T"'),
    ("time", "$end", 'time must be a number, which --time changes, but is "$end"'),
    ("joints.0.j", 9, "joints[0].j must be the number of a body, less than 4, but is 9"),
    ("joints.0.j", "bal", 'joints[0].j must be ball or box or floor or nail, but is "bal"'),
    ("joints.0.i", "ball", "joints[0]: joint's j must be another body than its i, but is 2"),
    ("joints.0.length", -1, "joints[0].length must be positive"),
    ("joints.0.kind", "hing", 'joints[0].kind must be ball or distance or hinge or rope or slider or weld, but is "hing"'),
    ("joints.0.kind", "hinge", "joints[0].kind must be distance or rope, where it has a length, but is hinge"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "hinge", "axis": [0, 0, 2]},
     "joints[0]: length of axis must be 1, but is 2"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "hinge", "limits": {"lower": 1, "upper": 0}},
     "joints[0].limits.upper must be more than lower, which is 1, but is 0"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "slider", "motor": {"sped": 1}},
     'joints[0].motor.sped is unknown; did you mean "speed"?'),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "hinge", "spring": {"stiffness": -1}},
     "joints[0].spring.stiffness must be zero or positive, and finite, but is -1"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "hinge", "motor": {"viscosity": -1}}, "joints[0].motor.viscosity must be"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "hinge", "spring": {"stifness": 1}},
     'joints[0].spring.stifness is unknown; did you mean "stiffness"?'),
    ("joints.0", {"i": "nail", "j": "ball", "spring": {"stiffness": 1}},
     "joints[0]: kind must be hinge or slider, where it has a spring, but is ball"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "rope"},
     "joints[0].length is missing: a joint of kind rope has one"),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "distance"},
     "joints[0].length is missing: a joint of kind distance has one"),
    *((f"joints.0.{key}", value, f"joints[0].{key} must be left out for a joint of kind distance, but is ")
      for key, value in (("axis", [0, 0, 1]), ("rest", [1, 0, 0, 0]), ("k_turn", 1), ("angle", 1), ("limit_d", 3))),
    *(("joints.0", {"i": "nail", "j": "ball", "kind": kind, key: value}, f"joints[0].{key} must be left out {why}, but is ")
      for kind, key, value, why in (("ball", "axis", [0, 0, 1], "for a joint of kind ball"), ("ball", "limit_d", 3, "for a joint of kind ball"),
                                    ("weld", "angle", 1, "for a joint of kind weld"), ("slider", "angle", 1, "for a joint of kind slider"),
                                    ("hinge", "limit_d", 3, "without limits"), ("weld", "limit_d", 3, "without limits"))),
    ("joints.0", {"i": "nail", "j": "ball", "kind": "rope", "length": 1, "axis": [0, 0, 1]},
     "joints[0].axis must be left out for a joint of kind rope"),
    ("no_contact", [["ball", "bx"]], 'no_contact[0][1] must be ball or box or floor or nail, but is "bx"'),
    ("no_contact", [["ball", "box"], ["ball"]],
     "no_contact[1]: number of bodies must be at least 2 to exclude contacts between them, but is 1"),
    ("no_contact", [["ball", "ball"]], "no_contact[0]: body must be listed once, but is 2"),
    ("no_contact", ["ball", "box"], 'no_contact[0] must be a list, but is "ball"'),
    ("bodies.1", {"name": "nail", "fixed": True, "x": [0, 0, 3], "keyframes": [{"time": 0, "x": [0, 0, 3]}]},
     "bodies[1].x must be left out where keyframes are given"),
    ("bodies.1", {"name": "nail", "fixed": True, "keyframes": [{"time": 1, "x": [0, 0, 3]}, {"time": 1, "x": [0, 0, 3]}]},
     "bodies[1].keyframes[1].time must be later than that of the keyframe before, which is 1"),
    ("bodies.1", {"name": "nail", "fixed": True, "keyframes": [{"time": 1}]}, "bodies[1].keyframes[0].x is missing"),
    ("bodies.1", {"name": "nail", "fixed": True, "keyframes": []}, "keyframes must be at least one, but are none"),
    ("bodies.1", {"name": "nail", "fixed": True, "keyframes": [{"time": 1, "x": [0, 0, 3], "q": [2, 0, 0, 0]}]},
     "bodies[1].keyframes[0]: length of q must be 1, but is 2"),
    ("bodies.3.keyframes", [], "bodies[3].keyframes is unknown"),
    ("settings.max_parts", 3, "max_parts must be a power of two from 1 to 1024, but is 3"),
    ("settings.max_parts", "many", 'settings.max_parts must be a whole number, but is "many"'),
    ("settings.k", 0, "k must be positive and finite, but is 0"),
    ("settings.friktion", 0, 'settings.friktion is unknown; did you mean "friction"?'),
    ("settings.friction_model", "cones", 'settings.friction_model must be box or cone or two_pass, but is "cones"'),
    ("settings.rotation", "slow", 'settings.rotation must be exponential or first_order or splitting, but is "slow"'),
    ("expected.0.tolerance", 0, "expected[0].tolerance must be positive, but is 0"),
    ("expected.0.time", None, "expected[0].time is missing"),
    ("model", "soft", 'model must be point or rigid, but is "soft"'),
    ("format", "x", 'format must be "spook scene", but is "x"'),
    ("version", 3, "version must be 1 or 2, but is 3"),
    ("settings.compose", 4, 'settings.compose is unknown; it is now called "integrator_order"'),
    ("bodies.2.half_length", -1, "bodies[2].half_length must be zero or positive"),
    ("bodies.3.material", {"frictoin": 1}, 'bodies[3].material.frictoin is unknown; did you mean "friction"?'),
    ("bodies.3.material", {"friction": -1}, "bodies[3].material.friction must be zero or positive, and finite, but is -1"),
    ("bodies.3.material", {}, "bodies[3].material must be a friction, restitution, k, d or resistance, but is {}"),
    ("materials", [{"i": "box", "j": "bx", "friction": 1}], 'materials[0].j must be ball or box or floor or nail, but is "bx"'),
    ("materials", [{"i": "box", "j": "box", "friction": 1}], "materials[0].j must be another body than i"),
    ("materials", [{"i": "box", "j": "floor"}], "materials[0] must be a friction, restitution, k, d or resistance"),
    ("bodies.0.surface_velocity", [1, 0, 1], "part of v along the plane's normal must be 0, but is 1"),
    ("expected.0.time", 1.001, "expected[0].time must be a whole number of steps of 0.008333 s, but is 1.001"),
    ("expected.0.time", -1, "expected[0].time must be a whole number of steps"),
    ("h", 0, "h must be positive and finite, but is 0"),
    ("solver", "dirct", 'unknown solver "dirct"; did you mean "direct"?'),
)


def changed(path: str, value) -> dict:
    scene = copy.deepcopy(EXAMPLE)
    *folders, last = [int(part) if part.isdecimal() else part for part in path.split(".")]
    at = scene
    for part in folders:
        at = at[part]
    if value is None:
        del at[last]
    else:
        at[last] = value
    return scene



def numbers_in(part, place: tuple = ()):
    """Yields the places of all numbers, as the keys that lead to them."""
    for key, value in part.items() if isinstance(part, dict) else enumerate(part):
        if isinstance(value, (dict, list)):
            yield from numbers_in(value, (*place, key))
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield *place, key


class SceneFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="spook-scenes-")
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "mine.json")
        self.table = Path(folder.name, "table.csv")

    def spook(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([SPOOK, *map(str, words)], capture_output=True, text=True)

    def run_of(self, scene: dict, *words) -> dict:
        self.file.write_text(json.dumps(scene))
        done = self.spook("run", self.file, "--json", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def positions(self, scene, *words) -> list[list[str]]:
        done = self.spook("run", scene, "--csv", self.table, "--positions", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(",") for line in self.table.read_text().splitlines()]
        bodies = 1 + int(re.search(r"of body (\d+)", rows[0][-1])[1])
        self.assertGreater(len(rows), 2)
        return [row[-3 * bodies:] for row in rows]

    def test_the_pages_example_runs_and_is_right(self):
        result = self.run_of(EXAMPLE)
        self.assertEqual((result["state"]["name"], result["solver"], result["steps"]), ("sound", "auto", 240))
        # By default the weights of ball and box compress one contact by a ten-thousandth of half the box's height, and the
        # box has four contacts.
        ball, box = 1000 * 4 / 3 * math.pi * 0.2**3, 5
        self.assertAlmostEqual(result["error"]["value"], box / (ball + box) / 4 * 1e-4 * 0.1 / 1e-4, delta=1e-4)

    def test_what_is_too_deep_or_too_large_is_refused_in_a_line(self):
        for text, words in (("[" * 100_000, "more than 20 deep"), ("[" * 100_000 + "]" * 100_000, "more than 20 deep"),
                            ('{"a":' * 100_000, "more than 20 deep"), ('{"h": 1e400}', "1e400")):
            self.file.write_text(text)
            done = self.spook("run", self.file)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr[:300])
            self.assertIn(words, done.stderr)

    def test_a_number_near_the_largest_ends_in_at_most_a_line(self):
        """Each number of the page's example in turn; its square, and most of its products, are infinite."""
        places = list(numbers_in(EXAMPLE))
        self.assertGreater(len(places), 30)
        for place in places:
            for value in (1e308, -1e308):
                scene = copy.deepcopy(EXAMPLE)
                *inside, last = place
                within = functools.reduce(lambda part, key: part[key], inside, scene)
                within[last] = value
                self.file.write_text(json.dumps(scene))
                with self.subTest(place=place, value=value):
                    done = self.spook("run", self.file, "--time", "0.1")
                    self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                    self.assertEqual(done.stderr.count("\n"), 0 if done.returncode == 0 else 1, done.stderr)

    def test_a_file_of_version_1_runs_with_its_own_words(self):
        bodies = [{"name": "nail", "fixed": True, "x": [0, 0, 0]}, {"name": "ball", "x": [1, 0, 0], "mass": 1}]
        old = {"format": "spook scene", "version": 1, "model": "point", "h": "1/60", "time": 0.5, "solver": "stiff",
               "settings": {"compose": 4, "d": 0}, "bodies": bodies,
               "joints": [{"i": "nail", "j": "ball", "length": 1}]}
        new = old | {"version": 2, "solver": "geometric_stiffness", "settings": {"integrator_order": 4, "d": 0}}
        runs = []
        for scene in (old, new, new | {"settings": {"d": 0}}):
            self.file.write_text(json.dumps(scene))
            runs.append(self.positions(self.file))
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[1], runs[2])
        self.assertEqual(self.run_of(old)["solver"], "none")  # steps of order four hold joints rigid
        self.assertEqual(self.run_of(old | {"settings": {"d": 0}})["solver"], "geometric_stiffness")

    def test_points_stand_beside_what_they_meet_where_joined_or_where_the_file_says_so(self):
        points = {"mass": 1, "principal": [1, 1, 1], "corners": [[0, 0, 0]]}
        pair = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/60", "time": 0.1,
                "bodies": [{"x": [0, 0, 0], **points}, {"x": [0, 0, 1], **points}, {"fixed": True, "x": [0, 0, 5]}]}
        tied = [{"i": 0, "j": 2, "p_j": [0, 0, -5]}, {"i": 1, "j": 2, "p_j": [0, 0, -4]}]
        for change, refused in (({}, True), ({"settings": {"points_pass": True}}, False),
                                ({"joints": [{"i": 0, "j": 1, "length": 1}]}, False),
                                ({"joints": tied}, True),  # a static body does not join them
                                ({"bodies": pair["bodies"][1:]}, False)):
            self.file.write_text(json.dumps(pair | change))
            done = self.spook("run", self.file)
            self.assertEqual(done.returncode, 2 if refused else 0, done.stderr)
            self.assertEqual("bodies[1].corners are points, which pass through bodies[0]" in done.stderr, refused)

    def test_a_capsule_lies_on_another_that_is_static(self):
        """Across it, on one point: it sinks by m g/k, and its mass is that of 1,000 kg/m³."""
        radius, half, k = 0.1, 0.4, 1e6
        lying, across = [0.5**0.5, 0, 0.5**0.5, 0], [0.5**0.5, 0.5**0.5, 0, 0]  # along x, along y
        mass = 1000 * (4 / 3 * math.pi * radius**3 + 2 * half * math.pi * radius**2)
        shape = {"radius": radius, "half_length": half}
        z = 2 * radius - mass * 9.81 / k
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/240", "time": 1, "settings": {"k": k},
                 "bodies": [{"fixed": True, "x": [0, 0, 0], "q": lying, **shape},
                            {"x": [0, 0, 2 * radius], "q": across, "density": 1000, **shape}],
                 "expected": [{"body": 1, "time": 1, "x": [0, 0, z], "tolerance": 1e-7}]}
        self.assertLess(self.run_of(scene)["error"]["value"], 1)

    def test_static_bodies_that_move_carry_what_lies_on_them(self):
        # A box slips on until it has the speed of what it lies on, and is behind by v²/(2 μ g) then.
        h, mu, speed = 1 / 240, 0.5, 1
        wanted = speed * 2 - speed**2 / (2 * mu * 9.81)
        plate = {"fixed": True, "x": [0, 0, -0.1], "half_sides": [9, 1, 0.1]}
        floor = {"plane": {"n": [0, 0, 1], "offset": 0}}
        for under in (plate | {"v": [speed, 0, 0]}, plate | {"surface_velocity": [speed, 0, 0]},
                      floor | {"surface_velocity": [speed, 0, 0]}):
            scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": h, "time": 2, "settings": {"friction": mu},
                     "bodies": [under, {"x": [0, 0, 0.2], "mass": 1, "half_sides": [0.2, 0.2, 0.2]}],
                     "expected": [{"body": 1, "time": 2, "x": [wanted, 0, 0.2], "tolerance": 2 * h}]}
            done = self.run_of(scene)
            self.assertLess(done["error"]["value"], 1, under)
            self.assertEqual(done["state"]["name"], "sound", done["state"])

    def test_a_spring_swings_as_its_closed_form(self):
        """A torsion pendulum of k = 2, c = 0.1 and I = 0.5, let go at 1 rad from rest, and a mark on its rim."""
        k, c, inertia, time, h = 2, 0.1, 0.5, 3, 1 / 960
        decay = c / inertia / 2
        frequency = math.sqrt(k / inertia - decay**2)
        angle = math.exp(-decay * time) * (math.cos(frequency * time) + decay / frequency * math.sin(frequency * time)) - 1
        disc = {"name": "disc", "x": [0, 0, 0], "mass": 1, "principal": [0.3, 0.3, inertia]}
        mark = {"name": "mark", "x": [1, 0, 0], "mass": 1e-9, "principal": [1e-9, 1e-9, 1e-9]}
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": h, "time": time,
                 "settings": {"gravity": [0, 0, 0]}, "bodies": [{"name": "nail", "fixed": True, "x": [0, 0, 0]}, disc, mark],
                 "joints": [{"i": "nail", "j": "disc", "kind": "hinge",
                             "spring": {"stiffness": k, "damping": c, "rest": -1}},
                            {"i": "disc", "j": "mark", "p_i": [1, 0, 0], "kind": "weld"}],
                 "expected": [{"body": "mark", "time": time, "x": [math.cos(angle), math.sin(angle), 0], "tolerance": 2 * h}]}
        done = self.run_of(scene)
        self.assertLess(done["error"]["value"], 1)  # the start is half a step late, an error of order h
        self.assertEqual(done["state"]["name"], "sound", done["state"])

    def test_a_rope_catches_what_falls(self):
        for model in ("point", "rigid"):
            ball = {"name": "ball", "x": [0, 0, -0.2], "mass": 1, "radius": 0.1}
            scene = {"format": "spook scene", "version": 2, "model": model, "h": "1/240", "time": 2,
                     "bodies": [{"name": "nail", "fixed": True, "x": [0, 0, 0]}, ball],
                     "joints": [{"i": "nail", "j": "ball", "kind": "rope", "length": 1}],
                     "expected": [{"body": "ball", "time": 0.3, "x": [0, 0, -0.2 - 9.81 * 0.3**2 / 2], "tolerance": 0.01},
                                  {"body": "ball", "time": 1, "x": [0, 0, -1], "tolerance": 1e-4},
                                  {"body": "ball", "time": 2, "x": [0, 0, -1], "tolerance": 1e-4}]}
            self.assertLess(self.run_of(scene)["error"]["value"], 1)

    def test_bodies_of_a_list_pass_through_each_other(self):
        # Two balls fall on a floor, one through the other; by names, and by numbers.
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/240", "time": 2,
                 "bodies": [{"name": "floor", "plane": {"n": [0, 0, 1], "offset": 0}},
                            {"name": "low", "x": [0, 0, 0.1], "mass": 1, "radius": 0.1},
                            {"name": "high", "x": [0, 0, 0.5], "mass": 1, "radius": 0.1}],
                 "expected": [{"body": "high", "time": 2, "x": [0, 0, 0.1], "tolerance": 1e-4}]}
        self.assertGreater(self.run_of(scene)["error"]["value"], 100)
        for lists in ([["low", "high"]], [[1, "high"]]):
            self.assertLess(self.run_of(scene | {"no_contact": lists})["error"]["value"], 1)

    def test_a_lift_follows_its_keyframes_and_carries_a_box(self):
        lift = {"name": "lift", "fixed": True, "half_sides": [1, 1, 0.1],
                "keyframes": [{"time": 0, "x": [0, 0, 0]}, {"time": 2, "x": [0, 0, "$top"]}, {"time": 3, "x": [0, 0, 0.5]}]}
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/240", "time": 4, "settings": {"friction": 0.5},
                 "parameters": {"top": {"default": 1}},
                 "bodies": [lift, {"name": "box", "x": [0, 0, 0.3], "mass": 2, "half_sides": [0.2, 0.2, 0.2]}],
                 "expected": [{"body": "lift", "time": 1, "x": [0, 0, 0.5], "tolerance": 1e-9},
                              {"body": "box", "time": 1, "x": [0, 0, 0.8], "tolerance": 1e-3},
                              {"body": "box", "time": 4, "x": [0, 0, 0.8], "tolerance": 1e-3}]}
        done = self.run_of(scene)
        self.assertLess(done["error"]["value"], 1)
        self.assertEqual(done["state"]["name"], "sound", done["state"])
        self.assertGreater(self.run_of(scene, "--set", "top=2")["error"]["value"], 100)

    def test_what_moves_and_what_does_not_touch_is_exported(self):
        turned = [0.6, 0, 0, 0.8]
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/60", "time": 1,
                 "settings": {"friction": 0.5, "max_parts": 4},
                 "bodies": [{"plane": {"n": [0, 0, 1], "offset": 0}, "surface_velocity": [1, 0, 0]},
                            {"fixed": True, "half_sides": [1, 1, 0.1],
                             "keyframes": [{"time": 0, "x": [9, 0, 1], "q": [1, 0, 0, 0]}, {"time": 1, "x": [9, 0, 2], "q": turned}]},
                            {"fixed": True, "x": [0, 9, 0.1], "radius": 0.2, "v": [1, 0, 0], "omega": [0, 0, 1]},
                            {"x": [0, 0, 0.1], "mass": 1, "half_sides": [0.1, 0.1, 0.1]},
                            {"x": [0, 0, 0.5], "mass": 1, "radius": 0.1}, {"x": [1, 0, 0.9], "mass": 1, "radius": 0.1}],
                 "joints": [{"i": 3, "j": 4, "kind": "slider", "spring": {"stiffness": 30, "damping": 1, "rest": -0.1}},
                            {"i": 4, "j": 5, "kind": "rope", "length": 2}],
                 "no_contact": [[3, 4], [4, 5, 0]]}
        self.file.write_text(json.dumps(scene))
        done = self.spook("scenes", self.file, "--export")
        self.assertEqual(done.returncode, 0, done.stderr)
        exported = json.loads(done.stdout)
        self.assertEqual((exported["no_contact"], exported["settings"]["max_parts"]), (scene["no_contact"], 4))
        before = self.positions(self.file)
        self.file.write_text(done.stdout)
        self.assertEqual(self.positions(self.file), before)

    def test_a_step_is_divided_at_most_so_often(self):
        """A ball whirled at 60 rad/s at 1/60 s leaves its circle unless steps are divided; the option goes before the file."""
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/60", "time": 1, "settings": {"gravity": [0, 0, 0]},
                 "bodies": [{"fixed": True, "x": [0, 0, 0]}, {"x": [1, 0, 0], "v": [0, 60, 0], "mass": 1, "radius": 0.1}],
                 "joints": [{"i": 0, "j": 1, "length": 1}]}

        def off(max_parts=None, *words) -> float:
            settings = scene["settings"] | ({} if max_parts is None else {"max_parts": max_parts})
            self.file.write_text(json.dumps(scene | {"settings": settings}))
            return max(abs(math.hypot(*map(float, row[-3:])) - 1) for row in self.positions(self.file, *words)[1:])

        self.assertLess(off(), 0.01)
        self.assertGreater(off(1), 0.05)
        self.assertGreater(off(32, "--max-parts", "1"), 0.05)
        self.assertLess(off(1, "--max-parts", "32"), 0.01)
        self.assertEqual(self.run_of(scene, "--max-parts", "8")["max_parts"], 8)

    def test_friction_is_coulombs_unless_the_file_or_an_option_says_another_model(self):
        # Thrown diagonally with 3 m/s at μ = 0.5 it slides v²/(2μg) = 0.917 m, less v h/2; by the box 1/√2 of it.
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/240", "time": 1,
                 "settings": {"friction": 0.5},
                 "bodies": [{"plane": {"n": [0, 0, 1], "offset": 0}},
                            {"x": [0, 0, 0.1], "v": [3 / math.sqrt(2), 3 / math.sqrt(2), 0], "mass": 1,
                             "half_sides": [0.2, 0.2, 0.1]}]}

        def run(*options: str) -> tuple[float, str]:
            said = self.run_of(scene, *options)["friction_model"]
            x, y, _ = map(float, self.positions(self.file, *options)[-1][-3:])
            return math.hypot(x, y), said

        coulomb = 9 / (2 * 0.5 * 9.81) - 3 / 480
        for options, model, wanted in (((), "cone", coulomb), (("--friction-model", "box"), "box", coulomb / math.sqrt(2))):
            way, said = run(*options)
            self.assertEqual(said, model)
            self.assertAlmostEqual(way, wanted, delta=0.01)
        scene["settings"]["friction_model"] = "box"
        self.assertEqual(run()[1], "box")
        self.assertEqual(run("--friction-model", "two_pass")[1], "two_pass")

    def test_a_run_says_the_order_that_its_file_has(self):
        scene = {"format": "spook scene", "version": 2, "model": "point", "h": "1/60", "time": 0.5,
                 "settings": {"integrator_order": 4}, "bodies": [{"x": [0, 0, 0], "mass": 1}]}
        self.assertEqual(self.run_of(scene)["integrator_order"], 4)
        self.assertEqual(self.run_of(scene, "--integrator-order", "2")["integrator_order"], 2)

    def test_materials_are_those_of_bodies_or_of_a_pair(self):
        """Two boxes on a slope in the axes of the slope: one sticks and one slides, by a material each."""
        slope, mu, g = math.radians(20), 0.5, 9.81
        box = {"mass": 1, "half_sides": [0.1, 0.1, 0.1]}
        scene = {"format": "spook scene", "version": 2, "model": "rigid", "h": "1/240", "time": 1,
                 "settings": {"gravity": [g * math.sin(slope), 0, -g * math.cos(slope)], "friction": mu},
                 "bodies": [{"plane": {"n": [0, 0, 1], "offset": 0}}, {"x": [0, 0, 0.1], **box}, {"x": [0, 1, 0.1], **box}]}
        of_body, of_pair = copy.deepcopy(scene), copy.deepcopy(scene)
        of_body["bodies"][2]["material"] = {"friction": 0}
        of_pair["materials"] = [{"i": 2, "j": 0, "friction": 0}]
        for changed_scene in (of_body, of_pair):
            self.file.write_text(json.dumps(changed_scene))
            *_, x, y, z = map(float, self.positions(self.file)[-1])
            self.assertAlmostEqual(x, g * math.sin(slope) / 2, delta=0.02)  # of order h
            self.assertLess(abs(float(self.positions(self.file)[-1][3])), 1e-3)
            exported = json.loads(self.spook("scenes", self.file, "--export").stdout)
            self.assertEqual((exported["bodies"][2].get("material"), exported.get("materials")),
                             ({"friction": 0.0}, None) if changed_scene is of_body
                             else (None, [{"i": 0, "j": 2, "friction": 0.0}]))

    def test_a_body_that_is_not_fixed_may_say_so(self):
        self.file.write_text(json.dumps(changed("bodies.3.fixed", False)))
        said_so = self.positions(self.file)
        self.file.write_text(json.dumps(EXAMPLE))
        self.assertEqual(self.positions(self.file), said_so)

    def test_an_answer_belongs_to_a_step_of_the_run(self):
        self.file.write_text(json.dumps(EXAMPLE))
        for words in (["--h", "0.3"], ["--h", "5"]):  # before, the step next to it was compared
            done = self.spook("run", self.file, *words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"expected[0].time must be a whole number of steps of {words[1]} s, but is 2", done.stderr)
        self.assertLess(self.run_of(EXAMPLE, "--h", "0.01", "--substeps", "2")["error"]["value"], 1)

    def test_a_wrong_answer_is_off_by_its_tolerances(self):
        scene = changed("expected.0.x", [2, 0, 0.3])
        # 0.2 m and the sinking, in tenths of a millimetre.
        self.assertAlmostEqual(self.run_of(scene)["error"]["value"], 0.2 / 1e-4, delta=0.01)

    def test_without_an_answer_or_before_its_time_there_is_no_error(self):
        self.assertIsNone(self.run_of(changed("expected", None))["error"]["value"])
        self.assertIsNone(self.run_of(EXAMPLE, "--time", "1")["error"]["value"])
        self.file.write_text(json.dumps(changed("expected", None)))
        text = self.spook("run", self.file).stdout
        self.assertIn("error     no answer to compare with", text)
        self.assertNotIn("nan", text)
        self.assertNotIn("\nset ", text)  # it has no parameters

    def test_the_friction_model_is_named_with_parameters_and_without(self):
        for scene in (EXAMPLE, EXAMPLE | {"parameters": {"m": {"default": 5, "unit": "kg", "meaning": "a mass"}},
                                          "bodies": EXAMPLE["bodies"][:3] + [EXAMPLE["bodies"][3] | {"mass": "$m"}]}):
            self.file.write_text(json.dumps(scene))
            self.assertIn("friction cone, tangents fixed; auto", " ".join(self.spook("run", self.file).stdout.split()))

    def test_density_is_mass_by_volume(self):
        runs = []
        for of in ({"density": 2}, {"mass": 16}):  # of 8 m³
            self.file.write_text(json.dumps(changed("bodies.2", {"name": "ball", "x": [0, 0, 2],
                                                                 "half_sides": [1, 1, 1], **of})))
            runs.append(self.positions(self.file, "--time", "0.5"))
        self.assertEqual(*runs)

    def test_what_makes_no_sense_is_refused_with_its_place(self):
        for path, value, said in REFUSED:
            with self.subTest(f"{path}: {value}"):
                scene = changed(path, value)
                if path == "bodies.3.x" and value[1] is None:
                    self.assertIsNone(scene["bodies"][3]["x"][1])
                self.file.write_text(json.dumps(scene))
                done = self.spook("run", self.file)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn(said, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_what_is_no_json_is_told_with_its_line(self):
        self.file.write_text('{"format":\n  "spook scene",,}')
        self.assertRegex(self.spook("run", self.file).stderr, r"^spook: \S+/mine.json: line 2, column 17: ")
        self.assertIn("missing.json: the file cannot be read", self.spook("run", "missing.json").stderr)

    def test_a_key_is_given_once_in_an_object(self):
        text = json.dumps(changed("time", 1))
        self.file.write_text(text.replace('"time": 1', '"time": 2, "time": 1', 1))
        self.assertIn('"time" is given twice in one object', self.spook("run", self.file).stderr)

    def test_every_scene_that_is_exported_runs_the_same_to_the_last_bit(self):
        names = [scene["name"] for scene in json.loads(self.spook("scenes", "--json").stdout)["scenes"]]
        of_formulas = []
        for name in names:
            exported = self.spook("scenes", name, "--export")
            if exported.returncode != 0:
                self.assertEqual(exported.stderr, f"spook: {name} cannot be written as a file: its force is a formula\n")
                of_formulas.append(name)
                continue
            with self.subTest(name):
                self.file.write_text(exported.stdout)
                time = "0.5" if name == "pile" else "0.1"  # until spheres meet the walls, which have a material
                self.assertEqual(self.positions(name, "--time", time)[1:], self.positions(self.file, "--time", time)[1:])
        self.assertEqual(of_formulas, ["oscillator", "orbit", "andrews"])

    def test_mechanisms_are_read(self):
        # A motor turns a wheel to its upper limit, -inf being no lower one, and holds it there.
        wheel = {"i": "nail", "j": "ball", "p_j": [0, 0, 1], "kind": "hinge", "axis": [0, 0, 1],
                 "limits": {"lower": "-inf", "upper": 0.5}, "motor": {"speed": 1, "strength": 10}}
        self.file.write_text(json.dumps({**changed("joints.0", wheel), "bodies": [
            EXAMPLE["bodies"][1], {"name": "ball", "x": [0, 0, 2], "radius": 0.2, "mass": 1, "q": [1, 0, 0, 0]}],
            "expected": [{"body": "ball", "time": 2, "x": [0, 0, 2], "tolerance": 1e-4}]}))
        record = self.table.with_suffix(".jsonl")
        self.assertEqual(self.spook("run", self.file, "--record", record).returncode, 0)
        header, *_, frame, _ = (json.loads(line) for line in record.read_text().splitlines())
        self.assertEqual((header["joints"][0]["kind"], header["joints"][0]["rows"]), ("hinge", 7))
        w, *_, z = struct.unpack("<8f", base64.b64decode(frame["q"]))[4:]
        self.assertAlmostEqual(2 * math.atan2(z, w), 0.5, 3)  # and 10 N m/k_turn beyond

    def test_parameters_are_exported_too(self):
        exported = json.loads(self.spook("scenes", "tower", "--export", "--set", "boxes=3", "ratio=7").stdout)
        self.assertEqual(len(exported["bodies"]), 4)
        self.assertEqual(max(body.get("mass", 0) for body in exported["bodies"]),
                         7 * min(body["mass"] for body in exported["bodies"] if "mass" in body))
        self.file.write_text(json.dumps(exported))  # the page's first example
        self.assertEqual(self.run_of(exported, "--solver", "direct", "--time", "0.1")["friction_model"], "two_pass")
        block = json.loads(self.spook("scenes", "sliding_block", "--export").stdout)
        self.assertEqual(block["settings"]["friction_model"], "box")  # which is not the default
        for words in (["scenes", "--export"], ["scenes", "tower", "--set", "boxes=3"]):
            self.assertEqual(self.spook(*words).returncode, 2)

    def test_it_is_recorded_as_any_scene(self):
        self.file.write_text(json.dumps(EXAMPLE))
        record = self.table.with_suffix(".jsonl")
        self.assertEqual(self.spook("run", self.file, "--record", record).returncode, 0)
        self.assertEqual(json.loads(record.read_text().splitlines()[0])["scene"], "mine")


if __name__ == "__main__":
    unittest.main()
