"""The figures of experiments, as pages show them: on a light page and on a dark one, with letters that need no font."""

import re
import sys
import unittest

from sandbox import ROOT

sys.path.insert(0, str(ROOT / "plots" / "machinery"))

import figures  # noqa: E402

MOST_BYTES = 400_000
_SEEN = 3.0  # contrast with the paper that the guidelines for the web ask of lines and markers
_LOOKS = re.compile(r"<style>svg\{([^}]*)\}@media \(prefers-color-scheme:dark\)\{svg\{([^}]*)\}\}</style>")


def luminance(colour: str) -> float:
    """Relative luminance of sRGB, 0 for black and 1 for white."""
    parts = (int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5))
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(colour: str, paper: str) -> float:
    low, high = sorted((luminance(colour), luminance(paper)))
    return (high + 0.05) / (low + 0.05)


class Colours(unittest.TestCase):
    def test_what_is_seen_on_light_paper_is_seen_on_dark_paper(self):
        paper = figures.on_dark_paper("#ffffff")
        self.assertLess(luminance(paper), 0.02)
        for colour in (*(style["color"].lower() for style in figures.STYLES), figures.INK, "#d00000", "#777777"):
            with self.subTest(colour):
                self.assertGreater(contrast(figures.on_dark_paper(colour), paper), _SEEN)

    def test_darker_greys_become_lighter_ones(self):
        greys = [luminance(figures.on_dark_paper(f"#{k:02x}{k:02x}{k:02x}")) for k in range(256)]
        self.assertEqual(greys, sorted(greys, reverse=True))

    def test_colours_of_maps_stay(self):
        self.assertEqual(figures.on_dark_paper("#7d7c78"), "#7d7c78")


class Committed(unittest.TestCase):
    def test_they_fit_both_pages_and_need_nothing_else(self):
        found = sorted(ROOT.glob("plots/*/*.svg"))
        self.assertGreater(len(found), 0)
        for path in found:
            with self.subTest(path.stem):
                svg = path.read_text(encoding="utf-8")
                self.assertLess(len(svg.encode()), MOST_BYTES)
                self.assertNotIn("<text", svg)
                self.assertEqual(re.findall(r'href="(?!#|data:)[^"]*"', svg), [])
                light, dark = (dict(rule.split(":") for rule in look.split(";")) for look in _LOOKS.search(svg).groups())
                self.assertEqual(dark, {name: figures.on_dark_paper(colour) for name, colour in light.items()})
                self.assertIn("#ffffff", light.values())
                for kind, colour, name in re.findall(r"(fill|stroke): (#[0-9a-f]{6}); \1: var\((--c\d+)\)", svg):
                    self.assertEqual(light[name], colour)
                plain = set(re.findall(r"(?:fill|stroke): (#[0-9a-f]{6})(?!; \w+: var)", svg))
                self.assertEqual({colour for colour in plain if figures.on_dark_paper(colour) != colour}, set())


if __name__ == "__main__":
    unittest.main()
