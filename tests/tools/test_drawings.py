"""The drawings of the lessons: committed files equal the scripts' output, and each is used, legible, and small."""

import re
import sys
import unittest
import xml.etree.ElementTree as ET

from sandbox import ROOT, TOOLS

sys.path.insert(0, str(TOOLS / "drawings"))

from gallery import drawings  # noqa: E402
from palette import COLOURS  # noqa: E402
from pen import Drawing  # noqa: E402

MOST_BYTES = 60_000
_SIZES = {"t": 16, "small": 14, "large": 19}  # pixels
# Widths of Arial's letters in thousandths of its size; what is not named takes _OTHERS. Times, of symbols, is narrower.
_WIDTHS = {letter: width for letters, width in (
    ("'|ijl", 222), (" !,./:;I[]ft", 278), ("()-r", 333), ("Jckszvxy", 500), ("FTZ", 611), ("&ABEKPSVXY", 667),
    ("CDHNRUw", 722), ("GOQ", 778), ("Mm", 833), ("W", 944), ("\u200b", 0)) for letter in letters}
_OTHERS = 570
_SHOWN = re.compile(r"^!\[([^\]]*)\]\(drawings/(\w+)\.svg\)\n\n(\*[^*](?:.|\n(?!\n))*\*)$", re.MULTILINE)


def labels(svg: str) -> list[tuple[str, float, float, float, float]]:
    """Each label with its left, right, top and bottom, by the widths of Arial's letters."""
    found = []
    for text in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}text"):
        classes = text.get("class").split()
        if "rim" in classes:
            continue
        words = "".join(text.itertext())
        size = _SIZES[next((name for name in ("small", "large") if name in classes), "t")]
        width = sum(_WIDTHS.get(letter, _OTHERS) for letter in words) * size / 1000
        left = float(text.get("x")) - {"start": 0, "middle": width / 2, "end": width}[text.get("text-anchor")]
        found.append((words, left, left + width, float(text.get("y")) - 0.7 * size, float(text.get("y")) + 2))
    return found


class Drawings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drawn = {path: draw().svg() for path, draw in drawings().items()}

    def test_what_is_committed_is_what_is_drawn(self):
        there = {*ROOT.glob("chapters/*/drawings/*"), *ROOT.glob("chapters/drawings/*")}
        self.assertEqual({str(path) for path in there ^ set(self.drawn)}, set(), "only drawn, or only committed")
        for path, svg in self.drawn.items():
            self.assertTrue(path.read_text(encoding="utf-8") == svg, f"{path.name} is not what is drawn now: "
                            f"python3 tools/drawings {path.stem}")

    def test_each_chapter_has_some_and_shows_each_with_its_words(self):
        for lesson in sorted(ROOT.glob("chapters/[0-9][0-9]_*/README.md")):
            with self.subTest(lesson.parent.name):
                text = lesson.read_text(encoding="utf-8")
                shown = _SHOWN.findall(text)
                names = [name for _, name, _ in shown]
                self.assertEqual(sorted(names), sorted(path.stem for path in self.drawn
                                                       if path.parent.parent == lesson.parent))
                self.assertGreater(len(names), 0)
                for alternative, name, caption in shown:
                    self.assertGreater(len(alternative), 20, name)
                    self.assertGreater(len(caption), 20, name)
                self.assertEqual(len(re.findall(r"\(drawings/", text)), len(names), "an image without its caption")

    def test_they_are_small_and_need_nothing_else(self):
        for path, svg in self.drawn.items():
            with self.subTest(path.stem):
                self.assertLess(len(svg.encode()), MOST_BYTES)
                root = ET.fromstring(svg)
                self.assertGreater(len(root.findtext("{http://www.w3.org/2000/svg}title")), 20)
                for word in ("href", "url(", "@import", "<script"):
                    self.assertNotIn(word, svg)

    def test_all_colours_have_their_dark_ones(self):
        for path, svg in self.drawn.items():
            with self.subTest(path.stem):
                light, dark = svg.split("@media (prefers-color-scheme:dark)")
                dark, shapes = dark.split("</style>")
                used = {word for words in re.findall(r'class="([^"]*)"', shapes) for word in words.split()}
                for word in used:
                    if word.removeprefix("on-") in COLOURS:
                        self.assertIn(f".{word}{{", light)
                        self.assertIn(f".{word}{{", dark)

    def test_no_label_leaves_the_card_or_lies_on_another(self):
        for path, svg in self.drawn.items():
            card = ET.fromstring(svg)
            placed = labels(svg)
            for k, (words, left, right, top, bottom) in enumerate(placed):
                with self.subTest(path.stem, label=words):
                    self.assertTrue(left > 2 and right < float(card.get("width")) - 2, f"from {left} to {right}")
                    self.assertTrue(top > 2 and bottom < float(card.get("height")) - 2, f"from {top} to {bottom}")
                    under = [other for other, *o in placed[k + 1:]
                             if left < o[1] and o[0] < right and top < o[3] and o[2] < bottom]
                    self.assertEqual(under, [])


class Pen(unittest.TestCase):
    def test_mathematics_in_labels(self):
        d = Drawing(10, "A title that is long enough")
        d.text((1, 2), "the arm $r_i$ < $v_{n+1/2}$, cos: $cos θ$")
        svg = d.svg()
        self.assertIn('<tspan class="m">r</tspan><tspan class="m s" dy="5">i</tspan>', svg)
        self.assertIn("&lt;", svg)
        self.assertIn('<tspan class="r">cos </tspan>'.replace("cos ", "cos"), svg)

    def test_the_last_bits_of_a_number_decide_nothing(self):
        d = Drawing(10, "A title that is long enough")
        d.line((12.25 + 1e-12, -1e-12), (12.25 - 1e-12, 3))
        self.assertIn('d="M12.2 0L12.2 3"', d.svg())


if __name__ == "__main__":
    unittest.main()
