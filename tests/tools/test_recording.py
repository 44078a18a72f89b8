"""`spook run --record` and `spook play`: `python3 test_recording.py PATH_TO_SPOOK`, or with SPOOK=path in the environment."""

import base64
import csv
import json
import math
import os
import select
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
from pathlib import Path

import numpy as np

SPOOK = os.environ.get("SPOOK", "spook")
FORMAT = Path(__file__).resolve().parents[2] / "solutions" / "recording" / "README.md"


def crowd(text: str, width: int, kind: str = "<f4") -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), kind).reshape(-1, width)


class Recordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "run.jsonl")

    def run_spook(self, *arguments: str, code: int = 0) -> subprocess.CompletedProcess:
        done = subprocess.run([SPOOK, "run", *arguments], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def record(self, *arguments: str, code: int = 0) -> tuple[dict, list[dict], dict]:
        self.run_spook(*arguments, "--record", str(self.file), code=code)
        header, *frames, end = map(json.loads, self.file.read_text(encoding="utf-8").splitlines())
        return header, frames, end

    def test_the_three_lines_of_the_description_read_it(self):
        lines = FORMAT.read_text(encoding="utf-8").partition("```python\n")[2].partition("```")[0]
        self.record("stack", "--time", "0.5")
        names: dict = {}
        warnings.simplefilter("ignore", ResourceWarning)  # three lines do not close what they read
        exec(lines.replace("run.jsonl", str(self.file)), names)
        self.assertEqual(names["x"].shape, (31, 4, 3))
        np.testing.assert_allclose(names["x"][0, 1:, 2], [0.5, 1.5, 2.5])

    def test_every_key_is_described(self):
        text = FORMAT.read_text(encoding="utf-8")
        for scene in ("pile", "cloth", "orbit", "pendulum", "incline", "flywheel", "door"):
            header, frames, end = self.record(scene, "--time", "0.2")
            shapes = {key for body in header["bodies"] for key in body}
            joints = {key for joint in header["joints"] for key in joint}
            keys = {*header, *(key for frame in frames for key in frame), *frames[0]["energy"], *end, *shapes, *joints,
                    *header["method"]}
            self.assertEqual([key for key in sorted(keys) if f"`{key}`" not in text and f'"{key}"' not in text], [])

    def test_positions_are_those_of_the_table(self):
        table = self.file.with_suffix(".csv")
        header, frames, end = self.record("pile", "--time", "0.5", "--csv", str(table), "--positions")
        with table.open(encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(end, {"end": "done"})
        self.assertEqual((header["frame_time"], len(frames), len(rows)), (0.02, 26, 51))
        for frame in frames:
            row = rows[frame["step"]]
            self.assertAlmostEqual(frame["time"], float(row["time [s]"]), 12)
            x = crowd(frame["x"], 3)
            told = [[float(row[f"{axis} of body {body} [m]"]) for axis in "xyz"] for body in range(len(x))]
            np.testing.assert_allclose(x, told, rtol=1e-6, atol=1e-30)
            self.assertEqual(frame["sample"], [float(row[name]) for name in header["columns"]])

    def test_contacts_carry_the_weight(self):
        header, frames, _ = self.record("tower", "--time", "1")
        forces = crowd(frames[-1]["contacts"], 10)[:, 7:] / header["method"]["h"]
        between = crowd(frames[-1]["between"], 2, "<i4")
        floor = next(body for body, shape in enumerate(header["bodies"]) if shape["shape"] == "plane")
        boxes = sum(not shape.get("fixed", False) for shape in header["bodies"])
        weight = boxes * header["parameters"]["m"] * header["parameters"]["g"]
        # On j; of those with the floor, which is always i.
        np.testing.assert_allclose(forces[between[:, 0] == floor].sum(axis=0), [0, 0, weight], atol=1e-3 * weight)
        gaps = crowd(frames[-1]["contacts"], 10)[:, 6]
        self.assertTrue((gaps <= 0).all())
        normals = crowd(frames[-1]["contacts"], 10)[:, 3:6]
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)

    def test_joints_pull_as_told(self):
        header, frames, _ = self.record("wire", "--set", "begin=at_rest", "links=3", "--time", "0.5", "--iterations", "500")
        pulls = -crowd(frames[-1]["joint_impulses"], 1)[:, 0] / header["method"]["h"]
        m, ratio, g = (header["parameters"][name] for name in ("m", "ratio", "g"))
        np.testing.assert_allclose(pulls, [(ratio + k) * m * g for k in (2, 1, 0)], rtol=1e-4)
        self.assertEqual([joint["kind"] for joint in header["joints"]], ["distance"] * 3)

    def test_a_hinge_tells_its_axis_and_its_rows(self):
        header, frames, _ = self.record("physical_pendulum", "--set", "stop=30", "--time", "0.1")
        joint, = header["joints"]
        self.assertEqual((joint["kind"], joint["rows"], joint["axis"]), ("hinge", 6, [0, -1, 0]))
        self.assertEqual(joint["limits"][0], None)  # no lower one
        self.assertAlmostEqual(joint["limits"][1], math.radians(30), 12)
        self.assertEqual(len(crowd(frames[-1]["joint_impulses"], 1)), 6)

    def test_turning_bodies_have_unit_quaternions(self):
        _, frames, _ = self.record("top", "--time", "2")
        for frame in frames:
            self.assertAlmostEqual(float(np.linalg.norm(crowd(frame["q"], 4)[0])), 1, 6)
            self.assertLess(abs(float(crowd(frame["q"], 4)[0] @ crowd(frame["ghost"], 7)[0, 3:])), 1.000001)

    def test_a_frame_is_a_whole_number_of_steps(self):
        for h, fps, expected in (("1/60", "60", 1 / 60), ("1/1000", "60", 0.017), ("0.1", "60", 0.1), ("1/240", "30", 1 / 30)):
            header, frames, _ = self.record("pendulum", "--h", h, "--fps", fps, "--time", "0.4")
            self.assertAlmostEqual(header["frame_time"], expected, 12)
            self.assertAlmostEqual(frames[1]["time"] - frames[0]["time"], expected, 12)
        header, frames, _ = self.record("stack", "--substeps", "4", "--time", "0.5")
        self.assertEqual([frame["step"] for frame in frames], [4 * n for n in range(31)])

    def test_much_is_said_beforehand(self):
        done = self.run_spook("cloth", "--h", "0.002", "--time", "2", "--record", str(self.file), "--fps", "1000")
        self.assertRegex(done.stderr, r"\Aspook: recording 1001 frames, \d+ MB and more with contacts; --fps [^\n]+\n\Z")
        megabytes = int(done.stderr.split("frames, ")[1].split()[0])
        self.assertAlmostEqual(megabytes, self.file.stat().st_size / 1e6, delta=0.15 * megabytes)
        self.assertEqual(self.run_spook("stack", "--record", str(self.file)).stderr, "")

    def test_a_run_that_blows_up_keeps_its_frames(self):
        _, frames, end = self.record("oscillator", "--h", "2.1", "--time", "30000", "--set", "k=1", code=1)
        self.assertEqual(end["end"], "blown up")
        self.assertIn("is not finite", end["why"])
        self.assertGreater(len(frames), 100)

    def test_what_makes_no_sense_is_refused_and_leaves_an_older_file(self):
        self.file.write_text("old")
        for call, named in (("orbit --fps 60", "record"), ("orbit --positions", "csv"),
                            (f"orbit --record {self.file} --fps 0", "fps"),
                            (f"orbit --record {self.file} --fps x", "fps"),
                            (f"orbit --record {self.file} --h -1", "h must"),
                            (f"wire --record {self.file} --set links=0", "links"),
                            ("orbit --record /nowhere/at/all.jsonl", "cannot be written")):
            done = self.run_spook(*call.split(), code=2)
            self.assertEqual(done.stdout, "")
            self.assertRegex(done.stderr, r"\Aspook: [^\n]+\n\Z")
            self.assertIn(named, done.stderr)
        self.assertEqual(self.file.read_text(), "old")


class Play(unittest.TestCase):
    """Each test ends by closing the program's input, which ends the program."""

    def play(self, *arguments: str) -> subprocess.Popen:
        process = subprocess.Popen([SPOOK, "play", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, bufsize=1)
        self.addCleanup(self.end, process)
        return process

    def end(self, process: subprocess.Popen):
        process.stdin.close()
        try:
            self.assertEqual(process.wait(timeout=60), 0, "the end of its input is the end of it")
        finally:
            process.kill()
            process.stdout.close()
            process.stderr.close()

    def tell(self, process: subprocess.Popen, **command):
        process.stdin.write(json.dumps(command) + "\n")
        process.stdin.flush()

    def until(self, process: subprocess.Popen, wanted) -> dict:
        """Returns the first line that satisfies the condition."""
        for _ in range(10_000):
            line = process.stdout.readline()
            self.assertTrue(line, "the program has ended")
            if wanted(found := json.loads(line)):
                return found
        self.fail("what was waited for never came")

    def frame_after(self, process: subprocess.Popen, seconds: float) -> dict:
        return self.until(process, lambda line: "step" in line and line["time"] >= seconds)

    def test_it_runs_as_run_does(self):
        process = self.play("orbit")
        header = json.loads(process.stdout.readline())
        self.assertTrue(header["live"])
        frame = self.frame_after(process, 0.2)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "run.jsonl")
            subprocess.run([SPOOK, "run", "orbit", "--time", "1", "--record", file], capture_output=True, check=True)
            same = next(line for line in map(json.loads, file.read_text().splitlines()) if line.get("step") == frame["step"])
        self.assertEqual(frame["x"], same["x"])
        self.assertNotIn("touched", frame)

    def test_it_keeps_real_time(self):
        process = self.play("orbit")
        begin = time.monotonic()
        self.frame_after(process, 1)
        # No sooner; how much later is the machine's affair.
        self.assertGreater(time.monotonic() - begin, 0.9)

    def test_it_holds_and_steps(self):
        process = self.play("orbit")
        self.tell(process, pause=True)
        self.tell(process, step=5)
        self.tell(process, nothing=True)  # its answer comes after all frames
        lines = []
        self.until(process, lambda line: lines.append(line) or "refused" in line)
        held = lines[-2]["step"]
        self.tell(process, step=7)
        self.assertEqual(json.loads(process.stdout.readline())["step"], held + 7)
        self.assertFalse(select.select([process.stdout], [], [], 0.2)[0], "nothing comes by itself")
        self.tell(process, pause=False)
        self.assertGreater(self.until(process, lambda line: "step" in line)["step"], held + 7)

    def test_what_is_turned_goes_on_from_where_the_bodies_are(self):
        process = self.play("pendulum", "--set", "angle=60")
        before = self.frame_after(process, 0.3)
        self.tell(process, set={"h": 0.002, "g": 0})
        header = self.until(process, lambda line: "format" in line)
        self.assertEqual((header["method"]["h"], header["parameters"]["g"]), (0.002, 0))
        after = json.loads(process.stdout.readline())
        self.assertGreaterEqual(after["time"], before["time"])
        far = np.abs(crowd(after["x"], 3) - crowd(before["x"], 3)).max()
        self.assertLess(far, 5 * (after["time"] - before["time"] + 0.02))
        self.tell(process, restart=True)
        self.assertEqual(self.until(process, lambda line: line.get("step") == 0)["time"], 0)

    def test_a_pull_moves_a_body(self):
        process = self.play("pile", "--set", "bodies=8")
        header = json.loads(process.stdout.readline())
        ball = next(k for k, body in enumerate(header["bodies"]) if body["shape"] == "ball")
        self.tell(process, pull={"body": ball, "point": [0, 0, 0], "to": [0, 0, 3]})
        held = self.until(process, lambda line: "format" in line)
        self.assertEqual(held["joints"][-1]["kind"], "ball")
        frame = self.until(process, lambda line: "x" in line and crowd(line["x"], 3)[ball, 2] > 2.5)
        self.assertTrue(frame["touched"])
        self.tell(process, pull={"body": ball + 1, "point": [0, 0, 0], "to": [0, 0, 3]})  # another, without a release
        self.assertEqual(self.until(process, lambda line: "format" in line)["joints"][-1]["j"], ball + 1)
        self.tell(process, release=True)
        self.assertEqual(self.until(process, lambda line: "format" in line)["joints"], [])
        self.until(process, lambda line: "x" in line and crowd(line["x"], 3)[ball, 2] < 2)

    def test_a_push_and_a_drop(self):
        process = self.play("stack", "--set", "bodies=1")
        self.tell(process, pause=True)
        self.tell(process, push={"body": 1, "impulse": [0, 0, 10]})
        self.tell(process, drop={"x": [3, 0, 1], "radius": 0.25, "mass": 2})
        header = self.until(process, lambda line: "format" in line and len(line["bodies"]) == 3)
        self.assertEqual(header["bodies"][2], {"shape": "ball", "radius": 0.25})
        self.tell(process, step=30)
        frame = self.until(process, lambda line: "x" in line and len(crowd(line["x"], 3)) == 3
                           and crowd(line["x"], 3)[1, 2] > 2)
        self.assertLess(crowd(frame["x"], 3)[2, 2], 0.9)

    def test_nonsense_is_refused_and_the_run_goes_on(self):
        process = self.play("pendulum")
        for command, named in (({"pull": {"body": 0, "point": [0, 0, 0], "to": [0, 0, 0]}}, "body"),
                               ({"pull": {"body": 1}}, "not found"), ({"set": {"h": -1}}, "h must"),
                               ({"set": {"nothing": 1}}, "nothing"), ({"set": {"solver": "magic"}}, "magic"),
                               ({"rate": 0}, "rate"), ({"pause": "yes"}, "boolean"), ({"fly": True}, "fly"),
                               ({"drop": {"x": [0, 0, 0], "radius": -1, "mass": 1}}, "radius"),
                               ({"step": "many"}, "number"), ({"step": 1.5}, "whole number up to 1e9, but is 1.5"),
                               ({"rate": 1e-12}, "from 1e-4 to 100, but is 1e-12"),
                               ({"push": {"body": 1.7, "impulse": [0, 0, 1]}}, "body must be a whole number"),
                               ({"pull": {"body": 0.7, "point": [0, 0, 0], "to": [0, 0, 0]}}, "but is 0.7")):
            self.tell(process, **command)
            self.assertIn(named, self.until(process, lambda line: "refused" in line)["refused"])
        process.stdin.write("this is no JSON\n[1, 2]\n\n")
        process.stdin.flush()
        self.until(process, lambda line: "refused" in line)
        now = self.until(process, lambda line: "step" in line)["time"]
        self.frame_after(process, now + 0.1)

    def frame_of(self, process: subprocess.Popen, **command) -> dict:
        """Returns the first frame after a command that is answered by a header."""
        self.tell(process, **command)
        self.assertIn("format", self.until(process, lambda line: "format" in line or "refused" in line))
        return json.loads(process.stdout.readline())

    def after(self, steps: int, *arguments: str) -> tuple[subprocess.Popen, dict]:
        """Returns a paused run that has made so many steps and perhaps a few more, and its frame."""
        process = self.play(*arguments)
        self.tell(process, pause=True)
        self.tell(process, step=steps)
        return process, self.until(process, lambda line: line.get("step", 0) >= steps)

    def test_an_option_of_the_method_keeps_the_error(self):
        for scene, steps, options in (("cradle", 30, ({"iterations": 60}, {"h": 0.006}, {"warm_start": "on"})),
                                      ("cradle", 3, ({"h": 0.004}, {"iterations": 60})),  # before the impact
                                      ("bouncing_ball", 1000, ({"iterations": 60}, {"h": 0.002}))):
            process, frame = self.after(steps, scene)
            self.assertLess(frame["error"], 1e-12)
            for option in options:
                frame = self.frame_of(process, set=option)
                self.assertLess(frame["error"], 1e-12, (scene, option))
                self.tell(process, step=40)
                after = self.until(process, lambda line: "step" in line)
                self.assertGreater(after["time"], frame["time"])
                self.assertLess(after["error"], 1e-12, (scene, option))
                self.assertNotIn("touched", after)

    def test_a_parameter_of_the_scene_marks_the_run_as_touched(self):
        process, before = self.after(50, "orbit")
        same = self.frame_of(process, set={"eccentricity": "1/2"})  # its default
        self.assertNotIn("touched", same)
        changed = self.frame_of(process, set={"eccentricity": 0.3})
        self.assertEqual((changed["touched"], changed["x"]), (True, before["x"]))
        self.assertTrue(self.frame_of(process, set={"h": 0.01})["touched"], "it stays so")
        again = self.frame_of(process, restart=True)
        self.assertNotIn("touched", again)

    def test_other_sizes_begin_the_run_again(self):
        for scene, change in (("stack", {"radius": 0.8}), ("pendulum", {"l": 2}), ("tower", {"side": 1.5}),
                              ("cloth", {"side": 2}), ("flat_box_100_contacts", {"side": 2})):
            process, before = self.after(50, scene)
            self.assertGreater(before["time"], 0)
            frame = self.frame_of(process, set=change)
            self.assertEqual((frame["time"], frame.get("touched")), (0, None), scene)
            self.tell(process, step=100)
            far = np.abs(crowd(self.until(process, lambda line: "step" in line)["x"], 3) - crowd(frame["x"], 3)).max()
            self.assertLess(far, 5, scene)

    def test_the_plain_engine_refuses_what_no_step_runs_and_goes_on(self):
        process = self.play("orbit", "--engine", "plain")
        bodies = json.loads(process.stdout.readline())["bodies"]
        planet = next(k for k, body in enumerate(bodies) if not body.get("fixed"))
        for paused in (False, True):
            self.tell(process, pause=paused)
            self.tell(process, pull={"body": planet, "point": [0, 0, 0], "to": [0, 0, 3]})
            refused = self.until(process, lambda line: "refused" in line)["refused"]
            self.assertRegex(refused, "plain engine .* cannot run a scene with a force field")
            self.tell(process, step=5)
            frame = self.until(process, lambda line: "step" in line)
            self.assertEqual(len(crowd(frame["x"], 3)), len(bodies))
            self.assertNotIn("touched", frame)

        process = self.play("top", "--engine", "plain")
        self.tell(process, set={"update": "exponential"})
        self.assertIn("rotation update", self.until(process, lambda line: "refused" in line)["refused"])
        self.frame_after(process, self.until(process, lambda line: "step" in line)["time"] + 0.1)

    def test_the_plain_engine_pulls_and_drops_what_a_step_can(self):
        process = self.play("stack", "--engine", "plain")
        self.tell(process, pull={"body": 3, "point": [0, 0, 0], "to": [0, 0, 5]})
        self.assertEqual(len(self.until(process, lambda line: "format" in line and line["joints"])["joints"]), 1)
        frame = self.until(process, lambda line: "x" in line and crowd(line["x"], 3)[3, 2] > 4)
        self.assertTrue(frame["touched"])
        self.tell(process, drop={"x": [3, 0, 1], "radius": 0.25, "mass": 2})
        self.until(process, lambda line: "format" in line and len(line["bodies"]) == 6)

    def test_a_run_that_is_lost_says_so_and_can_be_begun_again(self):
        process = self.play("oscillator", "--h", "2.1", "--set", "k=1")
        self.tell(process, rate=100)
        self.tell(process, step=100_000)
        self.assertEqual(self.until(process, lambda line: "end" in line)["end"], "blown up")
        self.tell(process, set={"h": 0.1})
        self.tell(process, restart=True)
        self.frame_after(process, 1)

    def test_bad_options_are_refused_before_anything_is_written(self):
        for call in ("obrit", "orbit --h x", "orbit --csv file", "orbit --fps -3", "andrews --engine plain", ""):
            done = subprocess.run([SPOOK, "play", *call.split()], capture_output=True, text=True, timeout=120,
                                  stdin=subprocess.DEVNULL)
            self.assertEqual((done.returncode, done.stdout), (2, ""), call)
            self.assertRegex(done.stderr, r"\Aspook: [^\n]+\n\Z")


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        SPOOK = sys.argv.pop(1)
    unittest.main()
