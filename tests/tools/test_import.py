"""./course import: small models of each kind that MJCF has, against closed forms and what Lagrange's equations say."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(os.environ.get("COURSE_SOURCE", Path(__file__).resolve().parents[2]))
MODELS = ROOT / "tests" / "models"
sys.path.insert(0, str(ROOT / "tools" / "course"))

from importing.shapes import _VOLUME, _surface  # noqa: E402
from importing.turning import about, from_matrix, matrix, product, turn_of  # noqa: E402
from xml.etree.ElementTree import fromstring  # noqa: E402

WHOLE = """<mujoco><compiler {compiler}/><option {option}/><default>{default}</default>
<worldbody>{world}</worldbody>{rest}</mujoco>"""


class Import(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="spook-import-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def course(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([str(ROOT / "course"), *map(str, words)], capture_output=True, text=True)

    def imported(self, model: Path) -> tuple[dict, str]:
        done = self.course("import", model)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def written(self, world: str, **parts: str) -> Path:
        path = self.folder / "model.xml"
        path.write_text(WHOLE.format(**{"compiler": "", "option": "", "default": "", "rest": ""} | parts, world=world))
        return path

    def refused(self, world: str, words: str, **parts: str) -> None:
        done = self.course("import", self.written(world, **parts))
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(words, done.stderr)

    def run_of(self, scene: dict, *words) -> tuple[dict, dict[str, np.ndarray]]:
        """Returns the report of a run, and columns of positions."""
        file, table = self.folder / "scene.json", self.folder / "table.csv"
        file.write_text(json.dumps(scene))
        done = self.course("run", file, "--json", "--csv", table, "--positions", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = list(csv.reader(table.read_text().splitlines()))
        return json.loads(done.stdout), dict(zip(rows[0], np.array(rows[1:], dtype=float).T))

    def at(self, table: dict, scene: dict, name: str) -> np.ndarray:
        """Returns the positions of a body, a row for each step."""
        k = next(k for k, body in enumerate(scene["bodies"]) if body["name"] == name)
        return np.column_stack([table[f"{axis} of body {k} [m]"] for axis in "xyz"])

    # What a geom weighs, and where it ends

    def test_moments_are_those_of_points_spread_through_the_shape(self):
        random = np.random.default_rng(1)
        inside = {"sphere": lambda p, s: (p**2).sum(1) < s[0]**2,
                  "ellipsoid": lambda p, s: ((p / s)**2).sum(1) < 1,
                  "box": lambda p, s: (abs(p) < s).all(1),
                  "cylinder": lambda p, s: (p[:, 0]**2 + p[:, 1]**2 < s[0]**2) & (abs(p[:, 2]) < s[1]),
                  "capsule": lambda p, s: p[:, 0]**2 + p[:, 1]**2 + np.maximum(0, abs(p[:, 2]) - s[1])**2 < s[0]**2}
        for kind, test in inside.items():
            size = np.array([0.3, 0.5, 0.2])[:{"sphere": 1, "capsule": 2, "cylinder": 2}.get(kind, 3)]
            points = random.uniform(-1, 1, (400_000, 3))
            within = points[test(points, size)]
            volume, moments = _VOLUME[kind](size)
            # 8 m³ of which the part p is hit: four standard deviations of a mean of so many.
            part = volume / 8
            self.assertAlmostEqual(len(within) / len(points), part, delta=4 * math.sqrt(part / len(points)), msg=kind)
            squares = within**2
            found = squares.sum(1)[:, None] - squares
            margin = 4 * found.std(axis=0) / math.sqrt(len(within))
            self.assertTrue((abs(found.mean(axis=0) - moments) < margin).all(), (kind, found.mean(axis=0), moments))

    def test_points_lie_on_the_surface_and_reach_as_far(self):
        for kind, size in (("sphere", [0.3]), ("ellipsoid", [0.3, 0.2, 0.1]), ("capsule", [0.1, 0.4]),
                           ("cylinder", [0.1, 0.4]), ("box", [0.1, 0.2, 0.3])):
            points = _surface(kind, np.array(size))
            ends = {"sphere": [0.3] * 3, "ellipsoid": size, "capsule": [0.1, 0.1, 0.5], "cylinder": [0.1, 0.1, 0.4],
                    "box": size}[kind]
            np.testing.assert_allclose(points.max(axis=0), ends, atol=1e-12)
            np.testing.assert_allclose(points.min(axis=0), -np.array(ends), atol=1e-12)
            if kind in ("sphere", "ellipsoid"):
                np.testing.assert_allclose(((points / ends)**2).sum(1), 1, atol=1e-12)

    # How it is turned

    def test_a_turn_is_the_same_however_it_is_written(self):
        half = math.sqrt(0.5)
        for text in ("quat='2 0 0 2'", "axisangle='0 0 3 90'", "euler='0 0 90'", "xyaxes='0 2 0 -1 5 0'"):
            turned = turn_of(fromstring(f"<geom {text}/>"), True, "xyz")
            np.testing.assert_allclose(turned, [half, 0, 0, half], atol=1e-12, err_msg=text)
        turned = matrix(turn_of(fromstring("<geom zaxis='1 1 0'/>"), True, "xyz"))
        np.testing.assert_allclose(turned[:, 2], [half, half, 0], atol=1e-12)

    def test_euler_angles_are_about_moving_axes_or_fixed_ones(self):
        x, y = about(np.eye(3)[0], 0.3), about(np.eye(3)[1], 0.5)
        element = fromstring("<geom euler='0.3 0.5 0'/>")
        np.testing.assert_allclose(turn_of(element, False, "xyz"), product(x, y), atol=1e-12)
        np.testing.assert_allclose(turn_of(element, False, "XYZ"), product(y, x), atol=1e-12)

    def test_a_matrix_gives_its_quaternion_at_every_angle(self):
        random = np.random.default_rng(2)
        for angle in (0, 1e-9, 1, math.pi - 1e-9, math.pi):
            q = about(random.normal(size=3), angle)
            np.testing.assert_allclose(matrix(from_matrix(matrix(q))), matrix(q), atol=1e-12)

    # What comes out

    def test_defaults_go_down_the_classes_and_the_childclass_holds(self):
        scene, _ = self.imported(self.written(
            "<body childclass='a'><freejoint/><geom/><geom class='b' pos='0 0 1'/>"
            "<geom density='1' pos='0 0 2'/></body>",
            default="<geom size='0.1'/><default class='a'><geom type='box' size='.1 .1 .1'/>"
                    "<default class='b'><geom density='2000'/></default></default>"))
        self.assertAlmostEqual(scene["bodies"][0]["mass"], 0.008 * (1000 + 2000 + 1), places=12)
        self.assertAlmostEqual(scene["bodies"][0]["x"][2], (2000 * 1 + 2) / 3001, places=12)

    def test_a_free_sphere_and_a_free_box_are_what_they_are(self):
        scene, said = self.imported(MODELS / "ant.xml")
        bodies = {body["name"]: body for body in scene["bodies"]}
        self.assertEqual(bodies["ball"]["radius"], 0.2)
        self.assertEqual(bodies["crate"]["half_sides"], [0.2, 0.3, 0.1])
        np.testing.assert_allclose(bodies["crate"]["x"], [3, 0, 0.6], atol=1e-12)
        np.testing.assert_allclose(bodies["crate"]["q"], about(np.eye(3)[2], math.pi / 6), atol=1e-9)
        np.testing.assert_allclose(bodies["crate"]["principal"], 48 / 3 * np.array([0.1, 0.05, 0.13]), atol=1e-9)
        self.assertIn("armature of joints", said)

    def test_a_free_capsule_is_one_along_its_own_axis(self):
        scene, said = self.imported(self.written(
            "<geom type='plane' size='0 0 1'/>"
            "<body name='stick'><freejoint/><geom type='capsule' fromto='0 0 1 .6 0 1' size='.1'/></body>"))
        stick = next(body for body in scene["bodies"] if body["name"] == "stick")
        self.assertEqual((stick["radius"], stick["half_length"]), (0.1, 0.3))
        self.assertNotIn("corners", stick)
        np.testing.assert_allclose(abs(matrix(np.array(stick["q"]))[:, 2]), [1, 0, 0], atol=1e-9)
        self.assertLess(stick["principal"][2], stick["principal"][0])
        self.assertNotIn("capsule", said)

    def test_what_was_left_out_is_said(self):
        _, said = self.imported(self.written(
            "<geom type='plane' size='1 1 1'/><geom name='ground' type='hfield' hfield='x'/>"
            "<body><joint frictionloss='2'/><joint type='ball' range='0 1' damping='1' stiffness='1'/>"
            "<geom size='.1'/></body>",
            rest="<tendon><fixed/></tendon><sensor><gyro/></sensor>"
                 "<equality><tendon name='t'/></equality>"))
        for words in ("edges of planes", "geom \"ground\" of type hfield",
                      "stiffness of ball joints", "frictionloss of joints", "limits of ball joints",
                      "damping of ball joints", "equality tendon \"t\"", "tendon: 1", "bodies with several joints"):
            self.assertIn(words, said)
        self.assertNotIn("sensor", said)

    def test_what_is_not_known_is_named_with_line_and_body(self):
        _, said = self.imported(self.written(
            "<geom type='plane' size='0 0 1'/>\n"
            "<body name='b'><freejoint/><geom size='.1' solref='.01 1' solimp='1' margin='1' gap='1' fluidshape='ellipsoid' "
            "shellinertia='true' masss='2'/><spring/></body>\n<body name='c'><freejoint/><geom size='.1' gap='2'/></body>",
            option="density='1' viscosity='1' wind='1 0 0'"))
        for words in ("density of the option (line 1)", "viscosity of the option", "wind of the option",
                      *(f'{name} of geoms (line 3, body "b")' for name in ("solref", "solimp", "margin", "fluidshape",
                                                                            "shellinertia", "masss")),
                      'gap of geoms (line 3, body "b", and 1 more)',
                      'element spring, which the import does not know (line 3, body "b")'):
            self.assertIn(words, said)

    def test_what_changes_nothing_is_not_named(self):
        _, said = self.imported(self.written(
            "<light/><camera name='c'/><site/><geom type='plane' size='0 0 1' material='m' rgba='1 0 0 1'/>"
            "<body name='b' user='3'><freejoint align='false'/><geom size='.1' group='2' margin='0'/></body>",
            option="integrator='RK4' density='0' wind='0 0 0'", rest="<asset><material name='m'/></asset><size nkey='1'/>"))
        self.assertNotIn("left out", said)

    def test_flags_turn_off_what_they_say(self):
        hinge = "<body><joint axis='0 1 0' range='-10 10' damping='2'/><geom size='.1' pos='.5 0 0'/></body>"
        for flag, limits, motor in (("", True, True), ("<flag limit='disable'/>", False, True),
                                    ("<flag constraint='disable'/>", False, True), ("<flag passive='disable'/>", True, False)):
            scene, _ = self.imported(self.written(hinge, rest=f"<option>{flag}</option>"))
            self.assertEqual(("limits" in scene["joints"][0], "motor" in scene["joints"][0]), (limits, motor), flag)
        ball = "<geom type='plane' size='0 0 1'/><body><freejoint/><geom size='.1'/></body>"
        scene, _ = self.imported(self.written(ball, rest="<option><flag constraint='disable'/></option>"))
        self.assertTrue(all("radius" not in body and "plane" not in body for body in scene["bodies"]))
        tied = "<body name='a'><freejoint/><geom size='.1'/></body>"
        for flag, count in (("enable", 1), ("disable", 0)):
            scene, _ = self.imported(self.written(
                tied, rest=f"<option><flag equality='{flag}'/></option><equality><connect body1='a' anchor='0 0 1'/></equality>"))
            self.assertEqual(len(scene.get("joints", [])), count)

    def test_springs_of_joints_are_springs(self):
        # A slider under its weight comes to rest at springref - m g/k; a hinge's angles are in degrees.
        slide = ("<body name='s'><joint name='up' type='slide' axis='0 0 1' stiffness='200' damping='40' springref='.3' "
                 "ref='.1'/><geom size='.1' mass='2'/></body>")
        scene, said = self.imported(self.written(slide, option="timestep='.01'"))
        self.assertEqual(scene["joints"][0]["spring"], {"stiffness": 200, "damping": 40, "rest": 0.3 - 0.1})
        self.assertNotIn("motor", scene["joints"][0])
        self.assertNotIn("stiffness", said)
        _, table = self.run_of(scene, "--time", "5")
        self.assertAlmostEqual(self.at(table, scene, "s")[-1, 2], 0.2 - 2 * 9.81 / 200, delta=1e-6)
        hinge = "<body><joint axis='0 1 0' stiffness='3' springref='90'/><geom size='.1' pos='.5 0 0'/></body>"
        scene, _ = self.imported(self.written(hinge))
        self.assertAlmostEqual(scene["joints"][0]["spring"]["rest"], np.pi / 2)
        for flag in ("passive", "spring"):
            scene, _ = self.imported(self.written(hinge, rest=f"<option><flag {flag}='disable'/></option>"))
            self.assertNotIn("spring", scene["joints"][0])

    def test_a_weight_that_is_taken_from_all_is_gravity(self):
        body = "<body name='{0}' gravcomp='{1}'><freejoint/><geom size='.1'/></body>"
        scene, said = self.imported(self.written(body.format("a", 0.25) + body.format("b", 0.25)))
        np.testing.assert_allclose(scene["settings"]["gravity"], [0, 0, -0.75 * 9.81], rtol=1e-15)
        self.assertNotIn("gravcomp", said)
        scene, said = self.imported(self.written(body.format("a", 1) + body.format("b", 0)))
        self.assertEqual(scene["settings"]["gravity"], [0, 0, -9.81])
        self.assertIn('gravcomp of bodies, which is not the same for all (line 2, body "a")', said)

    def test_static_boxes_and_mocap_bodies_hold_what_falls_on_them(self):
        scene, _ = self.imported(self.written(
            "<geom type='box' size='2 2 .1'/><body name='table' mocap='true' pos='5 0 0'><geom type='box' size='1 1 .5'/></body>"
            "<body name='one' pos='0 0 .3'><freejoint/><geom type='box' size='.1 .1 .1'/></body>"
            "<body name='two' pos='5 0 .7'><freejoint/><geom size='.1'/></body>"))
        result, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        self.assertEqual(result["state"]["name"], "sound", result["state"])
        for name, height in (("one", 0.2), ("two", 0.6)):  # to a thousandth of a size, the engine's largest overlap
            self.assertAlmostEqual(self.at(table, scene, name)[-1, 2], height, delta=1e-3)

    def test_without_friction_where_both_have_condim_1(self):
        ball = "<geom type='plane' size='0 0 1' condim='{0}' friction='.7'/><body><freejoint/><geom size='.1' condim='{1}' friction='.4'/></body>"
        for plane, geom, friction in ((1, 1, 0.0), (3, 1, 0.7), (1, 3, 0.7), (3, 3, 0.7)):
            scene, _ = self.imported(self.written(ball.format(plane, geom)))
            self.assertEqual(scene["settings"]["friction"], friction)

    def test_excluded_contacts_leave_each_with_the_floor(self):
        pair = "".join(f"<body name='{name}' pos='0 0 {z}'><freejoint/><geom type='box' size='.1 .1 .1'/></body>"
                       for name, z in (("p", 0.1), ("q", 0.15)))
        scene, said = self.imported(self.written("<geom type='plane' size='0 0 1'/>" + pair,
                                                 rest="<contact><exclude body1='p' body2='q'/></contact>"))
        self.assertEqual(scene["no_contact"], [["p", "q"]])
        self.assertNotIn("left out", said.replace("edges of planes", ""))
        _, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        for name in "pq":
            self.assertAlmostEqual(self.at(table, scene, name)[-1, 2], 0.1, delta=1e-3)
        self.refused("<body name='p'><freejoint/><geom size='1'/></body>", "body that there is not: \"z\"",
                     rest="<contact><exclude body1='p' body2='z'/></contact>")

    def test_an_excluded_contact_with_a_static_body_is_that_bodys_alone(self):
        scene, said = self.imported(self.written(
            "<geom name='floor' type='plane' size='0 0 1'/><body name='table'><geom name='top' type='box' size='1 1 .1'/></body>"
            "<body name='b' pos='0 0 1'><freejoint/><geom size='.1'/></body>",
            rest="<contact><exclude body1='b' body2='table'/></contact>"))
        self.assertEqual(scene["no_contact"], [["b", "top"]])
        self.assertNotIn("excluded", said)

    def test_masks_keep_bodies_apart_which_stand_on_one_floor(self):
        ball = "<body name='{0}' pos='0 0 {1}'><freejoint/><geom size='.2' contype='{2}' conaffinity='{3}'/></body>"
        floor = "<geom name='floor' type='plane' size='0 0 1' contype='3' conaffinity='3'/>"
        scene, said = self.imported(self.written(floor + ball.format("b", .2, 1, 1) + ball.format("c", .7, 2, 2)))
        self.assertEqual(scene["no_contact"], [["b", "c"]])
        self.assertNotIn("contype", said)
        _, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        for name in "bc":
            self.assertAlmostEqual(self.at(table, scene, name)[-1, 2], 0.2, delta=1e-3)
        # One-sided masks: no two of these balls touch, but each touches the floor; d touches nothing.
        scene, _ = self.imported(self.written(floor + ball.format("b", 1, 1, 0) + ball.format("c", 2, 1, 0) + ball.format("d", 3, 4, 4)))
        self.assertEqual(scene["no_contact"], [["b", "c"]])
        self.assertNotIn("radius", next(body for body in scene["bodies"] if body["name"] == "d"))
        # Static bodies and planes have masks, too.
        scene, _ = self.imported(self.written(
            floor + "<geom name='shelf' type='box' size='1 1 .1'/>" + ball.format("b", 1, 1, 1) + ball.format("c", 2, 2, 2)))
        self.assertEqual(sorted(map(sorted, scene["no_contact"])), [["b", "c"], ["c", "shelf"]])

    def test_a_body_on_a_joint_keeps_its_shape_but_does_not_touch_its_parent(self):
        world = ("<body name='door' pos='0 0 1'><joint axis='0 0 1'/><geom type='capsule' fromto='0 0 0 .6 0 0' size='.1'/>"
                 "<body name='end' pos='.6 0 0'><joint axis='0 1 0'/><geom type='box' size='.1 .1 .1' pos='.1 0 0'/></body></body>"
                 "<body name='ball' pos='.3 -.5 1'><freejoint/><geom size='.1' mass='50'/></body>")
        scene, said = self.imported(self.written(world, option="gravity='0 0 0'"))
        bodies = {body["name"]: body for body in scene["bodies"]}
        self.assertEqual((bodies["door"]["radius"], bodies["door"]["half_length"]), (0.1, 0.3))
        self.assertEqual(bodies["end"]["half_sides"], [0.1] * 3)
        self.assertEqual(scene["no_contact"], [["door", "end"]])
        self.assertNotIn("left out", said)
        bodies["ball"]["v"] = [0, 1, 0]
        _, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        self.assertGreater(self.at(table, scene, "door")[-1, 1], 0.05)  # the ball pushes it open
        scene, _ = self.imported(self.written(world, rest="<option><flag filterparent='disable'/></option>"))
        self.assertNotIn("no_contact", scene)

    def test_a_body_with_a_centre_beside_its_geom_becomes_points(self):
        body = "<geom type='plane' size='0 0 1'/><body name='b'><freejoint/><inertial pos='{0} 0 0' mass='2' diaginertia='1 1 1'/><geom size='.1'/></body>"
        for offset, shape in ((0, "radius"), (0.01, "corners")):
            scene, said = self.imported(self.written(body.format(offset)))
            self.assertIn(shape, scene["bodies"][-1])
            self.assertEqual("contacts with anything but planes, of bodies with several geoms" in said, shape == "corners")

    def test_links_take_their_part_of_a_solids_inertia(self):
        scene, _ = self.imported(self.written("<body name='b'><joint/><joint axis='1 0 0'/><geom size='.1' mass='5'/></body>"))
        body = next(body for body in scene["bodies"] if body["name"] == "b")
        np.testing.assert_allclose(body["principal"], 0.99 * 5 * 0.4 * 0.01 * np.ones(3), rtol=1e-12)

    def test_a_spring_swings_at_its_frequency_about_its_reference(self):
        """A mass of 2 kg on a slider, without weight: ω = 6 rad/s for 72 N/m, about 0.3 m, where it stands still again."""
        box = "<body><joint type='slide' axis='1 0 0' stiffness='72' springref='.3' {0}/><geom type='box' size='.1 .1 .1' mass='2'/></body>"
        scene, said = self.imported(self.written(box.format(""), option="gravity='0 0 0'"))
        self.assertNotIn("left out", said)
        name = scene["bodies"][-1]["name"]
        _, table = self.run_of(scene, "--h", "1/500", "--time", "1")
        t = table["time [s]"]
        # A step of the engine's springs has order 2, with a relative error of the period of (ω h)²/24 and less than 1e-4.
        np.testing.assert_allclose(self.at(table, scene, name)[:, 0], 0.3 - 0.3 * np.cos(6 * t), atol=2e-3)
        damped, _ = self.imported(self.written(box.format("damping='24'"), option="gravity='0 0 0'"))  # critical
        _, table = self.run_of(damped, "--h", "1/500", "--time", "3")
        self.assertAlmostEqual(self.at(table, damped, name)[-1, 0], 0.3, delta=1e-4)

    def test_a_replicate_is_as_many_copies(self):
        scene, _ = self.imported(self.written(
            "<replicate count='12' offset='1 0 0' euler='0 0 90' sep='-'><body name='b' pos='0 0 1'><freejoint/>"
            "<geom size='.1'/></body></replicate>"))
        self.assertEqual([body["name"] for body in scene["bodies"]], [f"b-{k:02}" for k in range(12)])
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]  # each copy a quarter of a turn from the one before, and a metre on
        for k, body in enumerate(scene["bodies"]):
            np.testing.assert_allclose(body["x"], [*corners[k % 4], 1], atol=1e-12)
        self.refused("<replicate count='1.5'><body/></replicate>", "count of a replicate must be a whole number")
        inner = "<body><geom size='.1'/></body>"
        for nested in ("<replicate count='1000'>" * 200 + inner + "</replicate>" * 200,
                       f"<replicate count='9000'>{inner}</replicate>" * 20,
                       f"<body><replicate count='9000'>{inner}</replicate></body>" * 20):
            self.refused(nested, "the copies of all replicates must add at most 200000 elements, but add ")

    def test_a_start_outside_its_limits_is_told(self):
        _, said = self.imported(self.written("<body name='b'><joint axis='0 1 0' range='10 20'/><geom size='.1'/></body>"))
        self.assertIn('a joint begins outside its limits: the first steps push it back (line 2, body "b")', said)

    def test_nothing_left_to_simulate_is_an_error(self):
        self.refused("<geom type='box' size='1 1 1'/>", "nothing is left to simulate")
        self.refused("<composite><joint kind='main'/></composite>", "nothing is left to simulate")

    def test_bad_models_are_refused_in_one_line(self):
        self.refused("<body name='b'><joint/></body>", "body \"b\" (line 2, body \"b\") moves, but has no mass")
        self.refused("<body><joint type='screw'/><geom size='1'/></body>", "hinge, slide, ball or free joint")
        self.refused("<body><joint axis='0 0 0'/><geom size='1'/></body>", "axis of a joint (line 2) must have a length above 0, but has 0")
        self.refused("<body><freejoint/><geom size='1' class='c'/></body>", "class \"c\" of a geom (line 2) has no default")
        self.refused("<body name='p' pos='0 0'/>", "pos of body \"p\" (line 2, body \"p\") must be 3 numbers, but is \"0 0\"")
        self.refused("<body pos='0 0 x'/>", "pos of a body (line 2) must be 3 numbers")
        self.refused("<geom type='capsule' size='1'/>", "a geom (line 2) of type capsule must have 2 positive sizes, but has \"1\"")
        self.refused("<body><freejoint/><geom size='-1'/></body>", "must have 1 positive size, but has \"-1\"")
        self.refused("<body><freejoint/><geom type='spere' size='1'/></body>", "type of a geom (line 2) must be sphere, box,")
        self.refused("<body name='b'><freejoint/><inertial pos='0 0 0' mass='-1' diaginertia='1 1 1'/></body>",
                     "mass of a inertial (line 2, body \"b\") must be at least 0, but is \"-1\"")
        self.refused("<body name='b'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 5'/></body>",
                     "inertia of body \"b\" (line 2, body \"b\") must have positive principal moments")
        self.refused("<body><joint range='1 -1'/><geom size='1'/></body>",
                     "range of a joint (line 2) must have the lower bound first, but is \"1 -1\"")
        self.refused("<body><freejoint/><geom type='mesh'/></body>", "moves, but has no mass: give it an inertial, or a geom that is no mesh")
        self.refused("<body><freejoint/><geom size='1'/></body>", "names no file that there is: \"there_is_none.xml\"",
                     rest="<include file='there_is_none.xml'/>")
        body = "<body><freejoint/><geom size='1'/></body>"
        self.refused(body, "timestep of the option (line 1) must be a finite number, but is \"abc\"", option="timestep='abc'")
        self.refused(body, "gravity of the option (line 1) must be 3 numbers", option="gravity='0 9'")
        self.refused(body, "settotalmass of the compiler", compiler="settotalmass='much'")
        self.refused("<body><freejoint/><geom size='1' contype='a'/></body>", "contype of a geom")
        self.refused("", "coordinate=\"global\"", compiler="coordinate='global'")
        self.refused("<body>" * 400 + "<freejoint/><geom size='1'/>" + "</body>" * 400, "more than 300 deep")
        self.refused("<body pos='1e308 0 0'><freejoint/><geom size='1'/></body>", "pos of a body (line 2) must be at most 1e+30")
        self.refused("<body><freejoint/><geom size='1e308'/></body>", "must be at most 1e+30, but is")
        self.refused("<body><freejoint/><geom size='1' density='1e308'/></body>", "density")
        self.refused("<body><freejoint/><geom size='1'/></body>", "body that there is not", rest="<equality><connect body1='b' anchor='0 0 0'/></equality>")
        for text, words in (("<robot/>", "MJCF begins with <mujoco>, but this with <robot>: URDF is not read"), ("<mujoco>", "no element found")):
            (self.folder / "other.xml").write_text(text)
            done = self.course("import", self.folder / "other.xml")
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.course("import", self.folder / "none.xml").returncode, 2)

    def test_an_output_that_cannot_be_written_is_refused_first(self):
        model = self.written("<body><freejoint/><geom size='1'/></body>")
        text = model.read_text()
        for out, words in ((self.folder / "no" / "x.json", "cannot be written"), (model, "another file than the model")):
            done = self.course("import", model, "--out", out)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(model.read_text(), text)

    def test_pairs_have_the_friction_of_the_model(self):
        """It is the larger of two, or that of the higher priority; and 0 if both have condim 1."""
        floor = "<geom name='floor' type='plane' size='0 0 1' friction='{0}' {1}/>"
        body = "<body name='{0}'><freejoint/><geom size='.1' friction='{1}' {2}/></body>"

        def frictions(*parts):
            scene, said = self.imported(self.written("".join(parts)))
            self.assertNotIn("friction", said)
            usual, names = scene["settings"]["friction"], [each["name"] for each in scene["bodies"]]
            given = {frozenset((pair["i"], pair["j"])): pair.get("friction", usual) for pair in scene.get("materials", [])}
            return [given.get(frozenset((i, j)), usual) for k, i in enumerate(names) for j in names[k + 1:]]

        # In the order floor and a, floor and b, a and b.
        self.assertEqual(frictions(floor.format(0.3, ""), body.format("a", 0.1, ""), body.format("b", 0.5, "condim='6'")), [0.3, 0.5, 0.5])
        self.assertEqual(frictions(floor.format(0.9, "condim='1'"), body.format("a", 0.4, "condim='1'"), body.format("b", 0.5, "")), [0, 0.9, 0.5])
        self.assertEqual(frictions(floor.format(0.9, "priority='1'"), body.format("a", 0.4, ""), body.format("b", 0.5, "priority='2'")), [0.9, 0.5, 0.5])
        self.assertEqual(frictions(floor.format(0.9, "condim='1' priority='1'"), body.format("a", 0.4, ""), body.format("b", 0.5, "")), [0, 0, 0.5])
        two = "<body name='b'><freejoint/><geom size='.1' friction='{0}'/><geom size='.1' pos='1 0 0' friction='{1}'/></body>"
        _, said = self.imported(self.written(floor.format(0.1, "") + two.format(0.5, 0.7)))
        self.assertIn("frictions of single geoms of a body, all but the largest", said)
        _, said = self.imported(self.written(floor.format(1, "") + two.format(0.5, 0.7)))
        self.assertNotIn("frictions", said)

    def test_a_ball_that_resists_rolling_comes_to_rest(self):
        """It slows down by 5/7 g ρ/r; condim 4 has torsion alone."""
        model = ("<geom type='plane' size='0 0 1'/><body name='b' pos='0 0 .1'><freejoint/>"
                 "<geom size='.1' condim='{0}' friction='1 .004 .002'/></body>")
        scene, _ = self.imported(self.written(model.format(4)))
        self.assertEqual([each["torsional_resistance"] for each in scene["materials"]], [0.005])  # the floor's is larger
        self.assertNotIn("rolling_resistance", scene["materials"][0])
        scene, said = self.imported(self.written(model.format(6)))
        self.assertNotIn("left out", said)
        scene["bodies"][1] |= {"v": [1, 0, 0], "omega": [0, 10, 0]}
        _, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        self.assertAlmostEqual(self.at(table, scene, "b")[-1, 0], 1 - 5 / 7 * 9.81 * 0.002 / 0.1 / 2, delta=2e-3)

    def test_a_smooth_ball_slides_beside_one_that_rolls(self):
        ball = "<body name='{0}' pos='0 {1} .1'><freejoint/><geom size='.1' {2}/></body>"
        scene, _ = self.imported(self.written("<geom type='plane' size='0 0 1' condim='1'/>" + ball.format("smooth", 0, "condim='1'")
                                              + ball.format("rough", 1, "")))
        for body in scene["bodies"][1:]:
            body["v"] = [1, 0, 0]
        _, table = self.run_of(scene, "--h", "1/240", "--time", "1")
        self.assertAlmostEqual(self.at(table, scene, "smooth")[-1, 0], 1, delta=1e-3)
        # A ball that begins to roll keeps 5/7 of its speed; at μ = 1 that takes 2/7/g = 0.03 s.
        self.assertAlmostEqual(self.at(table, scene, "rough")[-1, 0], 5 / 7, delta=0.01)

    # How it moves

    def test_a_cart_with_a_pole_moves_by_lagrange(self):
        scene, _ = self.imported(MODELS / "cart_pole.xml")
        result, table = self.run_of(scene, "--h", "1/2000", "--time", "1")
        self.assertEqual(result["state"]["name"], "sound")
        moment = next(body for body in scene["bodies"] if body["name"] == "pole")["principal"]
        M, m, l, inertia, g = 2.0, 0.5, 0.4, max(moment), 9.81

        def rate(y):
            _, angle, v, turn = y
            sin, cos = math.sin(angle), math.cos(angle)
            a = np.linalg.solve([[M + m, m * l * cos], [m * l * cos, inertia + m * l * l]],
                                [m * l * sin * turn * turn, m * g * l * sin])
            return np.array([v, turn, *a])

        y, h = np.array([0, math.radians(5), 0, 0]), 1 / 2000
        for _ in range(2000):  # Runge and Kutta: an error of some 1e-12
            k1 = rate(y)
            k2 = rate(y + h / 2 * k1)
            k3 = rate(y + h / 2 * k2)
            y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3))
        # The engine's error: 1e-5 m with this h, a start of first order included.
        np.testing.assert_allclose(self.at(table, scene, "cart")[-1], [y[0], 0, 0.5], atol=1e-3)
        pole = [y[0] + l * math.sin(y[1]), 0, 0.5 + l * math.cos(y[1])]
        np.testing.assert_allclose(self.at(table, scene, "pole")[-1], pole, atol=1e-3)

    def test_a_chain_is_held_at_both_ends_and_keeps_its_plate(self):
        scene, said = self.imported(MODELS / "chain.xml")
        result, table = self.run_of(scene, "--time", "2")
        self.assertEqual(result["state"]["name"], "sound", result["state"])
        self.assertNotIn("together", said)  # it is not active
        # Straight between ends 1.2 m apart: it sags by what its joints give way, some 3 cm, as no tension is enough.
        for link in range(1, 5):
            x = self.at(table, scene, f"link {link}")
            np.testing.assert_allclose(x[-1], [0.3 * link - 0.15, 0, 1], atol=0.05)
        apart = self.at(table, scene, "plate") - self.at(table, scene, "link 3")
        np.testing.assert_allclose(np.linalg.norm(apart, axis=1), np.linalg.norm(apart[0]), atol=1e-3)

    def test_a_hopper_stays_in_its_plane_and_falls(self):
        scene, _ = self.imported(MODELS / "hopper.xml")
        self.assertEqual(scene["settings"]["friction"], 0.9)  # the larger of two
        result, table = self.run_of(scene, "--time", "2")
        self.assertEqual(result["state"]["name"], "sound", result["state"])
        trunk = self.at(table, scene, "trunk")
        self.assertLess(abs(trunk[:, 1]).max(), 1e-3)
        self.assertGreater(trunk[-1, 2], 0)

    def test_a_figure_and_an_ant_fall_on_the_floor_and_stay_there(self):
        for model, most in (("humanoid.xml", 1.4), ("ant.xml", 0.7)):
            scene, _ = self.imported(MODELS / model)
            result, table = self.run_of(scene, "--time", "2")
            self.assertEqual(result["state"]["name"], "sound", (model, result["state"]))
            for body in scene["bodies"]:
                if "mass" in body:
                    z = self.at(table, scene, body["name"])[:, 2]
                    self.assertGreater(z.min(), 0, (model, body["name"]))
                    self.assertLess(z.max(), most + 0.3, (model, body["name"]))

    def test_a_model_keeps_its_mass_whatever_its_joints(self):
        scene, _ = self.imported(MODELS / "humanoid.xml")
        alone, _ = self.imported(self.without_joints(MODELS / "humanoid.xml"))
        self.assertEqual(sum("mass" in body for body in alone["bodies"]), 1)
        mass = sum(body.get("mass", 0) for body in scene["bodies"])
        self.assertAlmostEqual(mass, alone["bodies"][-1]["mass"], places=9)
        self.assertEqual(len(scene["joints"]), 21)

    def without_joints(self, model: Path) -> Path:
        """All of it one body: what has no joint is part of its parent."""
        lines = [line for line in model.read_text().splitlines() if "<joint name" not in line and "<motor" not in line]
        (self.folder / "alone.xml").write_text("\n".join(lines))
        return self.folder / "alone.xml"


if __name__ == "__main__":
    unittest.main()
