"""./course exam: every objective of a lesson is practised and asked for, and the answers are right."""

import math
import re
import unittest

import numpy as np
from sandbox import ROOT, Sandbox

from exam import all_questions, objectives_of, objectives_page
from manifest import read_chapters

SEEDS = range(1, 201)


def numbers(text: str) -> list[float]:
    return [float(found) for found in re.findall(r"(?<![\w^])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", text.replace("−", "-"))]


class Questions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.by_id = {one.id: one for one in all_questions()}
        cls.chapters = read_chapters()

    def test_every_objective_has_a_question_and_every_exercise_an_objective(self):
        asked = {(one.chapter, one.objective) for one in self.by_id.values()}
        self.assertEqual(len(asked), len(self.by_id))
        listed = {(chapter.number, k) for chapter in self.chapters for k in range(1, len(objectives_of(chapter)) + 1)}
        self.assertEqual(asked, listed)
        for chapter in self.chapters:
            named = {name for one in self.by_id.values() if one.chapter == chapter.number for name in one.exercises}
            self.assertEqual(named, {exercise.id for exercise in chapter.exercises})

    def test_the_page_of_objectives_is_what_the_lessons_say(self):
        self.assertEqual((ROOT / "chapters" / "OBJECTIVES.md").read_text(encoding="utf-8"), objectives_page(),
                         "./course exam --objectives > chapters/OBJECTIVES.md")

    def test_a_seed_makes_the_same_question_and_others_make_others(self):
        for one in self.by_id.values():
            with self.subTest(one.id):
                drawn = {one.drawn(seed) for seed in SEEDS}
                self.assertEqual(one.drawn(7), one.drawn(7))
                self.assertGreaterEqual(len(drawn), 6)
                for text, answer in drawn:
                    self.assertTrue(text.endswith("?") or text.endswith(".") or "g = 9.81" in text, text)
                    self.assertNotRegex(text + answer, r"\bnan\b|\binf\b|None|\{|e[−-]1[3-9]")

    def test_one_of_a_thing_is_not_called_several(self):
        for one in self.by_id.values():
            for seed in SEEDS:
                for text in one.drawn(seed):
                    self.assertNotRegex(text, r"(?<![\d.,^−-])\b1 (?!times\b)[a-z]+[^\Ws]s\b", one.id)

    def drawn(self, key: str):
        for seed in SEEDS:
            yield self.by_id[key].drawn(seed)

    def near(self, text: str, got: float, expected: float) -> None:
        self.assertLessEqual(abs(got - expected), 5.1e-4 * abs(expected) + 1e-9, text)  # four digits are said

    def test_falls_by_stepping(self):
        for text, answer in self.drawn("1.a"):
            _, a, n, h = numbers(text)[:4]
            v, x = (-a * h / 2 if "after the half" in text else 0.0), 0.0
            for _ in range(int(n)):
                v += a * h
                x += v * h
            self.near(text, numbers(answer)[0], x)

    def test_inertia_by_matrices(self):
        for text, answer in self.drawn("2.b"):
            moments, angle = np.diag(numbers(text)[:3]), math.radians(numbers(text)[3])
            axis = "xyz".index(re.search(r"world's (\w)", text)[1])
            p, q = (axis + 1) % 3, (axis + 2) % 3  # turns e_p towards e_q
            R = np.eye(3)
            R[p, p] = R[q, q] = math.cos(angle)
            R[q, p], R[p, q] = math.sin(angle), -math.sin(angle)
            for got, expected in zip(numbers(answer.partition(" kg")[0]), (R @ moments @ R.T).ravel(), strict=True):
                self.near(text, got, expected)

    def test_torque_by_numpy(self):
        for text, answer in self.drawn("2.c"):
            values = numbers(text)
            w = np.array(values[3:6])
            expected = -np.cross(w, np.array(values[:3]) * w)
            for got, value in zip(numbers(answer.partition(" N m")[0]), expected, strict=True):
                self.near(text, got, value)

    def test_sweeps_by_sweeping(self):
        for text, answer in self.drawn("4.c"):
            upper, lower = numbers(text)[:2]
            digits = int(re.search(r"10\^-(\d)", text)[1])
            S = np.array([[1 / lower, -1 / lower], [-1 / lower, 1 / lower + 1 / upper]])
            error, history = np.array([1.0, 1.0]), []
            for _ in range(2 + int(numbers(answer)[1])):
                error[0] = -S[0, 1] * error[1] / S[0, 0]
                error[1] = -S[1, 0] * error[0] / S[1, 1]
                history.append(error[1])
            rate = history[1] / history[0]
            self.near(text, numbers(answer)[0], rate)
            count = numbers(answer)[1]
            self.assertLessEqual(rate**count, 10**-digits * (1 + 1e-9))
            self.assertGreater(rate ** (count - 1), 10**-digits)

    def test_contradiction_and_descent_by_numpy(self):
        for text, answer in self.drawn("11.d"):
            _, b1, b2, s1, s2 = numbers(text)[:5]
            expected = np.linalg.solve([[1 + s1, 1], [1, 1 + s2]], [b1, b2])
            for got, value in zip(numbers(answer), [*expected, sum(expected)]):
                self.near(text, got, value)
        for text, answer in self.drawn("10.c"):
            a, b, c, d, *rest = numbers(text)
            S, B = np.array([[a, b], [c, d]]), np.array(rest[:2])
            alpha, energy = numbers(answer)
            left = [0.5 * x * x * B @ S @ B - x * B @ B for x in (alpha, 0.999 * alpha, 1.001 * alpha)]
            self.near(text, energy, left[0])
            self.assertLess(left[0], min(left[1:]) + 1e-6)

    def test_newton_within_by_its_equations(self):
        for text, answer in self.drawn("11.c"):
            S, B, _, lam, z, tau = numbers(text)[:6]
            delta, alpha = numbers(answer)
            dz = S * (lam + delta) - B - z  # the first line of the system before (11.7)
            self.assertLess(abs(lam * z + lam * dz + z * delta - tau), 5e-3, text)
            self.assertGreaterEqual(min(lam + alpha * delta, z + alpha * dz), -2e-3, text)
            self.assertTrue(alpha == 1 or min(lam + alpha * delta, z + alpha * dz) < 2e-3, text)

    def test_steps_of_one_body_by_stepping(self):
        for text, answer in self.drawn("2.d"):
            *_, v, h, omega, g = (x for x in numbers(text.replace("m/s²", "")))
            sign = -1 if "downwards" in text else 1
            height, angle, drifted = numbers(answer.replace("m/s²", ""))[:3]
            self.near(text, height, sign * (v + h * -g) * h)
            self.near(text, angle, omega * h)
            self.near(text, drifted, sign * v * h)
        for text, answer in self.drawn("3.d"):
            m, h, k, d, g = numbers(text.replace("m/s²", "").replace("mg/k", ""))[:5]
            a, b, s = (x / (1 + 4 * d) for x in (4 / h, 4 * d, 4 / h**2 / k))
            after = []
            for W, Wf in ((0.0, -h * g), (-h * g, -h * g)):
                impulse = max(0.0, (a * m * g / k - b * W - Wf) / (1 / m + s))
                after.append((-h * g + impulse / m) * (-1 if "downwards" in text else 1))
            self.near(text, after[0], 0)
            self.near(text, numbers(answer)[0], after[0])
            self.near(text, numbers(answer)[1], after[1])
        for text, answer in self.drawn("7.d"):
            W, e, h, g = numbers(text.replace("m/s²", "").replace("h/2", ""))[:4]
            g = g if "downwards" in text else -g
            u = W + h * g / 2
            W += -(1 + e) * u
            self.near(text, numbers(answer)[0], W)
            self.near(text, numbers(answer)[1], W + h * g)
        for text, answer in self.drawn("10.e"):
            m, deep, W, h, k, d, g = numbers(text.replace("m/s²", ""))[:7]
            soft, rigid = 4 / h**2 / k / (1 + 4 * d), 0
            closing, still = (4 / h * deep / 1000 - 4 * d * W) / (1 + 4 * d), -W
            after = [W - h * g + max(0.0, (right + h * g) / (1 / m + s)) / m for right, s in ((closing, soft), (still, rigid))]
            self.near(text, numbers(answer)[0], after[0])
            self.near(text, numbers(answer)[1], after[1])

    def test_steps_of_several_rows_by_numpy(self):
        for text, answer in self.drawn("4.d"):
            n, m, h, g, _, k = numbers(text.replace("m/s²", ""))[:6]
            G = np.eye(int(n)) - np.eye(int(n), k=-1)  # row k lifts ball k and presses on ball k - 1
            impulses = np.linalg.solve(G @ G.T / m, G @ np.full(int(n), h * g))
            self.near(text, numbers(answer)[0], (impulses[::-1] if "from the top" in text else impulses)[int(k) - 1])
            for V in G.T @ impulses / m:
                self.near(text, numbers(answer)[1], V)
        for text, answer in self.drawn("6.d"):
            m, degrees, _, h, g = numbers(text.replace("m/s²", ""))[:5]
            t = math.radians(degrees)
            G, kick = np.array([[-math.sin(t), math.cos(t)], [1, 0]]), np.array([0, -h * g])  # rod to pivot, wall
            impulses = np.linalg.solve(G @ G.T / m, -G @ kick)
            apart = kick
            for row in G:
                apart = apart - row * (row @ apart)
            for got, value in zip(numbers(answer), [*impulses, G[0] @ apart * (1 if "approach" in text else -1)], strict=True):
                self.near(text, got, value)
        for text, answer in self.drawn("14.d"):
            values = numbers(text.partition("hold")[2])
            tangents, radii = np.reshape(values[:8], (4, 2)), values[8:12]
            for got, x, radius in zip(numbers(answer), tangents, radii):
                size = np.linalg.norm(x)
                self.near(text, got * size, min(size, radius))  # onto the disc, and along the same direction
                self.assertTrue(0 < got <= 1 and (size > radius or got == 1), text)


class Command(unittest.TestCase):
    def test_what_is_printed_and_refused(self):
        box = Sandbox()
        self.addCleanup(box.close)
        plain = box.course("exam", "4", "--seed", "9")
        self.assertEqual((plain.returncode, plain.stderr), (0, ""))
        self.assertEqual(plain.stdout.count("\n**4."), 4)
        self.assertNotIn("*\n", plain.stdout.replace("**", ""))
        answered = box.course("exam", "4", "--seed", "9", "--answers").stdout
        self.assertEqual(len(re.findall(r"^\*[^*].*\*$", answered, re.MULTILINE)), 4)
        some = box.course("exam", "4.1-4.4,4.7,5.2")
        self.assertEqual(re.findall(r"^\*\*(\S+)\*\*", some.stdout, re.MULTILINE), ["4.a", "4.b", "4.d", "5.b"])
        self.assertIn("# Chapters 4.1-4.4, 4.7, 5.2, seed 1\n", some.stdout)
        self.assertEqual(some.stderr, "")
        first_half = box.course("exam", "8.1-8.4,8.9-8.12")
        self.assertEqual(re.findall(r"^\*\*(\S+)\*\*", first_half.stdout, re.MULTILINE), ["8.c", "8.e"])
        self.assertIn("8.a lacks 8.5, 8.6, 8.7, 8.8; 8.b lacks 8.8", " ".join(first_half.stderr.split()))
        box.assert_refused(self, ["exam"], ["name the chapters"])
        box.assert_refused(self, ["exam", "4.5-4.2"], ["'4.5-4.2' ends before it begins"])
        box.assert_refused(self, ["exam", "99"], ["99"])
        box.assert_refused(self, ["exam", "4", "--seed", "x"], ["'x'"])
        box.assert_refused(self, ["exam", "4", "--objectives"], ["--objectives"])


if __name__ == "__main__":
    unittest.main()
