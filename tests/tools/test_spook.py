"""The spook program, as it is called: `python3 test_spook.py PATH_TO_SPOOK`, or with SPOOK=path in the environment."""

import csv
import json
import math
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SPOOK = os.environ.get("SPOOK", "spook")
SCENES = Path(__file__).resolve().parents[2] / "solutions" / "scenes"


def spook(*arguments):
    return subprocess.run([SPOOK, *arguments], capture_output=True, text=True, timeout=600)


class Refusals(unittest.TestCase):
    """Invalid input gives one line on stderr that names it, nothing on stdout, and exit status 2."""

    def refused(self, call, *named):
        arguments = call.split() if isinstance(call, str) else call
        with self.subTest(call=arguments):
            done = spook(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stdout, "")
            self.assertRegex(done.stderr, r"\Aspook: [^\n]+\n\Z")
            for part in named:
                self.assertIn(part, done.stderr)

    def test_commands_and_scenes(self):
        self.refused("", "run", "scenes")
        self.refused("runn orbit", "runn", '"run"')
        self.refused("run", "SCENE")
        self.refused("run obrit", "obrit", '"orbit"')
        self.refused("run nothing_like_it", "orbit", "stack")
        self.refused("run orbit stack", "stack")
        self.refused("run orbit --itertions 4", "--itertions", '"--iterations"')
        self.refused("scenes obrit", "obrit", '"orbit"')

    def test_short_help_is_neither(self):
        for call in ["-h", "run -h", "run orbit -h 0.1", "scenes -h"]:
            self.refused(call, "--help", "--h ")

    def test_numbers(self):
        for text in ["1/0", "abc", "1e", "nan", "NaN", "inf", "-inf", "1e999", "", " 1", "1 s", "0x1", "1/2/3"]:
            for option in ["h", "time", "tolerance", "iterations"]:
                self.refused(["run", "stack", "--" + option, text], option, f'"{text}"')
            self.refused(["run", "stack", "--set", "k=" + text], "k", f'"{text}"')
        for text in ["0", "-1", "-1/60"]:
            self.refused(["run", "orbit", "--h", text], "h must be positive")
        self.refused("run orbit --time -1", "time", "-1")
        self.refused("run orbit --h 1e-12", "time/h", "1e9")
        self.refused("run stack --iterations 0", "iterations")
        self.refused("run stack --iterations 2.5", "iterations", "2.5")
        self.refused("run stack --tolerance -1", "tolerance", "-1")
        self.refused("run orbit --h 0.1 --h 0.2", "--h")
        self.refused("run orbit --h", "--h")

    def test_parameters(self):
        self.refused("run orbit --set eccentricty=0.1", "eccentricty", '"eccentricity"')
        self.refused("run orbit --set eccentricity=1", "eccentricity", "0.99")
        self.refused("run orbit --set axis=1 axis=2", "axis", "twice")
        self.refused("run orbit --set axis=1 --set axis=2", "axis", "twice")
        self.refused("run orbit --set axis", "NAME=VALUE")
        self.refused("run orbit --set =1", "NAME=VALUE")
        self.refused("run orbit --set h=1", "--h 1")
        self.refused("run orbit --set start=halfstep", "halfstep", '"half_step"')
        self.refused("run stack --set bodies=2.5", "bodies", "2.5")
        self.refused("run stack --set bodies=0", "bodies", "0")
        self.refused("run stack --set m=-1", "m must be more than 0", "-1")
        self.refused("run top --set gyroscopic=off", "gyroscopic", "update")
        self.refused("run top --set I1=5", "I2", "I1")

    def test_solvers(self):
        self.refused("run stack --solver gauss_siedel", "gauss_siedel", '"gauss_seidel"')
        self.refused("run orbit --solver none_such", "none_such", "gauss_seidel")

    def test_ways_of_solving(self):
        self.refused("run stack --friction-model cones", "friction-model", '"cone"')
        self.refused("run stack --tangents along", "tangents", "sliding")
        self.refused("run stack --row-order downn", "row-order", '"down"')
        self.refused("run stack --row-order up --solver direct", "order", "direct")
        self.refused("run pile --friction-model cone --solver direct", "cone", "direct")
        self.refused("run pile --solver geometric_stiffness", "geometric_stiffness")
        for option in ["substeps", "seed", "contact-margin"]:
            self.refused(f"run stack --{option} -1", option, "-1")
        self.refused("run stack --substeps 0", "substeps")
        for parts in ["0", "1025", "two", "3"]:
            self.refused(f"run stack --max-parts {parts}", "parts", parts)
        for threads in ["0", "257", "two"]:
            self.refused(f"run stack --threads {threads}", "threads", threads)

    def test_names_of_an_earlier_release_lead_to_the_present_ones(self):
        for words, now in (("stack --order up", "--row-order"), ("stack --order=up", "--row-order"),
                           ("stack --margin 0.1", "--contact-margin"), ("orbit --compose 4", "--integrator-order"),
                           ("stiff_wire --solver stiff", "geometric_stiffness"),
                           ("pile --solver stripes", "spatial_decomposition")):
            self.refused(f"run {words}", f'it is now called "{now}"')

    def test_steps_are_composed_only_where_that_is_of_order_four(self):
        self.refused("run orbit --integrator-order 3", "integrator-order", "3", "2, 4")
        self.refused("run double_pendulum --integrator-order 4", "d must be 0 with integrator_order 4", "3")
        self.refused("run stack --integrator-order 4 --set d=0", "integrator_order", "touch")
        self.refused("run sliding_block --integrator-order 4 --set d=0", "integrator_order", "touch", "friction")
        self.refused("run physical_pendulum --integrator-order 4 --set d=0 stop=30", "integrator_order", "limit")
        self.refused("run flywheel --integrator-order 4 --set d=0", "integrator_order", "motor")
        self.refused("run top --integrator-order 4 --set update=first_order", "integrator_order", "rotation")
        for option in ["solver direct", "row-order up", "friction-model cone", "tangents sliding", "max-parts 1", "warm-start"]:
            self.refused(f"run orbit --integrator-order 4 --{option}", option.split()[0], "integrator-order 4")
        self.refused("play orbit --integrator-order 4", "--integrator-order")

    def test_the_plain_engine_refuses_what_no_step_has(self):
        self.refused("run stack --engine mine", "engine", "plain")
        for option in ["contact-margin 0", "tangents sliding", "max-parts 1", "threads 2"]:
            self.refused(f"run stack --engine plain --{option}", option.split()[0], "--engine")
        for scene, has in (("andrews", "a wrench"), ("pile", "materials of single bodies"),
                           ("top --set update=first_order", "a rotation update")):
            self.refused(f"run {scene} --engine plain", f"cannot run a scene with {has}")

    def test_any_solver_follows_the_rows_of_the_plain_engine(self):
        for scene, exercise in (("stack", "4.7 step_contacts"), ("stack --solver direct", "9.9 step_rows"),
                                ("tower --friction-model two_pass", "9.9 step_rows"), ("stack --row-order up", "9.9 step_rows"),
                                ("stack --warm-start", "9.9 step_rows"), ("door", "9.9 step_rows"),
                                ("orbit --solver direct", "1.4 leapfrog_step")):
            with self.subTest(scene):
                said = spook("run", *scene.split(), "--engine", "plain", "--time", "0.05")
                self.assertEqual((said.returncode, said.stderr), (0, ""))
                self.assertIn(f"plain engine, exercise {exercise}", " ".join(said.stdout.split()))

    def test_the_plain_engine_hands_its_residual_back(self):
        """Ten sweeps leave most of what a stack of ten asks for, and the run says so; 2000 leave ρ^2000, with ρ = cos²(π/20)."""
        few, many = (json.loads(spook("run", "stack", "--engine", "plain", "--set", "bodies=10", "--time", "0.5",
                                      "--iterations", str(count), "--json").stdout) for count in (10, 2000))
        self.assertEqual(few["last_step"]["iterations"], 10)
        self.assertGreater(few["residual"], 0)
        self.assertEqual((few["state"]["name"], many["state"]["name"]), ("unsolved", "sound"))
        text = spook("run", "stack", "--engine", "plain", "--iterations", "10", "--time", "0.5").stdout
        self.assertRegex(text, r"residual  [\d.e-]+ m/s in the last step, after 10 iterations")

    def test_the_plain_engine_shows_no_zero_for_what_it_does_not_report(self):
        text = " ".join(spook("run", "resting_sphere", "--engine", "plain", "--time", "1").stdout.split())
        self.assertIn("; not reported by this engine: lambda", text)
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder, "a.csv")
            spook("run", "rope", "--engine", "plain", "--time", "0.1", "--csv", str(table))
            rows = list(csv.DictReader(table.read_text(encoding="utf-8").splitlines()))
        self.assertEqual({row["end tension [N]"] for row in rows}, {"nan"})
        self.assertNotIn("nan", {row["answer's end [N]"] for row in rows} | {row["energy [J]"] for row in rows})

    def test_the_plain_engine_bounces_as_high_as_the_answer(self):
        said = json.loads(spook("run", "bouncing_ball", "--engine", "plain", "--json").stdout)
        # Chapter 07 finds the ball a step late: a bounce gains or loses a height of h v, 4.4 mm of 1 m.
        self.assertLess(said["error"]["value"], 0.0045)

    def test_an_accuracy_is_that_of_auto(self):
        words = "run stack --set bodies=3 --time 1 --json --accuracy"
        found = {accuracy: json.loads(spook(*words.split(), accuracy).stdout) for accuracy in ("1e-9", "0.1")}
        self.assertEqual([found[accuracy]["accuracy"] for accuracy in found], [1e-9, 0.1])
        self.assertEqual({found[accuracy]["solver"] for accuracy in found}, {"auto"})
        named = json.loads(spook(*words.split(), "0.1", "--solver", "auto").stdout)
        self.assertEqual((named["accuracy"], named["row_updates"]), (0.1, found["0.1"]["row_updates"]))
        said = " ".join(spook("run", "stack", "--accuracy", "1e-9", "-v").stdout.split())
        self.assertIn("or to 1e-09 of the right-hand side", said)
        for accuracy in ["0", "-1", "1.5", "nan", "high"]:
            self.refused(f"run stack --accuracy {accuracy}", "accuracy", accuracy)
        for option in ["solver direct", "row-order up", "soft-steps 4", "integrator-order 2"]:
            self.refused(f"run stack --accuracy 1e-3 --{option}", option.split()[0], "accuracy")
        self.refused("run stack --engine plain --accuracy 1e-3", "accuracy", "use --engine fast")

    def test_soft_steps_have_sweeps_of_their_own(self):
        for option in ["solver direct", "iterations 5", "tolerance 1", "row-order up", "friction-model cone",
                       "integrator-order 2", "warm-start"]:
            self.refused(f"run stack --soft-steps 4 --{option}", option.split()[0], "soft-steps")
        for substeps in ["0", "1025", "few"]:
            self.refused(f"run stack --soft-steps {substeps}", "soft-steps", substeps)
        self.refused("run stack --engine plain --soft-steps 4", "soft-steps", "use --engine fast")
        self.refused("run pile --engine plain", "cannot run a scene with materials", "leave out --engine")

    def test_csv(self):
        self.refused("run orbit --csv /no/such/folder/a.csv", "csv", "/no/such/folder/a.csv")
        with tempfile.TemporaryDirectory() as folder:
            kept = Path(folder, "kept.csv")
            kept.write_text("mine")
            self.refused(["run", "top", "--set", "I1=5", "--csv", str(kept)], "I2")
            self.refused(["run", "top", "--h", "0", "--csv", str(kept)], "h")
            self.refused(["run", "andrews", "--engine", "plain", "--csv", str(kept)], "wrench")
            self.assertEqual(kept.read_text(), "mine")
            self.refused(["run", "orbit", "--csv", folder], "csv", folder)

    def test_a_refused_output_changes_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            kept, new = Path(folder, "kept.csv"), Path(folder, "new.csv")
            kept.write_text("mine")
            for csv in (kept, new):
                self.refused(["run", "stack", "--csv", str(csv), "--record", "/nonexist/r", "--time", "0.1"], "record", "/nonexist/r")
            self.refused(["run", "stack", "--csv", str(new), "--record", folder], "record", folder)
            self.assertEqual((kept.read_text(), os.listdir(folder)), ("mine", ["kept.csv"]))

    def test_two_outputs_or_an_input_and_an_output_are_two_files(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, state, other = (str(Path(folder, name)) for name in ("a.json", "a.state", "other"))
            text = spook("scenes", "tower", "--export").stdout
            Path(scene).write_text(text)
            run = ["run", scene, "--time", "0.1"]
            self.assertEqual(spook(*run, "--checkpoint", state).returncode, 0)
            os.symlink(scene, Path(folder, "link"))
            for words, named in (([*run, "--csv", scene], ["--csv must be another file than the scene", scene]),
                                 ([*run, "--record", str(Path(folder, "link"))], ["--record", "the scene"]),
                                 ([*run, "--checkpoint", scene], ["--checkpoint", "the scene"]),
                                 ([*run, "--csv", other, "--record", other], ["--record", "that of --csv", other]),
                                 ([*run, "--csv", other, "--checkpoint", folder + "/./other"], ["--checkpoint", "that of --csv"]),
                                 ([*run, "--csv", state, "--restart", state], ["--csv", "that of --restart"])):
                self.refused(words, *named)
            inside = subprocess.run([SPOOK, *run, "--csv", "new", "--checkpoint", "./new"], cwd=folder, text=True,
                                    capture_output=True, check=False)
            self.assertEqual((inside.returncode, Path(folder, "new").exists()), (2, False), inside.stderr)
            self.assertIn("--checkpoint must be another file", inside.stderr)
            self.assertEqual((Path(scene).read_text(), Path(other).exists()), (text, False))
            self.assertEqual(spook(*run, "--restart", state, "--checkpoint", state).returncode, 0)
            self.assertEqual(spook(*run, "--csv", "/dev/null", "--record", "/dev/null").returncode, 0)

    def test_options_that_lack_a_value_or_have_two(self):
        self.refused("run orbit --h 1/60 --h 1/30", "--h is given twice: leave one out")
        self.refused("run orbit --csv", "--csv needs a value")
        self.refused("run orbit --set", "--set needs a value")
        self.refused("run stack --iterations 10,12", "iterations must be one number", '"10,12"', "a sweep of iterations takes a list")
        self.refused("run orbit --seed 3", "seed has no effect without row-order random: leave it out")
        self.refused("run pile --seed 3 --row-order up", "for the scene's own, use --set seed=3")
        self.refused("run stack --iterations many", "iterations must be a whole number from 1", '"many"')


class Runs(unittest.TestCase):
    def test_json_has_what_it_promises(self):
        call = ["run", "orbit", "--set", "eccentricity=1/4", "start=unshifted", "--h", "1/60", "--time", "5", "--json"]
        done = spook(*call)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        result = json.loads(done.stdout)
        self.assertRegex(result["program"]["version"], r"^\d+\.\d+\.\d+$")
        self.assertRegex(result["program"]["compiler"], r"^\w+ \d+\.")
        self.assertEqual(result["scene"], "orbit")
        self.assertEqual(
            result["parameters"], {"m": 1, "eccentricity": 0.25, "axis": 1, "gm": 1, "start": "unshifted"}
        )
        self.assertEqual(result["solver"], "none")
        self.assertIsNone(result["residual"])
        self.assertEqual((result["h"], result["steps"]), (1 / 60, 300))
        self.assertGreater(result["us_per_step"], 0)
        self.assertEqual(result["error"]["unit"], "relative")
        self.assertTrue(0 < result["error"]["value"] < 1)
        self.assertEqual(json.loads(spook(*call).stdout)["error"], result["error"])

    def test_scene_with_contacts_reports_its_solver(self):
        done = spook("run", "resting_sphere", "--json", "--solver", "gauss_seidel", "--iterations", "7")
        result = json.loads(done.stdout)
        self.assertEqual((result["solver"], result["iterations"]), ("gauss_seidel", 7))
        self.assertLessEqual(result["residual"], 1e-12)
        self.assertLessEqual(result["error"]["value"], 1e-9)
        self.assertEqual(result["last_step"]["rows"], 1)

    def test_each_way_of_solving_is_said_and_done(self):
        for solver in ["gauss_seidel", "conjugate_gradients", "anderson", "newton", "direct", "auto", "geometric_stiffness"]:
            run = json.loads(spook("run", "wire", "--solver", solver, "--iterations", "1000", "--json").stdout)
            self.assertEqual(run["solver"], solver)
            self.assertLess(run["error"]["value"], 1e-6, solver)
        # What has sweeps of its own replaces the scene's solver, unless one is named.
        run = json.loads(spook("run", "tower", "--row-order", "random", "--seed", "3", "--json").stdout)
        self.assertEqual((run["solver"], run["row_order"]), ("gauss_seidel", "random"))
        for order in ["given", "up", "down", "interleaved"]:
            run = json.loads(spook("run", "tower", "--row-order", order, "--time", "0.1", "--json").stdout)
            self.assertEqual(run["row_order"], order)
        run = json.loads(spook(*"run spinning_disc --friction-model cone --tangents sliding --warm-start --contact-margin "
                               "0.001 --json".split()).stdout)
        self.assertEqual([run["friction_model"], run["tangents"], run["warm_start"], run["contact_margin"]],
                         ["cone", "sliding", True, 0.001])

    def test_stages_add_up_to_the_speed(self):
        for scene in ["orbit", "tower"]:
            run = json.loads(spook("run", scene, "--time", "0.5", "--json").stdout)
            stages = [time for time in run["us_per_step_of_stage"].values() if time is not None]
            self.assertTrue(math.isclose(sum(stages), run["us_per_step"], rel_tol=1e-9), run)

    def test_substeps_are_steps_of_a_part_of_h(self):
        whole = json.loads(spook(*"run free_fall --h 0.1 --substeps 10 --json".split()).stdout)
        parts = json.loads(spook(*"run free_fall --h 0.01 --json".split()).stdout)
        self.assertEqual(whole["substeps"], 10)
        self.assertEqual(10 * whole["steps"], parts["steps"])
        self.assertEqual(whole["error"], parts["error"])
        self.assertIn("each of 10 substeps", spook(*"run free_fall --h 0.1 --substeps 10".split()).stdout)

    def test_threads_change_the_time_alone(self):
        words = "run pile --set bodies=300 mu=0.3 --solver spatial_decomposition --iterations 10 --time 0.3 --h 1/240".split()
        said = " ".join(spook(*words, "--threads", "2").stdout.split())
        self.assertIn("on 2 threads", said)
        self.assertIn("friction two_pass, tangents fixed; spatial_decomposition, at most 10 sweeps", said)
        one, two = (json.loads(spook(*words, "--threads", n, "--json").stdout) for n in "12")
        self.assertEqual([one["threads"], two["threads"]], [1, 2])
        for what in ["error", "residual", "row_updates", "last_step"]:
            self.assertEqual(one[what], two[what])

    def test_soft_steps_say_so(self):
        words = "run stack --set bodies=3 --soft-steps 4 --time 1"
        self.assertIn("soft steps of 4 substeps", " ".join(spook(*words.split()).stdout.split()))
        run = json.loads(spook(*words.split(), "--json").stdout)
        self.assertEqual((run["soft_steps"], run["solver"], run["iterations"], run["friction_model"]),
                         (4, "none", None, "cone"))
        self.assertIsNone(run["error"]["value"])
        self.assertIn("none in this run: largest error of the last gaps", " ".join(spook(*words.split()).stdout.split()))
        self.assertEqual(json.loads(spook(*"run orbit --soft-steps 4 --time 1 --json".split()).stdout)["soft_steps"], 4)
        for mu, limit in (("0", 1e-9), ("0.3", 0.02)):  # the start is half a substep back
            slope = json.loads(spook(*f"run incline --set mu={mu} --soft-steps 8 --json".split()).stdout)
            self.assertLess(slope["error"]["value"], limit)
        self.assertEqual(run["last_step"]["iterations"], 8)
        self.assertEqual(run["row_updates"], 8 * run["last_step"]["rows"] * run["steps"])

    def test_composed_steps_say_so(self):
        words = "run double_pendulum --set d=0 --integrator-order 4 --h 1/60"
        text = spook(*words.split()).stdout
        self.assertIn("composed to order four", text)
        self.assertIn("none: order four holds joints rigid", text)
        run = json.loads(spook(*words.split(), "--json").stdout)
        self.assertEqual(run["integrator_order"], 4)
        self.assertLess(run["error"]["value"], 1.5e-6)  # 3e-6 m of 2 m

    def test_a_solver_is_stopped_by_iterations_and_tolerance(self):
        def made(*options):
            run = json.loads(spook("run", "stack", "--time", "1", "--json", *options).stdout)
            return run["last_step"]["iterations"]

        self.assertEqual(made("--iterations", "5"), 5)
        self.assertLess(made("--iterations", "1000", "--tolerance", "1e-3"), made("--iterations", "1000"))

    def test_iterations_are_called_what_they_are(self):
        def said(scene, *options):
            return " ".join(spook("run", scene, "--time", "0.1", *options).stdout.split())

        for solver, what in [("gauss_seidel", "sweep"), ("conjugate_gradients", "iteration"), ("auto", "iteration")]:
            text = said("stack", "--solver", solver, "--iterations", "2")
            self.assertIn(f"{solver}, at most 2 {what}s", text)
            self.assertRegex(text, rf"after (1 {what}|2 {what}s)\b")
        text = said("wire", "--solver", "direct")
        self.assertIn("direct, at most 50 factorisations", text)
        self.assertRegex(text, r"after 1 factorisation\b")
        # Stiff links are solved at once, whatever else may be iterated.
        text = said("stiff_wire")
        self.assertIn("geometric_stiffness, at most 50 iterations", text)
        self.assertRegex(text, "m/s in the last step$")

    def test_the_method_comes_first(self):
        """The model and the solver stand below the scene's name."""
        for words, said in [("sliding_block --tangents sliding --friction-model box",
                             r"friction box, tangents sliding; gauss_seidel, at most 50 sweeps"),
                            ("pile --solver colours", r"friction cone, tangents fixed; colours, at most 50 sweeps"),
                            ("wire --solver direct", r"direct, at most 50 factorisations"),
                            ("free_fall", r"none: no constraints")]:
            lines = spook("run", *words.split(), "--time", "0.02").stdout.splitlines()
            with self.subTest(words):
                entry = next(k for k, line in enumerate(lines) if line.startswith("solver "))
                self.assertLessEqual(entry, 2)
                self.assertRegex(" ".join(lines[entry].split()), f"^solver {said}$")

    def test_no_step_is_fine(self):
        result = json.loads(spook("run", "orbit", "--time", "0", "--json").stdout)
        self.assertEqual((result["steps"], result["us_per_step"], result["error"]["value"]), (0, None, 0))

    def test_error_too_large_for_a_number_is_null(self):
        done = spook("run", "oscillator", "--h", "3", "--time", "1115", "--json", "--set", "amplitude=1e-6")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIsNone(json.loads(done.stdout)["error"]["value"])

    def test_text_fits_a_terminal(self):
        helps = [["--help"], ["run", "--help"], ["scenes", "--help"]]
        for call in [["run", name] for name in self.names()] + [["scenes"], ["scenes", "top"], *helps]:
            done = spook(*call)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            for line in done.stdout.splitlines():
                self.assertLessEqual(len(line), 80, line)
        short, full = spook("run", "stack").stdout, spook("run", "stack", "-v").stdout
        for word in ["end       time", "error", "time      ", "µs a step", "residual"]:
            self.assertIn(word, short)
            self.assertIn(word, full)
        for word in ["set       ", "answer    ", "stages    ", " pairs, "]:
            self.assertNotIn(word, short)
            self.assertIn(word, full)

    def test_a_run_prints_some_ten_lines(self):
        for name in self.names():
            lines = spook("run", name, "--time", "0.02").stdout.splitlines()
            told = [line for line in lines if line[:10].strip() not in ("note", "trouble")]
            self.assertLessEqual(len(told), 12, name)

    def test_scenes_are_listed_on_two_screens(self):
        lines = spook("scenes").stdout.splitlines()
        self.assertLessEqual(len(lines), 80)
        self.assertTrue(lines[0].startswith("free_fall "), "names come first")

    def test_a_long_run_tells_its_progress_on_a_terminal(self):
        terminal, theirs = pty.openpty()
        self.addCleanup(os.close, terminal)
        run = subprocess.Popen([SPOOK, "run", "pile", "--time", "1000"], stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        told, begun = "", time.monotonic()
        try:
            while "%" not in told and time.monotonic() < begun + 60:
                if select.select([terminal], [], [], 1)[0]:
                    told += os.read(terminal, 100).decode()
        finally:
            run.kill()
            run.wait()
        self.assertRegex(told, r"^\d+ % +\r")
        self.assertGreater(time.monotonic() - begun, 0.9, "a short run tells nothing")

    def test_every_scene_that_is_written_is_listed(self):
        written = {name for file in SCENES.glob("*.cpp")
                   for name in re.findall(r"^SceneDescription (\w+)\(\)", file.read_text(encoding="utf-8"), re.MULTILINE)}
        self.assertGreater(len(written), 0)
        self.assertEqual(written - set(self.names()), set(), "they lack a line in registry.hpp and in registry.cpp")

    def test_scenes_are_listed_with_parameters_and_answers(self):
        listed = json.loads(spook("scenes", "--json").stdout)
        self.assertIn("gauss_seidel", [solver["name"] for solver in listed["solvers"]])
        for scene in listed["scenes"]:
            self.assertTrue(scene["answer"] and scene["summary"] and scene["error"]["unit"])
            self.assertIn(scene["answer"].split()[0], spook("scenes", scene["name"]).stdout)
            ran = json.loads(spook("run", scene["name"], "--time", "0", "--json").stdout)
            defaults = {parameter["name"]: parameter["default"] for parameter in scene["parameters"]}
            self.assertEqual(ran["parameters"], defaults)

    @staticmethod
    def names():
        return [scene["name"] for scene in json.loads(spook("scenes", "--json").stdout)["scenes"]]

    def test_csv_has_every_step(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "fall.csv")
            done = spook("run", "free_fall", "--h", "0.5", "--time", "2", "--csv", str(file), "--json")
            self.assertEqual(done.returncode, 0)
            header, *lines = file.read_text().splitlines()
        self.assertEqual(header, "time [s],z [m],v [m/s],energy [J]")
        values = [[float(number) for number in line.split(",")] for line in lines]
        self.assertEqual([line[0] for line in values], [0, 0.5, 1, 1.5, 2])
        for time, z, v, energy in values:
            self.assertTrue(math.isclose(z, -9.81 * time**2 / 2, rel_tol=1e-14))
            self.assertTrue(math.isclose(v, -9.81 * time, rel_tol=1e-14))
            self.assertTrue(math.isclose(energy, 0, abs_tol=1e-12))

    def test_a_run_goes_on_from_a_checkpoint_with_the_same_bits(self):
        with tempfile.TemporaryDirectory() as folder:
            whole, first, rest, state = (str(Path(folder) / name) for name in ("w.csv", "f.csv", "r.csv", "state"))
            call = ["run", "pile", "--set", "bodies=8", "shape=box", "--h", "0.01", "--json"]
            done = json.loads(spook(*call, "--time", "0.8", "--csv", whole).stdout)
            spook(*call, "--time", "0.5", "--csv", first, "--checkpoint", state)
            went_on = spook(*call, "--time", "0.8", "--csv", rest, "--restart", state, "--threads", "2")
            self.assertEqual(went_on.returncode, 0, went_on.stderr)
            went_on = json.loads(went_on.stdout)
            for key in ("steps", "time", "error", "state", "residual", "row_updates", "last_step"):
                self.assertEqual(done[key], went_on[key], key)
            lines = [Path(name).read_text().splitlines() for name in (whole, first, rest)]
            self.assertEqual(lines[0], lines[1] + lines[2][1:])
            self.assertEqual(lines[2][0], lines[0][0])
            self.assertEqual(sorted(os.listdir(folder)), ["f.csv", "r.csv", "state", "w.csv"])
            self.assertIn("80 steps of 0.01 s, 0.8 s, restarted at 0.5 s",
                          spook(*call[:-1], "--time", "0.8", "--restart", state).stdout)
            self.assertIn(f'--csv "{rest}" is replaced, by the steps after the restart alone',
                          spook(*call, "--time", "0.8", "--csv", rest, "--restart", state).stderr)
            again = json.loads(spook(*call, "--time", "0.5", "--restart", state).stdout)
            self.assertIsNone(again["us_per_step"])  # no step is left

    def test_a_checkpoint_replaces_nothing_but_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe, link, target = Path(folder, "pipe"), Path(folder, "link"), Path(folder, "target")
            os.mkfifo(pipe)
            done = spook("run", "tower", "--time", "0.1", "--checkpoint", str(pipe))
            self.assertEqual((done.returncode, pipe.is_fifo()), (2, True))
            self.assertIn("checkpoint must be a file", done.stderr)
            target.write_text("old")
            link.symlink_to(target)
            self.assertEqual(spook("run", "tower", "--time", "0.1", "--checkpoint", str(link)).returncode, 0)
            self.assertTrue(link.is_symlink())
            self.assertIn("spook checkpoint", target.read_bytes().decode(errors="replace"))

    def test_a_csv_on_standard_output_erases_no_log(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder, "log")
            log.write_text("earlier\n")
            with log.open("a") as out:
                subprocess.run([SPOOK, "run", "tower", "--time", "0.1", "--csv", "/dev/stdout"], stdout=out, check=True)
            self.assertTrue(log.read_text().startswith("earlier\n"))

    def test_a_checkpoint_of_another_run_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            state, file = str(Path(folder) / "state"), Path(folder) / "ball.json"
            call = ["run", "tower", "--time", "0.5", "--checkpoint", state]
            self.assertEqual(spook(*call).returncode, 0)
            for more, named in ([["--h", "0.01"], ["h 0.01666", "h is 0.01"]],
                                [["--set", "boxes=6"], ["boxes 5", "boxes is 6"]],
                                [["--substeps", "2"], ["substeps 1", "substeps is 2"]],
                                [["--solver", "direct"], ['solver "auto"', 'solver is "direct"']],
                                [["--time", "0.25"], ["time must be at least the time of the restart, 0.5 s", "0.25"]],
                                [["--record", "x.rec"], ["--record", "--restart"]],
                                [["--engine", "plain", "--solver", "gauss_seidel"], ["--engine"]]):
                refused = spook("run", "tower", *more, "--restart", state)
                self.assertEqual(refused.returncode, 2, more)
                for part in named:
                    self.assertIn(part, refused.stderr, more)
            self.assertIn('scene "tower"', spook("run", "stack", "--restart", state).stderr)
            bytes_ = Path(state).read_bytes()
            for damaged in (bytes_[:-1], bytes_[:-9] + b"x" * 9, bytes_ + b"x", b"", b"{}", bytes_[:40]):
                Path(state).write_bytes(damaged)
                refused = spook("run", "tower", "--restart", state)
                self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)
            self.assertIn("cannot be read", spook("run", "tower", "--restart", str(Path(folder) / "none")).stderr)

            scene = json.loads(spook("scenes", "tower", "--export").stdout)
            file.write_text(json.dumps(scene))
            self.assertEqual(spook("run", str(file), "--time", "0.2", "--checkpoint", state).returncode, 0)
            self.assertEqual(spook("run", str(file), "--time", "0.4", "--restart", state).returncode, 0)
            file.write_text(json.dumps(scene | {"summary": "Another tower."}))
            self.assertIn("another text of the scene's file",
                          spook("run", str(file), "--time", "0.4", "--restart", state).stderr)
            nowhere = spook("run", "tower", "--time", "0.1", "--checkpoint", "/nowhere/state")
            self.assertEqual((nowhere.returncode, nowhere.stderr.count("\n")), (2, 1), nowhere.stderr)

    def test_blowup_names_step_and_body_and_leaves_what_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "blown.csv")
            done = spook("run", "oscillator", "--h", "3", "--time", "5000", "--csv", str(file), "--json")
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"\Aspook: blew up in step \d+ \(time \S+ s\): body 0 is not finite\n\Z")
            step = int(done.stderr.split("step ")[1].split()[0])
            lines = file.read_text().splitlines()
        self.assertEqual(len(lines), 1 + step)  # the header, and the steps from 0 to the one before
        self.assertTrue(all(line.count(",") == 3 for line in lines))

    def test_full_disk_is_told(self):
        if not Path("/dev/full").exists():
            self.skipTest("no /dev/full here")
        with open("/dev/full", "w") as full:
            done = subprocess.run([SPOOK, "run", "orbit"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Aspook: [^\n]+\n\Z")
        self.assertEqual(spook("run", "orbit", "--csv", "/dev/full").returncode, 2)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        SPOOK = sys.argv.pop(1)
    if not shutil.which(SPOOK):
        sys.exit(f"test_spook.py: no program {SPOOK}; give its path, or set SPOOK")
    unittest.main()
