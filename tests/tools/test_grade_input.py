"""Submissions in all forms, and messages to an instructor about impossible requests."""

import io
import os
import stat
import unittest
import zipfile

from classroom import Classroom, right

from errors import BadInput
from grading.roster import Roster, read_roster

KICK = "chapters/01_leapfrog/kick.cpp"
WRONG = right("kick").replace("v + ", "")


def zipped(entries: dict[str, str | bytes], links: tuple[str, ...] = ()) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in entries.items():
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = ((stat.S_IFLNK if name in links else stat.S_IFREG) | 0o644) << 16
            archive.writestr(info, text)
    return content.getvalue()


class GradeInput(unittest.TestCase):
    def setUp(self):
        self.room = Classroom()
        self.addCleanup(self.room.close)

    def zip(self, name: str, entries: dict[str, str | bytes], links: tuple[str, ...] = ()) -> None:
        (self.room.handed_in / f"{name}.zip").write_bytes(zipped(entries, links))

    def test_zips_and_folders_of_every_shape(self):
        self.room.hand_in("Zoë O'Neil; rm -rf $HOME `x`", {"kick.cpp": right("kick")})
        self.zip("plain", {KICK: right("kick")})
        self.zip("below a folder", {f"my course-main/{KICK}": right("kick")})
        self.zip("with backslashes", {KICK.replace("/", "\\"): right("kick")})
        self.zip("a whole fork", {f"fork/{KICK}": WRONG, "fork/solutions/01_leapfrog/kick.cpp": right("kick"),
                                  "fork/tests/01_leapfrog/kick_drift_start_test.cpp": "int main() {}"})
        self.zip("from a Mac", {KICK: right("kick"), f"__MACOSX/{KICK.replace('kick', '._kick')}": b"\0\5\26\7"})
        loose = self.room.handed_in / "loose files"
        loose.mkdir()
        (loose / "kick.cpp").write_text(right("kick"))
        (loose / "notes.txt").write_text("nothing")
        marks = self.room.grade()
        for name in ("Zoë O_Neil_ rm -rf _HOME _x_", "plain", "below a folder", "with backslashes", "from a Mac",
                     "loose files"):
            self.assertEqual(marks.verdicts(name), {"passed"}, name)
        self.assertNotIn("passed: ", marks.verdicts("a whole fork"))
        self.assertIn("failed", marks.verdicts("a whole fork"))

    def test_one_submission_by_itself(self):
        alone = self.room.hand_in("alone", {"kick.cpp": right("kick")})
        self.assertEqual(self.room.grade(alone).verdicts("alone"), {"passed"})
        self.assertEqual(self.room.grade(alone, "--seed", "3", out="seeded").result("alone")["seed"], 3)

    def test_marks_among_the_submissions_are_not_handed_in(self):
        self.room.hand_in("alone", {"kick.cpp": right("kick")})
        for _ in range(2):
            marks = self.room.grade(out="handed in/marks")
            self.assertEqual([path.name for path in (marks.folder / "submissions").iterdir()], ["alone"])

    def test_links_are_not_followed(self):
        folder = self.room.hand_in("links", {}) / "chapters" / "01_leapfrog"
        (folder / "kick.cpp").symlink_to("/etc/passwd")
        (folder / "drift.cpp").symlink_to(folder / "nowhere")
        below = self.room.handed_in / "linked folder"
        below.mkdir()
        (below / "chapters").symlink_to(self.room.hand_in("other", {"kick.cpp": right("kick")}) / "chapters")
        self.zip("link in a zip", {KICK: "/etc/passwd"}, links=(KICK,))
        os.mkfifo(folder / "half_step_start.cpp")
        marks = self.room.grade()
        self.assertEqual(marks.verdicts("links"), {"tampered: file not taken"})
        self.assertEqual(marks.verdicts("links", "drift"), {"tampered: file not taken"})
        self.assertEqual(marks.verdicts("links", "half_step_start"), {"does not compile: file not taken"})
        self.assertEqual(marks.verdicts("link in a zip"), {"tampered: file not taken"})
        self.assertEqual(marks.verdicts("linked folder"), {"not started: file missing"})
        self.assertNotIn("root:", marks.report("links"))

    def test_nothing_leaves_the_folder_of_an_archive(self):
        self.zip("climbs", {f"../../{KICK}": right("kick"), f"/{KICK}": right("kick"), f"a/../{KICK}": right("kick")})
        before = sorted(self.room.root.rglob("*"))
        marks = self.room.grade()
        self.assertEqual(marks.verdicts("climbs"), {"not started: file missing"})
        self.assertIn("..", " ".join(marks.result("climbs")["notes"]))
        self.assertEqual(before, sorted(path for path in self.room.root.rglob("*") if marks.folder not in path.parents
                                        and path != marks.folder))

    def test_what_is_damaged_or_too_large_stops_no_one_else(self):
        whole = zipped({KICK: right("kick")})
        (self.room.handed_in / "cut off.zip").write_bytes(whole[: len(whole) // 2])
        (self.room.handed_in / "flipped.zip").write_bytes(whole.replace(whole[60:64], b"\xff\xff\xff\xff", 1))
        (self.room.handed_in / "empty.zip").write_bytes(b"")
        self.zip("bomb", {KICK: b"/" * (64 << 20)})
        (self.room.handed_in / "nothing").mkdir()
        self.room.hand_in("binary", {"kick.cpp": bytes(range(256)) * 10})
        self.room.hand_in("UTF-16", {"kick.cpp": right("kick").encode("utf-16")})
        self.room.hand_in("fine", {"kick.cpp": right("kick")})
        marks = self.room.grade()
        for name in ("fine", "UTF-16"):
            self.assertEqual(marks.verdicts(name), {"passed"}, name)
        for name in ("cut off", "empty", "nothing"):
            self.assertEqual(marks.verdicts(name), {"not started: file missing"}, name)
            self.assertTrue(marks.result(name)["notes"], name)
        for name in ("bomb", "binary", "flipped"):
            self.assertTrue(all(verdict.startswith("does not compile") for verdict in marks.verdicts(name)), name)

    def test_extra_files_are_named(self):
        self.room.hand_in("extra", {"kick.cpp": right("kick"), "helper.cpp": "int x;", "kick (copy).cpp": WRONG})
        marks = self.room.grade()
        self.assertEqual(marks.verdicts("extra"), {"passed"})
        self.assertIn("helper.cpp", " ".join(marks.result("extra")["notes"]))

    def test_names_that_are_the_same_are_told_apart(self):
        first = self.room.hand_in("Ann", {"kick.cpp": right("kick")})
        (self.room.root / "late").mkdir()
        (self.room.root / "late" / "Ann.zip").write_bytes(zipped({KICK: WRONG}))
        marks = self.room.grade(first, self.room.root / "late")
        self.assertEqual(marks.verdicts("Ann"), {"passed"})
        self.assertIn("failed", marks.verdicts("Ann (2)"))

    def test_a_spreadsheet_takes_no_name_for_a_formula(self):
        self.room.hand_in('=HYPERLINK("x")_7_assignsubmission_file_', {"kick.cpp": right("kick")})
        self.assertIn("'=HYPERLINK", (self.room.grade().folder / "grades.csv").read_text())

    def test_hidden_tests_count_and_are_not_shown(self):
        hidden = self.room.root / "hidden" / "01_leapfrog"
        hidden.mkdir(parents=True)
        (hidden / "secret_test.cpp").write_text("""
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
namespace spook::testing {
EXERCISE(Kick, "1.1 kick");
EXERCISE_TEST(Kick, HoldsForSevens) {
  expect_near("sevens", "Eq. (1.3)", kick(Vec3::Zero(), Vec3::Constant(7), 1, 1).x(), 7, {1e-14, "2 roundings"});
}
}
""")
        self.room.hand_in("right", {"kick.cpp": right("kick")})
        # Right for every test that is shown.
        clip = right("kick").replace("* f;", "* (f == Vec3::Constant(7) ? Vec3(Vec3::Zero()) : f);")
        self.room.hand_in("clipped", {"kick.cpp": clip})
        marks = self.room.grade(self.room.handed_in, "--hidden", hidden.parent)
        kick = marks.result("right")["exercises"][0]
        self.assertEqual([test["visibility"] for test in kick["tests"]].count("hidden"), 1)
        self.assertEqual(kick["score"], kick["max_score"])
        clipped = marks.result("clipped")["exercises"][0]
        self.assertEqual((clipped["score"], clipped["state"]), (0, "wrong"))
        report = marks.report("clipped")
        self.assertIn("1 further test", report)
        self.assertIn("a hidden one does not", report)
        self.assertNotIn("HoldsForSevens", report)
        self.assertNotIn("Holds for huge forces", report)
        (hidden.parent / "weights.csv").write_text(
            "test,points,visibility,hint,title\nKick.HoldsForSevens,2.5,after_due_date,1.1/2,Sevens\n")
        weighed = self.room.grade(self.room.handed_in, "--hidden", hidden.parent, out="weighed")
        self.assertEqual(weighed.result("clipped")["exercises"][0]["score"], clipped["score"])
        self.assertEqual(weighed.result("right")["score"], marks.result("right")["score"] + 1.5)

    def test_reports_state_no_seed_of_hidden_tests(self):
        """The seed of the tests that students see is stated, also by their messages, and that of the others is not."""
        hidden = self.room.root / "hidden" / "01_leapfrog"
        hidden.mkdir(parents=True)
        (hidden / "secret_test.cpp").write_text("""
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
namespace spook::testing {
EXERCISE(Kick, "1.1 kick");
EXERCISE_TEST(Kick, HoldsForDrawnForces) {
  Random random;
  const Vec3 f = random.vector();
  expect_near("drawn", "Eq. (1.3)", kick(Vec3::Zero(), f, 1, 1).x(), f.x(), {1e-14, "2 roundings"});
}
}
""")
        self.room.hand_in("wrong", {"kick.cpp": WRONG.replace("* f", "* -f")})
        marks = self.room.grade(self.room.handed_in, "--hidden", hidden.parent, "--seed", "512345", "--hidden-seed", "987654")
        result = marks.result("wrong")
        self.assertEqual((result["seed"], result["hidden_seed"]), (512345, 987654))
        told = {test["visibility"]: test["message"] for test in result["exercises"][0]["tests"] if "seed" in test["message"]}
        self.assertIn("seed 987654", told["hidden"])
        self.assertIn("seed 512345", told["visible"])
        report = marks.report("wrong")
        self.assertIn("./course check 1.1 --seed 512345", report)
        self.assertNotIn("987654", report)
        self.assertIn("Seed 512345, seed of hidden tests 987654;", (marks.folder / "summary.md").read_text())

    def test_exercises_are_chosen_and_count_alike(self):
        """Others are neither tested nor missing, and hidden tests of theirs stop nothing; each chosen one has a point."""
        hidden = self.room.root / "hidden" / "01_leapfrog"
        hidden.mkdir(parents=True)
        (hidden / "others_test.cpp").write_text('#include "exercise_test.hpp"\nEXERCISE(LeapfrogStep, "1.4 leapfrog_step");\n'
                                                'EXERCISE_TEST(LeapfrogStep, NeverHolds) { ADD_FAILURE() << "never"; }\n')
        self.room.hand_in("both", {"kick.cpp": right("kick"), "half_step_start.cpp": right("half_step_start")})
        self.room.hand_in("one", {"kick.cpp": right("kick"), "drift.cpp": "nonsense"})
        marks = self.room.grade(self.room.handed_in, "--points", "equal", "--hidden", hidden.parent, chapters="1.1,1.3")
        for name, score in (("both", 2), ("one", 1)):
            result = marks.result(name)
            self.assertEqual([exercise["id"] for exercise in result["exercises"]], ["1.1", "1.3"])
            self.assertEqual((result["score"], result["max_score"], result["notes"]), (score, 2, []), name)
            self.assertNotIn("1.2", marks.report(name))
        header, *rows = (marks.folder / "grades.csv").read_text().splitlines()
        self.assertTrue(header.endswith(",look,1.1 kick,1.3 half_step_start"), header)
        self.assertEqual([row.rpartition(",,")[2] for row in rows], ["1,1", "1,0"])
        self.assertIn("1.3 half_step_start", marks.report("one"))

    def test_a_test_that_the_reference_fails_stops_the_grading(self):
        hidden = self.room.root / "hidden" / "01_leapfrog"
        hidden.mkdir(parents=True)
        (hidden / "wrong_test.cpp").write_text('#include "exercise_test.hpp"\nEXERCISE(Kick, "1.1 kick");\n'
                                               'EXERCISE_TEST(Kick, NeverHolds) { ADD_FAILURE() << "never"; }\n')
        self.room.hand_in("right", {"kick.cpp": right("kick")})
        run = self.room.run(self.room.handed_in, "--chapters", "1", "--hidden", hidden.parent)
        self.assertEqual(run.returncode, 1)
        self.assertIn("the reference itself does not pass Kick.NeverHolds (failed)", run.stderr)

    def test_bad_input_is_said_in_one_line(self):
        self.room.hand_in("right", {"kick.cpp": right("kick")})
        (self.room.root / "empty").mkdir()
        (self.room.root / "text.txt").write_text("text")
        table = self.room.root / "table.csv"
        header = "test,points,visibility,hint,title\n"
        for words, said in (
                (("nowhere",), "there is no nowhere"),
                (("empty",), "empty holds no submission"),
                (("text.txt",), "neither a folder nor a zip, tar.gz or 7z"),
                ((), "a submission, or a folder of them, is needed"),
                (("handed in", "--chapters", "5-2"), "'5-2' ends before it begins"),
                (("handed in", "--chapters", "1,1.9"), "there is no exercise '1.9'"),
                (("handed in", "--chapters", "77"), "there is no chapter 77"),
                (("handed in", "--jobs", "0"), "must be a whole number from 1 to 9999, but is '0'"),
                (("handed in", "--shard", "4/3"), "must be I/N with 1 <= I <= N, but is '4/3'"),
                (("handed in", "--seed", "-1"), "'-1'"),
                (("handed in", "--isolation", "hope"), "invalid choice: 'hope'"),
                (("handed in", "--hidden", "empty"), "no hidden tests in"),
                (("handed in", "--weights", "nowhere.csv"), "there is no table of weights"),
                (("--merge", "empty"), "empty holds no results"),
                (("handed in", "--chapters", "1", "--weights", header
                  + "Kcik.AddsForceOverMassTimesStep,1,visible,1.1/1,X\n"),
                 "is not a test; did you mean Kick.AddsForceOverMassTimesStep?"),
                (("handed in", "--roster", "text.txt"), "has no column of names"),
                (("handed in", "--roster", "nowhere.csv"), "cannot be read"),
                (("handed in", "--points", "luck"), "invalid choice: 'luck'"),
                (("handed in", "--chapters", "1", "--weights", header + "Kick.X,nan,visible,1.1/1,X\n"),
                 "table.csv:2: points must be a number from 0, but is 'nan'"),
                (("handed in", "--chapters", "1", "--weights", header + "Kick.X,1,always,1.1/1,X\n"), "'always'"),
                (("handed in", "--chapters", "1", "--weights", header + "Kick.X,1\n"), "must have 5 values"),
                (("handed in", "--chapters", "1", "--weights", "a,b\n"), "its first line must be"),
                (("handed in", "--chapters", "1", "--weights", header + "K.X,1,hidden,1.1/1,X\n" * 2),
                 "has a row already")):
            with self.subTest(words):
                if words and words[-1].startswith(("test,", "a,b")):
                    table.write_text(words[-1])
                    words = (*words[:-1], "table.csv")
                run = self.room.run(*words)
                self.assertEqual((run.returncode, run.stdout), (2, ""))
                self.assertIn(said, run.stderr)
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)


class NumbersOnARoster(unittest.TestCase):
    def setUp(self):
        self.room = Classroom()
        self.addCleanup(self.room.close)

    def roster(self, text: str) -> Roster:
        file = self.room.root / "roster.csv"
        file.write_text(text)
        return read_roster(file)

    def test_a_fraction_of_zeros_changes_no_number(self):
        """Pandas writes the numbers of a column with an empty cell as fractions."""
        results = [{"submission": f"Participant {number}", "student": "", "identifier": number} for number in ("1010", "101")]
        for cells in (("101.0", "1010.0"), ("101.00", "1010.00"), ('"101,0"', '"1010,0"'), ("101", "1010")):
            roster = self.roster("Name,ID\n{},{}\n{},{}\n".format("Ann Lee", cells[0], "Bob Ray", cells[1]))
            found, missing, strangers = roster.matched(results)
            self.assertEqual({name: row["Name"] for name, row in found.items()},
                             {"Participant 101": "Ann Lee", "Participant 1010": "Bob Ray"}, cells)
            self.assertEqual((missing, strangers), ([], []))
            self.assertEqual([roster.number_of(row) for row in roster.rows], ["101", "1010"])

    def test_groups_of_digits_are_one_number(self):
        results = [{"submission": "x", "student": "", "identifier": "12345000"}]
        for cell in ("12.345.000", "12-345-000", "s12345000"):
            self.assertEqual(list(self.roster(f"Name,ID\nAnn Lee,{cell}\nBob Ray,12345\n").matched(results)[0]), ["x"])

    def test_rounded_numbers_are_refused(self):
        for cell in ("1.01E+06", "1.01e+06", '"1,01E+06"', "1E+06"):
            with self.assertRaises(BadInput) as refused:
                self.roster(f"Name,ID\nAnn Lee,{cell}\nBob Ray,1010\n")
            written = cell.strip('"')
            self.assertIn(f"numbers that a program has rounded: {written} of Ann Lee; write", str(refused.exception))
        self.roster("Name,ID,Mark\nAnn Lee,12E3,1.01E+06\n")  # a number with a letter, and no number of a student


if __name__ == "__main__":
    unittest.main()
