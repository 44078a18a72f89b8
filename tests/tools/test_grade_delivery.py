"""Deliveries of platforms in all forms: their students, the files taken, and that nobody is lost."""

import bz2
import contextlib
import csv
import io
import os
import shutil
import socket
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
import unittest.mock
import zipfile
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import SimpleNamespace

import sandbox  # noqa: F401

from arguments import parse
from errors import BadInput, CourseError
from exporting.grades import for_canvas, for_moodle, not_on_it
from grading import reading
from grading.archives import LARGEST, names_in
from grading.choices import ON_TIME
from grading.delivery import find_submissions
from grading.feedback import FEEDBACK, write_feedback
from grading.merge import merge, missing_shards, set_aside, write_delivery
from grading.grade import _for_a_shard, grade
from grading.gradebook import Class, _write_grades, cell, not_graded, uncertain
from grading.names import Student, attempt_of, safe, student_of, time_of, unseen_shown
from grading.results import SCHEMA, folder_of, write_json
from grading.roster import read_roster
from grading.submission import Handed, Place, read_submission
from grading.text import clean
from manifest import all_exercises

KICK, WHERE = b"Vec3 kick;", "chapters/01_leapfrog/kick.cpp"
STUB = b'Vec3 kick() { not_implemented("1.1 kick"); }'


def zipped(files: dict[str, bytes]) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return content.getvalue()


def tarred(files: dict[str, bytes], how: str) -> bytes:
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode=f"w:{how}") as archive:
        for name, text in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(text)
            archive.addfile(info, io.BytesIO(text))
    return content.getvalue()


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="delivery-")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()

    def put(self, files: dict[str, bytes], under: str = "in") -> Path:
        for name, content in files.items():
            (self.root / under / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / under / name).write_bytes(content)
        return self.root / under


class Finds(InFolder):
    def found(self, path: Path):
        """Returns each submission by its name, and the files left out."""
        delivery = find_submissions([path], self.root / "out")
        exercises = all_exercises()
        return ({one.name: read_submission(one, exercises) for one in delivery.handed},
                {what.rpartition("/")[2] for what, _ in delivery.left_out})

    def assert_kicks(self, submissions: dict, *names: str) -> None:
        for name in names:
            with self.subTest(name):
                self.assertEqual(submissions[name].sources["kick"].content, KICK)


class Delivered(Finds):
    MOODLE = {"Åsa Öberg_101_assignsubmission_file_/work.zip": zipped({WHERE: KICK}),
              "Bo Ek_102_assignsubmission_file_/kick.cpp": KICK,
              "Cy_103_assignsubmission_file_/all.zip": zipped({"inner.zip": zipped({f"my/{WHERE}": KICK})}),
              "Di_104_assignsubmission_file_/w.tar.gz": tarred({"w/Chapters/01_Leapfrog/KICK.CPP": KICK}, "gz"),
              "Ed_105_assignsubmission_file_/essay.docx": b"x", "Flo_106_assignsubmission_onlinetext_/text.html": b"x",
              "Gus_107_assignsubmission_file_/cut.zip": b"PK nothing"}

    def test_moodle(self):
        folder = self.put(self.MOODLE | {"kick.cpp": KICK, "grades.xlsx": b"x", "__MACOSX/._kick.cpp": b"x"})
        whole = self.root / "download.zip"
        whole.write_bytes(zipped(self.MOODLE))
        for path, left_out in ((folder, {"kick.cpp", "grades.xlsx"}), (whole, set())):
            submissions, left = self.found(path)
            self.assertEqual(set(submissions), {"Åsa Öberg", "Bo Ek", "Cy", "Di", "Ed", "Flo", "Gus"})
            self.assert_kicks(submissions, "Åsa Öberg", "Bo Ek", "Cy", "Di")
            self.assertEqual(submissions["Bo Ek"].student.identifier, "102")
            self.assertEqual(left, left_out)
            self.assertIn("essay.docx", submissions["Ed"].notes[0])
            self.assertIn("cannot be read", submissions["Gus"].notes[0])
            self.assertIn("taken for kick", submissions["Di"].notes[0])

    def test_a_name_that_is_too_long_once_its_bytes_are_replaced(self):
        folder = self.put({f"bo/{WHERE}": KICK})
        with open(os.path.join(os.fsencode(folder), b"bo", b"\xff" * 251 + b".cpp"), "wb") as file:
            file.write(b"x")
        submissions, _ = self.found(folder / "bo")
        self.assert_kicks(submissions, "bo")

    def test_canvas(self):
        submissions, left = self.found(self.put({
            "leeann_12_55_kick.cpp": KICK, "leeann_12_56_drift-2.cpp": b"d",
            "ekbo_LATE_13_57_work.zip": zipped({WHERE: KICK}),
            "ohcy_late_14_58_kick-1.cpp": KICK, "notes.pdf": b"x"}))
        self.assertEqual(set(submissions), {"leeann", "ekbo", "ohcy"})
        self.assert_kicks(submissions, "leeann", "ekbo", "ohcy")
        self.assertEqual(set(submissions["leeann"].sources), {"kick", "drift"})
        self.assertEqual([submissions[name].student.late for name in ("leeann", "ekbo", "ohcy")], [False, True, True])
        self.assertEqual(left, {"notes.pdf"})

    def test_moodle_with_a_text_online_is_one_submission(self):
        submissions, _ = self.found(self.put(self.MOODLE | {"Bo Ek_102_assignsubmission_onlinetext_/text.html": b"x"}))
        self.assertEqual(set(submissions), {"Åsa Öberg", "Bo Ek", "Cy", "Di", "Ed", "Flo", "Gus"})
        self.assert_kicks(submissions, "Bo Ek")

    def test_blackboard(self):
        """Each attempt has a text about it, and files; the last one counts."""
        files = {"2026-11-20-10-11-12": b"old", "2026-11-21-09-00-00": KICK, "2026-09-30-10-11-12": b"older"}
        delivered = {f"Home_work 1_{login}_attempt_{time}{end}": content
                     for login in ("leeann", "bo") for time, content in files.items() for end in (".txt", "_kick.cpp")}
        whole = self.root / "gradebook.zip"
        whole.write_bytes(zipped(delivered))
        for path in (self.put(delivered), whole):
            submissions, left = self.found(path)
            self.assertEqual((set(submissions), left), ({"leeann", "bo"}, set()))
            self.assert_kicks(submissions, "leeann", "bo")

    def test_logins_on_blackboard_may_have_what_stands_before_them(self):
        names = [f"Home_work 1_{login}_attempt_2026-11-20-10-11-12_kick.cpp" for login in ("ann_lee", "bob_lee", "cy")]
        whole = self.root / "gradebook.zip"
        whole.write_bytes(zipped(dict.fromkeys(names, KICK)))
        for path in (self.put(dict.fromkeys(names, KICK)), whole):
            submissions, _ = self.found(path)
            self.assertEqual(set(submissions), {"ann_lee", "bob_lee", "cy"})
            self.assert_kicks(submissions, *submissions)

    def test_nobody_takes_anothers_place_on_moodle_by_a_name(self):
        """Students may choose their own names, and those of their files."""
        folders = {f"Bo Ek_102_assignsubmission_file_/{WHERE}": KICK,
                   "Bo Ek_102_assignsubmission_file_x_105_assignsubmission_file_/kick.cpp": b"hers"}
        files = {"Bo Ek_102_assignsubmission_file_kick.cpp": KICK,
                 "Bo Ek_102_assignsubmission_file_a_105_assignsubmission_file_kick.cpp": b"hers",
                 "Cy_103_assignsubmission_file_Cy_103_assignsubmission_file_kick.cpp": KICK}
        for kind, delivered in (("folders", folders), ("files", files)):
            whole = self.root / f"{kind}.zip"
            whole.write_bytes(zipped(delivered))
            for path in (self.put(delivered, kind), whole):
                submissions, _ = self.found(path)
                self.assertEqual(len(submissions), len(delivered))
                by_number = {one.student.identifier: one for one in submissions.values()}
                self.assertEqual(by_number["102"].sources["kick"].content, KICK)
                self.assertEqual("103" in by_number, kind == "files")

    def test_brightspace(self):
        submissions, left = self.found(self.put({
            "12-9 - Ann Lee - Nov 2, 2026 1011 AM/kick.cpp": b"old",
            "12-9 - Ann Lee - Nov 2, 2026 101 PM/kick.cpp": KICK,
            "12-9 - Ann Lee - Oct 30, 2026 1159 PM/kick.cpp": b"older", "index.html": b"x",
            "13-9 - Bo - Ek - Nov 2, 2026 1011 AM/work.zip": zipped({WHERE: KICK})}))
        self.assertEqual((set(submissions), left), ({"Ann Lee", "Bo - Ek"}, {"index.html"}))
        self.assert_kicks(submissions, "Ann Lee", "Bo - Ek")
        self.assertEqual(submissions["Ann Lee"].student.identifier, "12")

    def test_brightspace_in_another_language(self):
        submissions, _ = self.found(self.put({"12-9 - Ann Lee - 20 nov. 2026 1011/kick.cpp": KICK,
                                              "13-9 - Bo - 3 - 20 nov. 2026 911/kick.cpp": KICK}))
        self.assertEqual({name: one.student.identifier for name, one in submissions.items()},
                         {"Ann Lee": "12", "Bo - 3": "13"})
        self.assertEqual(attempt_of("12-9 - Ann Lee - 20 nov. 2026 1011"), "2026-11-20T10:11:00")
        self.assertEqual(attempt_of("12-9 - Ann Lee - 20 listopada 2026 1011"), "")

    def test_a_class_that_was_packed_again_has_a_folder_above(self):
        kicks = {f"s{k:02d}.zip": zipped({WHERE: KICK}) for k in range(25)}
        for files, names in ((self.MOODLE, {"Åsa Öberg", "Bo Ek", "Cy", "Di", "Ed", "Flo", "Gus"}),
                             (kicks, {name[:3] for name in kicks})):
            packed = self.put({"class.zip": zipped({f"HW 1/{name}": content for name, content in files.items()}
                                                   | {"__MACOSX/._HW 1": b""})}, f"{len(files)}") / "class.zip"
            for path in (packed, packed.parent):
                submissions, left = self.found(path)
                self.assertEqual((set(submissions), left), (names, set()))
                self.assert_kicks(submissions, *names - {"Ed", "Flo", "Gus"})
        for files in ({f"ann/{WHERE}": KICK, "ann/my/old/kick.cpp": b"old"}, {"ann/kick.cpp": KICK, "ann/drift.cpp": b"d"},
                      {"ann/v1/kick.cpp": KICK, "ann/v2/kick.cpp": KICK}):
            submissions, _ = self.found(self.put({"one.zip": zipped(files)}, "one") / "one.zip")
            self.assert_kicks(submissions, "one")
            self.assertEqual(len(submissions), 1)

    def test_the_last_attempt_on_canvas_counts(self):
        submissions, _ = self.found(self.put({
            "leeann_12_55_kick.cpp": b"old", "leeann_12_56_kick-1.cpp": b"older", "leeann_LATE_12_57_kick-10.cpp": KICK,
            "leeann_12_58_kick-9.cpp": b"x"}))
        self.assert_kicks(submissions, "leeann")
        self.assertTrue(submissions["leeann"].student.late)
        self.assertEqual(submissions["leeann"].notes[0], "late: the name that the platform gave says so, or its time")

    def test_another_attempt_counts_on_demand(self):
        folder = self.put({"leeann_12_55_kick.cpp": b"first", "leeann_12_56_kick-1.cpp": b"second",
                           "leeann_12_57_kick-2.cpp": b"third", "ekbo_13_58_kick.cpp": KICK})
        handed = {one.name: one for one in find_submissions([folder], self.root / "out").handed}
        for attempt, content in (("last", b"third"), ("first", b"first")):
            read = read_submission(handed["leeann"], all_exercises(), attempt)
            self.assertEqual((read.sources["kick"].content, read.attempts), (content, {}))
        read = read_submission(handed["leeann"], all_exercises(), "best")
        self.assertEqual([source.content for source in read.attempts["kick"]], [b"third", b"second", b"first"])
        read = read_submission(handed["ekbo"], all_exercises(), "best")
        self.assertEqual((read.sources["kick"].content, read.attempts), (KICK, {}))

    def test_the_file_of_an_attempt_is_named_with_it(self):
        """In Brightspace's folders it has the same name in each."""
        attempts = [f"12-9 - Ann Lee - Nov {day}, 2026 1011 AM" for day in (2, 3)]
        handed, = find_submissions([self.put({f"{name}/kick.cpp": KICK for name in attempts})], self.root / "out").handed
        for attempt, taken, other in (("last", 1, 0), ("first", 0, 1)):
            self.assertEqual(read_submission(handed, all_exercises(), attempt).notes,
                             [f"taken for kick: {attempts[taken]}/kick.cpp; there is also {attempts[other]}/kick.cpp"])
        read = read_submission(handed, all_exercises(), "best")
        self.assertEqual([source.path for source in read.attempts["kick"]],
                         [f"{attempts[1]}/kick.cpp", f"{attempts[0]}/kick.cpp"])

    def versions(self, names: tuple[str, ...]) -> dict[str, str | list[str]]:
        """Returns the version that is taken, where the last or the first counts, and those where the best does."""
        folder = self.put({f"ann/{name}": KICK for name in names})
        one, found = Handed("ann", (Place(folder / "ann"),), Student("ann")), {}
        for attempt in ("last", "first"):
            read = read_submission(one, all_exercises(), attempt)
            found[attempt] = read.sources["kick"].path
            self.assertTrue(read.notes[0].startswith(f"taken for kick: {found[attempt]}, a guess; there is also "))
        found["best"] = [source.path for source in read_submission(one, all_exercises(), "best").attempts["kick"]]
        shutil.rmtree(folder)
        return found

    def test_the_last_version_counts_as_the_last_attempt_does(self):
        """Versions are numbered, v10 after v9. What lies less deep, or where it belongs, is no version."""
        for form in ("v{}/kick.cpp", "{}/v/kick.cpp", "kick ({}).cpp", "kick_v{}.cpp", f"version {{}}/{WHERE}"):
            names = tuple(form.format(k) for k in (1, 2, 9, 10))
            self.assertEqual(self.versions(names), {"last": names[3], "first": names[0], "best": list(names[::-1])})
        for files in ({WHERE: b"mine", "v1/kick.cpp": KICK, "v2/kick.cpp": KICK}, {"v1/kick.cpp": b"mine", "v2/kick.cpp": STUB},
                      {"v/kick.cpp": b"mine", "v/w/kick.cpp": KICK}):
            folder = self.put(files, "one")
            read = read_submission(Handed("one", (Place(folder),), Student("one")), all_exercises())
            self.assertEqual(read.sources["kick"].content, b"mine")
            shutil.rmtree(folder)

    def test_the_newest_version_in_an_archive_counts(self):
        """By the times that archives have, unless the names are numbered."""
        for names, last in ((("new/kick.cpp", "old/kick.cpp"), 0), (("draft/kick.cpp", "final/kick.cpp"), 1),
                            (("v2/kick.cpp", "v10/kick.cpp"), 1), (("v10/kick.cpp", "v2/kick.cpp"), 0)):
            newest = last if not names[0].startswith("v") else 1 - last
            times = [(2026, 11, 20 + (k == newest), 10, 11, 12) for k in (0, 1)]
            packed, taped = io.BytesIO(), io.BytesIO()
            with zipfile.ZipFile(packed, "w") as archive:
                for name, time_of_it in zip(names, times):
                    archive.writestr(zipfile.ZipInfo(name, time_of_it), KICK)
            with tarfile.open(fileobj=taped, mode="w:gz") as archive:
                for name, time_of_it in zip(names, times):
                    info = tarfile.TarInfo(name)
                    info.size, info.mtime = len(KICK), datetime(*time_of_it).timestamp()
                    archive.addfile(info, io.BytesIO(KICK))
            for ending, content in ((".zip", packed.getvalue()), (".tar.gz", taped.getvalue()),
                                    (".zip", zipped({"work.zip": packed.getvalue()}))):
                (self.root / f"ann{ending}").write_bytes(content)
                one = Handed("ann", (Place(self.root / f"ann{ending}"),), Student("ann"))
                self.assertEqual(read_submission(one, all_exercises()).sources["kick"].path.removeprefix("work.zip/"),
                                 names[last])

    def test_a_time_that_is_none_stops_nobody(self):
        info = tarfile.TarInfo("kick.cpp")
        info.size, info.mtime, content = len(KICK), 1e30, io.BytesIO()
        with tarfile.open(fileobj=content, mode="w", format=tarfile.PAX_FORMAT) as archive:
            archive.addfile(info, io.BytesIO(KICK))
        self.assert_kicks(self.found(self.put({"ann.tar": content.getvalue()}) / "ann.tar")[0], "ann")

    def test_the_last_attempt_on_time_counts(self):
        """The time is in Blackboard's and Brightspace's names, and Canvas writes that an attempt is late."""
        noon = datetime(2026, 11, 20, 12)
        blackboard = "HW_{}_attempt_2026-11-{}-00_kick.cpp"
        for named, due in (({"ann": (blackboard.format("ann", "20-09-00"), blackboard.format("ann", "20-11-59"),
                                     blackboard.format("ann", "20-12-01")),
                             "bo": (blackboard.format("bo", "20-12-00"),),
                             "cy": (blackboard.format("cy", "20-12-01"), blackboard.format("cy", "21-09-00"))}, noon),
                           ({"ann": ("12-9 - ann - Nov 20, 2026 901 AM/kick.cpp", "12-9 - ann - Nov 20, 2026 1159 AM/kick.cpp",
                                     "12-9 - ann - Nov 20, 2026 1201 PM/kick.cpp"),
                             "bo": ("13-9 - bo - Nov 20, 2026 1200 PM/kick.cpp",),
                             "cy": ("14-9 - cy - Nov 20, 2026 1201 PM/kick.cpp", "14-9 - cy - Nov 21, 2026 901 AM/kick.cpp")},
                            noon),
                           ({"ann": ("ann_12_55_kick.cpp", "ann_12_56_kick-1.cpp", "ann_LATE_12_57_kick-2.cpp"),
                             "bo": ("bo_13_58_kick.cpp",),
                             "cy": ("cy_LATE_14_59_kick.cpp", "cy_LATE_14_60_kick-1.cpp")}, None)):
            folder = self.put({name: str(k).encode() for names in named.values() for k, name in enumerate(names)},
                              named["ann"][0][:4])
            delivery = find_submissions([folder], self.root / "out")
            delivery.drop_late(due)
            read = {one.name: read_submission(one, all_exercises(), ON_TIME) for one in delivery.handed}
            self.assertEqual({name: (one.sources["kick"].content, one.student.late) for name, one in read.items()},
                             {"ann": (b"1", False), "bo": (b"0", False), "cy": (b"1", True)})
            late = named["ann"][2].split("/")[0]
            self.assertEqual([note for note in read["ann"].notes if "late" in note], [f"late, so not counted: {late}"])
            self.assertEqual(read["bo"].notes, [])
            self.assertIn("late: the name that the platform gave says so, or its time", read["cy"].notes)

    def test_brightspaces_time_in_every_form(self):
        for text, expected in (("Nov 20, 2026 1011 AM", (11, 20, 10, 11)), ("November 20, 2026 1211 AM", (11, 20, 0, 11)),
                               ("30 November, 2026 1011", (11, 30, 10, 11)), ("1 December, 2026 0900", (12, 1, 9, 0)),
                               ("1 December, 2026 900", (12, 1, 9, 0)), ("21. Nov. 2026 1011", (11, 21, 10, 11)),
                               ("20 Nov 2026 1011 p.m.", (11, 20, 22, 11)), ("3 M\u00e4rz 2026 2359", (3, 3, 23, 59)),
                               ("20 de noviembre de 2026 0005", (11, 20, 0, 5)), ("4 d\u00e9c. 2026 1630", (12, 4, 16, 30)),
                               ("1 juin 2026 0800", (6, 1, 8, 0)), ("1 juillet 2026 0800", (7, 1, 8, 0)),
                               ("2 marraskuuta 2026 0800", (11, 2, 8, 0)), ("mar 24 nov 2026 1011", None),
                               ("20 listopada 2026 1011", None), ("31 November, 2026 1011", None),
                               ("20 Nov 2026 2511", None), ("20 Nov 2026 1311 PM", None), ("20 Nov 2026 1011 Uhr", None)):
            time_read = time_of(f"123-1 - Ann Lee - {text}")
            self.assertEqual(time_read, datetime(2026, *expected) if expected else None, text)

    def test_a_day_before_its_month_makes_late(self):
        names = [f"123-{k} - Ann Lee - {text}" for k, text in enumerate(("30 November, 2026 1011", "1 December, 2026 0900"))]
        folder = self.put({f"{name}/kick.cpp": str(k).encode() for k, name in enumerate(names)})
        for due, taken, late in ((datetime(2026, 11, 20), b"1", True), (datetime(2026, 11, 30, 12), b"0", False),
                                 (datetime(2026, 12, 1, 9), b"1", False)):
            delivery = find_submissions([folder], self.root / "out")
            delivery.drop_late(due)
            read, = (read_submission(one, all_exercises(), ON_TIME) for one in delivery.handed)
            self.assertEqual((read.sources["kick"].content, read.student.late), (taken, late), due)

    def test_who_has_no_time_is_named(self):
        due = datetime(2026, 11, 20)
        for names, with_due, without in (
                (("1-9 - Ann Lee - 20 listopada 2026 1011", "2-9 - Bo Ek - Nov 20, 2026 1011 AM",
                  "2-9 - Bo Ek - Ob 20, 2026 1011 AM", "3-9 - Cy Oh - 20 Nov 2026 1011"),) + (["Ann Lee", "Bo Ek"],) * 2,
                (("ann", "bo"), ["ann", "bo"], []),
                (("Ann_1_assignsubmission_file_", "Bo_2_assignsubmission_file_"), ["Ann", "Bo"], []),
                (("HW_ann_attempt_2026-11-20-09-00-00_kick.cpp", "HW_bo_attempt_2026-11-20-09-00-00_kick.cpp"), [], []),
                (("leeann_12_55_kick.cpp", "ekbo_LATE_13_57_kick.cpp"), [], [])):
            folder = self.put({name if name.endswith(".cpp") else f"{name}/kick.cpp": KICK for name in names}, names[0][:5])
            delivery = find_submissions([folder], self.root / "out")
            self.assertEqual((delivery.without_time(due), delivery.without_time(None)), (with_due, without), names)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), unittest.mock.patch("grading.grade.Grader", side_effect=BadInput("stop")):
            with self.assertRaisesRegex(BadInput, "stop"):
                grade(parse(["grade", str(self.root / "ann"), "--yes", "--attempt", ON_TIME, "--due", "2026-11-20T23:59"]))
        self.assertEqual(" ".join(said.getvalue().split()),
                         "The time of these submissions cannot be read, so they count as on time: ann, bo.")

    def test_a_shard_is_told_when_it_is_due(self):
        words = ["grade", "in", "--attempt", ON_TIME, "--due", "2026-11-20T23:59"]
        arguments = parse(words)
        self.assertEqual(arguments.due, datetime(2026, 11, 20, 23, 59))
        again = parse(["grade", "in", *_for_a_shard(arguments)])
        self.assertEqual((again.attempt, again.due), (arguments.attempt, arguments.due))

    def test_due_has_a_meaning_with_attempts_on_time_alone(self):
        with self.assertRaisesRegex(BadInput, "--due is for --attempt on-time, but the attempt is best"):
            grade(parse(["grade", "in", "--attempt", "best", "--due", "2026-11-20T23:59"]))
        with self.assertRaisesRegex(BadInput, "2026-11-20T23:59, but is '20 Nov'"):
            parse(["grade", "in", "--due", "20 Nov"])

    def test_a_name_of_another_platform_takes_nobodys_place(self):
        """On Canvas a student chooses what follows the numbers."""
        submissions, _ = self.found(self.put({
            "leeann_12_55_kick.cpp": KICK, "bo_13_56_kick.cpp": KICK,
            "eve_14_57_lee_12_assignsubmission_file_kick.cpp": b"x",
            "fay_15_58_x_leeann_attempt_2026-11-20-10-11-12_kick.cpp": b"x",
            "gil_16_59_12-9 - Ann Lee - Nov 2, 2026 1011 AM": b"x"}))
        self.assertEqual({(one.student.name, one.student.identifier) for one in submissions.values()},
                         {("leeann", "12"), ("bo", "13"), ("eve", "14"), ("fay", "15"), ("gil", "16")})

    def test_folders_of_every_shape(self):
        submissions, left = self.found(self.put({
            "hw/ann-fork/" + WHERE: KICK, "hw/ann-fork/solutions/01_leapfrog/kick.cpp": b"ours",
            "hw/bo/kick (1).cpp": KICK, "hw/cy/01_leapfrog/kick.cpp": KICK, "hw/di/Kick - Copy.cpp": KICK,
            "hw/ed/" + WHERE: STUB, "hw/ed/kick (2).cpp": KICK, "hw/flo/src/deep/kick.cpp": KICK}))
        self.assertEqual(left, set())
        self.assert_kicks(submissions, "ann-fork", "bo", "cy", "di", "ed", "flo")
        self.assertEqual(submissions["ann-fork"].notes, [])
        for name in ("bo", "cy", "di", "ed", "flo"):
            self.assertIn("taken for kick: ", submissions[name].notes[0])

    def test_names_that_browsers_and_systems_give_files(self):
        for name in ("kick (1).cpp", "kick.cpp (2)", "Kopie von kick.cpp", "Copy of kick.cpp", "kick.cpp.txt",
                     "kick.txt", "kick_final.cpp", "kick_v2.cpp", "KICK.CPP", "kick - Copy (2).cpp"):
            submissions, _ = self.found(self.put({f"ann/{name}": KICK}, name))
            self.assert_kicks(submissions, "ann")
            self.assertEqual(submissions["ann"].notes, [f"taken for kick: {name}"])
        for name in ("kick\u200b.cpp", "\u200ekick.cpp", "\uff4bick.cpp", "kick\uff0ecpp"):
            submissions, _ = self.found(self.put({f"ann/{name}": KICK}, ascii(name)))
            self.assert_kicks(submissions, "ann")
            self.assertEqual(submissions["ann"].notes, [f"taken for kick: {unseen_shown(name)}"])
            self.assertNotRegex(submissions["ann"].notes[0], "[\u200b\u200e]")
        for name in ("kick.md", "kick.hpp", "kicks.cpp", "notes.txt", "final.cpp"):
            submissions, _ = self.found(self.put({f"ann/{name}": KICK}, name))
            self.assertEqual(submissions["ann"].sources, {}, name)

    def test_what_tools_make_does_not_count(self):
        files = {f"my/.git/objects/{k}": b"" for k in range(20_001)}
        (self.root / "ann.zip").write_bytes(zipped(files | {f"my/{WHERE}": KICK}))
        submissions, _ = self.found(self.root / "ann.zip")
        self.assert_kicks(submissions, "ann")
        self.assertEqual(submissions["ann"].notes, [])

    def test_other_encodings_are_read(self):
        text = "// Öl\nVec3 kick;\n"
        for encoding in ("utf-8", "utf-16", "utf-16-le", "utf-16-be", "utf-32"):
            submissions, _ = self.found(self.put({"ann/kick.cpp": text.encode(encoding)}, encoding))
            self.assertEqual(submissions["ann"].sources["kick"].text, text, encoding)
        odd = b"\xff\xfe" + b"\0\xd8" * 20  # half a letter, again and again
        submissions, _ = self.found(self.put({"ann/kick.cpp": odd}, "odd"))
        self.assertEqual(submissions["ann"].sources["kick"].content, odd)

    def test_archives(self):
        for name, content in (("a.zip", zipped({WHERE: KICK})), ("a.tar", tarred({WHERE: KICK}, "")),
                              ("a.tar.xz", tarred({WHERE: KICK}, "xz")), ("a.tgz", tarred({"kick.cpp": KICK}, "gz"))):
            submissions, _ = self.found(self.put({name: content}, name) / name)
            self.assert_kicks(submissions, "a")

    def test_archives_under_names_of_others(self):
        for name, content in (("a.zip", tarred({WHERE: KICK}, "gz")), ("a.tar.gz", zipped({WHERE: KICK})),
                              ("a.tar", tarred({WHERE: KICK}, "xz")), ("a.rar", zipped({WHERE: KICK}))):
            submissions, _ = self.found(self.put({name: content, "b/kick.cpp": KICK}, f"renamed {name}"))
            self.assert_kicks(submissions, "a")
        submissions, _ = self.found(self.put({"a.zip": b"Rar!\x1a\7\0" + bytes(99)}, "a rar") / "a.zip")
        self.assertIn("this kind of archive is not read", submissions["a"].notes[0])

    def test_one_odd_member_of_a_zip_hides_no_other(self):
        nameless, locked = io.BytesIO(), zipped({WHERE: KICK})
        with zipfile.ZipFile(nameless, "w") as archive:
            for name in ("x", "/", ".", WHERE):
                archive.writestr(name, KICK)
            archive.filelist[0].filename = ""
        at = locked.index(b"PK\1\2") + 8
        submissions, _ = self.found(self.put({"a.zip": nameless.getvalue(),
                                              "b.zip": locked[:at] + b"\1" + locked[at + 1:]}))
        self.assert_kicks(submissions, "a")
        self.assertEqual(submissions["b"].sources["kick"].problem, f"{WHERE} cannot be read: it is encrypted")
        self.assertEqual(submissions["b"].notes, [submissions["b"].sources["kick"].problem])

    def test_many_files_of_no_exercise_cost_little(self):
        folder = self.put({f"ann/{k}.txt": b"" for k in range(5000)})
        begun = time.process_time()
        submissions, _ = self.found(folder)
        self.assertIn("no file of an exercise", submissions["ann"].notes[0])
        self.assertLess(time.process_time() - begun, 5)

    def test_seven_zip(self):
        if not shutil.which("bsdtar"):
            self.skipTest("bsdtar (libarchive-tools) is not installed")
        folder = self.put({WHERE: KICK}, "ann")
        subprocess.run(["bsdtar", "--format=7zip", "-cf", str(self.root / "ann.7z"), "-C", str(folder), "chapters"],
                       check=True)
        self.assert_kicks(self.found(self.root / "ann.7z")[0], "ann")

    def test_a_seven_zip_of_zeros_is_read_to_a_limit(self):
        if not shutil.which("bsdtar"):
            self.skipTest("bsdtar (libarchive-tools) is not installed")
        zeros = self.root / "zeros"
        zeros.touch()
        os.truncate(zeros, 300 << 20)
        folder = self.put({f"ann/{WHERE}": KICK})
        subprocess.run(["bsdtar", "--format=7zip", "--options", "7zip:compression=deflate,7zip:compression-level=1",
                        "-cf", str(folder / "eve.7z"), "-C", str(self.root), "zeros"], check=True)
        submissions, _ = self.found(folder)
        self.assert_kicks(submissions, "ann")
        self.assertIn("a 7z that holds more than 256 MiB is not read", submissions["eve"].notes[0])

    def test_a_loose_file_makes_no_class_one_submission(self):
        files = {f"s{k:02d}/{WHERE}": KICK for k in range(30)}
        submissions, left = self.found(self.put(files | {"kick.cpp": b"x", "drift.cpp": b"x"}))
        self.assertEqual((len(submissions), left), (30, {"kick.cpp", "drift.cpp"}))
        submissions, left = self.found(self.put({"kick.cpp": KICK, "drift.cpp": b"d"}, "alone"))
        self.assertEqual((set(submissions), left), ({"alone"}, set()))

    def test_one_who_works_in_folders_is_one(self):
        archive = self.root / "ann.zip"
        archive.write_bytes(zipped({"week1/kick.cpp": KICK, "week2/drift.cpp": b"d"}))
        submissions, _ = self.found(archive)
        self.assertEqual(set(submissions["ann"].sources), {"kick", "drift"})

    def test_everything_is_somewhere(self):
        """Whatever lies in a folder is a submission's or is left out, with its name."""
        folder = self.put({"ann/" + WHERE: KICK, "bo.rar": b"Rar!", "cy.zip": b"", "readme.txt": b"x",
                           ".hidden/x": b"x"})
        (folder / "di").mkdir()
        (folder / "link").symlink_to(folder / "ann")
        submissions, left = self.found(folder)
        self.assertEqual(set(submissions), {"ann", "bo", "cy", "di"})
        self.assertEqual(left, {"readme.txt", ".hidden", "link"})
        for name in ("bo", "cy", "di"):
            self.assertTrue(submissions[name].notes, name)

    def test_one_stops_nobody(self):
        deep = zipped({f"{k}.zip": zipped({f"{m}.zip": zipped({"x": b""}) for m in range(20)}) for k in range(20)})
        zeros = bz2.compress(self.header("zeros", 4 << 30)) + bz2.compress(bytes(64 << 20)) * 64
        folder = self.put({f"ann/{WHERE}": KICK, "deep.zip": deep, "zeros.tar.bz2": zeros,
                           "names.tar": tarred({"\udcff/x": b"", "kick.cpp": KICK}, ""),
                           "many.zip": zipped({f"{k}/kick.cpp": KICK for k in range(8000)}), "eve.7z": b"7z"})
        (folder / "self").symlink_to("self")
        os.mkfifo(folder / "pipe.zip")
        with socket.socket(socket.AF_UNIX) as name:
            name.bind(str(folder / "socket.zip"))
        submissions, left = self.found(folder)
        self.assertEqual(set(submissions), {"ann", "deep", "zeros", "names", "many", "eve", "pipe", "socket"})
        self.assertEqual(left, {"self"})
        self.assert_kicks(submissions, "ann", "names", "many")
        self.assertNotIn(str(self.root), " ".join(note for one in submissions.values() for note in one.notes))
        for name, said in (("deep", "200 archives"), ("zeros", "1024 MiB"), ("many", "only 20"), ("pipe", "regular")):
            self.assertIn(said, " ".join(submissions[name].notes))

    def test_a_tar_of_holes_is_read_to_a_limit(self):
        """A file of 2 GiB that takes no room, and members of a few bytes that claim 2 GiB."""
        folder = self.put({f"ann/{WHERE}": KICK, "hole.tar": self.header("hole", 2 << 30),
                           "file.tar": self.sparse("kick.cpp", 2 << 30), "inner.tar": self.sparse("more.tar", 2 << 30)})
        os.truncate(folder / "hole.tar", 2 << 30)
        self.assertLess((folder / "hole.tar").stat().st_blocks, 1 << 10)
        used = time.process_time()
        submissions, _ = self.found(folder)
        self.assertLess(time.process_time() - used, 20)
        self.assert_kicks(submissions, "ann")
        self.assertIn("1024 MiB", submissions["hole"].notes[0])
        self.assertIn("is larger than 256 KiB", submissions["file"].sources["kick"].problem)
        self.assertIn("too large", submissions["inner"].notes[0])

    def test_what_cannot_be_looked_at_stops_nobody(self):
        """Folders that may not be listed, and files that are removed in the meantime."""
        folder = self.put({f"ann/{WHERE}": KICK, f"bo/{WHERE}": KICK, "bo/shut/kick.cpp": KICK, "bo/gone.cpp": b"x"})
        lists, looks = os.scandir, Path.lstat

        def scandir(path):
            if str(path).endswith("shut"):
                raise PermissionError(13, "Permission denied", path)
            return lists(path)

        def lstat(path):
            if path.name == "gone.cpp":
                raise FileNotFoundError(2, "No such file or directory", str(path))
            return looks(path)
        with unittest.mock.patch("os.scandir", scandir), unittest.mock.patch.object(Path, "lstat", lstat):
            submissions, _ = self.found(folder)
        self.assert_kicks(submissions, "ann", "bo")
        self.assertEqual(submissions["bo"].notes, ["gone.cpp cannot be read: No such file or directory",
                                                   "shut cannot be read: Permission denied"])

    def test_a_folder_whose_name_is_no_text_stops_nobody(self):
        folder = self.put({f"{os.fsdecode(bytes([220]))}bung/{name}": KICK for name in
                           ("ann/kick.cpp", "bo/kick.cpp", "notes.pdf")})
        delivery = find_submissions([folder], self.root / "out")
        write_delivery(self.root / "out", [one.name for one in delivery.handed], delivery.left_out, (1, 1))
        self.assertEqual([one.name for one in delivery.handed], ["ann", "bo"])

    def test_one_in_a_class_zip_stops_nobody(self):
        """Each is read for itself, and has a budget of its own, however many there are."""
        deep = zipped({f"{k}.zip": zipped({f"{m}.zip": zipped({"x": b""}) for m in range(20)}) for k in range(20)})
        names = [f"s{k:03d}" for k in range(210)]
        path = self.put({"class.zip": zipped({"a.zip": deep, "b": b"", **{f"{name}.zip": zipped({WHERE: KICK})
                                                                         for name in names}})}) / "class.zip"
        delivery = find_submissions([path], self.root / "out")
        self.assertEqual([one.name for one in delivery.handed], ["a", *names])
        read = [read_submission(one, all_exercises()) for one in (delivery.handed[0], delivery.handed[-1])]
        self.assertIn("200 archives", read[0].notes[0])
        self.assertEqual((read[1].sources["kick"].content, read[1].notes), (KICK, []))

    def test_a_class_zip_is_opened_to_a_limit_of_each_student(self):
        one = zipped({WHERE: KICK})
        hers, others = {f"eve/{k}/x.zip": one for k in range(50)}, {f"ann/{k}.zip": one for k in range(5)}
        for above in ("", "HW/"):
            path = self.root / "class.zip"
            path.write_bytes(zipped({f"{above}{name}": content for name, content in (hers | others).items()}))
            opened = [name for name in names_in(path, opened=True) if name.name == "kick.cpp"]
            self.assertEqual(sum("eve" in name.parts for name in opened), 20)
            self.assertEqual(sum("ann" in name.parts for name in opened), 5)

    def test_a_path_that_is_too_long_to_ask_for_stops_nobody(self):
        """Folders within folders, each with a name as long as may be: no call takes the whole path."""
        folder = self.put({f"ann/{WHERE}": KICK, f"eve/{WHERE}": KICK})
        here = os.open(folder / "eve", os.O_RDONLY)
        for _ in range(30):
            os.mkdir("d" * 255, dir_fd=here)
            below = os.open("d" * 255, os.O_RDONLY, dir_fd=here)
            os.close(here)
            here = below
        os.close(here)
        self.addCleanup(subprocess.run, ["rm", "-rf", str(folder)])
        submissions, _ = self.found(folder)
        self.assert_kicks(submissions, "ann", "eve")
        self.assertIn("names so long", " ".join(submissions["eve"].notes))

    def test_folders_without_end_stop_nobody(self):
        """The walk through them calls itself for each level."""
        folder = self.put({f"{name}/{WHERE}": KICK for name in ("ann", "bo", "cy")})
        here = os.open(folder / "bo", os.O_RDONLY)
        for _ in range(2 * sys.getrecursionlimit()):
            os.mkdir("a", dir_fd=here)
            below = os.open("a", os.O_RDONLY, dir_fd=here)
            os.close(here)
            here = below
        os.close(here)
        self.addCleanup(subprocess.run, ["rm", "-rf", str(folder)])
        submissions, _ = self.found(folder)
        self.assert_kicks(submissions, "ann", "bo", "cy")
        self.assertEqual(submissions["bo"].notes, ["folders more than 40 deep cannot be read"])

    def test_what_it_says_of_itself_is_cut(self):
        files = {f"{'n' * 60_000}{k}.hpp": b"" for k in range(100)} | {f"{'n' * 999}{k}.zip": b"" for k in range(99)}
        (self.root / "long.zip").write_bytes(zipped(files))
        submissions, _ = self.found(self.root / "long.zip")
        self.assertLess(len("".join(submissions["long"].notes)), 100_000)

    @staticmethod
    def header(name: str, size: int) -> bytes:
        info = tarfile.TarInfo(name)
        info.size = size
        return info.tobuf()

    @classmethod
    def sparse(cls, name: str, size: int) -> bytes:
        """Returns an archive with one member in GNU's old form, which is a single hole."""
        block = bytearray(cls.header(name, 0))
        block[156:157] = tarfile.GNUTYPE_SPARSE
        block[257:265] = b"ustar  \0"  # GNU's, in which the places of the data and the size follow
        block[386:410] = b"%011o\0%011o\0" % (size, 0)
        block[483:495] = b"%011o\0" % size
        block[148:156] = b"        "
        block[148:156] = b"%06o\0 " % sum(block)
        return bytes(block) + bytes(1024)

    def test_names(self):
        for name, expected in (("A B_1_assignsubmission_file_", ("A B", "1", False, "")),
                               ("A B_1_assignsubmission_file_w.zip", ("A B", "1", False, "w.zip")),
                               ("leeann_late_12_3_my_kick.cpp", ("leeann", "12", True, "my_kick.cpp")),
                               ("HW_3_4711_attempt_2026-11-20-10-11-12_a_kick.cpp", ("4711", "", False, "a_kick.cpp")),
                               ("HW_bo_attempt_2026-11-20-10-11-12.txt", ("bo", "", False, "")),
                               ("HW_bo_attempt_2026-11-20-10-11-12_x_cy_attempt_2026-11-21-10-11-12_kick.cpp",
                                ("bo", "", False, "x_cy_attempt_2026-11-21-10-11-12_kick.cpp")),
                               ("12-34 - A B - Nov 2, 2026 1011 AM", ("A B", "12", False, "")),
                               ("kick.cpp", None), ("01_leapfrog", None), ("half_step_start.cpp", None)):
            found = student_of(name)
            self.assertEqual((found[0].name, found[0].identifier, found[0].late, found[1]) if found else None, expected)


class Gradescope(Finds):
    """Gradescope's download has numbered folders, and a file with their students."""

    METADATA = b"""---
submission_11:
  :submitters:
  - :name: "\\u00c5sa Lee"
    :sid: '1234'
    :email: asa@example.edu
  :created_at: 2026-11-20 10:11:12.000000000 Z
  :history:
  - :submitters:
    - :name: Nobody
submission_12:
  :submitters:
  - :name: 'Bo O''Ek'
    :sid:
    :email: bo@example.edu
  - :name: Cy
    :email: cy@example.edu
submission_13:
  :submitters: []
"""

    def test_who_is_who(self):
        folder = self.put({"submission_metadata.yml": self.METADATA, "submission_11/kick.cpp": KICK,
                           "submission_12/kick.cpp": KICK, "submission_13/kick.cpp": KICK})
        submissions, left = self.found(folder)
        self.assertEqual(set(submissions), {"Åsa Lee", "Bo O_Ek", "Cy", "submission_13"})
        self.assert_kicks(submissions, *submissions)
        self.assertEqual(submissions["Åsa Lee"].student.identifier, "1234")
        self.assertEqual(submissions["Bo O_Ek"].student, Student("Bo O'Ek", "bo@example.edu"))
        self.assertEqual(left, set())

    def test_nobody_is_combined_with_another_of_the_same_name_and_number(self):
        """Students may choose both."""
        text = b"".join(b"submission_%d:\n  :submitters:\n  - :name: Bo\n    :sid: '7'\n" % k for k in (9, 10))
        submissions, _ = self.found(self.put({"submission_metadata.yml": text, f"submission_9/{WHERE}": KICK,
                                              "submission_10/kick.cpp": b"hers"}))
        self.assertEqual({one.sources["kick"].content for one in submissions.values()}, {KICK, b"hers"})

    def test_one_that_is_packed_is_to_be_unpacked(self):
        packed = self.root / "export.zip"
        packed.write_bytes(zipped({"assignment_1/submission_metadata.yml": self.METADATA,
                                   "assignment_1/submission_11/kick.cpp": KICK}))
        with self.assertRaisesRegex(BadInput, "unpack it"):
            self.found(packed)

    def test_a_students_file_of_that_name_stops_no_class(self):
        packed = self.root / "class.zip"
        packed.write_bytes(zipped({"eve/submission_metadata.yml": self.METADATA, f"eve/{WHERE}": KICK,
                                   f"submission_11/{WHERE}": KICK}))
        submissions, _ = self.found(packed)
        self.assert_kicks(submissions, "eve", "submission_11")

    def test_a_file_of_that_name_that_says_nothing_names_nobody(self):
        for content in (b"", b"\xff\xfe", b"submission_11: [" * 1000, b"submission_11:\n  :submitters:\n    :name: x\n"):
            folder = self.put({"submission_metadata.yml": content, "submission_11/kick.cpp": KICK,
                               "submission_12/kick.cpp": KICK})
            submissions, _ = self.found(folder)
            self.assertEqual(set(submissions), {"submission_11", "submission_12"})


class Ready(Exception):
    """Ends a command where it would begin to grade."""


class Doubts(Finds):
    def doubts(self, folder: Path) -> list[str]:
        return find_submissions([folder], self.root / "out").doubts

    def test_a_folder_of_other_things_is_asked_about(self):
        for files in ({"Downloads/a.pdf": b"x", "Music/b.mp3": b"x", "Work/kick.cpp": KICK},
                      {"ann/kick.cpp": KICK, "a.pdf": b"x", "b.pdf": b"x"}):
            folder = self.put(files)
            doubt, = self.doubts(folder)
            self.assertIn("no form that is known", doubt)
            shutil.rmtree(folder)

    def class_of(self, *names: str, above: str = "", files: str = "kick.cpp") -> dict[str, bytes]:
        return {f"{above}{name}/{files}": KICK for name in names}

    def in_each_form(self, files: dict[str, bytes]):
        """Delivers files as a folder, as an archive, and as an archive in a folder: yields the path, the names of the
        submissions and the doubts."""
        packed = self.put({"packed.zip": zipped(files)}, "holds") / "packed.zip"
        for path in (self.put(files), packed, packed.parent):
            delivery = find_submissions([path], self.root / "out")
            with self.subTest(path.name, files=list(files)):
                yield path, [one.name for one in delivery.handed], delivery.doubts
        shutil.rmtree(self.root / "in")

    def test_an_archive_of_other_things_is_asked_about(self):
        """As is a folder in which the only folder or archive is a class."""
        files = {"Downloads/a.pdf": b"x", "Music/b.mp3": b"x", "Work/kick.cpp": KICK, "Old/kick.cpp": KICK, "Mail/c": b"x"}
        for above in ("", "class/", "disk/class/"):
            for _, names, doubts in self.in_each_form({f"{above}{name}": content for name, content in files.items()}):
                self.assertEqual(names, ["Downloads", "Mail", "Music", "Old", "Work"])
                self.assertIn("has no form that is known: of 5 submissions in it 3 hold no exercise's file", doubts[0])
                self.assertEqual(len(doubts), 1)
        (self.root / "text.zip").write_bytes(zipped({"essay.docx": b"x"}))
        self.assertIn("is taken for one submission, but holds no exercise's file", self.doubts(self.root / "text.zip")[0])

    def test_a_class_in_folders_in_one_another_is_found(self):
        for above in ("", "class/", "a/class/", "a/b/c/class/"):
            for files in ("kick.cpp", WHERE):
                for _, names, doubts in self.in_each_form(self.class_of("ann", "bob", "cy", above=above, files=files)):
                    self.assertEqual((names, doubts), (["ann", "bob", "cy"], []))

    def test_folders_without_end_in_an_archive_cost_little(self):
        packed = self.root / "eve.zip"
        packed.write_bytes(zipped({f"{'a/' * 30_000}{name}.cpp": KICK for name in ("kick", "drift")}))
        begun = time.process_time()
        self.assertEqual([one.name for one in find_submissions([packed], self.root / "out").handed], ["eve"])
        self.assertLess(time.process_time() - begun, 5)

    def test_nobody_in_a_large_class_in_folders_is_lost(self):
        """The limits of names are those of each student."""
        packed = self.root / "class.zip"
        names = [f"s{k:02d}" for k in range(30)]
        packed.write_bytes(zipped({f"a/b/{name}/{k}.zip": zipped({"kick.cpp": KICK}) for name in names for k in range(2)}))
        self.assertEqual(sum(name.name == "kick.cpp" for name in names_in(packed, opened=True)), 60)
        self.assertEqual([one.name for one in find_submissions([packed], self.root / "out").handed], names)

    def test_one_submission_that_may_be_several_is_asked_about(self):
        for files in (self.class_of("ann", "bob", above="a/class/"), self.class_of("ann", "bob", above="a/class/", files=WHERE)):
            for path, names, doubts in self.in_each_form(files):
                self.assertEqual(len(names), 1)
                self.assertEqual(len(doubts), 1)
                self.assertIn(f"{path} is taken for one submission, but kick lies in 2 of its folders", doubts[0])
        packed = self.root / "two.zip"
        packed.write_bytes(zipped(self.class_of("ann", "bob", above="class/")))
        self.assertIn("kick lies in 2 of its folders", self.doubts(packed)[0])
        hidden = self.put({"x/class.zip": zipped(self.class_of("ann", "bob"))}, "deep")
        self.assertIn("kick lies in 2 of its folders", self.doubts(hidden)[0])

    def test_one_submission_is_not(self):
        """An answer where it belongs, a copy beside it, marks inside, and one of a platform."""
        for files in ({f"my/{WHERE}": KICK, "my/old/kick.cpp": b"old"}, {"my/kick.cpp": KICK, "my/kick (1).cpp": KICK},
                      {"my/week 1/kick.cpp": KICK, "my/week 2/drift.cpp": b"d"}):
            for _, names, doubts in self.in_each_form(files):
                self.assertEqual((len(names), doubts), (1, []))
        moodle = "Bo Ek_102_assignsubmission_file_"
        self.assertEqual(self.doubts(self.put({f"{moodle}/v{k}/kick.cpp": KICK for k in (1, 2)}, "moodle")), [])
        marks = self.put({f"ann/{WHERE}": KICK, f"ann/out/x/{WHERE}": KICK}, "marks")
        self.assertEqual(find_submissions([marks / "ann"], marks / "ann" / "out").doubts, [])

    def test_what_a_system_packs_with_a_class_is_no_student(self):
        packed = self.root / "class.zip"
        packed.write_bytes(zipped(self.class_of("ann", "bob") | {"__MACOSX/ann/._kick.cpp": b"x", ".DS_Store": b"x"}))
        delivery = find_submissions([packed], self.root / "out")
        self.assertEqual(([one.name for one in delivery.handed], delivery.left_out), (["ann", "bob"], []))

    def grade(self, *words: str, answer: str | None) -> tuple[list[str], str]:
        """Returns who would be graded, and what is printed; `answer` is what is typed, None without a terminal."""
        graded, told = [], io.StringIO()

        class Grades:
            def __init__(self, _):
                raise Ready

        def typed(question: str) -> str:
            told.write(question)
            return answer

        folder = self.put({"Downloads/a.pdf": b"x", "Music/b.mp3": b"x", "Work/kick.cpp": KICK})
        arguments = parse(["grade", str(folder), "--out", str(self.root / "marks"), *words])
        terminal = SimpleNamespace(isatty=lambda: answer is not None)
        with (unittest.mock.patch("grading.grade.Grader", Grades), unittest.mock.patch("builtins.input", typed),
              unittest.mock.patch("sys.stdin", terminal), contextlib.redirect_stdout(told)):
            try:
                grade(arguments)
            except Ready:
                graded.append("all")
        return graded, told.getvalue()

    def test_the_question_is_asked_and_answered(self):
        for answer in ("n", "", "no", "what?"):
            with self.assertRaisesRegex(BadInput, "nothing was graded"):
                self.grade(answer=answer)
            self.assertFalse((self.root / "marks").exists())
        for words, answer, asked in (((), "y", True), ((), " YES ", True), ((), None, False), (("--yes",), "n", False)):
            graded, told = self.grade(*words, answer=answer)
            self.assertEqual((graded, "Grade these? [y/N] " in told), (["all"], asked), (words, answer))
            self.assertEqual("Each of these is taken for one submission: Downloads, Music, Work." in told, not words, told)

    def test_a_class_is_not(self):
        for files in (Delivered.MOODLE, {"ann/kick.cpp": KICK, "bo/kick.cpp": KICK, "cy/essay.docx": b"x"},
                      {WHERE: KICK}, {"ann.zip": zipped({WHERE: KICK}), "bo.rar": b"x"},
                      {f"HW_ann_attempt_2026-11-20-10-11-12{end}": KICK for end in (".txt", "_kick.cpp")}):
            folder = self.put(files)
            self.assertEqual(self.doubts(folder), [])
            shutil.rmtree(folder)


class Told(Finds):
    """Messages that help."""

    def notes(self, files: dict[str, bytes], functions: tuple[str, ...] = ("kick",)) -> list[str]:
        folder = self.put(files)
        one, = find_submissions([folder], self.root / "out").handed
        shutil.move(folder, self.root / "read")
        one = replace(one, places=(Place(self.root / "read"),))
        notes = read_submission(one, [each for each in all_exercises() if each.function in functions]).notes
        shutil.rmtree(self.root / "read")
        return notes

    def test_a_right_file_that_is_not_asked_for(self):
        note, = self.notes({WHERE: KICK}, ("drift",))
        self.assertEqual(note, f"files of exercises that are not graded this time: {WHERE} (1.1 kick)")
        for also in ("chapters/drift.cpp", "chapters/01_leapfrog/drift.cpp", "chapters/08_pairs/plane_ball.cpp"):
            self.assertEqual(self.notes({WHERE: KICK, also: b"x"}), [], also)

    def test_what_cannot_be_read_is_not_called_empty(self):
        note, = self.notes({"chapters/work.rar": b"Rar!"})
        self.assertIn("this kind of archive is not read", note)
        self.assertIn("chapters/essay.txt", self.notes({"chapters/essay.txt": b"x"})[0])

    def test_what_is_uncertain_is_told_to_the_instructor(self):
        """One of two guesses, and a file of no exercise; but not a guess without another, nor one in its own place."""
        for files, said in (({"kick (1).cpp": KICK, "kick (2).cpp": KICK}, "kick (2).cpp, a guess; there is also kick (1).cpp"),
                            ({"kick.cpp.txt": b"x", "kick_final.cpp": KICK, "KICK.cpp": b"y"}, "a guess; there is also"),
                            ({"chapters/final.cpp": KICK}, "no file of an exercise was found in chapters/final.cpp"),
                            ({WHERE: KICK, "final.cpp": KICK}, "not taken: final.cpp"),
                            ({WHERE: KICK, "work.rar": b"Rar!"}, "work.rar cannot be read: this kind of archive"),
                            ({WHERE: KICK, "cut.zip": b"PK"}, "cut.zip cannot be read: "),
                            ({WHERE: KICK * 99_999}, f"{WHERE} cannot be read: it is larger than 256 KiB"),
                            ({WHERE: KICK, "x/" * 41 + "x.hpp": b""}, "folders more than 40 deep cannot be read"),
                            ({"kick (1).cpp": KICK}, ""), ({WHERE: KICK, "old/kick.cpp": KICK}, ""),
                            ({"kick (1).cpp": KICK, "kick (2).cpp": STUB}, "")):
            result = {"submission": "ann", "notes": self.notes(files)}
            with self.subTest(files=list(files)):
                told = uncertain([result])
                self.assertEqual(len(told), 1 if said else 0, told)
                self.assertIn(said, " ".join(told))
        self.assertEqual(uncertain([{"submission": "ann", "notes": ["late: the platform's file name says so"]}]), [])

    def test_what_steers_a_reader_is_not_shown(self):
        for steering in ("\x1b[31m", "\x07", "\u202e", "\u2067", "\u200f", "\u061c", "\ufffa", "\U000e0041", "\x9b"):
            self.assertEqual(clean(f"a{steering}b"), "ab", ascii(steering))
        self.assertEqual(clean("می\u200cخواهم\n"), "می\u200cخواهم\n")

    def test_twins_are_told_of_each_other(self):
        names = ("Ann Lee", "Ann\u200b Lee", "\u0410nn L\u0435e", "Ann\u3164 Lee", "Anna Lee")
        folder = self.put({f"{name}/kick.cpp": KICK for name in names})
        noted = {one.student.name: one.notes for one in find_submissions([folder], self.root / "out").handed}
        self.assertEqual(noted.pop("Anna Lee"), ())
        self.assertEqual(len(noted), 4)
        for name, (note,) in noted.items():
            self.assertIn(ascii(name), note)
            self.assertIn("looks like that of", note)


class ReadApart(InFolder):
    """Reading in a process of its own gives the same result, and has a limited cost."""

    def read(self, name: str, content: bytes, **limits: int):
        (self.root / name).write_bytes(content)
        handed = Handed(name, (Place(self.root / name),), Student(name))
        with unittest.mock.patch("grading.reading._READING", replace(reading._READING, **limits)):
            return reading.read_apart(handed, all_exercises())

    def test_it_is_the_same(self):
        content = zipped({"kick.cpp": KICK + b"\0\xff", "drift.cpp": b"/" * (LARGEST + 1), "x.hpp": b"x"})
        read = self.read("ann.zip", content)
        self.assertEqual(read, read_submission(Handed("ann.zip", (Place(self.root / "ann.zip"),),
                                                      Student("ann.zip")), all_exercises()))
        self.assertEqual(set(read.sources), {"kick", "drift"})

    def test_its_time_is_told(self):
        self.assertGreater(self.read("ann.zip", zipped({"kick.cpp": KICK})).seconds, 0)

    def test_all_attempts_are_the_same(self):
        places = []
        for name in ("HW_ann_attempt_2026-11-20-10-11-12_work.zip", "HW_ann_attempt_2026-11-21-10-11-12_work.zip"):
            (self.root / name).write_bytes(zipped({"kick.cpp": name.encode()}))
            places.append(Place(self.root / name))
        handed = Handed("ann", tuple(places), Student("ann"))
        read = reading.read_apart(handed, all_exercises(), "best")
        self.assertEqual(read, read_submission(handed, all_exercises(), "best"))
        self.assertEqual(len(read.attempts["kick"]), 2)

    def test_what_takes_too_long(self):
        zeros = bz2.compress(Delivered.header("zeros", 4 << 30)) + bz2.compress(bytes(16 << 20)) * 64
        self.assertEqual(self.read("zeros.tar.bz2", zeros, cpu=1).notes, ["it cannot be read: that takes too long"])

    def test_what_takes_too_much_memory(self):
        content = io.BytesIO()
        with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("inner.tar", bytes(60 << 20))
        notes = self.read("large.zip", content.getvalue(), memory=90 << 20).notes
        self.assertRegex(notes[0], "MemoryError|Unable to allocate|too much memory")

    def test_nothing_is_imported_from_where_it_is_called(self):
        (self.root / "json.py").write_text("raise SystemExit(3)")
        before = os.getcwd()
        os.chdir(self.root)
        self.addCleanup(os.chdir, before)
        self.assertEqual(self.read("ann.zip", zipped({"kick.cpp": KICK})).sources["kick"].content, KICK)


class Names(Finds):
    """A student's name leads only to that student's own folder."""

    NAMES = ("/x", "../x", "..", ".", "", "a/b", "\0", "x" * 300, "Ö" * 300, "\udcff", "a\nb", "con\u202etrol", "  ",
             "/", "results.json/..", "~root", "é", "e\u0301")

    def test_a_name_is_made_safe(self):
        for name in self.NAMES:
            with self.subTest(name):
                made = safe(name)
                self.assertEqual(made, safe(made))
                self.assertLessEqual(len(made.encode()), 200)
                self.assertEqual(folder_of(self.root, made).parent, self.root / "submissions")
                self.assertRegex(made, r"\A[\w. -]*[\w-][\w. -]*\Z")
        self.assertEqual(safe("Åsa Öberg-Ek Jr."), "Åsa Öberg-Ek Jr.")

    def test_a_folder_is_never_elsewhere(self):
        for name in ("", ".", "..", "a/b", "/x", "../x", "x/"):
            with self.assertRaises(CourseError):
                folder_of(self.root, name)

    def test_an_archive_that_looks_like_a_class_is_one_students(self):
        hostile = zipped({f"/x/{WHERE}": KICK, f"../y/{WHERE}": KICK, f"ann/{WHERE}": KICK, f"bo/{WHERE}": KICK})
        submissions, _ = self.found(self.put({"ann/" + WHERE: b"hers", "eve.zip": hostile, "mal/v1/kick.cpp": KICK,
                                              "mal/v2/kick.cpp": KICK}))
        self.assertEqual(set(submissions), {"ann", "eve", "mal"})
        self.assertEqual(submissions["ann"].sources["kick"].content, b"hers")
        self.assert_kicks(submissions, "eve", "mal")

    def test_what_the_instructor_names_is_a_class_with_names_that_are_safe(self):
        files = {f"/x/{WHERE}": KICK, f"../y/{WHERE}": KICK, ".": b"", "bo/kick.cpp": KICK, "cy/kick.cpp": KICK}
        for name, hostile in (("zip", zipped(files)), ("tar", tarred(files, ""))):
            folder = self.put({f"class.{name}": hostile}, f"named {name}")
            for path in (folder / f"class.{name}", folder):
                submissions, _ = self.found(path)
                self.assert_kicks(submissions, "bo", "cy")
                for one in submissions:
                    folder_of(self.root, one)

    def test_a_cell_is_no_formula_wherever_a_cell_ends(self):
        for text in ("=1", "x;=1", 'x; "=1', "x,@y", "-1", "x;+1", "\uff1d1", "x;\uff20y"):
            for part in cell(text).replace(",", ";").split(";"):
                self.assertNotRegex(part, r'\A[\s"]*[=+@\uff1d\uff0b\uff0d\uff20-]', text)

    def test_a_number_that_a_student_chose_is_no_formula(self):
        result = {"submission": "bo", "student": "Bo", "identifier": "=1+1", "late": False, "score": 0, "max_score": 1,
                  "notes": [], "exercises": []}
        _write_grades(self.root / "grades.csv", [result], Class())
        self.assertIn(",'=1+1,", (self.root / "grades.csv").read_text())


class Rosters(InFolder):
    def result(self, name: str, student: str = "", identifier: str = "") -> dict:
        return {"submission": name, "student": student or name, "identifier": identifier, "score": 3, "max_score": 5,
                "late": False, "notes": [], "exercises": [
                    {"id": f"1.{k}", "function": function, "chapter": "01_leapfrog", "state": "done", "score": points,
                     "max_score": points, "tests": []} for k, function, points in ((1, "kick", 3), (2, "drift", 2))]}

    def roster(self, text: str):
        return read_roster(self.put({"roster.csv": text.encode("utf-8-sig")}) / "roster.csv")

    def test_by_number_name_and_login(self):
        roster = self.roster('Student,ID,SIS Login ID,Section\n"    Points Possible",,,\n"Lee, Ann",12,al1,A\n'
                             '"Öberg, Åsa",13,ao2,A\n"Ek, Bo",14,be3,A\n"Student, Test",99,,A\n')
        found, missing, strangers = roster.matched([
            self.result("leeann", identifier="12"), self.result("Asa Oberg"), self.result("be3"), self.result("Zed")])
        self.assertEqual({name: row["ID"] for name, row in found.items()},
                         {"leeann": "12", "Asa Oberg": "13", "be3": "14"})
        self.assertEqual((missing, strangers), ([], ["Zed"]))

    def test_two_of_one_name_are_not_guessed(self):
        found, missing, strangers = self.roster("Name\nAnn Lee\nAnn Lee\n").matched([self.result("Ann Lee")])
        self.assertEqual((found, len(missing), strangers), ({}, 2, ["Ann Lee"]))

    def test_a_number_of_one_with_the_name_of_another_is_given_to_neither(self):
        roster = self.roster("Name,ID\nAnn Lee,12\nBo Ek,13\nCy Oh,14\n")
        results = [self.result("Ann Lee", identifier="13"), self.result("Bo Ek", identifier="12"),
                   self.result("Cyrus", identifier="14")]
        found, missing, strangers = roster.matched(results)
        self.assertEqual((list(found), len(missing), strangers), (["Cyrus"], 2, ["Ann Lee", "Bo Ek"]))
        lines = not_graded(results, Class([], roster))
        for name in ("Ann Lee", "Bo Ek"):
            line = next(line for line in lines if line.startswith(f"{name}: its number"))
            self.assertTrue("Ann Lee" in line and "Bo Ek" in line, line)

    def test_a_row_that_two_claim_is_given_to_the_one_with_its_number_or_to_none(self):
        roster = self.roster("Name,ID\nAnn Lee,12\nBo Ek,13\n")
        by_name = [self.result("Ann Lee"), self.result("Ann Lee (2)", "Ann Lee")]
        found, missing, strangers = roster.matched(by_name)
        self.assertEqual((found, len(missing), strangers), ({}, 2, ["Ann Lee", "Ann Lee (2)"]))
        self.assertIn("Ann Lee (2): another submission also claims Ann Lee on the roster; decide whose it is",
                      not_graded(by_name, Class([], roster)))
        self.assertIn("Ann Lee: on the roster, and no submission is certain to be theirs",
                      not_graded(by_name, Class([], roster)))
        found, _, strangers = roster.matched([*by_name, self.result("ann", identifier="12")])
        self.assertEqual((list(found), strangers), (["ann"], ["Ann Lee", "Ann Lee (2)"]))

    def test_a_mark_in_doubt_is_not_imported_as_none(self):
        roster = self.roster("Student,ID\nAnn Lee,12\nBo Ek,13\nCy,14\n")
        results = [self.result("Ann Lee"), self.result("Ann Lee (2)", "Ann Lee"), self.result("Bo Ek")]
        rows = [line.rpartition(",")[2] for line in for_canvas(results, roster, "HW (1)").splitlines()]
        self.assertEqual(rows, ["HW (1)", "5", "", "3", "0"])
        self.assertIn("also claims Ann Lee", not_on_it(results, roster)["Ann Lee (2)"])

    def test_a_number_of_two_rows_is_that_of_none(self):
        roster = self.roster("Number,Name,ID\n12,Ann Lee,1\n2,Bo Ek,12\n")
        self.assertEqual(roster.matched([self.result("x", identifier="12")])[0], {})
        self.assertEqual(roster.matched([self.result("Bo Ek", identifier="12")])[0]["Bo Ek"]["Name"], "Bo Ek")

    def test_as_spreadsheets_write_it(self):
        text = "Last name;First name;ID\nÖberg;Åsa;12\nLee;Ann;13\n"
        for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"):
            for separator in ";,\t":
                path = self.put({"roster.csv": text.replace(";", separator).encode(encoding)}) / "roster.csv"
                found, missing, _ = read_roster(path).matched([self.result("Asa Oberg"), self.result("leeann")])
                self.assertEqual((len(found), missing), (2, []), (encoding, separator))

    def test_numbers_of_every_title(self):
        for title in ("SID", "Student ID", "OrgDefinedId", "Matrikelnummer", "Student_ID", "Matrikel-Nr."):
            for number in ("12", "#12"):
                roster = self.roster(f"{title},Section\n{number},A\n13,A\n")
                self.assertEqual(list(roster.matched([self.result("x", identifier="12")])[0]), ["x"], title)
                self.assertEqual(roster.number_of(roster.rows[1]), "13")

    def test_a_name_beside_first_names_is_the_last_name(self):
        results = [self.result("Ann Lee"), self.result("Öberg Åsa"), self.result("Lee")]
        for titles, rows in (("Name;Vorname", "Lee;Ann\nÖberg;Åsa\nJones;Jo\nJo;Jo\n"), ("First name;Name", "Ann;Lee\nÅsa;Öberg\n")):
            roster = self.roster(f"{titles}\n{rows}")
            found, _, strangers = roster.matched(results)
            self.assertEqual((list(found), strangers), (["Ann Lee", "Öberg Åsa"], ["Lee"]))
            self.assertEqual(roster.name_of(roster.rows[0]), "Ann Lee")
        whole = self.roster("Name,First name\nAnn Lee,Ann\n\"Öberg, Åsa\",Åsa\n")
        self.assertEqual(list(whole.matched(results)[0]), ["Ann Lee", "Öberg Åsa"])

    def test_github_classroom(self):
        roster = self.roster('"identifier","github_username","github_id","name"\n"Ann Lee","annl","77",""\n')
        self.assertEqual(list(roster.matched([self.result("annl")])[0]), ["annl"])

    def test_gradescopes_numbers_and_addresses(self):
        """A number may have letters, and who has none is known by the address."""
        roster = self.roster("Name,ID,Email\nAnn Lee,s-1234,ann@x.edu\nBo Ek,s-77,bo23@x.edu\nCy,23,cy@x.edu\n")
        results = [self.result("A. L.", identifier="s-1234"), self.result("Bobby", identifier="BO23@x.edu"),
                   self.result("Dee", identifier="dee23@y.edu")]
        found, missing, strangers = roster.matched(results)
        self.assertEqual({name: row["Name"] for name, row in found.items()}, {"A. L.": "Ann Lee", "Bobby": "Bo Ek"})
        self.assertEqual(([row["Name"] for row in missing], strangers), (["Cy"], ["Dee"]))

    def test_github_classrooms_folders_begin_with_the_assignment(self):
        roster = self.roster('"identifier","github_username","github_id","name"\n"Ann Lee","annl","77",""\n'
                             '"Bo Ek","Bo-Ek","78",""\n"Eve","eve-annl","79",""\n"Cy","","",""\n')
        names = ("hw-1-annl", "hw-1-bo-ek-main", "hw-1-eve-annl", "hw-1-zed")
        found, _, strangers = roster.matched([self.result(name) for name in names])
        self.assertEqual({name: row["identifier"] for name, row in found.items()},
                         dict(zip(names, ("Ann Lee", "Bo Ek", "Eve"))))
        self.assertEqual(strangers, ["hw-1-zed"])

    def test_moodle_may_hide_the_names(self):
        for text in ("Identifier,Full name,Grade\nParticipant 101,,\nParticipant 102,,\n",
                     "Identifier,Grade\nParticipant 101,\nParticipant 102,\n"):
            roster = self.roster(text)
            found, missing, _ = roster.matched([self.result("Participant_101", identifier="101")])
            self.assertEqual((len(found), [roster.name_of(row) for row in missing]), (1, ["Participant 102"]))

    # By language: titles of the worksheet, the word for a participant, and the state of a submission.
    WORKSHEETS = {
        "en": ("Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed",
               "Participant ", "No submission"),
        "de": ("ID,Vollständiger Name,E-Mail-Adresse,Status,Bewertung,Beste Bewertung,Bewertung kann geändert werden",
               "Teilnehmer/in ", "Keine Abgabe"),
        "fr": ("Identifiant,Nom complet,Adresse de courriel,Statut,Note,Note maximale,La note peut être modifiée",
               "Participant·e ", "Aucun travail remis"),
        "es": ("Identificador,Nombre completo,Dirección de correo,Estado,Calificación,Calificación máxima,Se puede cambiar",
               "Participante ", "Sin entrega"),
        "it": ("Identificativo,Nome completo,Indirizzo email,Stato,Valutazione,Valutazione massima,Può essere modificata",
               "Partecipante ", "Nessuna consegna"),
        "pt": ("Identificador,Nome completo,Endereço de email,Estado,Nota,Nota máxima,A nota pode ser alterada",
               "Participante ", "Nenhum envio"),
        "nl": ("Identificatie,Volledige naam,E-mailadres,Status,Cijfer,Maximumcijfer,Cijfer kan gewijzigd worden",
               "Deelnemer ", "Geen inzending"),
        "zh": ("标识符,全名,电子邮件地址,状态,成绩,最高分,成绩可以更改", "参与者", "没有提交"),
    }

    def worksheet(self, language: str, *students: tuple[str, str], largest: str = "100.00", hidden: bool = False) -> str:
        titles, word, state = self.WORKSHEETS[language]
        titles = titles.split(",")[:2 - hidden] + titles.split(",")[2 + hidden:]
        rows = [f'{word}{number},{"" if hidden else f"{name},a{number}@x.edu,"}{state},,"{largest}",+'
                for number, name in students]
        return "\n".join([",".join(titles), *rows]) + "\n"

    def test_moodles_worksheet_in_any_language(self):
        results = [self.result("leeann", identifier="101"), self.result("Bo Ek")]
        for language in self.WORKSHEETS:
            with self.subTest(language):
                roster = self.roster(self.worksheet(language, ("101", "Ann Lee"), ("102", "Bo Ek"), ("103", "Cy Oh")))
                self.assertEqual([(roster.name_of(row), roster.number_of(row)) for row in roster.rows],
                                 [("Ann Lee", "101"), ("Bo Ek", "102"), ("Cy Oh", "103")])
                found, missing, strangers = roster.matched(results)
                self.assertEqual((set(found), strangers), ({"leeann", "Bo Ek"}, []))
                self.assertEqual([roster.name_of(row) for row in missing], ["Cy Oh"])
                rows = list(csv.reader(io.StringIO(for_moodle(results, roster))))
                self.assertEqual(tuple(rows[0]), roster.columns)
                self.assertEqual([row[4:6] for row in rows[1:]], [["60.00", "100.00"], ["60.00", "100.00"], ["", "100.00"]])

    def test_moodles_worksheet_with_a_decimal_comma_and_without_names(self):
        roster = self.roster(self.worksheet("de", ("101", ""), ("102", ""), ("103", ""), largest="20,00", hidden=True))
        self.assertEqual(roster.name_of(roster.rows[0]), "Teilnehmer/in 101")
        rows = list(csv.reader(io.StringIO(for_moodle([self.result("Teilnehmer_in 101", identifier="101")], roster))))
        self.assertEqual([row[2:4] for row in rows[1:]], [["12,00", "20,00"], ["", "20,00"], ["", "20,00"]])

    def test_what_is_no_worksheet_is_said(self):
        """Without a maximum, or with numbers that are no participants: nothing is guessed."""
        for text in ("Kennung,Name,Note\nTeilnehmer 1,Ann,\nTeilnehmer 2,Bo,\n", "Name,Note,Beste\nAnn,,100\nBo,,100\n",
                     "Kennung,Name,Note,Beste\nTeilnehmer 1,Ann,,100\nTeilnehmer 1,Bo,,100\n",
                     "Kennung,Name,Note,Beste\nTeilnehmer 1,Ann,,100\nTeilnehmer 2,Bo,,20\n"):
            with self.subTest(text), self.assertRaisesRegex(BadInput, "the assignment's grading worksheet"):
                for_moodle([self.result("Ann")], self.roster(text))

    def test_a_login_with_a_number_is_no_platforms_number(self):
        roster = self.roster("Login,Name\nuser101,Ann Lee\nuser102,Bo Ek\n")
        self.assertEqual(roster.matched([self.result("x", identifier="101")])[0], {})

    def test_tables_of_other_languages(self):
        for text in ("Nachname;Vorname;E-Mail\nLee;Ann;a@x.edu\n", "Nom;Prénom;Courriel\nLee;Ann;a@x.edu\n",
                     "Apellidos;Nombre;Correo\nLee;Ann;a@x.edu\n", "Cognome;Nome;Posta\nLee;Ann;a@x.edu\n"):
            roster = self.roster(text)
            found, _, strangers = roster.matched([self.result("Ann Lee"), self.result("A", identifier="a@x.edu")])
            self.assertEqual((set(found), strangers), ({"A"}, ["Ann Lee"]), text)  # the address is certain

    def test_who_handed_in_nothing_has_the_same_columns(self):
        """Names, numbers and 0 points, as in the rows of the others; the roster also tells numbers that no platform did."""
        roster = self.roster(self.worksheet("en", ("101", "Ann Lee"), ("102", "Bo Ek"), ("103", "Cy Oh")))
        results = [self.result("Ann Lee", identifier="101"), self.result("Bo Ek")]
        _write_grades(self.root / "grades.csv", results, Class([], roster))
        with (self.root / "grades.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["student"], row["identifier"]) for row in rows],
                         [("Ann Lee", "101"), ("Bo Ek", "102"), ("Cy Oh", "103")])
        self.assertEqual([(row["1.1 kick"], row["1.2 drift"], row["01_leapfrog"]) for row in rows],
                         [("3", "2", "5")] * 2 + [("0", "0", "0")])
        self.assertEqual([(row["score"], row["max_score"], row["not started"]) for row in rows][-1], ("0", "5", "2"))
        self.assertNotIn(None, rows[-1])
        self.assertNotIn(None, rows[-1].values())

    def test_what_spreadsheets_write_above_the_titles(self):
        for above in ("sep=;\n", "\n\n", " \r\nsep=;\r\n"):
            roster = self.roster(f"{above}E-Mail;Name\nann@x.edu;Ann\n")
            self.assertEqual(list(roster.matched([self.result("A", identifier="ann@x.edu")])[0]), ["A"])
        with self.assertRaisesRegex(BadInput, "is a spreadsheet; save it as CSV"):
            read_roster(self.put({"roster.csv": b"PK\3\4" + bytes(99)}) / "roster.csv")

    def test_what_is_none_is_said(self):
        for text in ("", "a,b\n1,2\n"):
            with self.assertRaisesRegex(BadInput, "no column of names"):
                self.roster(text)


class Feedback(InFolder):
    """feedback.zip, which Moodle takes back: the report of each student who is known by its number."""

    @staticmethod
    def folder_taken_by_moodle(path: str) -> tuple[str, str] | None:
        """Returns the participant's number and the file, as Moodle reads a path; see assignfeedback_file_zip_importer."""
        parts = path.split("/")
        while parts:
            info = parts.pop(0).split("_", 4)
            if len(info) >= 4 and info[1].isdecimal() and info[2:4] == ["assignsubmission", "file"]:
                return info[1], "/".join(filter(None, [*info[4:], *parts]))
        return None

    def write(self, names: dict[str, bytes]) -> dict[tuple[str, str] | None, str]:
        """Delivers, writes a report for each submission, and returns what Moodle makes of the zip."""
        results = []
        for one in find_submissions([self.put(names)], self.root / "out").handed:
            folder = folder_of(self.root / "out", one.name)
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "report.md").write_text(f"of {one.student.name}", encoding="utf-8")
            results.append({"submission": one.name, "student": one.student.name, "identifier": one.student.identifier,
                            "platform": one.student.platform})
        written = write_feedback(self.root / "out", results)
        if not written:
            return {}
        with zipfile.ZipFile(written) as archive:
            return {self.folder_taken_by_moodle(name): archive.read(name).decode() for name in archive.namelist()}

    def test_each_student_has_the_report(self):
        found = self.write(Delivered.MOODLE)
        names = ("Åsa Öberg", "Bo Ek", "Cy", "Di", "Ed", "Flo", "Gus")
        self.assertEqual(found, {(str(101 + k), "report.md"): f"of {name}" for k, name in enumerate(names)})

    def test_loose_files_and_odd_names(self):
        found = self.write({"Bo_Ek_102_assignsubmission_file_kick.cpp": KICK,
                            "Ann_9_Lee_101_assignsubmission_file_/kick.cpp": KICK,
                            "Ed_105_assignsubmission_file_x_106_assignsubmission_file_kick.cpp": KICK})
        self.assertEqual(found, {("102", "report.md"): "of Bo_Ek", ("101", "report.md"): "of Ann_9_Lee"})

    def test_other_deliveries_have_none_and_an_old_one_is_removed(self):
        self.assertTrue(self.write(Delivered.MOODLE))
        shutil.rmtree(self.root / "in")
        self.assertEqual(self.write({"leeann_12_55_kick.cpp": KICK, "ekbo_13_56_kick.cpp": KICK}), {})
        self.assertFalse((self.root / "out" / FEEDBACK).exists())

    def test_the_same_reports_give_the_same_bytes(self):
        self.write(Delivered.MOODLE)
        first = (self.root / "out" / FEEDBACK).read_bytes()
        self.write(Delivered.MOODLE)
        self.assertEqual((self.root / "out" / FEEDBACK).read_bytes(), first)


class Records(InFolder):
    def graded(self, shard: int, names: list[str], count: int = 3) -> Path:
        folder = self.root / f"shard{shard}"
        write_delivery(folder, names, [("x", "why")], (shard, count))
        for name in names[shard - 1::count]:
            (folder / "submissions" / name).mkdir(parents=True)
            write_json(folder / "submissions" / name / "results.json", {
                "schema": SCHEMA, "submission": name, "points": "tests", "seed": 1, "seconds_a_test": 1, "tests": "t",
                "max_score": 1})
        return folder

    def test_missing_shards_are_named(self):
        names = [f"s{k}" for k in range(7)]
        folders = [self.graded(shard, names) for shard in (1, 3)]
        results, left_out = merge(folders, self.root / "whole")
        self.assertEqual([result["submission"] for result in results], ["s0", "s2", "s3", "s5", "s6"])
        self.assertEqual(missing_shards(folders), ["2/3"])
        self.assertEqual(left_out, [("x", "why"), ("s1", "its shard is not done: 2/3"),
                                    ("s4", "its shard is not done: 2/3")])

    def test_a_result_with_bytes_that_are_no_text_is_written(self):
        write_json(self.root / "results.json", {"message": "a section x\udcff"})
        self.assertEqual((self.root / "results.json").read_text(encoding="utf-8"), '{\n "message": "a section x?"\n}\n')

    def test_who_is_removed_leaves_the_results(self):
        folder = self.graded(1, ["ann", "bo"], count=1)
        self.assertEqual(set_aside(folder, ["bo"]), ["ann"])
        self.assertEqual([path.name for path in (folder / "submissions").iterdir()], ["bo"])
        self.assertTrue((folder / "no longer handed in" / "ann" / "results.json").exists())


if __name__ == "__main__":
    unittest.main()
