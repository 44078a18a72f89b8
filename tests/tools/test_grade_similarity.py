"""Similar works are found under other names, and independent ones are not accused."""

import itertools
import random
import re
import tempfile
import unittest
from pathlib import Path

import sandbox  # noqa: F401

from grading.fingerprints import fingerprints, tokens_of
from grading.similar_page import write_similarity
from grading.similarity import similar
from manifest import all_exercises

SEED = 7
CLASS = 40
STUB = "void solve() { not_implemented(); }\n"
# What everybody writes, in an order and with a detail of one's own.
IDIOMS = ["for (std::size_t {a} = 0; {a} < {b}.size(); ++{a}) {c} += {b}[{a}] * {d};",
          "const double {a} = std::sqrt({b} * {b} + {c} * {c});", "if ({a} < {b}) return {c};", "double {a} = {n};",
          "while ({a} > {b}) {{ {a} -= {c}; {d} += {n} * {c}; }}", "const Vec3 {a} = {b}.cross({c}) / {d}.norm();",
          "if (std::abs({a} - {b}) > {n} && {c} != {d}) {a} = std::min({b}, {c} + {d});",
          "{a} = ({b} + {c}) * ({d} - {n}) / (1 + {a} * {b});", "auto [{a}, {b}] = split({c}, {n});",
          "std::vector<double> {a}(static_cast<std::size_t>({b}), {n});", "{a}.push_back({{{b}, {c}, {n} * {d}}});",
          "do {{ {a} = step({b}, {c}); }} while (++{d} < {n} && {a} > {b} * {c});",
          "switch ({a}) {{ case 0: {b} = {c}; break; default: {d} -= {n}; }}", "const bool {a} = !({b} < {c}) || {d};"]
NAMES = "x y z h k m n p q r s t u v w alpha beta gamma delta total sum rest".split()


def written(draw: random.Random, length: int = 24) -> str:
    lines = []
    for _ in range(length):
        words = {key: draw.choice(NAMES) for key in "abcd"} | {"n": str(draw.randint(0, 9))}
        lines.append("  " + draw.choice(IDIOMS).format(**words))
    return "void solve() {\n" + "\n".join(lines) + "\n}\n"


def renamed(source: str, draw: random.Random) -> str:
    other = dict(zip(NAMES, draw.sample([f"my_{name}" for name in NAMES], len(NAMES))))
    return re.sub(r"\b\w+\b", lambda word: other.get(word[0], word[0]), source)


def disguised(source: str, draw: random.Random) -> str:
    """Returns a program with other names, comments, spaces, and a few more lines."""
    lines = []
    for line in renamed(source, draw).split("\n"):
        lines.append(line.replace(" = ", "=").replace(", ", ",  "))
        if draw.random() < 0.3:
            lines.append("  // what I thought about this")
        if draw.random() < 0.08 and line.endswith(";"):
            lines.append("  my_check(my_x);")
    return "\n".join(lines)


class Similarity(unittest.TestCase):
    def test_copies_are_found_and_nobody_else(self):
        draw = random.Random(SEED)
        works = {exercise: {f"s{k:02d}": written(draw) for k in range(CLASS)} for exercise in ("1", "2", "3")}
        works["2"]["s05"] = disguised(works["2"]["s31"], draw)
        works["1"]["s08"] = disguised(works["1"]["s09"], draw)
        works["3"]["s08"] = disguised(works["3"]["s09"], draw)
        found = similar(works, {exercise: [STUB, written(draw)] for exercise in works})
        self.assertEqual({(pair.first, pair.second) for pair in found.pairs}, {("s05", "s31"), ("s08", "s09")},
                         f"seed {SEED}")
        self.assertEqual(found.references, [])
        both = next(pair for pair in found.pairs if pair.first == "s08")
        self.assertEqual(set(both.shared), {"1", "3"})

    def test_a_copy_in_a_class_of_three_is_found(self):
        draw = random.Random(SEED)
        works = {"1": {name: written(draw) for name in "abc"}}
        works["1"]["c"] = disguised(works["1"]["a"], draw)
        pairs = similar(works, {"1": [STUB, written(draw)]}).pairs
        self.assertEqual([(pair.first, pair.second) for pair in pairs], [("a", "c")])

    def test_a_class_that_wrote_alone_is_left_alone(self):
        for seed in range(5):
            draw = random.Random(seed)
            works = {"1": {f"s{k:02d}": written(draw) for k in range(CLASS)}}
            self.assertEqual(similar(works, {"1": [STUB, written(draw)]}).pairs, [], f"seed {seed}")

    def test_groups_of_copies_are_found_whatever_their_size(self):
        """Copies of all, up to all works but one; of one exercise, or with more changes, up to half of a class."""
        for people in (9, 12, 20, 30):
            for size in range(2, min(10, people - 1) + 1):
                for changed in (False, True) if 2 * size <= people else (False,):
                    draw = random.Random(100 * people + size)
                    works = {exercise: {f"s{k:02d}": written(draw) for k in range(people)} for exercise in ("1", "2")}
                    group = sorted(draw.sample(sorted(works["1"]), size))
                    for exercise in ("2",) if size <= people / 2 and people % 2 == 0 else works:
                        source = works[exercise][group[0]]
                        for name in group[1:]:
                            works[exercise][name] = disguised(source, draw) if changed else renamed(source, draw)
                    pairs = similar(works, {exercise: [STUB, written(draw)] for exercise in works}).pairs
                    self.assertEqual({(pair.first, pair.second) for pair in pairs},
                                     set(itertools.combinations(group, 2)), f"{size} of {people}, changed: {changed}")

    def test_two_groups_are_found(self):
        draw = random.Random(SEED)
        works = {"1": {f"s{k}": written(draw) for k in range(9)}}
        for name in "12":
            works["1"][f"s{name}"] = renamed(works["1"]["s0"], draw)
        for name in "567":
            works["1"][f"s{name}"] = renamed(works["1"]["s4"], draw)
        pairs = similar(works, {"1": [STUB, written(draw)]}).pairs
        self.assertEqual({(pair.first, pair.second) for pair in pairs},
                         {*itertools.combinations(("s0", "s1", "s2"), 2), *itertools.combinations(("s4", "s5", "s6", "s7"), 2)})

    def test_what_all_share_is_no_evidence(self):
        """A part that all have, or all but one, and that no stub contains; also beside a group of copies."""
        for people in (9, 12, 20, 30):
            draw = random.Random(people)
            given = written(draw, 60)
            works = {"1": {f"s{k:02d}": given + written(draw) for k in range(people)}}
            self.assertEqual(similar(works, {"1": [STUB, written(draw)]}).pairs, [], f"class of {people}")
            works["1"]["s00"] = STUB
            self.assertEqual(similar(works, {"1": [STUB, written(draw)]}).pairs, [], f"class of {people}")
            for name in ("s01", "s02", "s03"):
                works["1"][name] = renamed(works["1"]["s01"], draw)
            pairs = similar(works, {"1": [STUB, written(draw)]}).pairs
            self.assertEqual({(pair.first, pair.second) for pair in pairs},
                             set(itertools.combinations(("s01", "s02", "s03"), 2)), f"class of {people}")

    def test_what_half_of_a_class_writes_alike_is_no_evidence(self):
        """A short exercise that has two answers, beside one that everybody writes differently."""
        for people in (9, 12, 20, 30):
            draw = random.Random(people)
            answers = [written(draw, 4), written(draw, 4)]
            works = {"1": {f"s{k:02d}": answers[k % 2] for k in range(people)},
                     "2": {f"s{k:02d}": written(draw) for k in range(people)}}
            self.assertEqual(similar(works, {"1": [STUB, STUB], "2": [STUB, STUB]}).pairs, [], f"class of {people}")

    def test_what_was_given_is_no_evidence(self):
        draw = random.Random(SEED)
        stub = written(draw, 60)
        works = {"1": {name: stub + written(draw, 6) for name in "abcdef"}}
        self.assertEqual(similar(works, {"1": [stub, written(draw)]}).pairs, [])

    def test_the_reference_under_other_names_is_said(self):
        draw = random.Random(SEED)
        reference = written(draw)
        works = {"1": {f"s{k}": written(draw) for k in range(8)} | {"cheat": disguised(reference, draw)}}
        found = similar(works, {"1": [STUB, reference]})
        self.assertEqual([(who, what) for who, what, _ in found.references], [("cheat", "1")])

    def test_names_comments_and_spaces_do_not_count(self):
        draw = random.Random(SEED)
        source = written(draw)
        again = re.sub(r"\bx\b", "position", source).replace("\n", "  // so\n").replace(" = ", "\n= /* is */ ")
        self.assertEqual(fingerprints(tokens_of(source)).keys(), fingerprints(tokens_of(again)).keys())

    def test_the_page_shows_what_students_wrote_as_text(self):
        draw = random.Random(SEED)
        exercise = all_exercises()[0]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            source = written(draw)
            for k in range(20):
                text = source if k < 2 else written(draw)
                file = folder / "submissions" / f"<b>{k}&" / "taken" / f"{exercise.function}.cpp"
                file.parent.mkdir(parents=True)
                file.write_text(text + "// </pre><script>alert(1)</script>\n")
            found = write_similarity(folder, [exercise])
            page = (folder / "similarity.html").read_text()
        self.assertEqual(len(found.pairs), 1)
        self.assertNotIn("<script>", page)
        self.assertNotIn("<b>0", page)
        self.assertIn("<mark>", page)
        self.assertIn("&lt;script&gt;", page)


if __name__ == "__main__":
    unittest.main()
