"""The reference answers for nobody: the linked part of it contains neither the submission's exercise nor a later
one."""

import contextlib
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import unittest.mock
from pathlib import Path

from classroom import Classroom, right
from sandbox import all_exercises

from errors import CourseError
from grading.copies import Copies
from grading.isolation import choose, take_user
from grading.objects import _defined_elsewhere, make
from grading.reference import Reference, callable_from
from grading.submission import Source
from grading.workshop import CHECK, Workshop
from manifest import read_chapters
from paths import BUILD
from tree import Tree

MATRIX = "ERKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEE"
KICK = f"_ZN5spook4kick{MATRIX}S4_dd"
HEAD = '#include "01_leapfrog/leapfrog.hpp"\n#include "common/require.hpp"\n'
TRAP = HEAD + """
namespace spook {
__attribute__((weak)) void composed_step(Particles& bodies, const ForceField& force, double h, int pairs) {
  __builtin_trap();
}
}
"""


def versioned(name: str) -> str:
    """A useless function that a checker would take for kick if it stopped at the @."""
    return HEAD + f'extern "C" void mine() {{}}\nasm(".symver mine, {name}");\n'


def quoted(name: str) -> str:
    return HEAD + f'asm(".text\\n.globl \\"{name}\\"\\n.type \\"{name}\\",@function\\n\\"{name}\\": ret");\n'


def inline_of_the_reference() -> str:
    """Returns an inline function in the reference's object of composed_step, as a symbol."""
    reject = "_ZN5spook6rejectERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEdS7_"
    return f'asm(".pushsection .data\\n.quad {reject}\\n.popsection");\n'


ATTACKS = {  # by exercise and name: the source
    ("kick", "a version"): versioned(f"{KICK}@x"),
    ("kick", "a version of its own"): versioned(f"{KICK}@@x"),
    ("kick", "a version or none"): versioned(f"{KICK}@@@x"),
    ("kick", "a name with an at"): quoted(f"{KICK}@x"),
    ("kick", "a name with a blank"): quoted(f"{KICK} x"),
    ("kick", "a name with a tab"): quoted(f"{KICK}\\\\tx"),
    ("composed_step", "weak"): TRAP,
    ("composed_step", "weak and an inline function"): TRAP + inline_of_the_reference(),
    ("drift", "an earlier one"): HEAD + "namespace spook {\nVec3 drift(const Vec3& x, const Vec3& v, double h) {\n"
                                        "  return kick(x, v, 1, h);\n}\n}\n",
    ("kick", "a later one"): HEAD + """
namespace spook {
Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  Particles bodies{{Vec3::Zero()}, {v}, {inverse_mass}};
  leapfrog_step(bodies, [&f](std::size_t, const std::vector<Vec3>&) { return f; }, h);
  return bodies.v[0];
}
}
""",
}


class GradeReference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = Classroom()
        cls.addClassCleanup(cls.room.close)
        for (function, name), source in ATTACKS.items():
            cls.room.hand_in(f"{function} {name}", {f"{function}.cpp": source})
        once = "Vec3 const once = kick(v, f, inverse_mass, -h / 2);\n  return"
        calls = right("half_step_start").replace("return", once)
        cls.room.hand_in("calls an earlier one", {"half_step_start.cpp": calls})
        cls.marks = cls.room.grade()

    def test_no_attack_has_points(self):
        for function, name in ATTACKS:
            with self.subTest(f"{function} {name}"):
                result = self.marks.result(f"{function} {name}")
                self.assertEqual(result["score"], 0, self.marks.verdicts(f"{function} {name}", function))

    def test_an_earlier_exercise_may_be_called(self):
        self.assertEqual(self.marks.verdicts("calls an earlier one", "half_step_start"), {"passed"})

    def test_nothing_after_an_exercise_may_be_called(self):
        exercises = all_exercises()
        for k, exercise in enumerate(exercises):
            later = {one.function for one in exercises[k:]}
            self.assertEqual(later & set(callable_from(exercise)), set(), exercise.label)

    def test_the_linker_is_believed_only_where_it_names_the_submission(self):
        here, there = "/usr/bin/ld: local.o: definition of f\n", "/usr/bin/ld: /x/kick.a(kick.o): definition of f\n"
        asked = "/usr/bin/ld: answering.o: reference to f\n"
        self.assertEqual(_defined_elsewhere(asked + here, {"f"}), "")
        for told in (there, here + there, asked, "", here.replace("of f", "of f@x")):
            self.assertEqual(_defined_elsewhere(told, {"f"}), "f", told)


class OneBuild(unittest.TestCase):
    """All files with which submissions are compiled, linked and tested are copied once, from one build."""

    @classmethod
    def setUpClass(cls):
        room = Classroom()
        cls.addClassCleanup(room.close)
        cls.workshop = Workshop([next(iter(read_chapters()))], None)
        cls.addClassCleanup(cls.workshop.close)

    def test_a_change_is_noticed(self):
        """Changes the content, the time, and the file itself."""
        with tempfile.TemporaryDirectory() as folder:
            file, other, copy = (Path(folder, name) for name in ("a.o", "b.o", "copy.o"))
            for change, is_one in ((lambda: file.write_bytes(b"longer"), True), (lambda: other.rename(file), True),
                                   (lambda: os.utime(file, (1, 1)), True), (file.unlink, True), (file.read_bytes, False)):
                file.write_bytes(b"old")
                other.write_bytes(b"old")
                copies = Copies()
                copies.copy(file, copy)
                self.assertEqual((copies.changed(), copy.read_bytes()), (None, b"old"))
                change()
                self.assertEqual(copies.changed(), file if is_one else None)

    def test_what_is_missing_counts_as_changing(self):
        """An archive is removed before it is made anew."""
        with tempfile.TemporaryDirectory() as folder:
            copies, file = Copies(), Path(folder, "a.a")
            with self.assertRaises(FileNotFoundError):
                copies.copy(file, Path(folder, "b.a"))
            self.assertEqual(copies.changed(), file)
            file.touch()
            self.assertEqual(copies.changed(), file)

    def staged(self, *outcomes: tuple[Path | None, Exception | None]) -> int:
        """Returns how often files are copied, where each time one of them has changed, or copying it has failed."""
        left = list(outcomes)

        def stage(*_) -> None:
            if left[0][1]:
                raise left[0][1]
        workshop = Workshop.__new__(Workshop)
        with (tempfile.TemporaryDirectory() as folder, unittest.mock.patch.object(Workshop, "_stage", stage),
              unittest.mock.patch.object(Copies, "changed", lambda _: left.pop(0)[0]), unittest.mock.patch("time.sleep"),
              unittest.mock.patch("grading.workshop.build_tests"), unittest.mock.patch("grading.workshop.CHECK", Tree("x"))):
            workshop.answers = Path(folder, "answers")
            with unittest.mock.patch.object(Tree, "alone", contextlib.nullcontext):
                workshop._stage_one_build([], None)
        return len(outcomes) - len(left)

    def test_it_begins_again_until_no_file_has_changed(self):
        archive, half_written = Path("libx.a"), CourseError("ar cannot take the reference apart")
        self.assertEqual(self.staged((None, None)), 1)
        self.assertEqual(self.staged((archive, None), (archive, half_written), (None, None)), 3)
        with self.assertRaisesRegex(CourseError, "ar cannot take"):
            self.staged((archive, None), (None, half_written))
        with self.assertRaisesRegex(CourseError, "libx.a changes while it is copied: another process is building there"):
            self.staged(*[(archive, None)] * 99)

    def test_an_archive_that_is_replaced_while_it_is_copied_is_copied_again(self):
        """As ninja replaces it: here by one of half the size, whose copy is not used."""
        copied, whole = [], shutil.copyfile

        def replaced(file: Path, to: Path) -> None:
            whole(file, to)
            if file.name == "libspook_reference.a":
                copied.append(file)
                if len(copied) == 1:
                    os.truncate(to, file.stat().st_size // 2)
                    states.append(file)
        states: list[Path] = []
        changed = Copies.changed
        with (unittest.mock.patch("shutil.copyfile", replaced), unittest.mock.patch("time.sleep"),
              unittest.mock.patch.object(Copies, "changed", lambda one: states.pop() if states else changed(one))):
            workshop = Workshop([next(iter(read_chapters()))], None)
        self.addCleanup(workshop.close)
        self.assertEqual(len(copied), 2)
        self.assertEqual(self.workshop.build, workshop.build)

    def test_an_object_is_known_by_the_functions_that_it_calls(self):
        """From one call of nm: with one for each object every grading began half a minute later."""
        calls = []

        def ran(command: list[str], folder: Path) -> str:
            calls.append(command[0])
            return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("grading.reference._ran", ran):
            reference = Reference(self.workshop._archive, Path(folder))
            names = {file.name for file in (Path(folder) / "members").iterdir()}
        self.assertLess(len(calls), 6)
        self.assertLessEqual(set(reference._asked), names)
        composed = reference._asked["composed_step.cpp.o"]
        self.assertLessEqual(reference.symbols["kick"], composed)
        self.assertEqual(reference.symbols["composed_step"] & composed, set())

    def test_nothing_of_the_build_is_read_afterwards(self):
        """Neither by the compiler nor by the linker, and the archives that the linker has name no file there."""
        workshop = self.workshop
        for exercise in next(iter(read_chapters())).exercises:
            words = [*workshop.compile_command(exercise, "kick.cpp", "kick.o"),
                     *workshop.link_command(exercise, "kick.o", "kick"), str(workshop.test_program(exercise))]
            self.assertTrue(any(str(workshop.root) in word for word in words))
            self.assertEqual([word for word in words if str(CHECK.path) in word or str(BUILD) in word], [])
            thin = workshop.reference.archive_for(exercise).read_bytes()
            self.assertNotIn(str(BUILD).encode(), thin)


class Linked(unittest.TestCase):
    """The functions that a submission could read as machine code, and print."""

    def functions_in(self, function: str, source: str) -> set[str]:
        """Returns the exercises that have a function in the program of an answer."""
        exercise = next(one for one in all_exercises() if one.function == function)
        isolation = choose()
        user = take_user(isolation)
        self.addCleanup(user.release)
        with tempfile.TemporaryDirectory(dir=self.workshop.root) as folder:
            Path(folder).chmod(0o755)
            made = make(exercise, Source(f"{function}.cpp", source.encode()), self.workshop, isolation, user, Path(folder))
            self.assertIsNotNone(made.program, made.message)
            told = subprocess.run(["nm", "-P", "--defined-only", str(made.program)], capture_output=True, text=True)
        defined = {line.split()[0] for line in told.stdout.splitlines()}
        return {name for name, symbols in self.workshop.functions.items() if symbols & defined}

    @classmethod
    def setUpClass(cls):
        room = Classroom()  # closes the course to other users where that is needed
        cls.addClassCleanup(room.close)
        cls.workshop = Workshop([next(iter(read_chapters()))], None)
        cls.addClassCleanup(cls.workshop.close)

    def test_an_answer_has_no_other_exercise_than_those_that_it_names(self):
        for function in ("kick", "drift", "half_step_start", "leapfrog_step"):
            answer = right(function, "folded")
            named = {one.function for one in all_exercises() if re.search(rf"\b{one.function}\(", answer)}
            self.assertEqual(self.functions_in(function, answer), named, function)
        once = "Vec3 const once = kick(v, f, inverse_mass, -h / 2);\n  return"
        calling = right("half_step_start").replace("return", once)
        self.assertEqual(self.functions_in("half_step_start", calling), {"half_step_start", "kick"})


if __name__ == "__main__":
    unittest.main()
