"""A seed gives the same inputs with every compiler: no two draws are in an order that C++ leaves open."""

import re
import unittest

from sandbox import ROOT, our_files

# random.uniform(…) and such; some_box(random, …) and such
DRAW = re.compile(r"\b\w*\.?random\.\w+\(|\b(?:some|any|random)_\w+\((?=(?:\w+\.)?random\b)")
SILENT = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"')
ORDERED = re.compile(r"[;{},?:]|&&|\|\||<<| = ")


def without_words(code: str) -> str:
    """Returns the code with blanks for comments and strings."""
    return SILENT.sub(lambda found: " " * len(found[0]), code)


def arguments_of_calls(code: str):
    """Returns where each pair of parentheses opens, and its arguments."""
    open_ones = []
    for k, letter in enumerate(code):
        if letter in "([{":
            open_ones.append((letter, k, [k + 1]))
        elif letter == "," and open_ones:
            open_ones[-1][2].append(k + 1)
        elif letter in ")]}" and open_ones:
            bracket, start, begins = open_ones.pop()
            if bracket == "(":
                yield start, [code[a:b - 1] for a, b in zip(begins, begins[1:] + [k + 1])]


def operands(code: str):
    """Returns where each expression begins whose operands have no order, with an @ for each draw."""
    while found := DRAW.search(code):
        depth, end = 1, found.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(code[end], 0)
            end += 1
        lines = "\n" * code.count("\n", found.start(), end)
        code = code[:found.start()] + "@" + lines + code[end:]
    begin = 0
    for mark in [*ORDERED.finditer(code), None]:
        yield code.count("\n", 0, begin), code[begin:mark.start() if mark else None]
        begin = mark.end() if mark else begin


def lines_without_order(code: str) -> list[int]:
    code = without_words(code)
    lines = [code.count("\n", 0, start) for start, arguments in arguments_of_calls(code)
             if sum(bool(DRAW.search(one)) for one in arguments) > 1 and not any("<<" in one for one in arguments)]
    lines += [line for line, expression in operands(code) if expression.count("@") > 1]
    return [line + 1 for line in lines]


class RandomInputs(unittest.TestCase):
    def test_draws_have_an_order(self):
        found = [f"{name}:{line}" for name in our_files() if name.parts[0] == "tests" and name.suffix in (".cpp", ".hpp")
                 for line in lines_without_order((ROOT / name).read_text(encoding="utf-8"))]
        self.assertEqual(found, [], "draws in one call or sum: their order is the compiler's")

    def test_draws_without_an_order_are_found(self):
        for code, wrong in (("f(random.uniform(0, 1), t.random.vector());", True),
                            ("f(s, {.m = random.uniform(0, 1)}, random.vector());", True),
                            ("x = random.uniform(0, 1) *\n    random.unit_vector();", True),
                            ("f(some_ball(random, 4), some_ball(random, 1));", True),
                            ("const Vec3 x{random.uniform(0, 1), random.uniform(0, 2), 0};", False),
                            ("const double x = random.uniform(0, 1), y = random.uniform(0, 1);", False),
                            ("f(random, 4, random.integer(0, 1));", False),
                            ("(Vec() << random.vector(), random.vector()).finished();", False)):
            with self.subTest(code=code):
                self.assertEqual(bool(lines_without_order(code)), wrong)


if __name__ == "__main__":
    unittest.main()
