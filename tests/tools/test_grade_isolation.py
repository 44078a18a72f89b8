"""The access of a submission in every isolation that works here, and the reading of verdicts."""

import contextlib
import os
import signal
import socket
import sys
import tempfile
import time
import unittest
from pathlib import Path

from sandbox import ROOT

from errors import CourseError
from grading.choices import ISOLATIONS
from grading.confined import Ended, Limits, run
from grading.isolation import Isolation, choose, take_user
from grading.judge import read_verdict
from grading.pair import Ran

LIMITS = Limits(cpu=5, wall=20, memory=1 << 30, files=1 << 20, processes=16, output=1 << 16)


def works(name: str) -> bool:
    try:
        return choose(name).name == name
    except CourseError:
        return False


WORKING = [name for name in ISOLATIONS if works(name)]
WITH_NAMESPACES = [name for name in WORKING if name.startswith("bubblewrap")]
PYTHON = "/usr/bin/python3"


class InIsolation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="isolation-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        self.folder.chmod(0o755)

    def python(self, name: str, code: str, limits: Limits = LIMITS) -> Ended:
        """Runs the code isolated; it can read the folder, but not write to it."""
        user = take_user(Isolation(name))
        self.addCleanup(user.release)
        return Isolation(name).run([PYTHON, "-c", code], limits, user, (self.folder,), folder=self.folder)

    def test_one_works_and_root_is_never_without(self):
        self.assertTrue(WORKING, "bubblewrap is missing")
        if os.geteuid() == 0:
            with self.assertRaisesRegex(CourseError, "do not grade as root"):
                choose("limits")

    def test_it_has_no_descriptor_but_the_usual_three(self):
        for name in WORKING:
            ended = self.python(name, "import os\nfor d in range(3, 64):\n  try: print(d, os.fstat(d))\n"
                                "  except OSError: pass")
            self.assertEqual(ended.output.strip(), "", name)

    def test_nothing_of_the_graders_is_seen_or_written(self):
        secret = self.folder.parent / f"{self.folder.name}-secret"
        secret.write_text("secret")
        self.addCleanup(secret.unlink)
        code = f"""
import os
for path in {[str(secret), str(ROOT / "course"), "/etc/passwd", "/proc/1/environ", str(Path.home())]!r}:
    if os.path.exists(path): print("sees", path)
for path in ("/x", "/tmp/x", "/usr/x", "/dev/shm/x", {str(self.folder / "x")!r}):
    try: open(path, "w").write("x"); print("writes", path)
    except OSError: pass
"""
        for name in WITH_NAMESPACES:
            self.assertEqual(self.python(name, code).output, "", name)

    def test_no_network(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            code = f"import socket; socket.create_connection(('127.0.0.1', {server.getsockname()[1]}), 5)"
            for name in WITH_NAMESPACES:
                self.assertIn("Error", self.python(name, code).output, name)

    def test_no_process_outside_is_reached(self):
        for name in WORKING:
            if name == "limits":
                continue
            code = f"import os; os.kill({os.getpid()}, 15)"
            self.assertIn("Error", self.python(name, code).output, name)

    def test_what_is_left_behind_ends_with_the_program(self):
        for name in WORKING:
            if name == "limits":
                continue
            mark = f"left-{os.getpid()}-{WORKING.index(name)}"
            code = ("import os, time\n"
                    f"if os.fork() == 0:\n  os.setsid()\n  if os.fork() == 0: os.execv({PYTHON!r}, "
                    f"['{mark}', '-c', 'import time; time.sleep(60)'])\n  os._exit(0)\n"
                    "time.sleep(0.3)")
            self.assertEqual(self.python(name, code).code, 0, name)
            deadline = time.monotonic() + 10  # the kernel kills what is in the namespace, soon
            while (left := _running(mark)) and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertEqual(left, [], name)

    def test_limits_hold(self):
        for name in WORKING:
            with self.subTest(name):
                spins = self.python(name, "while True: pass", Limits(1, 20, 1 << 30, 1 << 20, 16, 1 << 16))
                self.assertIn(spins.code, (-signal.SIGXCPU, 128 + signal.SIGXCPU))
                waits = self.python(name, "import time; time.sleep(60)", Limits(5, 1, 1 << 30, 1 << 20, 16, 1 << 16))
                self.assertTrue(waits.timed_out)
                floods = self.python(name, "while True: print('x' * 1000)")
                self.assertTrue(floods.too_much)
                hogs = self.python(name, "bytearray(2 << 30)")
                self.assertIn("MemoryError", hogs.output)
                bomb = "import os, signal\nfor _ in range(100):\n  if os.fork() == 0: signal.pause()\n"
                forks = self.python(name, bomb, Limits(2, 5, 1 << 30, 1 << 20, 16, 1 << 16))
                # Without a uid of its own: root is exempt, and of a user all processes are counted.
                if name != "limits" and (os.geteuid() != 0 or "uid" in name):
                    self.assertIn("BlockingIOError", forks.output)

    def test_memory_is_not_given_to_what_prints_much(self):
        ended = run([PYTHON, "-c", "import os\nwhile True: os.write(1, b'x' * 65536)"], LIMITS, {})
        self.assertTrue(ended.too_much)
        self.assertLessEqual(len(ended.output), 1 << 17)


class ReadVerdict(unittest.TestCase):
    """Outputs, made by hand, that only broken or hostile programs send."""

    def read(self, *fields: bytes, **more) -> str:
        verdict, reason, _ = read_verdict(Ran(fields or None, **more), 10)
        return f"{verdict}: {reason}" if reason else verdict

    def test_verdicts(self):
        self.assertEqual(self.read(b"0", b"1", b""), "passed")
        self.assertEqual(self.read(b"1", b"1", b"", b"Failed\nwhy"), "failed")
        self.assertEqual(self.read(b"0", b"1", b"", b"Failed\nwhy"), "failed")
        self.assertEqual(self.read(b"0", b"0", b""), "failed: no test ran")
        self.assertEqual(self.read(b"0", b"2", b""), "failed: no test ran")
        self.assertEqual(self.read(b"1", b"1", b""), "failed: no test ran")
        self.assertEqual(self.read(b"0", b"1", b"skipped"), "failed: skipped")
        self.assertEqual(self.read(b"1", b"1", b"", b"got std::bad_alloc"), "out of memory")
        self.assertEqual(self.read(b"0", b"1", b"", nonsense=True), "tampered: a forged answer")

    def test_an_assertion_is_told_and_not_called_an_index(self):
        said = "kick.cpp:7: Vec3 kick(): Assertion `inverse_mass >= 0' failed.\n"
        for output in (said, "x" * 60_000 + "\n" + said, ":1: " * 15_000 + "\n" + said):
            told = read_verdict(Ran(code=-signal.SIGABRT, output=output), 10)[2]
            self.assertIn("The assertion inverse_mass >= 0", told[0])
        self.assertIn("most often an index", read_verdict(Ran(code=-signal.SIGABRT), 10)[2][0])

    def test_a_signal_of_no_index_is_not_called_one(self):
        """SIGILL is that of __builtin_trap(), and none of the others here comes from a wrong index either."""
        for number, told in ((signal.SIGILL, "__builtin_trap()"), (signal.SIGTRAP, "debugger"), (signal.SIGKILL, "memory"),
                             (signal.SIGSYS, "system call"), (signal.SIGTERM, "sent itself this signal")):
            message, = read_verdict(Ran(code=-number), 10)[2]
            self.assertIn(told, message)
            self.assertNotIn("index", message)

    def test_without_a_verdict(self):
        self.assertEqual(self.read(code=0), "ended early: exit code 0")
        self.assertEqual(self.read(code=3), "ended early: exit code 3")
        self.assertIn("Does it call exit?", read_verdict(Ran(code=0), 10)[2][0])
        self.assertIn("far too large", read_verdict(Ran(code=97), 10)[2][0])
        self.assertEqual(self.read(code=-signal.SIGSEGV), "crashed: SIGSEGV")
        self.assertEqual(self.read(code=128 + signal.SIGFPE), "crashed: SIGFPE")
        self.assertEqual(self.read(code=128 + signal.SIGXCPU), "timed out: looped")
        self.assertEqual(self.read(code=-signal.SIGKILL, cpu=10.5), "timed out: looped")
        self.assertEqual(self.read(code=-signal.SIGKILL, cpu=1), "crashed: SIGKILL")
        self.assertEqual(self.read(code=128 + signal.SIGABRT, output="what():  std::bad_alloc"), "out of memory")
        self.assertEqual(self.read(timed_out=True), "timed out: waited")
        self.assertEqual(self.read(timed_out=True, cpu=4), "timed out: looped")
        self.assertEqual(self.read(tests_code=-signal.SIGABRT), "crashed: SIGABRT")
        self.assertEqual(self.read(tests_code=-signal.SIGXCPU), "timed out: looped")
        self.assertEqual(self.read(b"0", b"1", b"", too_much=True), "too much output")


def _running(mark: str) -> list[Path]:
    """Returns the processes whose command line contains the mark."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has ended
            if mark in path.read_text(errors="replace"):
                found.append(path)
    return found


if __name__ == "__main__":
    print(f"isolation that works here: {', '.join(WORKING)}", file=sys.stderr)
    unittest.main()
