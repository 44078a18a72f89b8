"""Other systems, simulated on Linux: macOS with Homebrew, conda, Windows' shells."""

import contextlib
import io
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from sandbox import ROOT, TOOLS, Sandbox, all_exercises

sys.path.append(str(TOOLS))

import bare_machine
import diagnostics
import everything
import install
import javascript
import machine
import needs
import packages
import symbols
import trial
from arguments import parse
from errors import CourseError
from exporting.export import export
from grading.grade import grade
from needs import BOOK_NEEDS, LIVE_NEEDS, NEEDS, PYTHON_NEEDS, VIEW_NEEDS
from trial import run_limited

_SYSTEM_TOOLS = ("sh", "dirname", "readlink", "id", "cat", "chmod", "mkdir", "touch", "env")
# Takes away what Python has on Linux only, before the course begins.
_MAC_PYTHON = """
import os, resource
_said = os.uname()
os.uname = lambda: os.uname_result(("Darwin", *_said[1:]))
del os.sched_getaffinity, resource.prlimit
"""
_BREW = """#!/bin/sh
echo "$@" >>"$FAKE/asked"
mkdir -p "$FAKE/include/eigen3/Eigen" "$FAKE/include/gtest" "$FAKE/include/CLI" "$FAKE/include/nlohmann"
touch "$FAKE/include/eigen3/Eigen/Core" "$FAKE/include/gtest/gtest.h" "$FAKE/include/CLI/CLI.hpp" \\
  "$FAKE/include/nlohmann/json.hpp"
for name in cmake ninja git; do
  printf '#!/bin/sh\\nexit 3\\n' >"$FAKE/bin/$name"; chmod +x "$FAKE/bin/$name"
done
"""


class Fake:
    """A folder of programs as the whole PATH."""

    def __init__(self, test: unittest.TestCase):
        folder = tempfile.TemporaryDirectory(prefix="machine-")
        test.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        (self.root / "bin").mkdir()
        for name in _SYSTEM_TOOLS:
            (self.root / "bin" / name).symlink_to(shutil.which(name))

    def program(self, name: str, text: str) -> None:
        path = self.root / "bin" / name
        path.unlink(missing_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def mac(self) -> dict[str, str]:
        """Returns the environment of a Mac with Apple's compiler."""
        self.program("uname", "#!/bin/sh\necho Darwin\n")
        self.program("c++", "#!/bin/sh\necho Apple clang version 15.0.0\n")
        (self.root / "python").mkdir()
        (self.root / "python" / "sitecustomize.py").write_text(_MAC_PYTHON)
        return self.environment() | {"PYTHONPATH": str(self.root / "python"), "HOMEBREW_PREFIX": str(self.root)}

    def environment(self) -> dict[str, str]:
        return {"PATH": str(self.root / "bin"), "FAKE": str(self.root), "CXX": "", "CONDA_PREFIX": ""}


class Mac(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Sandbox()
        cls.addClassCleanup(cls.box.close)

    def setUp(self):
        self.fake = Fake(self)
        self.env = self.fake.mac()

    def test_start_asks_homebrew_for_what_is_missing_and_goes_on(self):
        self.fake.program("brew", _BREW)
        done = self.box.course("start", "--yes", **self.env)
        self.assertEqual((self.fake.root / "asked").read_text().split(),
                         ["install", "cmake", "ninja", "git", "eigen", "googletest", "cli11", "nlohmann-json"])
        system = re.search(r"^This course is tested on (macOS \d+)\. .*need Linux\.$", done.stdout,
                           re.MULTILINE)[1]
        self.assertIn(f"runs-on: {system.lower().replace(' ', '-')}\n",
                      (ROOT / ".github" / "workflows" / "releases.yml").read_text(encoding="utf-8"))
        # All is there now; the cmake that brew has brought cannot do more than fail.
        self.assertEqual(done.returncode, 1)
        self.assertIn("CMake failed", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_the_python_module_asks_homebrew_for_names_that_it_knows(self):
        self.fake.program("brew", _BREW)
        self.box.course("python", "--yes", **self.env)
        asked = (self.fake.root / "asked").read_text().split()
        self.assertIn("pybind11", asked)
        self.assertLessEqual(set(asked[1:]), set(packages.BREW.values()))

    def test_nothing_is_installed_without_an_answer(self):
        self.fake.program("brew", _BREW)
        done = self.box.course("start", **self.env)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("install with:  brew install cmake ninja git eigen", done.stderr)
        self.assertNotIn("apt", done.stderr)
        self.assertFalse((self.fake.root / "asked").exists())

    def test_without_homebrew_it_says_what_that_is(self):
        done = self.box.course("start", "--yes", **self.env)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("brew is the command of Homebrew", done.stderr)

    def test_without_apples_compiler(self):
        self.fake.program("brew", _BREW)
        (self.fake.root / "bin" / "c++").unlink()
        done = self.box.course("start", "--yes", **self.env)
        self.assertIn("install with:  xcode-select --install && brew install", done.stderr)

    def test_what_needs_nothing_works(self):
        done = self.box.course("hint", "1.1", **self.env)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("hint 1 of", done.stdout)


class MacParts(unittest.TestCase):
    def setUp(self):
        patch = mock.patch.object(machine, "is_mac", return_value=True)
        patch.start()
        self.addCleanup(patch.stop)

    def test_modules_go_into_an_environment_of_the_courses_own_and_the_command_begins_anew(self):
        with mock.patch.object(install.shutil, "which", lambda name: f"/opt/homebrew/bin/{name}"), \
             mock.patch.object(install, "_run") as run, mock.patch.object(install.os, "execv") as anew:
            install._install(["ninja-build", "python3-numpy", "python3-matplotlib", "libjs-three"], yes=True)
        ours = str(ROOT / ".course" / "python")
        self.assertEqual([call.args[0] for call in run.call_args_list], [
            ["brew", "install", "ninja"],
            ["npm", "install", "--prefix", str(ROOT / ".course" / "npm"), "three@0.111.0"],
            [sys.executable, "-m", "venv", ours], [f"{ours}/bin/pip", "install", "numpy", "matplotlib"]])
        anew.assert_called_once_with(f"{ours}/bin/python3", [f"{ours}/bin/python3", *sys.argv])

    def test_npm_comes_with_node(self):
        with mock.patch.object(install.shutil, "which", return_value=None):
            self.assertTrue(install.install_line(["libjs-katex"]).startswith("brew install node && npm install "))

    def test_the_table_has_all_that_a_student_needs(self):
        known = {*packages.BREW, *packages.PIP, *packages.NPM, *packages.APPLE}
        for need in NEEDS + BOOK_NEEDS + VIEW_NEEDS + LIVE_NEEDS + PYTHON_NEEDS:
            self.assertIn(need.package, known)
        lists = [value for name, value in vars(needs).items() if name.endswith("NEEDS")]
        self.assertGreater(len(lists), 8)
        for need in [need for each in lists for need in each]:
            self.assertIn(need.package, {*known, *packages.LINUX_ONLY})

    def test_brew_is_not_asked_for_a_name_that_it_does_not_know(self):
        with mock.patch.object(install.shutil, "which", lambda name: f"/opt/homebrew/bin/{name}"), \
             mock.patch.object(install, "_run") as run, self.assertRaises(CourseError) as caught:
            install._install(["libode-dev", "libmujoco-dev"], yes=True)
        self.assertEqual(str(caught.exception), "missing: libode-dev libmujoco-dev; install with:  brew install ode  "
                                                "(not in Homebrew: libmujoco-dev)")
        run.assert_not_called()

    def test_the_python_module_needs_a_header_of_this_python(self):
        header = next(need for need in PYTHON_NEEDS if need.package == "python3-dev")
        self.assertEqual(Path(header.name), Path(sysconfig.get_path("include"), "Python.h"))
        self.assertEqual(install.install_line(["pybind11-dev", "python3-dev"]), "brew install pybind11 python")

    def test_headers_and_libraries_are_where_homebrew_and_npm_put_them(self):
        with mock.patch.dict(os.environ, {"HOMEBREW_PREFIX": "/brew"}):
            self.assertEqual(machine.header_folders(), ("/brew/include", "/brew/include/eigen3"))
        with mock.patch.object(javascript, "_DEBIAN", Path("/nowhere")), \
             mock.patch.object(javascript, "is_mac", return_value=True):
            npm = ROOT / ".course" / "npm" / "node_modules"
            self.assertEqual((javascript.three(), javascript.three_min(), javascript.katex()),
                             (npm / "three", npm / "three/build/three.min.js", npm / "katex/dist"))

    def test_apples_stand_ins_are_no_compiler(self):
        with mock.patch.object(machine.shutil, "which", lambda name: f"/usr/bin/{name}"), \
             mock.patch.object(machine.subprocess, "run") as run:
            for code, there in ((2, False), (0, True)):
                run.return_value.returncode = code
                self.assertEqual(machine.has_command("c++"), there)
            self.assertTrue(machine.has_command("ninja"))


    def test_what_needs_linux_says_so_in_one_line(self):
        for command, *words in ((grade, "grade", "."), (everything.test, "test", "--all"),
                                (export, "export", "students", "--out", "/tmp/nowhere")):
            with self.subTest(words), self.assertRaises(CourseError) as caught:
                command(parse(words))
            self.assertIn("needs Linux", str(caught.exception))

    def test_what_is_compiled_is_tested_and_the_rest_is_named(self):
        passed = everything.Outcome("check", 3, [], [], True)
        with mock.patch.object(everything, "install"), mock.patch.object(everything, "_build") as build, \
             mock.patch.object(everything, "_run", return_value=passed) as run, \
             contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(everything.test(parse(["test"])), 0)
        self.assertEqual(build.call_args.args[1], ["fast"])
        self.assertEqual(run.call_args.args[1], ["-L", "^(fast)$", "-E", r"^tools\."])
        self.assertIn("3 of 3 tests passed\nLeft out: mutant.*, plot.*, tools.*", said.getvalue())

    def test_apple_s_linker_names_a_function_in_the_line_below(self):
        for output, told in (
                ('Undefined symbols for architecture arm64:\n  "spook::twice(int)", referenced from:\n      a.o\n',
                 'Undefined symbols for architecture arm64: "spook::twice(int)", referenced from:'),
                ("duplicate symbol 'spook::kick(int)' in:\n    a.o\n", "duplicate symbol 'spook::kick(int)' in: a.o"),
                ("x.o: undefined reference to `f()'\ny", "undefined reference to `f()'"),
                ("ld.lld: error: undefined symbol: f()\ny", "undefined symbol: f()")):
            self.assertEqual(diagnostics.linker_error(output), told)


class Lines(unittest.TestCase):
    """Source lines in the formats of each system's tool; the distances are hexadecimal."""

    def lines(self, tool: str, told: str, mac: bool) -> tuple[list[tuple[str, int]], str]:
        fake = Fake(self)
        fake.program(tool, f"#!/bin/sh\necho \"$@\" >\"$FAKE/asked\"\ncat <<'end'\n{told}end\n")
        with mock.patch.dict(os.environ, fake.environment()), mock.patch.object(machine, "is_mac", return_value=mac):
            found = machine.lines_at(Path("check"), ["1a", "2b"])
        return found, (fake.root / "asked").read_text().strip()

    def test_on_linux(self):
        found, asked = self.lines("addr2line", "/c/kick.cpp:7 (discriminator 2)\n??:0\n/c/my drift.cpp:3\n", False)
        self.assertEqual(found, [("/c/kick.cpp", 7), ("??", 0), ("/c/my drift.cpp", 3)])
        self.assertEqual(asked, "-i -e check 1a 2b")

    def test_on_macos(self):
        found, asked = self.lines("atos", "spook::kick(int) (in check) (/c/my kick.cpp:7)\n\n0x2b (in check)\n", True)
        self.assertEqual(found, [("/c/my kick.cpp", 7)])
        self.assertEqual(asked, "-o check -fullPath -i -offset 0x1a 0x2b")

    def test_without_the_tool(self):
        with mock.patch.dict(os.environ, Fake(self).environment()):
            self.assertEqual(machine.lines_at(Path("check"), ["1a"]), [])


class Processor(unittest.TestCase):
    def model(self, mac: bool, program: str = "") -> str:
        fake = Fake(self)
        if program:
            fake.program("sysctl", program)
        with mock.patch.dict(os.environ, fake.environment()), mock.patch.object(machine, "is_mac", return_value=mac):
            return machine.processor_model()

    def test_on_linux(self):
        with mock.patch.object(machine.Path, "read_text", return_value="processor\t: 0\nmodel name\t: Fast 3000\n"):
            self.assertEqual(self.model(mac=False), "Fast 3000")

    def test_on_macos(self):
        program = '#!/bin/sh\n[ "$*" = "-n machdep.cpu.brand_string" ] && echo Apple M1\n'
        self.assertEqual(self.model(mac=True, program=program), "Apple M1")
        self.assertEqual(self.model(mac=True), "")

    def test_no_other_file_asks_the_system(self):
        asking = [file.name for file in ROOT.glob("tools/course/**/*.py")
                  if re.search("/proc/cpuinfo|sysctl", file.read_text(encoding="utf-8"))]
        self.assertEqual(asking, ["machine.py"])


class Symbols(unittest.TestCase):
    """Reads symbols as nm lists them on macOS, with one more _ before each name."""

    NAMES = "__ZN5spook4kickEv T 0 0\n__ZN5spook4kickEi t 0 0\n__ZN5spook5driftEv T 0 0\n_main T 0 0\n\n"

    def setUp(self):
        fake = Fake(self)
        fake.program("nm", f"#!/bin/sh\ncat <<'end'\n{self.NAMES}end\n")
        self.file = fake.root / "object"
        self.file.touch()
        patch = mock.patch.dict(os.environ, fake.environment())
        patch.start()
        self.addCleanup(patch.stop)

    def test_they_are_found(self):
        self.assertEqual(symbols.functions_in(self.file, "kick"), {"_ZN5spook4kickEv"})

    def test_an_empty_reference_is_no_reason_to_pass(self):
        exercise = next(exercise for exercise in all_exercises() if exercise.function == "residual")
        with mock.patch.object(symbols, "reference_functions", return_value=set()), \
             self.assertRaises(CourseError) as caught:
            symbols.missing_functions(mock.Mock(), exercise)
        self.assertIn("nm finds no residual", str(caught.exception))


class Conda(unittest.TestCase):
    def setUp(self):
        self.fake = Fake(self)
        (self.fake.root / "include" / "eigen3").mkdir(parents=True)

    def test_an_environment_for_the_course_is_asked_and_no_other(self):
        for prefix, there in ((self.fake.root, self.fake.root), (self.fake.root / "bin", None), ("", None)):
            with mock.patch.dict(os.environ, {"CONDA_PREFIX": str(prefix)}):
                self.assertEqual(machine.conda(), there)

    def test_what_is_missing_is_said_in_its_words(self):
        with mock.patch.dict(os.environ, {"CONDA_PREFIX": str(self.fake.root)}), \
             self.assertRaises(CourseError) as caught:
            install._install(["ninja-build"], yes=True)
        self.assertEqual(str(caught.exception),
                         "missing: ninja-build; install with:  conda env update -f environment.yml")
        with mock.patch.dict(os.environ, {"CONDA_PREFIX": str(self.fake.root)}):
            include = f"{self.fake.root}/include"
            self.assertEqual(machine.header_folders(), (include, f"{include}/eigen3"))

    def test_libraries_for_the_browser_come_by_npm(self):
        with mock.patch.dict(os.environ, {"CONDA_PREFIX": str(self.fake.root)}), \
             mock.patch.object(install.shutil, "which", return_value="npm"), mock.patch.object(install, "_run") as run:
            install._install(["libjs-three"], yes=True)
        self.assertEqual(run.call_args.args[0][:2], ["npm", "install"])

    def test_its_python_runs_the_course(self):
        self.fake.program("python3", f'#!/bin/sh\necho by conda >&2\nexec {sys.executable} "$@"\n')
        done = subprocess.run([ROOT / "course", "--version"], capture_output=True, text=True,
                              env=os.environ | {"CONDA_PREFIX": str(self.fake.root)})
        self.assertEqual(done.returncode, 0)
        self.assertIn("by conda", done.stderr)

    def test_the_file_has_all_that_start_needs(self):
        text = (ROOT / "environment.yml").read_text(encoding="utf-8")
        listed = dict(re.findall(r"^  - ([\w-]+)(?:>=([\d.]+))?$", text, re.MULTILINE))
        names = {"ninja-build": "ninja", "g++": "cxx-compiler", "clang": "cxx-compiler", "libeigen3-dev": "eigen",
                 "libgtest-dev": "gtest", "libcli11-dev": "cli11", "nlohmann-json3-dev": "nlohmann_json",
                 "python3-numpy": "numpy", "python3-matplotlib": "matplotlib-base"}
        for need in NEEDS:
            name = names.get(need.package, need.package)
            self.assertIn(name, listed)
            if name != "cxx-compiler":
                self.assertEqual(listed[name], need.least, name)


class WithoutRoot(unittest.TestCase):
    def test_it_says_what_is_missing_and_how_to_get_it_in_ones_own_space(self):
        with mock.patch.object(install, "_is_root", return_value=False), \
             mock.patch.object(install.shutil, "which", lambda name: name if name == "apt-get" else None), \
             mock.patch.object(install, "stream", side_effect=AssertionError), self.assertRaises(CourseError) as caught:
            install._install(["ninja-build", "libeigen3-dev"], yes=True)
        said = str(caught.exception)
        for text in ("missing: ninja-build libeigen3-dev;", "sudo apt-get install",
                     "without root, in your own space:  conda env create -f environment.yml"):
            self.assertIn(text, said)
        self.assertNotIn("\n", said)


class PythonWithoutLinux(unittest.TestCase):
    def test_processors(self):
        self.assertEqual(machine.processors(), len(os.sched_getaffinity(0)))
        with mock.patch.object(machine, "os", mock.Mock(spec=["cpu_count"])) as without:
            without.cpu_count.return_value = 7
            self.assertEqual(machine.processors(), 7)
            without.cpu_count.return_value = None
            self.assertEqual(machine.processors(), 1)

    def limited(self, text: str, **options) -> tuple[int, bool, str]:
        """Returns the exit code, whether it took too long, and the output, of a shell's program."""
        with tempfile.TemporaryDirectory() as folder, open(Path(folder, "out"), "wb") as out:
            command = ["sh", "-c", text, "a name", "two words"]
            code, late = run_limited(command, out, dict(os.environ), folder, **options)
            return code, late, Path(folder, "out").read_text()

    def test_limits(self):
        for how, calls in (("by a shell", mock.Mock(spec=[])), ("by prlimit", resource)):
            # A busy machine may have its second of processor time for a loop in minutes.
            with self.subTest(how), mock.patch.object(machine, "resource", calls), \
                 mock.patch.object(trial, "_PATIENCE", 600):
                self.assertEqual(self.limited('printf %s "$1"; exit 3'), (3, False, "two words"))
                self.assertEqual(self.limited("while :; do :; done", processor=1)[:2], (-signal.SIGXCPU, True))
                code, _, said = self.limited("sleep 0.2; ulimit -f; ulimit -c")  # prlimit needs a moment
                self.assertEqual((code, said.split()), (0, [str((64 << 20) // 512), "0"]))


class Command(unittest.TestCase):
    """The script `course` before it has a Python."""

    def run_course(self, fake: Fake, *words: str, command: Path | str = ROOT / "course", cwd: Path | None = None):
        return subprocess.run([str(command), *words], capture_output=True, text=True, env=fake.environment(), cwd=cwd)

    def test_windows_shells_are_sent_to_wsl_in_one_line(self):
        for name in ("MINGW64_NT-10.0-19045", "MSYS_NT-10.0", "CYGWIN_NT-10.0"):
            fake = Fake(self)
            fake.program("uname", f"#!/bin/sh\necho {name}\n")
            done = self.run_course(fake, "check")
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1))
            self.assertIn("WSL", done.stderr)

    def test_windows_own_shell_is_told_the_same(self):
        script = (ROOT / "course.cmd").read_bytes().decode("ascii")
        told = re.search(r"echo '(course: this is Windows.*)' >&2", (ROOT / "course").read_text(encoding="utf-8"))[1]
        self.assertIn(f"echo {told} 1>&2\n", script.replace("\r\n", "\n"))
        self.assertNotRegex(told, r"[&|<>^%\"]")  # what cmd does not print as it stands
        self.assertTrue(script.replace("\r\n", "\n").endswith("exit /b 1\n"))

    def test_a_mac_s_python_is_too_old_and_homebrew_has_a_newer_one(self):
        fake = Fake(self)
        fake.program("uname", "#!/bin/sh\necho Darwin\n")
        fake.program("id", "#!/bin/sh\necho 501\n")
        fake.program("apples", '#!/bin/sh\n[ "$1" = --version ] && echo Python 3.9.6\n')
        command = fake.root / "course"  # with Apple's Python in place of this machine's
        text = (ROOT / "course").read_text(encoding="utf-8")
        command.write_text(text.replace("/usr/bin/python3", str(fake.root / "bin" / "apples")))
        command.chmod(0o755)
        (fake.root / "tools").symlink_to(ROOT / "tools")
        done = self.run_course(fake, "hint", command=command)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "course: Python 3.9.6 was found, and the course needs Python 3.10 or newer; "
                                      "install it with:  brew install python\n")
        fake.program("brew", f"""#!/bin/sh
echo "$@" >"$FAKE/asked"
printf '#!/bin/sh\\nexec {sys.executable} "$@"\\n' >"$FAKE/bin/python3"; chmod +x "$FAKE/bin/python3"
""")
        done = self.run_course(fake, "hint", "--yes", command=command)
        self.assertEqual((fake.root / "asked").read_text(), "install python\n")
        self.assertIn("Installing Python", done.stderr)
        self.assertIn("course hint", done.stderr)  # the course itself runs now

    def test_links_are_followed_where_readlink_knows_no_f(self):
        fake = Fake(self)
        fake.program("uname", "#!/bin/sh\necho Darwin\n")
        fake.program("readlink", f'#!/bin/sh\ncase $1 in -*) exit 1;; esac\nexec {shutil.which("readlink")} "$1"\n')
        (fake.root / "one").symlink_to(ROOT / "course")
        (fake.root / "folder").mkdir()
        (fake.root / "folder" / "two").symlink_to("../one")
        for command, cwd in ((fake.root / "folder" / "two", None), ("./two", fake.root / "folder")):
            done = self.run_course(fake, "--version", command=command, cwd=cwd)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(done.stdout.startswith("course "))


    def test_a_cdpath_leads_nowhere_else(self):
        fake = Fake(self)
        (fake.root / "there" / "tools").mkdir(parents=True)
        done = subprocess.run(["tools/../course", "--version"], capture_output=True, text=True, cwd=ROOT,
                              env=os.environ | {"CDPATH": f"{fake.root / 'there'}:{ROOT}"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.count("\n"), 1)


class Container(unittest.TestCase):
    def test_it_starts_the_course_and_has_the_editors_extensions(self):
        told = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text(encoding="utf-8"))
        self.assertEqual(told["onCreateCommand"], "./course start --yes")
        self.assertIn("clangd gdb", told["postCreateCommand"])  # as CONTRIBUTING.md has it for editors
        for step in ("onCreateCommand", "postCreateCommand"):
            self.assertIn(told[step], bare_machine.of_container())
        wanted = json.loads((ROOT / ".vscode" / "extensions.json").read_text(encoding="utf-8"))["recommendations"]
        self.assertEqual(told["customizations"]["vscode"]["extensions"], wanted)


if __name__ == "__main__":
    unittest.main()
