"""./course view without a browser: bad input, the recording, and the content of the page."""

import contextlib
import gzip
import io
import json
import re
import tempfile
import unittest
from base64 import b64decode
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import recordings
from sandbox import Sandbox, all_exercises

import frames
import view
from beside import Run, label_of, variations
from errors import BadInput
from needs import VIEW_NEEDS
from page import film, live

BAD_INPUT = (
    (["view"], "a scene is missing"),
    (["view", "--mine"], "a scene is missing"),
    (["view", "pendulum", "--beside"], "--beside"),
    (["view", "pendulum", "--beside", "h"], "NAME=VALUE", "'h'"),
    (["view", "pendulum", "--beside", "h=0.1,=3"], "NAME=VALUE"),
    (["view", "pendulum", "--beside", "warm-start=2"], "on or off", "'2'"),
    (["view", "pendulum", "--beside", "links=3"], "'links' is neither a parameter of pendulum nor an option of run"),
    (["view", "pendulum", "--beside", "solvr=direct"], "did you mean solver?"),
    (["view", "pendulum", "--mine", "--beside", "mine"], "--mine"),
    (["view", "pendulum", "--record", "x"], "--record"),
    (["view", "pendulum", "--out", "/nowhere/x.html"], "/nowhere/x.html", "cannot be written"),
    (["view", "pendulum", "--out", "/"], "cannot be written"),
    (["view", "pendulum", "--gltf", "x.gltf", "--out", "x.html"], "--gltf"),
    (["view", "pendulum", "--gltf", "x.gltf", "--beside", "mine"], "--gltf"),
    (["view", "pendulum", "--gltf", "/nowhere/x.gltf"], "/nowhere/x.gltf", "cannot be written"),
    (["view", "nothing.jsonl"], "nothing.jsonl", "No such file"),
    (["view", "README.md"], "README.md", "not a recording"),
    (["view", "README.md", "--out", "./README.md"], "README.md is read, so it cannot be written"),
    (["view", "README.md", "--gltf", "README.md"], "README.md is read, so it cannot be written"),
    (["view", "README.md", "--mine"], "--mine"),
    (["view", "README.md", "--h", "1"], "--h"),
    (["play"], "a scene is missing"),
    (["play", "pendulum", "--port", "0"], "'0'"),
    (["play", "pendulum", "--port", "65536"], "'65536'"),
)


def arguments(*words: str, **options) -> SimpleNamespace:
    return SimpleNamespace(**{"words": list(words), "mine": False, "beside": None, "fps": None, "out": None,
                              "gltf": None, "back": None} | options)


def contents(page: str) -> list[tuple[str, str]]:
    """Returns the label and the text of each recording in a page."""
    found = re.findall(r'data-recording="([^"]*)">([^<]+)<', page)
    return [(label, gzip.decompress(b64decode(packed)).decode()) for label, packed in found]


class Gltf(unittest.TestCase):
    def test_what_is_no_whole_recording_is_refused_in_one_line(self):
        whole = recordings.rolling_ball().encode()
        for content in (whole[:3000], whole.splitlines()[0], b"", b"{}", b"[1]\n[2]"):
            with self.subTest(content=content[:20]), self.assertRaisesRegex(BadInput, r"\Aview: the recording [^\n]+\Z"):
                view._as_gltf([view.Recording("", content)])
        self.assertEqual(json.loads(view._as_gltf([view.Recording("", whole)]))["asset"]["version"], "2.0")

    def test_a_capsule_is_as_long_as_it_is(self):
        scene = json.loads(view._as_gltf([view.Recording("", recordings.lying_capsule(0.2, 0.5).encode())]))
        node = next(node for node in scene["nodes"] if node.get("name") == "capsule 1")
        position = scene["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]
        ends = [0.2 * number for number in scene["accessors"][position]["max"]]
        self.assertEqual(node["scale"], [0.2] * 3)
        for end, wanted in zip(ends, (0.2, 0.2, 0.7), strict=True):
            self.assertAlmostEqual(end, wanted, delta=2e-3)  # of facets

    def test_a_kinematic_body_moves_and_a_static_one_does_not(self):
        scene = json.loads(view._as_gltf([view.Recording("", recordings.lift().encode())]))
        animated = [(scene["nodes"][channel["target"]["node"]]["name"], channel["target"]["path"])
                    for channel in scene["animations"][0]["channels"]]
        self.assertEqual(animated, [("ball 0", "translation")])

    def test_it_takes_one_recording(self):
        with self.assertRaisesRegex(BadInput, "one recording"):
            view._as_gltf([view.Recording("a", b""), view.Recording("b", b"")])


class Page(unittest.TestCase):
    def test_the_way_back(self):
        page = film([("", b"x")], ("../chapters/01_leapfrog/index.html", "01 · Leapfrog & more"))
        self.assertIn('href="../chapters/01_leapfrog/index.html">← 01 · Leapfrog &amp; more</a>', page)
        for alone in (film([("", b"x")]), live()):
            self.assertNotIn('id="way-back"', alone)

    @classmethod
    def setUpClass(cls):
        if not all(need.there() for need in VIEW_NEEDS):
            raise unittest.SkipTest("libjs-three is not installed")

    def test_it_needs_nothing_else(self):
        for page in (film([("", b"x")]), live()):
            self.assertNotRegex(page, r'(src|href)="(?!data:)')
            self.assertNotIn("@import", page)
            self.assertNotIn("<!-- data -->", page)
            self.assertLess(len(page), 500_000)

    def test_it_holds_the_recordings_and_their_names(self):
        texts = [recordings.rolling_ball(), recordings.tower()]
        page = film([("h = 1", texts[0].encode()), ('<"&', texts[1].encode())])
        self.assertEqual(contents(page), [("h = 1", texts[0]), ("&lt;&quot;&amp;", texts[1])])

    def test_the_same_recording_makes_the_same_page(self):
        self.assertEqual(film([("", b"x")]), film([("", b"x")]))


class Beside(unittest.TestCase):
    def runs(self, *words: str, **options) -> list[Run]:
        return variations(list(words), arguments(*words, **options))

    def test_an_option_is_replaced_and_a_parameter_set(self):
        for given in (["--h", "0.1"], ["--h=0.1"]):
            first, second = self.runs("pile", *given, "--time", "2", beside=["h=1/60,bodies=3"])
            self.assertEqual(first.words, ("pile", *given, "--time", "2"))
            self.assertEqual(second.words, ("pile", "--time", "2", "--h", "1/60", "--set", "bodies=3"))

    def test_names_may_be_written_with_either_dash(self):
        self.assertEqual(self.runs("pile", beside=["friction_model=cone"])[1].words,
                         ("pile", "--friction-model", "cone"))

    def test_a_flag_goes_on_and_off(self):
        self.assertEqual(self.runs("pile", beside=["warm-start=on"])[1].words, ("pile", "--warm-start"))
        self.assertEqual(self.runs("pile", "--warm-start", beside=["warm-start=off"])[1].words, ("pile",))

    def test_frames_are_the_same_in_all(self):
        for run in self.runs("pile", fps="30", beside=["h=1"]):
            self.assertEqual(run.words[1:3], ("--fps", "30"))

    def test_labels(self):
        headers = [{"method": {"h": 0.0166666, "warm_start": False}, "parameters": {"bodies": 20}, "time": 5}] * 3
        alone = self.runs("pile")
        self.assertEqual(label_of(0, alone, headers), "")
        changed = self.runs("pile", beside=["h=1/240", "bodies=3,warm-start=on"])
        self.assertEqual([label_of(k, changed, headers) for k in range(3)],
                         ["h = 0.01667, bodies = 20, warm-start = off", "h = 1/240", "bodies = 3, warm-start = on"])
        yours = self.runs("pile", beside=["mine"])
        self.assertEqual([label_of(k, yours, headers) for k in range(2)], ["reference", "yours"])


class Size(unittest.TestCase):
    def test_it_is_known_after_a_few_frames(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "run.jsonl")
            text = recordings.rolling_ball(frames=61)
            file.write_text(text)
            self.assertAlmostEqual(view.expected_size(file) / len(text), 1, delta=0.1)
            for few in ("", text[:200], "{}\n" * 20, "\n" * 20):
                file.write_text(few)
                self.assertEqual(view.expected_size(file), 0)

    def test_a_large_one_is_announced_once(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(view, "_LARGE", 1000):
            file = Path(folder, "run.jsonl")
            file.write_text(recordings.rolling_ball())
            call, said = view._Call(file), io.StringIO()
            with contextlib.redirect_stderr(said):
                call._look()
                call._look()
            self.assertEqual(said.getvalue().count("\n"), 1)
            self.assertIn("--fps", said.getvalue())

    def test_a_recording_that_is_none_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "run.jsonl")
            for text in ("", "x", "[]", "{}", json.dumps({"format": "another"})):
                file.write_text(text)
                with self.assertRaisesRegex(BadInput, "not a recording"):
                    view._files(arguments(str(file)))


class Frames(unittest.TestCase):
    """A short run is recorded finely enough to be seen."""

    def words(self, *words: str, h: float = 0.01, time: float = 10) -> list[str]:
        with mock.patch.object(frames, "_defaults", return_value={"h": h, "time": time}):
            return frames.with_frames(words)[len(words):]

    def test_it(self):
        self.assertEqual(self.words("pile"), [])
        self.assertEqual(self.words("pile", "--time", "1"), ["--fps", "150"])
        self.assertEqual(self.words("andrews", h=2e-5, time=0.03), ["--fps", "5000"])
        self.assertEqual(self.words("cloth", h=0.01, time=0.3), ["--time", "1.5", "--fps", "100"])
        self.assertEqual(self.words("cloth", "--fps", "10", h=0.01, time=0.3), [])
        self.assertEqual(self.words("pile", "--time=nonsense"), [])


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not all(need.there() for need in VIEW_NEEDS):
            raise unittest.SkipTest("libjs-three is not installed")
        cls.box = Sandbox(built=True)
        cls.addClassCleanup(cls.box.close)
        cls.box.course("run", "free_fall")  # a build that takes its time is told on stderr

    def test_bad_input_is_one_line_that_names_it_and_exit_code_2(self):
        for words, *told in BAD_INPUT:
            self.box.assert_refused(self, words, told)

    def test_what_the_program_refuses_is_its_one_line(self):
        for words in (["pendulm"], ["pendulum", "--h", "0"], ["pendulum", "--hh", "1"], ["pendulum", "--fps", "x"]):
            for command in ("view", "play"):
                self.box.assert_refused(self, [command, *words], ["spook: "])

    def test_a_scene_and_what_it_is_beside(self):
        result = self.box.course("view", "pendulum", "--time", "0.5", "--beside", "h=1/240", "angle=30")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"^build/views/pendulum\.html: 3 runs, 0\.\d MB\.")
        page = self.box.root / "build" / "views" / "pendulum.html"
        (first, text), (second, _), (third, other) = contents(page.read_text())
        self.assertEqual((first, second, third), ("h = 0.001, angle = 90", "h = 1/240", "angle = 30"))
        header, *frames, end = map(json.loads, text.splitlines())
        self.assertEqual((header["scene"], end), ("pendulum", {"end": "done"}))
        self.assertAlmostEqual(frames[-1]["time"], 0.5, delta=0.02)
        self.assertEqual(json.loads(other.splitlines()[0])["parameters"]["angle"], 30)

    def test_yours_beside_the_reference(self):
        kick = next(exercise for exercise in all_exercises() if exercise.function == "kick")
        self.addCleanup(self.box.restore, kick)
        self.box.solve(kick)
        wrong = self.box.file(kick).read_text().replace("return v +", "return v + 0.5 *")
        self.box.file(kick).write_text(wrong)
        result = self.box.course("view", "free_fall", "--beside", "mine", "--out", "both.html")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Yours, right or wrong: 1.1;", result.stderr)
        (ours, reference), (yours, mine) = contents((self.box.root / "both.html").read_text())
        self.assertEqual((ours, yours), ("reference", "yours"))
        errors = [json.loads(text.splitlines()[-2])["error"] for text in (reference, mine)]
        self.assertLess(errors[0], 1e-9)
        self.assertGreater(errors[1], 0.1)
        self.assertIn("kick", str(json.loads(mine.splitlines()[0]).get("mine")))

    def test_recordings(self):
        file = self.box.root / "mine.jsonl"
        file.write_text(recordings.tower())
        self.addCleanup(file.unlink)
        result = self.box.course("view", "mine.jsonl", "--out", "tower.html")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(contents((self.box.root / "tower.html").read_text()), [("", recordings.tower())])

    def test_a_run_that_blows_up_is_shown_up_to_there(self):
        result = self.box.course("view", "oscillator", "--h", "3", "--time", "3000", "--out", "lost.html")
        self.assertEqual(result.returncode, 1, result.stderr)
        [(_, text)] = contents((self.box.root / "lost.html").read_text())
        self.assertEqual(json.loads(text.splitlines()[-1])["end"], "blown up")


if __name__ == "__main__":
    unittest.main()
