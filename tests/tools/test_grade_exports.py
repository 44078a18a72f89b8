"""Results in the formats of other platforms, and the kits, run in an imitation of the platform's folders."""

import base64
import csv
import io
import json
import os
import shutil
import subprocess
import tarfile
import unittest
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

from classroom import SECONDS_A_TEST, Classroom, corpus, make_up, right, run_course
from sandbox import ROOT, Sandbox

from exporting.kit import replaced


def unpack(archive: Path, folder: Path) -> None:
    """Unpacks as unzip does, and keeps executable files executable."""
    with zipfile.ZipFile(archive) as content:
        for info in content.infolist():
            os.chmod(content.extract(info, folder), info.external_attr >> 16)


class FilesOfTheCourse(unittest.TestCase):
    """Which files kits have in them, by what git says of the folder."""

    def setUp(self):
        self.box = Sandbox()
        self.addCleanup(self.box.close)

    def names(self, what: str, folder: Path) -> list[str]:
        if what == "autolab":
            with tarfile.open(folder / "autograde.tar") as archive:
                return archive.getnames()
        with zipfile.ZipFile(folder) as archive:
            return archive.namelist()

    def write(self, name: str) -> None:
        (self.box.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.box.root / name).write_text("secret")

    def test_untracked_files_are_left_out_and_named(self):
        left = ("submissions/ann/kick.cpp", "marks/grades.csv", "exam/exam.md", "class.csv", "points.csv",
                "chapters/01_leapfrog/kick.cpp.orig")
        for name in left:
            self.write(name)
        for what in ("autolab", "gradescope"):
            out = self.box.root.parent / what
            done = self.box.course("export", what, "--out", str(out))
            self.assertEqual((done.returncode, done.stderr), (0, "3 untracked files were left out: class.csv, "
                                                              "exam/exam.md, points.csv (git add FILE takes one in)\n"))
            names = self.names(what, out)
            self.assertIn("course/README.md", names)
            self.assertEqual({f"course/{name}" for name in left} & set(names), set())

    def test_an_archive_in_a_repository_that_ignores_it(self):
        shutil.rmtree(self.box.root / ".git")
        outer = self.box.root.parent
        subprocess.run(["git", "init", "-q", str(outer)], check=True)
        (outer / ".gitignore").write_text("course/\n")
        for what in ("autolab", "gradescope"):
            done = self.box.course("export", what, "--out", str(outer / what))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("course/README.md", self.names(what, outer / what))
        subprocess.run(["git", "-C", str(outer), "add", "-f", "course/README.md"], check=True)  # it knows the folder now
        self.assertEqual(self.box.course("export", "autolab", "--out", str(outer / "kit")).returncode, 0)
        self.assertEqual(self.names("autolab", outer / "kit"), ["course/README.md"])

    def test_a_repository_without_files_and_one_without_git(self):
        shutil.rmtree(self.box.root / ".git")
        subprocess.run(["git", "init", "-q", str(self.box.root)], check=True)
        tools = self.box.root.parent / "bin"
        tools.mkdir()
        for name in ("sh", "uname", "dirname", "readlink", "id"):
            (tools / name).symlink_to(shutil.which(name))
        for env, told in (({}, "git tracks no file"), ({"PATH": str(tools)}, "git is missing")):
            done = self.box.course("export", "gradescope", "--out", "kit.zip", **env)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            self.assertIn(told, done.stderr)
            self.assertFalse((self.box.root / "kit.zip").exists())

    def test_a_name_that_is_not_utf_8(self):
        name = os.fsencode(self.box.root) + b"/caf\xe9.txt"
        with open(name, "w", encoding="utf-8") as out:
            out.write("x")
        done = self.box.course("export", "gradescope", "--out", "kit.zip")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("caf?.txt", done.stderr)
        subprocess.run([b"git", b"-C", os.fsencode(self.box.root), b"add", name], check=True)
        done = self.box.course("export", "gradescope", "--out", "other.zip")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("caf?.txt", done.stderr)
        self.assertEqual(self.box.course("export", "autolab", "--out", "kit").returncode, 0)


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = Classroom()
        cls.addClassCleanup(cls.room.close)
        answers = corpus()
        for name in ("right", "wrong", "forks", "floods"):
            cls.room.hand_in(name, {"kick.cpp": answers[name][0].read_bytes(), "drift.cpp": right("drift")})
        cls.room.hand_in("control \x07 and <b>&amp;", {"kick.cpp": right("kick").replace(
            "return", 'throw std::runtime_error("\\x1b[31m\\x01 ]]> </failure>"); return')})
        cls.marks = cls.room.grade()

    def export(self, *words) -> str:
        run = run_course("export", *words, cwd=self.room.root)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def file(self, name: str):
        return self.marks.folder / "submissions" / name / "results.json"

    def points(self, *functions: str) -> float:
        return sum(exercise["max_score"] for exercise in self.marks.result("right")["exercises"]
                   if exercise["function"] in functions)

    def test_junit(self):
        root = ET.fromstring(self.export("junit", self.marks.folder).encode())
        cases = root.findall(".//testcase")
        tests = sum(len(exercise["tests"]) for exercise in self.marks.result("right")["exercises"])
        self.assertEqual(len(cases), 5 * tests)
        self.assertEqual(int(root.get("tests")), len(cases))
        for kind, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            self.assertEqual(int(root.get(kind)), len(root.findall(f".//{tag}")), kind)
        wrong = [case for case in cases if case.get("classname") == "wrong.1.1 kick"]
        self.assertTrue(all("expected" in case.find("failure").text for case in wrong))

    def test_csv(self):
        rows = list(csv.DictReader(io.StringIO(self.export("csv", self.file("right"), self.file("forks")))))
        self.assertEqual({row["verdict"] for row in rows if row["function"] == "drift"}, {"passed"})
        self.assertEqual({row["reason"] for row in rows if (row["submission"], row["function"]) == ("forks", "kick")},
                         {"calls fork()"})

    def test_github(self):
        said = json.loads(base64.b64decode(self.export("github", self.file("wrong"))))
        self.assertEqual((said["version"], said["status"]), (1, "fail"))
        self.assertEqual(said["max_score"], sum(test["max_score"] for test in said["tests"]))
        self.assertEqual([test["status"] for test in said["tests"][:2]], ["fail", "pass"])
        self.assertIn("got       (7, 7, 7)", said["tests"][0]["message"])

    def test_autolab(self):
        last = self.export("autolab", self.file("right")).splitlines()[-1]
        self.assertEqual(json.loads(last)["scores"]["1.1 kick"], self.points("kick"))

    def test_gradescopes_form(self):
        said = json.loads(self.export("gradescope", self.file("floods")))
        self.assertEqual(said["score"], self.marks.result("floods")["score"])
        self.assertEqual(said["score"], sum(test["score"] for test in said["tests"]))
        for test in said["tests"]:
            self.assertIn(test["visibility"], ("visible", "hidden", "after_due_date", "after_published"))
            self.assertIn(test["status"], ("passed", "failed"))
            self.assertEqual(test["score"], test["max_score"] if test["status"] == "passed" else 0)
        self.assertTrue(said["tests"][0]["output"].startswith("too much output"))

    def test_what_makes_no_sense_is_said(self):
        for words, said in ((("junit",), "junit needs results"), (("github", self.marks.folder), "but these are 5"),
                            (("csv", self.room.root / "nowhere"), "cannot be read"), (("pdf",), "invalid choice"),
                            (("canvas", self.marks.folder), "needs --roster FILE"),
                            (("moodle", self.marks.folder, "--roster", self.room.root / "nowhere"), "cannot be read"),
                            (("csv", self.marks.folder, "--time-limit", "3"), f"graded with {SECONDS_A_TEST} s a test"),
                            (("csv", self.marks.folder, "--chapters", "1-2"), "2.1 quaternion_rate was not graded in these"),
                            (("gradescope", "--weights", self.room.root / "none.csv"), "no table of weights"),
                            (("gradescope", "--hidden", self.room.root / "nowhere"), "no hidden tests in"),
                            (("github", "--hidden", self.room.root), "cannot be kept from those")):
            run = run_course("export", *words, cwd=self.room.root)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertIn(said, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1)

    def test_github_kit_is_a_workflow(self):
        self.export("github", "--chapters", "1-3", "--out", "classroom.yml")
        text = (self.room.root / "classroom.yml").read_text()
        self.assertIn("grade submission --out results --chapters 1-3\n", text)
        self.assertIn("token: ${{ secrets.COURSE_TOKEN || github.token }}", text)
        self.assertNotIn("@", text.replace("actions/checkout@v4", "").replace("autograding-grading-reporter@v1", ""))
        self.assertEqual(text.count("\t"), 0)

    def test_kits_take_weights_hidden_tests_and_limits(self):
        room = self.room.root
        hidden = room / "hidden" / "01_leapfrog"
        hidden.mkdir(parents=True)
        (hidden / "one_test.cpp").write_text("// a test")
        table = room / "my_weights.csv"
        table.write_text("test,points,visibility,hint,title\nKick.LeavesAFixedBodyAlone,7,visible,1.1/1,Fixed\n")
        words = ("--chapters", "1", "--weights", table, "--hidden-seed", "5", "--time-limit", "3", "--points", "tests")
        self.export("gradescope", *words, "--hidden", hidden.parent, "--out", "kit.zip")
        with zipfile.ZipFile(room / "kit.zip") as archive:
            self.assertEqual(archive.read("weights.csv"), table.read_bytes())
            self.assertEqual(archive.read("hidden/01_leapfrog/one_test.cpp"), b"// a test")
            called = archive.read("run_autograder").decode()
        for option in ("--hidden-seed 5", "--time-limit 3", "--points tests", '--weights "$root/source/weights.csv"',
                       '--hidden "$root/source/hidden"'):
            self.assertIn(option, called)
        self.export("autolab", *words, "--hidden", hidden.parent, "--out", "kit")
        with tarfile.open(room / "kit" / "autograde.tar") as archive:
            self.assertEqual(archive.extractfile("weights.csv").read(), table.read_bytes())
        self.assertIn('--time-limit 3 --points tests --weights "weights.csv" --hidden "hidden" 1>&2',
                      (room / "kit" / "autograde-Makefile").read_text())
        self.export("github", *words, "--out", "weighed.yml")
        self.assertIn('--weights "course/tests/classroom_weights.csv"', (room / "weighed.yml").read_text())
        self.assertEqual((room / "classroom_weights.csv").read_bytes(), table.read_bytes())

    def test_results_are_weighed_again(self):
        """By another table and rule, and nothing is run again. A test without a row in that table has the default."""
        table = self.room.root / "table.csv"
        table.write_text("test,points,visibility,hint,title\n"
                         "Drift.BackwardsUndoesForwards,9,hidden,1.2/1,Secret words\n")
        rows = list(csv.DictReader(io.StringIO(self.export("csv", self.file("wrong"), "--weights", table))))
        self.assertEqual([row["score"] for row in rows if row["test"] == "Drift.BackwardsUndoesForwards"], ["9"])
        self.assertEqual([row["max_score"] for row in rows if row["test"] == "LeapfrogStep.ConservesMomentum"], ["1"])
        junit = self.export("junit", self.file("wrong"), "--weights", table)
        self.assertNotIn("BackwardsUndoesForwards\"", junit.partition("1.2 drift")[2].partition("1.3")[0])
        self.assertIn("hidden test 2", junit)
        by_test = json.loads(self.export("gradescope", self.file("wrong"), "--points", "tests"))
        self.assertEqual(by_test["score"], sum(test["score"] for test in by_test["tests"]))
        alike = json.loads(self.export("gradescope", self.file("wrong"), "--points", "equal"))
        self.assertEqual(alike["score"], 1)
        self.assertAlmostEqual(sum(test["max_score"] for test in alike["tests"]), 5)
        fewer = json.loads(self.export("gradescope", self.file("wrong"), "--chapters", "1.1,1.3-1.5"))
        self.assertEqual((fewer["score"], {test["number"] for test in fewer["tests"]}), (0, {"1.1", "1.3", "1.4", "1.5"}))

    def test_canvas_and_moodle(self):
        canvas = self.room.root / "canvas.csv"
        canvas.write_text('Student,ID,SIS User ID,SIS Login ID,Section,Old (1)\n"    Points Possible",,,,,10\n'
                          '"Right, Ray",1,,right,A,5\n"Wrong, Wu",2,,wrong,A,\n"Nobody, Ned",3,,ned,A,\n')
        run = run_course("export", "canvas", self.marks.folder, "--roster", canvas, "--assignment", "Chapter 1 (77)",
                         cwd=self.room.root)
        rows = list(csv.reader(io.StringIO(run.stdout)))
        self.assertEqual(rows[0], ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Chapter 1 (77)"])
        most = f"{self.marks.result('right')['max_score']:g}"
        both, one = (f"{self.points(*functions):g}" for functions in (("kick", "drift"), ("drift",)))
        self.assertEqual([row[-1] for row in rows[1:]], [most, both, one, "0"])
        self.assertIn("forks", run.stderr)
        moodle = self.room.root / "moodle.csv"
        moodle.write_text('Identifier,"Full name",Grade,"Maximum Grade","Feedback comments"\n'
                          'Participant 1,right,,100.00,\n'
                          'Participant 2,Ned,,100.00,\n', encoding="utf-8-sig")
        rows = list(csv.DictReader(io.StringIO(self.export("moodle", self.marks.folder, "--roster", moodle))))
        self.assertEqual([row["Grade"] for row in rows], [f"{100 * float(both) / float(most):.2f}", ""])

    def test_autolab_kit(self):
        """The recipe up to the grading, which the other tests do."""
        self.export("autolab", "--chapters", "1", "--out", "autolab")
        folder = self.room.root / "autolab"
        recipe = [line.removeprefix("\t@") for line in (folder / "autograde-Makefile").read_text().splitlines()
                  if line.startswith("\t@")]
        self.assertIn("./course/course grade handin.zip --out graded --chapters 1 1>&2", recipe)
        subprocess.run(["sh", "-ec", recipe[0] + "; " + recipe[1]], cwd=folder, check=True)
        self.assertTrue(os.access(folder / "course" / "course", os.X_OK))
        self.assertEqual((folder / "course" / "README.md").read_bytes(), (ROOT / "README.md").read_bytes())

    def test_gradescope_from_zip_to_results(self):
        """setup.sh once, run_autograder for each submission, in folders that are laid out as Gradescope's."""
        self.export("gradescope", "--chapters", "1", "--seed", "4", "--out", "autograder.zip")
        root = self.room.root / "autograder"
        source = root / "source"
        unpack(self.room.root / "autograder.zip", source)
        for folder in ("results", "submission"):
            (root / folder).mkdir()
        (root / "submission_metadata.json").write_text("{}")
        env = {name: value for name, value in os.environ.items() if not name.startswith(("COURSE_", "SPOOK_"))}
        env["AUTOGRADER_ROOT"] = str(root)
        shutil.copyfile(source / "run_autograder", root / "run_autograder")
        os.chmod(root / "run_autograder", 0o755)
        setup = subprocess.run(["bash", str(source / "setup.sh")], capture_output=True, text=True, env=env)
        self.assertEqual(setup.returncode, 0, setup.stdout + setup.stderr)
        self.assertIn("Ready to grade 5 exercises", setup.stdout)
        for files, score in (({"kick.cpp": right("kick"), "drift.cpp": right("drift")}, self.points("kick", "drift")),
                             ({"chapters/01_leapfrog/kick.cpp": right("kick")}, self.points("kick")),
                             ({"repository/chapters/01_leapfrog/drift.cpp": right("drift")}, self.points("drift")),
                             ({"nothing.txt": ""}, 0)):
            shutil.rmtree(root / "submission")
            for name, text in files.items():
                (root / "submission" / name).parent.mkdir(parents=True, exist_ok=True)
                (root / "submission" / name).write_text(text)
            run = subprocess.run([str(root / "run_autograder")], capture_output=True, text=True, env=env)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            said = json.loads((root / "results" / "results.json").read_text())
            self.assertEqual(said["score"], score, files)
            self.assertEqual(said["extra_data"]["seed"], 4)


class Refused(unittest.TestCase):
    """Exports that would be wrong, of results that were not graded, but written as the grader does."""

    HEADER = "test,points,visibility,hint,title\n"

    def setUp(self):
        self.room = Classroom()
        self.addCleanup(self.room.close)
        self.root = self.room.root
        self.marks = self.root / "marks"
        make_up(self.marks, "ann", 2)

    def export(self, *words) -> subprocess.CompletedProcess:
        return run_course("export", *words, cwd=self.root)

    def assert_refused(self, words: tuple, said: str) -> None:
        run = self.export(*words)
        self.assertEqual((run.returncode, run.stdout), (2, ""), words)
        self.assertIn(said, run.stderr)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)

    def table(self, rows: str) -> Path:
        (self.root / "table.csv").write_text(self.HEADER + rows)
        return self.root / "table.csv"

    def hidden(self) -> Path:
        folder = self.root / "hidden" / "01_leapfrog"
        folder.mkdir(parents=True)
        (folder / "secret_test.cpp").write_text('EXERCISE(Kick, "1.1 kick");\n  EXERCISE_TEST(Kick, HoldsForSevens) {}\n')
        return folder.parent

    def test_results_of_several_gradings(self):
        other, again = self.root / "marks of more", self.root / "marks again"
        make_up(other, "bob", 2, numbers=("1.1", "1.2"))
        make_up(again, "ann", 0)
        (self.root / "roster.csv").write_text("Student,ID\nann,1\nbob,2\n")
        (self.root / "sheet.csv").write_text("Identifier,Full name,Grade,Maximum Grade\nParticipant 1,ann,,10\n")
        for what in (("canvas", "--roster", "roster.csv"), ("moodle", "--roster", "sheet.csv"), ("csv",), ("junit",)):
            self.assert_refused((what[0], other, self.marks, *what[1:]),
                                "export: ann was graded with another max_score (2.0) than bob (4.0)")
            self.assert_refused((what[0], self.marks, again, *what[1:]), "export: ann was graded twice, with different results")
            run = self.export(what[0], other, self.marks, *what[1:], "--chapters", "1.1")  # which both were graded in
            self.assertEqual(run.returncode, 0, run.stderr)
        rows = list(csv.reader(io.StringIO(self.export("csv", self.marks, self.marks).stdout)))
        self.assertEqual(len(rows), 3)
        make_up(other, "bob", 2, seed=2)
        self.assert_refused(("csv", self.marks, other), "bob was graded with another seed (2) than ann (1)")

    def test_weights_of_tests_that_do_not_exist(self):
        right_name, hidden = "Kick.AddsForceOverMassTimesStep", self.hidden()
        wrong = self.table("Kcik.AddsForceOverMassTimesStep,1,visible,1.1/1,X\n")
        said = f"has a row for Kcik.AddsForceOverMassTimesStep, which is not a test; did you mean {right_name}?"
        for words in (("csv", self.marks), ("gradescope", self.marks), ("gradescope",), ("github",), ("autolab",),
                      ("gradescope", "--chapters", "1"), ("gradescope", "--hidden", hidden)):
            self.assert_refused((*words, "--weights", wrong), said)
        hidden_row = self.table("Kick.HoldsForSevens,5,hidden,1.1/1,X\n")
        self.assert_refused(("gradescope", "--weights", hidden_row), "has a row for Kick.HoldsForSevens, which is not a test")
        for words in (("gradescope", "--hidden", hidden), ("gradescope", "--chapters", "2")):
            run = self.export(*words, "--weights", hidden_row, "--out", "kit.zip")
            self.assertEqual(run.returncode, 0, run.stderr)
        (hidden / "weights.csv").write_text(self.HEADER + "Kick.HoldsForEights,5,hidden,1.1/1,X\n")
        self.assert_refused(("autolab", "--hidden", hidden), "Kick.HoldsForEights, which is not a test; did you mean Kick.Hold")

    def test_options_that_a_format_does_not_use(self):
        hidden = self.hidden()
        for words, said in (((("gradescope", "--roster", "x.csv")), "gradescope does not use --roster, but it is 'x.csv'"),
                            (("students", "--out", "x", "--seed", "3"), "students does not use --seed, but it is '3'"),
                            (("weights", "--hidden", "x"), "weights does not use --hidden, but it is 'x'"),
                            (("weights", self.marks), "weights takes no results"),
                            (("students", self.marks, "--out", "x"), "students takes no results"),
                            (("csv", self.marks, "--seed", "3"), "csv does not use --seed, but it is '3'"),
                            (("csv", self.marks, "--roster", "x.csv"), "csv does not use --roster"),
                            (("junit", self.marks, "--hidden-seed", "3"), "junit does not use --hidden-seed"),
                            (("moodle", self.marks, "--assignment", "HW"), "moodle does not use --assignment, but it is 'HW'"),
                            (("github", self.marks, "--seed", "3"), "github of results does not use --seed"),
                            (("csv", self.marks, "--hidden", hidden), "has no weights.csv")):
            self.assert_refused(words, said)

    def test_a_refused_kit_leaves_the_good_one(self):
        empty = self.root / "empty"
        empty.mkdir()
        kits = (("gradescope", "kit.zip", ("kit.zip",)), ("github", "kit.yml", ("kit.yml", "classroom_weights.csv")),
                ("autolab", "kit", ("kit/autograde-Makefile", "kit/autograde.tar")))
        good = self.table("Kick.LeavesAFixedBodyAlone,7,visible,1.1/1,Fixed\n")
        for what, out, _ in kits:
            run = self.export(what, "--out", out, "--weights", good)
            self.assertEqual(run.returncode, 0, run.stderr)
        content = {file: (self.root / file).read_bytes() for _, _, files in kits for file in files}
        names = sorted(path.name for path in self.root.rglob("*"))
        for what, out, files in kits:
            for table, said in (("Kick.X,1,visible,1.1/1,X\n", "Kick.X, which is not a test"), ("Kick.X,-1\n", "5 values")):
                self.assert_refused((what, "--out", out, "--seed", "3", "--weights", self.table(table)), said)
            if what != "github":
                self.assert_refused((what, "--out", out, "--hidden", empty), "no hidden tests in")
            for file in files:
                self.assertEqual((self.root / file).read_bytes(), content[file], file)
        with self.assertRaises(OSError), replaced(self.root / "kit.zip") as (beside,):
            beside.write_text("half")
            raise OSError("the disk is full")
        self.assertEqual((self.root / "kit.zip").read_bytes(), content["kit.zip"])
        self.assertEqual(sorted(path.name for path in self.root.rglob("*")), names)


if __name__ == "__main__":
    unittest.main()
