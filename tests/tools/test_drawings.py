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
_SHOWN = re.compile(r"^!\[([^\]]*)\]\(drawings/(\w+)\.svg\)\n\n(\*[^*](?:.|\n(?!\n))*\*)$", re.MULTILINE)


class Drawings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pens = {path: draw() for path, draw in drawings().items()}
        cls.drawn = {path: pen.svg() for path, pen in cls.pens.items()}

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
                self.assertEqual(re.findall(r'href="[^#][^"]*"|url\(|@import|<script', svg), [])

    def test_letters_are_shapes(self):
        for path, svg in self.drawn.items():
            with self.subTest(path.stem):
                self.assertNotIn("<text", svg)
                self.assertNotIn("font", svg)
                names = re.findall(r'\bid="([^"]*)"', svg)
                self.assertEqual(len(names), len(set(names)))
                self.assertEqual(set(re.findall(r'href="#([^"]*)"', svg)), set(names))

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
        for path, pen in self.pens.items():
            for k, one in enumerate(pen.labels):
                with self.subTest(path.stem, label=one.words):
                    self.assertTrue(one.left > 2 and one.right < pen.width - 2, f"from {one.left} to {one.right}")
                    self.assertTrue(one.top > 2 and one.bottom < pen.height - 2, f"from {one.top} to {one.bottom}")
                    under = [other.words for other in pen.labels[k + 1:]
                             if one.left < other.right and other.left < one.right
                             and one.top < other.bottom and other.top < one.bottom]
                    self.assertEqual(under, [])


class Pen(unittest.TestCase):
    def test_mathematics_in_labels(self):
        """Letters in italics, digits and words such as cos upright, what is lowered smaller; a label's words are kept."""
        d = Drawing(10, "A title that is long enough")
        d.text((100, 2), "a $v_{n+1}$ $cos θ$")
        self.assertEqual([label.words for label in d.labels], ["a v_{n+1} cos θ"])
        self.assertEqual(set(d._letters), {("words", "a"), ("words", " "), ("italic", "v"), ("italic", "n"),
                                           ("upright", "+"), ("upright", "1"), ("upright", "c"), ("upright", "o"),
                                           ("upright", "s"), ("upright", " "), ("italic", "θ")} - {
                                               ("words", " "), ("upright", " ")})
        lowered = re.findall(r'<g transform="translate\(\d+ -(\d+)\) scale\(([.\d]+)\)">', d.svg())
        self.assertEqual(lowered, [("312", "0.85")] * 2)  # 5 of 16 pixels, for n and for +1

    def test_labels_stand_where_they_are_anchored(self):
        d = Drawing(100, "A title that is long enough")
        for anchor in ("start", "middle", "end"):
            d.text((300, 50), "what $G_i$", anchor=anchor)
        start, middle, end = d.labels
        self.assertAlmostEqual(start.left, 300)
        self.assertAlmostEqual(middle.left + middle.right, 600)
        self.assertAlmostEqual(end.right, 300)
        self.assertTrue(40 < start.right - start.left < 90, start)

    def test_the_last_bits_of_a_number_decide_nothing(self):
        d = Drawing(10, "A title that is long enough")
        d.line((12.25 + 1e-12, -1e-12), (12.25 - 1e-12, 3))
        self.assertIn('d="M12.2 0L12.2 3"', d.svg())


if __name__ == "__main__":
    unittest.main()
