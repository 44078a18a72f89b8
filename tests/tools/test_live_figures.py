"""The live figures of the lessons, given by lines of Markdown: each can be run, and shows the number in its line."""

import re
import unittest

from playing_scene import played
from sandbox import ROOT

from binding.live import is_live, live_figure
from films import films

MOST_CONTROLS = 3
HEAD = "error", "energy", "residual"


def figures() -> dict[str, str]:
    """Returns the line of each lesson, by its folder."""
    found = {}
    for path in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md")):
        lines = [line for line in path.read_text(encoding="utf-8").splitlines() if is_live(line)]
        found[path.parent.name] = lines[0] if len(lines) == 1 else ""
    return found


def number(figure, header: dict, frame: dict) -> float:
    if figure.graph == "energy":
        return sum(frame["energy"].values())
    return frame[figure.graph] if figure.graph in HEAD else frame["sample"][header["columns"].index(figure.graph)]


class LiveFigures(unittest.TestCase):
    def test_every_lesson_has_one_right_above_its_film(self):
        for folder, line in figures().items():
            with self.subTest(folder):
                text = (ROOT / "chapters" / folder / "README.md").read_text(encoding="utf-8")
                self.assertTrue(line, "one line begins with <!-- live:")
                self.assertRegex(text, re.escape(line) + r"\n!\[[^\]]+\]\(film\.webp\)\n")
                self.assertLessEqual(len(line), 120)

    def test_each_runs_and_shows_what_it_says(self):
        for folder, line in figures().items():
            with self.subTest(folder):
                figure = live_figure(line)
                header, _ = played(figure.scene, figure.settings, 1)
                names = {control["name"] for control in header["controls"]}
                self.assertTrue(1 <= len(figure.controls) <= MOST_CONTROLS and names.issuperset(figure.controls))
                for control in header["controls"]:
                    self.assertTrue(control["meaning"], control["name"])
                self.assertIn(figure.graph, (*HEAD, *header["columns"]))
                steps = round(figure.time / header["method"]["h"])
                self.assertAlmostEqual(steps * header["method"]["h"], figure.time, delta=0.51 * header["method"]["h"])
                _, frame = played(figure.scene, figure.settings, steps)
                # As many digits as the line has: those of a number that is right, whatever the compiler rounds.
                shown = number(figure, header, frame)
                self.assertEqual(f"{shown:.{digits(figure.said)}g}", f"{figure.value:.{digits(figure.said)}g}")

    def test_what_a_film_shows_side_by_side_the_figure_has_as_a_control(self):
        for folder, line in figures().items():
            if beside := films()[folder].get("beside"):
                with self.subTest(folder):
                    self.assertIn(beside.partition("=")[0], live_figure(line).controls)

    def test_what_cannot_be_read_is_refused(self):
        for line in ("<!-- live: orbit -->", "<!-- live: orbit | h | error -->", "<!-- live: orbit | h | error | 1 -->",
                     "<!-- live: orbit h | h | error | 1 at 2 -->", "<!-- live: orbit | a b c d | error | 1 at 2 -->",
                     "<!-- live: orbit | h | error | much at 2 -->"):
            with self.assertRaises(ValueError, msg=line):
                live_figure(line)
        with self.assertRaisesRegex(ValueError, "eccentrcity"):
            played("orbit", {"eccentrcity": "0.5"}, 1)


def digits(text: str) -> int:
    """Returns the number of significant digits in a text."""
    return len(re.sub(r"^0+", "", re.sub(r"e.*|[-.]", "", text)))


if __name__ == "__main__":
    unittest.main()
