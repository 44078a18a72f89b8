"""The live figures of the lessons, given by comments of Markdown: each can be run, and shows the number in its comment."""

import re
import unittest

from playing_scene import played, refused
from sandbox import ROOT

from binding.live import LiveFigure, live_figure
from films import films

MOST_CONTROLS = 3
HEAD = "error", "energy", "residual"
MARKS = {"contacts", "impulses", "friction", "velocities", "pairs", "colours"}  # of tools/viewer/controls.js
# What each lesson argues about, and its reader can therefore change or see: a scene with controls or marks.
ARGUED = {
    "01_leapfrog": ["orbit h start"], "02_quaternions": ["top update"], "03_single_contact": ["resting_sphere k d"],
    "04_gauss_seidel": ["stack iterations row_order"], "05_friction_box": ["incline angle", "sliding_block heading"],
    "06_distance": ["cloth d", "pendulum d"], "07_impacts": ["bouncing_ball restitution", "cradle restitution"],
    "08_pairs": ["pile pairs"], "09_better_friction": ["spinning_disc friction_model"],
    "10_convergence": ["tower warm_start"], "11_direct": ["wire ratio solver iterations"], "12_stiff_wires": ["stiff_wire ratio"],
    "13_mechanisms": ["flywheel torque speed"], "14_fast_rows": ["pile colours solver"],
}
_COMMENT = re.compile(r"^<!-- live:.*?-->$", re.MULTILINE | re.DOTALL)


def figures() -> dict[str, list[LiveFigure]]:
    """Returns the figures of each lesson, by its folder."""
    return {folder: [live_figure(comment) for comment in _COMMENT.findall(text)] for folder, text in lessons().items()}


def lessons() -> dict[str, str]:
    return {path.parent.name: path.read_text(encoding="utf-8")
            for path in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md"))}


def each() -> list[tuple[str, LiveFigure]]:
    return [(folder, figure) for folder, found in figures().items() for figure in found]


def film_settings(film: dict) -> dict[str, str]:
    """Returns what a film's options set: `--set NAME=VALUE ...`, and `--NAME VALUE` of the method."""
    words, found = film.get("options", []), {}
    for before, word in zip(["", *words], words):
        if "=" in word:
            found |= [word.split("=", 1)]
        elif before.startswith("--") and before not in ("--set", "--time"):
            found[before.removeprefix("--").replace("-", "_")] = word
    return found


def both(settings: dict[str, str], beside: tuple[str, str] | None) -> list[dict[str, str]]:
    """Returns the settings of the one run, or of the two."""
    return [settings, *([settings | dict([beside])] if beside else [])]


def values_of(scene: str, settings: dict[str, str], name: str):
    """Returns the value of a setting in a run, be it set or the default."""
    header, _ = played(scene, settings, 1)
    return (header["parameters"] | header["method"])[name]


def number(figure, header: dict, frame: dict) -> float:
    if figure.graph == "energy":
        return sum(frame["energy"].values())
    return frame[figure.graph] if figure.graph in HEAD else frame["sample"][header["columns"].index(figure.graph)]


class LiveFigures(unittest.TestCase):
    def test_every_lesson_has_them_right_above_its_film(self):
        for folder, text in lessons().items():
            with self.subTest(folder):
                self.assertTrue(figures()[folder], "a comment begins with <!-- live:")
                self.assertRegex(text, r"\n\n(<!-- live:[^>]*-->\n)+!\[[^\]]+\]\(film\.webp\)\n")
                self.assertEqual(len(_COMMENT.findall(text)), text.count("<!-- live:"))
                scenes = [figure.scene for figure in figures()[folder]]
                self.assertEqual(scenes[0], films()[folder]["scene"])
                self.assertEqual(len(scenes), len(set(scenes)), "buttons are named by scenes")

    def test_what_a_lesson_argues_about_can_be_changed_or_seen(self):
        self.assertEqual(list(ARGUED), list(figures()))
        for folder, argued in ARGUED.items():
            for words in argued:
                with self.subTest(folder, words=words):
                    scene, *names = words.split()
                    figure = next(figure for figure in figures()[folder] if figure.scene == scene)
                    there = {*figure.controls, *figure.asked(folder)["shows"], *(figure.beside or ())[:1]}
                    self.assertLessEqual(set(names), there)

    def test_each_runs_and_shows_what_it_says(self):
        for folder, figure in each():
            with self.subTest(folder, scene=figure.scene):
                header, _ = played(figure.scene, figure.settings, 1)
                names = {control["name"] for control in header["controls"]}
                self.assertTrue(1 <= len(figure.controls) <= MOST_CONTROLS and names.issuperset(figure.controls))
                for control in header["controls"]:
                    self.assertTrue(control["meaning"], control["name"])
                self.assertIn(figure.graph, (*HEAD, *header["columns"]))
                self.assertLessEqual(set(figure.asked(folder)["shows"]), MARKS)
                self.assertTrue(figure.lasts == 0 or figure.lasts >= figure.time)
                if figure.beside:
                    name, value = figure.beside
                    self.assertIn(name, names)
                    other, _ = played(figure.scene, figure.settings | {name: value}, 1)
                    self.assertEqual(other["bodies"], header["bodies"])
                steps = round(figure.time / header["method"]["h"])
                self.assertAlmostEqual(steps * header["method"]["h"], figure.time, delta=0.51 * header["method"]["h"])
                _, frame = played(figure.scene, figure.settings, steps)
                self.assert_shown(number(figure, header, frame), figure.said)

    def assert_shown(self, value: float, said: str) -> None:
        """Compares as many digits as the line has: those of a number that is right, whatever the compiler rounds."""
        self.assertEqual(f"{value:.{digits(said)}g}", f"{float(said):.{digits(said)}g}")

    def test_each_trial_gives_what_the_figure_says(self):
        for folder, figure in each():
            self.assertTrue(figure.trials and figure.argues, f"{folder}: {figure.scene} says what to change, and why")
            controls = {control["name"]: control for control in played(figure.scene, figure.settings, 1)[0]["controls"]}
            for trial in figure.trials:
                with self.subTest(folder, scene=figure.scene, trial=trial.changed):
                    self.assertLessEqual(set(trial.changed), set(figure.controls))
                    for name, value in trial.changed.items():
                        control = controls[name]
                        self.assertTrue(value in control["choices"] if "choices" in control
                                        else control["low"] <= float(value) <= control["high"], name)
                    settings = figure.settings | trial.changed
                    header, _ = played(figure.scene, settings, 1)
                    steps = round(figure.time / header["method"]["h"])
                    self.assertAlmostEqual(steps * header["method"]["h"], figure.time, delta=0.51 * header["method"]["h"])
                    self.assert_shown(number(figure, *played(figure.scene, settings, steps)), trial.said)

    def test_equations_that_a_figure_names_exist(self):
        text = "".join(lessons().values())
        for folder, figure in each():
            for equation in re.findall(r"Eq\. \(([0-9.]+)\)", figure.argues):
                self.assertIn(f"\\tag{{{equation}}}", text, folder)

    def test_both_ends_of_every_control_are_accepted(self):
        for folder, figure in each():
            header, _ = played(figure.scene, figure.settings, 1)
            for control in header["controls"]:
                if control["name"] not in figure.controls:
                    continue
                for value in control.get("choices") or [control["low"], control["high"]]:
                    with self.subTest(folder, scene=figure.scene, control=control["name"], value=value):
                        said = refused(figure.scene, figure.settings | {control["name"]: value})
                        # Only choices may exclude each other, which the reader is told.
                        self.assertTrue(not said or "choices" in control, said)

    def test_ranges_are_those_of_the_quantity(self):
        ranges = {(scene, name): (low, high) for scene, name, low, high in (
            ("wire", "ratio", 1, 1e6), ("sliding_block", "heading", -180, 180))}
        for _, figure in each():
            header, _ = played(figure.scene, figure.settings, 1)
            for control in header["controls"]:
                if wanted := ranges.pop((figure.scene, control["name"]), None):
                    self.assertEqual((control["low"], control["high"]), wanted, control["name"])
        self.assertEqual(ranges, {})

    def test_what_a_film_shows_side_by_side_the_figure_shows_or_has_as_a_control(self):
        for folder, (figure, *_) in figures().items():
            if beside := films()[folder].get("beside"):
                with self.subTest(folder):
                    self.assertIn(beside.partition("=")[0], (*figure.controls, *(figure.beside or ())[:1]))

    def test_the_caption_of_the_film_describes_the_figure_too(self):
        """Each setting that a film names has, in the figure, the value of one of the film's runs."""
        for folder, (figure, *_) in figures().items():
            film = films()[folder]
            beside = tuple(film["beside"].split("=", 1)) if "beside" in film else None
            filmed = both(film_settings(film), beside)
            for name in filmed[-1]:
                with self.subTest(folder, setting=name):
                    values = [values_of(film["scene"], settings, name) for settings in filmed]
                    for settings in both(figure.settings, figure.beside):
                        self.assertIn(values_of(figure.scene, settings, name), values)

    def test_the_settings_of_a_film_are_read(self):
        film = {"options": ["--set", "a=1", "b=x=y", "--friction-model", "cone", "--time", "2", "--iterations", "10"]}
        self.assertEqual(film_settings(film), {"a": "1", "b": "x=y", "friction_model": "cone", "iterations": "10"})

    def test_trials_are_read(self):
        figure = live_figure("<!-- live: top h=0.5 | h update | v [m/s] | 1 at 2\n"
                             "  | h=0.1 gives -1.5e-4; update=first_order h=2 gives 3. More is lost. Much more. -->")
        self.assertEqual([(trial.changed, trial.said) for trial in figure.trials],
                         [({"h": "0.1"}, "-1.5e-4"), ({"update": "first_order", "h": "2"}, "3")])
        self.assertEqual(figure.says(),
                         "Before you change a setting, the graph shows 1 m/s after 2 s. If you set h to 0.1 and begin again, "
                         "the graph shows −1.5·10⁻⁴ m/s at that time. If you set update to first_order and h to 2 and begin "
                         "again, the graph shows 3 m/s at that time. More is lost. Much more.")
        self.assertTrue(live_figure("<!-- live: top | h | error | 1 at 2 | It falls. -->").says().endswith("2 s. It falls."))
        self.assertTrue(live_figure("<!-- live: top | h | error | 1 at 2 | h=1 gives 3.5. -->").says().endswith("that time."))

    def test_options_are_read(self):
        figure = live_figure("<!-- live: wire ratio=10 beside ratio=20 showing pairs impulses rate 0.5 for 3\n"
                             "     | ratio | error | 1 at 2 -->")
        self.assertEqual((figure.settings, figure.beside), ({"ratio": "10"}, ("ratio", "20")))
        self.assertEqual((figure.shows, figure.rate, figure.lasts), (("pairs", "impulses"), 0.5, 3))
        self.assertIn("the graph of ratio 10 shows 1 after 2 s", figure.says())

    def test_what_cannot_be_read_is_refused(self):
        for line in ("<!-- live: orbit -->", "<!-- live: orbit | h | error -->", "<!-- live: orbit | h | error | 1 -->",
                     "<!-- live: orbit h | h | error | 1 at 2 -->", "<!-- live: orbit | a b c d | error | 1 at 2 -->",
                     "<!-- live: orbit | h | error | much at 2 -->", "<!-- live: orbit beside | h | error | 1 at 2 -->",
                     "<!-- live: orbit beside h=1 | h | error | 1 at 2 -->",
                     "<!-- live: orbit for ever | h | error | 1 at 2 -->", "<!-- live: orbit | h | error | 1 at 2 | -->",
                     "<!-- live: orbit | h | error | 1 at 2 | no sentence -->"):
            with self.assertRaises(ValueError, msg=line):
                live_figure(line)
        with self.assertRaisesRegex(ValueError, "eccentrcity"):
            played("orbit", {"eccentrcity": "0.5"}, 1)


def digits(text: str) -> int:
    """Returns the number of significant digits in a text."""
    return len(re.sub(r"^0+", "", re.sub(r"e.*|[-.]", "", text)))


if __name__ == "__main__":
    unittest.main()
