"""Draws the lessons' drawings: python3 tools/drawings [NAME ...]; all unless named.

A drawing is a function in a chapter_NN.py beside this file. Its file is chapters/NN_topic/drawings/NAME.svg. Those of
course.py are in chapters/drawings.
"""

import argparse
import sys

from gallery import drawings


def main() -> int:
    table = drawings()
    parser = argparse.ArgumentParser(prog="tools/drawings", description="Draws what the lessons show.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of a drawing, such as half_steps; all unless named")
    names = parser.parse_args().names
    unknown = sorted(set(names) - {path.stem for path in table})
    if unknown:
        parser.error(f"there is no drawing {unknown[0]}; there are {', '.join(sorted(path.stem for path in table))}")
    for path, draw in table.items():
        if not names or path.stem in names:
            path.parent.mkdir(exist_ok=True)
            path.write_text(draw().svg(), encoding="utf-8")
            print(f"{path.parts[-3]}/{path.parts[-2]}/{path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
