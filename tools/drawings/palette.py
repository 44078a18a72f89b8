"""The colours and weights of all drawings: those of the viewer, tools/viewer/colours.js, and the pages' backgrounds.

Bodies are grey, impulses orange, velocities blue, right answers green, in every chapter. A class is written into a
drawing only if the drawing uses it.
"""

COLOURS = {  # name: (on light paper, on dark paper)
    "ink": ("#1f2328", "#e6e8eb"),
    "soft": ("#5d6570", "#a3abb5"),
    "faint": ("#c9cdd2", "#464c55"),
    "body": ("#5f6771", "#a3abb5"),
    "impulse": ("#c8410b", "#ff9355"),
    "velocity": ("#1273b8", "#62b6f2"),
    "good": ("#2b8a3e", "#5cc76f"),
    "gold": ("#946f00", "#dcbf55"),
    "pair": ("#6741d9", "#b197fc"),
}
TINTS = {  # what "fill" fills with
    "ink": ("#e9ebee", "#2a2e35"), "soft": ("#f0f1f3", "#22262c"), "faint": ("#f0f1f3", "#22262c"),
    "body": ("#dde1e6", "#3a4049"), "impulse": ("#fbe3d8", "#4a2c1d"), "velocity": ("#dcebf7", "#1d3a50"),
    "good": ("#dcf1e0", "#1f4028"), "gold": ("#f7ecc9", "#423819"), "pair": ("#e8e1fb", "#372d5c"),
}
PAPER = ("#fbfbf9", "#16181c")
WEIGHTS = {"thin": "stroke-width:1.2", "bold": "stroke-width:3.4", "dash": "stroke-dasharray:7 5",
           "dots": "stroke-dasharray:1.5 5"}
SIZES = {"": 16, "small": 14, "large": 19}  # of words [pixels]
# Letters take the colour of the label that shows them; a rim is 5 pixels wide.
TEXT = {"letter": "fill:inherit;stroke:inherit;stroke-width:inherit", "rim": "stroke-width:310;stroke-linejoin:round"}
_SHAPES = "path,circle,rect{fill:none;stroke-width:2;stroke-linecap:round;stroke-linejoin:round}"


def style_sheet(used: set[str]) -> str:
    """Returns the rules of the used classes: for light paper, and the differences on dark paper."""
    fixed = [_SHAPES, *(f".{name}{{{rule}}}" for name, rule in (WEIGHTS | TEXT).items() if name in used)]
    return "\n" + "\n".join([*fixed, *_coloured(used, 0), "@media (prefers-color-scheme:dark){",
                             *_coloured(used, 1), "}"]) + "\n"


def _coloured(used: set[str], which: int) -> list[str]:
    rules = [f"rect.paper{{fill:{PAPER[which]}}}", f".rim{{fill:{PAPER[which]};stroke:{PAPER[which]}}}"]
    for name, colours in COLOURS.items():
        if name in used:
            rules.append(f".{name}{{stroke:{colours[which]}}}")
            if "fill" in used:
                rules.append(f".{name}.fill{{fill:{TINTS[name][which]}}}")
        if f"on-{name}" in used:
            rules.append(f".on-{name}{{fill:{colours[which]}}}")
    return rules
