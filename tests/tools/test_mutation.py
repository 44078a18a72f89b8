"""The mutation run: the mutants of small files, the survivor that it finds, the equivalents."""

import os
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import sandbox  # finds the course's modules

sys.path.insert(0, str(sandbox.TOOLS / "mutation"))

import equivalents  # noqa: E402
import exercise_run  # noqa: E402
import outcome  # noqa: E402
from commands import Commands  # noqa: E402
from crowd import Crowd, Switched  # noqa: E402
from errors import CourseError  # noqa: E402
from exercise_run import ExerciseRun, Result  # noqa: E402
from manifest import Exercise  # noqa: E402
from mutant import Mutant  # noqa: E402
from mutate import mutants_of  # noqa: E402
from scores import score, table  # noqa: E402
from trial import Test, Trial  # noqa: E402


def changed(body: str, kind: str | None = None) -> set[str]:
    """Returns the mutants of a function's body, as text."""
    text = f"namespace spook {{\ndouble f() {{\n{body}\n}}\n}}\n"
    return {mutant.after(text) for mutant in mutants_of(text) if kind in (None, mutant.kind)}


def subtly_changed(body: str, kind: str, head: str = "double f()") -> set[str]:
    text = f"namespace spook {{\n{head} {{\n{body}\n}}\n}}\n"
    return {mutant.after(text) for mutant in mutants_of(text, subtle=True) if mutant.kind == kind}


class SubtleMutations(unittest.TestCase):
    def test_thresholds(self):
        self.assertEqual(subtly_changed("if (x > 0) ;", "threshold"), {"if (x > 1e-9) ;", "if (x > -1e-9) ;"})
        self.assertEqual(subtly_changed("return x;", "threshold"),
                         {"return [](double x) { return x < 1e-9 && x > -1e-9 ? 0 : x; }(x);"})
        self.assertEqual(subtly_changed("return 1;", "threshold", "int f()"), set())

    def test_small_parts(self):
        self.assertEqual(subtly_changed("return x;", "part", "Vec3 f()"),
                         {"return [](Vec3 x) -> Vec3 { return (x.array().abs() < 1e-6 * x.norm())"
                          ".select(0, x.array()); }(x);"})
        self.assertEqual(subtly_changed("return x;", "part"), set())

    def test_small_addends(self):
        found = subtly_changed("return a * b - f(c + d) + e;", "part", "Vec3 f()")
        large_y = "if (x.norm() < 1e-6 * y.norm())"
        self.assertIn(f"return [](Vec3 x, Vec3 y) -> Vec3 {{ {large_y} return -y; return x - y; }}"
                      "(a * b, f(c + d)) + e;", found)
        self.assertIn(f"return [](Vec3 x, Vec3 y) -> Vec3 {{ {large_y} return +y; return x + y; }}"
                      "(a * b - f(c + d), e);", found)
        self.assertEqual(len(found), 1 + 2 * 2)
        self.assertEqual(subtly_changed("return a > 0 ? a + b : c;", "part"), set())

    def test_floats(self):
        self.assertEqual(subtly_changed("const double x = y * z;\nreturn;", "float"),
                         {"const double x = static_cast<float>(y * z);"})
        self.assertEqual(subtly_changed("return x;", "float", "Vec3 f()"),
                         {"return Vec3(Vec3(x).cast<float>().cast<double>());"})

    def test_what_lives_on(self):
        self.assertEqual(subtly_changed("std::vector<double> x;", "static"), {"static std::vector<double> x;"})
        self.assertEqual(subtly_changed("const Vec3 x = y;", "static"), {"static const Vec3 x = y;"})
        self.assertEqual(subtly_changed("x = y;", "static"), set())
        self.assertEqual(subtly_changed("class A {\nstd::vector<int> x;\n};\nx = y;", "static"), set())

    def test_inputs(self):
        head = "double f(const Vec3& x, double y, const std::vector<int>& z)"
        changes = " ".join(subtly_changed("return y;", "input", head))
        self.assertIn("const_cast<Vec3&>(x) *= 2;", changes)
        self.assertIn("const_cast<std::vector<int>&>(z).front()", changes)
        self.assertEqual(subtly_changed("return y;", "input", "double f(Vec3& x, double y)"), set())

    def test_loops_that_end_after_many(self):
        self.assertEqual(subtly_changed("for (int k = 0; k < n; ++k) x += k;", "limit"),
                         {"for (int k = 0; k < 64 && (k < n); ++k) x += k;"})
        self.assertEqual(subtly_changed("for (const int k : f(list)) x += k;", "limit"),
                         {"for (int left = 64; const int k : f(list)) if (left-- > 0) x += k;"})
        self.assertEqual(subtly_changed("for (int k = n; k > 0; --k) x += k;", "limit"), set())
        self.assertEqual(subtly_changed("for (const int end : {k, k + 1}) x += end;", "limit"), set())

    def test_zeros(self):
        head = "double f(double x, const Vec3& y)"
        self.assertEqual(subtly_changed("return x;", "zero", head),
                         {"double f(double x, const Vec3& y) { if (x == 0) const_cast<double&>(x) = 1;"})

    def test_nans_that_are_dropped(self):
        head = "Vec3 f(double x, const Mat3& K, int n)"
        self.assertEqual(subtly_changed("return x * v;", "nan", head),
                         {f"{head} {{ if ({check}) return Vec3::Zero();" for check in ("x != x", "K.hasNaN()")})

    def test_fields_that_should_not_matter(self):
        head = "void f(const Contact& contact)"
        self.assertEqual(subtly_changed("x = y;", "field", head),
                         {head + " { if (contact.gap < 0) return ;", head + " { if (contact.gap > 0) return ;"})

    def test_pairs_are_the_same_each_time(self):
        body = "x = y + 2;\nz = x * x;\nw = z - 1;"
        found = subtly_changed(body, "pair")
        self.assertTrue(found)
        self.assertEqual(found, subtly_changed(body, "pair"))


class Mutations(unittest.TestCase):
    def test_operators(self):
        self.assertEqual(changed("x = y + 2;", "operator"), {"x += y + 2;", "x -= y + 2;", "x = y - 2;"})
        self.assertEqual(changed("x += y;", "operator"), {"x -= y;", "x = y;"})
        self.assertEqual(changed("if (x < y && y == z) ;", "operator"),
                         {"if (x <= y && y == z) ;", "if (x >= y && y == z) ;", "if (x < y || y == z) ;",
                          "if (x < y && y != z) ;"})

    def test_a_declaration_is_not_an_assignment(self):
        self.assertEqual(changed("const double x = y;", "operator"), set())
        self.assertEqual(changed("std::vector<int> x = y;", "operator"), set())
        self.assertEqual(changed("V[row.i] = y;", "operator"), {"V[row.i] += y;", "V[row.i] -= y;"})

    def test_signs(self):
        self.assertEqual(changed("return -x;", "sign"), {"return x;"})
        self.assertIn("return -x * y;", changed("return x * y;", "sign"))
        self.assertIn("if (x) ;", changed("if (!x) ;", "sign"))
        self.assertEqual(changed('require_all_finite("x", x);', "sign"), {'-require_all_finite("x", x);'})

    def test_what_is_no_operator(self):
        self.assertEqual(changed("const auto& x = static_cast<int>(*y);", "operator"), set())
        self.assertEqual(changed("return std::vector<double>();", "operator"), set())

    def test_constants(self):
        self.assertEqual(changed("return 0;", "constant"), {"return 1;"})
        self.assertEqual(changed("return 2;", "constant"), {"return 1;", "return 3;", "return (-2);"})
        self.assertEqual(changed("return 0.5;", "constant"), {"return 1;", "return 0.25;", "return (-0.5);"})
        self.assertEqual(changed("return 1e-8;", "constant"),
                         {"return 0.0001;", "return 0;", "return (-1e-8);"})
        self.assertEqual(changed("return true;", "constant"), {"return false;"})
        self.assertEqual(changed("return a.head<3>();", "constant"), set())

    def test_indices(self):
        self.assertEqual(changed("return x[k];", "index"), {"return x[k + 1];"})
        self.assertEqual(changed("return A.col(k);", "index"), {"return A.col(k + 1);"})
        self.assertEqual(changed("return f(row.hi);", "index"), set())

    def test_names(self):
        self.assertEqual(changed("return contact.i;", "name"), {"return contact.j;"})
        self.assertEqual(changed("return Gi * Gj;", "name"), {"return Gj * Gj;", "return Gi * Gi;"})
        self.assertEqual(changed("return x.room_lo;", "name"), {"return x.room_hi;"})
        self.assertEqual(changed("return i;", "name"), set())  # there is no j
        self.assertEqual(changed("return r.y();", "function"), {"return r.z();"})
        self.assertEqual(changed("return std::sin(x);", "function"), {"return std::cos(x);"})

    def test_calls(self):
        self.assertEqual(changed("return R.transpose();", "call"), {"return R;"})
        self.assertEqual(changed("return std::abs(x);", "call"), {"return (x);"})
        self.assertEqual(changed("return g(x, y + 1, z);", "arguments"),
                         {"return g(y + 1, x, z);", "return g(x, z, y + 1);"})
        self.assertEqual(changed("return c.r.cross(n);", "arguments"), {"return (n).cross(c.r);"})
        self.assertEqual(changed("return std::max(x, y);", "arguments"), set())

    def test_statements(self):
        self.assertEqual(changed("x = y;\nNet net;\nf(x);", "statement"), {";"})
        text = "namespace spook {\nint f() {\nx = y;\nNet net;\nf(x);\n}\n}"
        lines = [mutant.line(text) for mutant in mutants_of(text) if mutant.kind == "statement"]
        self.assertEqual(lines, [3, 5])
        self.assertEqual(changed("if (x) return y;\nreturn z;", "statement"), {"if (x) ;"})
        self.assertEqual(changed("while (x) break;", "statement"), {"while (x) ;"})

    def test_conditions_and_loops(self):
        self.assertEqual(changed("if (x) y = 2;", "condition"),
                         {"if (!(x)) y = 2;", "if (false && (x)) y = 2;", "if (true || (x)) y = 2;"})
        self.assertEqual(changed("return x ? y : z;", "condition"), {"return x ? z : y;"})
        self.assertEqual(changed("for (int k = 0; k < n; ++k) x;", "bound"),
                         {"for (int k = 0; k < n - 1; ++k) x;"})

    def test_comments_text_and_declarations_stay(self):
        text = "#include <a+b>\nnamespace spook {\n// 1 + 1\nint f(int i = 1);\ntemplate int f<3>(int);\n}\n"
        self.assertEqual(mutants_of(text), [])
        self.assertEqual(changed('f("1 + 1");', "operator"), set())
        self.assertEqual(changed("left.reserve(8 * n + 1);"), set())
        self.assertEqual(changed('if (x) reject("k", k + 1, "at least 1");', "constant"), set())


class ManyInOne(unittest.TestCase):
    TEXT = "#include <a>\n\nnamespace spook {\nint f() {\n  return 1;\n}\n\n}  // namespace spook\n"

    def test_errors_are_told_apart_by_their_lines(self):
        everyone = Crowd({0: self.TEXT, 3: self.TEXT, 7: self.TEXT})
        lines = everyone.source().splitlines()
        self.assertEqual([k for k, line in enumerate(lines, 1) if "return" in line], [4, 10, 16])
        self.assertEqual(everyone.culprits("crowd.cpp:10:3: error: no"), {3})
        template = "crowd.cpp:16:3:   required from here\nx.h:5:1: error: no\ncrowd.cpp:4:3: note: f"
        self.assertEqual(everyone.culprits(template), {7})

    def test_all_that_any_of_them_includes_comes_first_and_once(self):
        other = "// Wrong: ...\n#include <b>\n#include <a>\n" + self.TEXT.partition("\n")[2]
        lines = Crowd({1: self.TEXT, 2: other}).source().splitlines()
        self.assertEqual(lines[:2], ["#include <a>", "#include <b>"])
        self.assertEqual(sum("#include" in line for line in lines), 2)

    def test_a_name_stands_in_what_the_compiler_calls_it(self):
        source = Crowd({1: self.TEXT, 2: self.TEXT}, {2: SimpleNamespace(full_name="half_of_f")}).source()
        self.assertIn("namespace mutant_000001 {", source)
        self.assertIn("namespace mutant_0_half_of_f {", source)

    def test_one_that_does_not_define_the_function_is_named(self):
        other = self.TEXT.replace("int f()", "int g()")
        with tempfile.TemporaryDirectory() as folder:
            source, compiled = Path(folder, "crowd.cpp"), Path(folder, "crowd.o")
            crowd = Crowd({1: self.TEXT.replace("#include <a>", ""), 2: other.replace("#include <a>", "")},
                          {2: SimpleNamespace(full_name="half_of_f", place="f.diff:5: half")})
            source.write_text(crowd.source())
            compiler = os.environ.get("CXX") or "c++"
            subprocess.run([compiler, "-o", str(compiled), "-c", str(source)], check=True)
            with self.assertRaisesRegex(CourseError, r"f\.diff:5: half: it does not define spook::f\(\)"):
                crowd.switch([compiled], [Switched(frozenset({"_ZN5spook1fEv"}), (1, 2), otherwise=1)])

    def test_what_has_to_be_compiled_alone(self):
        self.assertTrue(Crowd.can_hold(self.TEXT))
        self.assertFalse(Crowd.can_hold("#define ONE 1\n" + self.TEXT))
        self.assertFalse(Crowd.can_hold("int g();\n" + self.TEXT))


class Outcomes(unittest.TestCase):
    def judged(self, **trial):
        given = {"tests": [Test("F.Is", False, [])], "exit_code": 0, "timed_out": False, "output": ""}
        return outcome.judged(Trial(**given | trial))[0]

    def test_each(self):
        self.assertEqual(self.judged(), outcome.SURVIVED)
        self.assertEqual(self.judged(tests=[Test("F.Is", False, ["wrong"])], exit_code=1), outcome.KILLED)
        self.assertEqual(self.judged(tests=None, exit_code=-11), outcome.CRASHED)
        self.assertEqual(self.judged(tests=None, exit_code=-9, timed_out=True), outcome.TIMED_OUT)
        self.assertEqual(self.judged(tests=[]), outcome.CRASHED)

    def test_the_score_leaves_equivalents_out(self):
        mutant = Mutant("sign", 0, 0, "")
        found = score(Result(mutant, what) for what in (
            *[outcome.KILLED] * 7, outcome.CRASHED, outcome.TIMED_OUT, outcome.SURVIVED, outcome.EQUIVALENT,
            outcome.LISTED, outcome.NOT_COMPILED))
        self.assertEqual(found.row(), ["12", "7", "1", "1", "1", "1+1", "1", "90.0 %"])
        self.assertIn("90.0 %", table([("01", found)]))


class Small(unittest.TestCase):
    """A course with one function, compiled and run; a script in GoogleTest's place calls `program`."""

    FILE = "namespace spook {\nint twice(int x) {\n  return x + x;\n}\n\n}  // namespace spook\n"
    TESTS = """\
        #include <cstdio>
        #include <cstdlib>
        #include <cstring>
        namespace spook { int twice(int x); }
        int main(int count, char** words) {
          const bool fails = !(CHECK);
          for (int k = 1; k < count; ++k)
            if (std::strncmp(words[k], "--gtest_output=json:", 20) == 0) {
              std::FILE* report = std::fopen(words[k] + 20, "w");
              std::fprintf(report,
                           R"({"testsuites": [{"name": "Twice", "testsuite": [{"name": "Is",)"
                           R"("status": "RUN", "result": "COMPLETED", "failures": [%s]}]}]})",
                           fails ? R"({"failure": "wrong"})" : "");
              std::fclose(report);
            }
          return fails;
        }
        """

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        solutions = self.root / "solutions" / "01_small"
        solutions.mkdir(parents=True)
        (solutions / "twice.cpp").write_text(self.FILE)
        self.exercise = Exercise(1, 1, "twice", "01_small", ())
        self.tree = mock.Mock(path=self.root / "build")

    def results(self, check: str, seeds: tuple[int, ...] = (1,)) -> dict[str, str]:
        """Returns the outcomes of the mutants, by their text."""
        self.tree.path.mkdir(exist_ok=True)
        (self.tree.path / "tests.cpp").write_text(textwrap.dedent(self.TESTS).replace("CHECK", check))
        compiler = os.environ.get("CXX") or "c++"
        given = Commands(self.tree.path, (compiler, "-std=c++20"),
                         (compiler, "own.o", "tests.cpp", "-o", "program"), "own.o")
        with mock.patch.object(Commands, "inputs", lambda _: [self.tree.path / "tests.cpp"]), \
                mock.patch.object(exercise_run, "commands", lambda *_: given), \
                mock.patch.object(exercise_run, "reference_functions", lambda *_: {"_ZN5spook5twiceEi"}), \
                mock.patch.object(Exercise, "reference", self.root / "solutions" / "01_small" / "twice.cpp"):
            found = ExerciseRun(self.tree, self.exercise, 1, seeds=seeds).results()
        return {result.mutant.after(self.FILE): result.outcome for result in found}

    def test_a_survivor_is_found_and_then_killed_by_a_better_check(self):
        self.assertEqual(self.results("spook::twice(0) == 0"),
                         {"return x - x;": outcome.SURVIVED, "return -x + x;": outcome.SURVIVED})
        self.assertEqual(self.results("spook::twice(1) == 2"),
                         {"return x - x;": outcome.KILLED, "return -x + x;": outcome.KILLED})

    def test_what_is_caught_with_one_seed_only_is_a_survivor(self):
        check = '*std::getenv("SPOOK_SEED") == \'2\' || spook::twice(1) == 2'
        found = {seeds: set(self.results(check, seeds).values()) for seeds in ((1,), (1, 2))}
        self.assertEqual(found, {(1,): {outcome.KILLED}, (1, 2): {outcome.SURVIVED}})

    def test_a_crash_counts_as_one(self):
        found = self.results("spook::twice(1) != 0 || (__builtin_trap(), true)")
        self.assertEqual(set(found.values()), {outcome.CRASHED})

    def test_a_reference_that_fails_its_tests(self):
        with self.assertRaisesRegex(CourseError, "fails its own tests"):
            self.results("spook::twice(1) == 3")


class ListOfEquivalents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "equivalent.txt")

    def entries(self, text: str):
        self.file.write_text(textwrap.dedent(text))
        return equivalents.read_equivalents(self.file)

    def test_an_entry(self):
        (entry,) = self.entries("""\
            # Words.
            solutions/a/f.cpp  sign
            - return x;
            + return -x;
            = Squared
              later.
            """)
        self.assertEqual((entry.path, entry.kind, entry.before, entry.after, entry.reason, entry.line),
                         ("solutions/a/f.cpp", "sign", "return x;", "return -x;", "Squared later.", 2))

    def test_an_entry_without_a_reason(self):
        with self.assertRaisesRegex(CourseError, "equivalent.txt:1: .* are needed"):
            self.entries("solutions/a/f.cpp sign\n- x\n+ -x\n")

    def test_entries_are_held_against_the_mutants(self):
        exercise = next(found for found in sandbox.all_exercises() if found.function == "kick")
        text = exercise.reference.read_text(encoding="utf-8")
        mutant = mutants_of(text)[0]
        path = str(exercise.reference.relative_to(sandbox.ROOT))
        entry = equivalents.Equivalent(path, mutant.kind, mutant.before(text), mutant.after(text), "so", 3)
        marked, wrong = equivalents.exempted(exercise, [Result(mutant, outcome.SURVIVED)], [entry])
        self.assertEqual((marked[0].outcome, wrong), (outcome.LISTED, []))
        _, wrong = equivalents.exempted(exercise, [Result(mutant, outcome.KILLED, "Kick.Is")], [entry])
        self.assertIn("no survivor: killed Kick.Is", wrong[0])
        _, wrong = equivalents.exempted(exercise, [], [entry])
        self.assertIn("no mutant of", wrong[0])


if __name__ == "__main__":
    unittest.main()
