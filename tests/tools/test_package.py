"""The engine as a package: another program finds it installed, or adds its sources."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT

from tree import Tree

PAGE = ROOT / "solutions" / "engine" / "README.md"
SAYS = re.search(r"It prints `(.+)`", PAGE.read_text(encoding="utf-8"))[1]
WARNINGS = "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror"
SUBDIRECTORY = 'add_subdirectory("{}" spook)'


def block(language: str) -> str:
    return re.search(rf"```{language}\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[1]


def run(*command) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          env=os.environ | {"LC_ALL": "C"})


class Consumer:
    """A project of a dozen lines: the page's example."""

    def __init__(self, folder: Path, lists: str):
        self.folder = folder
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(lists)
        (folder / "slope.cpp").write_text(block("cpp"))

    def configure(self, *settings: str) -> subprocess.CompletedProcess:
        return run("cmake", "-G", "Ninja", "-S", self.folder, "-B", self.folder / "build", *settings)

    def build(self) -> subprocess.CompletedProcess:
        return run("cmake", "--build", self.folder / "build")

    def says(self) -> str:
        return run(self.folder / "build" / "slope").stdout.strip()


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._scratch = tempfile.TemporaryDirectory(prefix="course-package-")
        cls.scratch = Path(cls._scratch.name).resolve()
        cls.addClassCleanup(cls._scratch.cleanup)
        tree = Tree("release")
        built = tree.build(["spook_package"], "building the package")
        assert built.ok, built.output
        cls.prefix = cls.scratch / "prefix"
        installed = run("cmake", "--install", tree.path, "--prefix", cls.prefix)
        assert installed.returncode == 0, installed.stderr

    def consumer(self, name: str, lists: str | None = None) -> Consumer:
        return Consumer(self.scratch / name, lists or block("cmake"))

    def configured(self, consumer: Consumer, *settings: str) -> None:
        done = consumer.configure(f"-DCMAKE_PREFIX_PATH={self.prefix}", *settings)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def built(self, consumer: Consumer) -> None:
        done = consumer.build()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(consumer.says(), SAYS)

    def test_an_installed_one_is_found_and_our_headers_have_no_warnings_that_we_turn_on(self):
        consumer = self.consumer("installed")
        self.configured(consumer, f"-DCMAKE_CXX_FLAGS={WARNINGS}")
        self.built(consumer)

    def test_folders_of_the_users_with_our_names_do_not_come_in_between(self):
        consumer = self.consumer("same_names")
        for name in ("engine/world/world.hpp", "engine/constraints/joints.hpp", "common/types.hpp", "07_impacts/impacts.hpp"):
            (consumer.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (consumer.folder / name).write_text("#error This is the user's own.\n")
        self.configured(consumer, f"-DCMAKE_CXX_FLAGS=-I{consumer.folder}")
        self.built(consumer)

    def test_another_alignment_is_an_error_that_names_it(self):
        consumer = self.consumer("other_flags")
        self.configured(consumer, "-DCMAKE_CXX_FLAGS=-DEIGEN_MAX_ALIGN_BYTES=128")
        done = consumer.build()
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"LibraryCompiledWith<.*AlignedTo<128>")

    def test_a_later_version_is_not_found(self):
        for version, found in (("1.0", True), ("1.99", False), ("2.0", False)):
            with self.subTest(version):
                consumer = self.consumer(f"version_{version}", block("cmake").replace("spook 1.0", f"spook {version}"))
                done = consumer.configure(f"-DCMAKE_PREFIX_PATH={self.prefix}")
                self.assertEqual(done.returncode == 0, found, done.stderr)

    def test_it_is_a_library_and_headers_and_hands_on_no_flags(self):
        files = [path.relative_to(self.prefix) for path in self.prefix.rglob("*") if path.is_file()]
        others = sorted(path.name for path in files if path.suffix not in (".hpp", ".cmake"))
        self.assertEqual(others, ["libspook.a", "spook.pc"])
        self.assertEqual([path for path in files if "scenes" in path.parts], [])
        targets = "".join(path.read_text() for path in self.prefix.rglob("spookTargets*.cmake"))
        self.assertNotRegex(targets, r"COMPILE_OPTIONS|-m|-W|-std")
        self.assertNotIn(str(ROOT), targets)

    def test_pkg_config_finds_it_wherever_it_was_moved(self):
        if not shutil.which("pkg-config"):
            self.skipTest("pkg-config is not installed")
        file = next(self.prefix.rglob("spook.pc"))
        self.assertNotIn(str(self.prefix), file.read_text())
        told = subprocess.run(["pkg-config", "--cflags", "--libs", "--static", "spook"], capture_output=True, text=True,
                              env=os.environ | {"PKG_CONFIG_PATH": str(file.parent)})
        self.assertEqual(told.returncode, 0, told.stderr)
        folders = [Path(word[2:]).resolve() for word in told.stdout.split() if word.startswith(("-I", "-L"))]
        self.assertIn(self.prefix / "include", folders)
        self.assertTrue(any((folder / "libspook.a").exists() for folder in folders), folders)

    def test_the_version_is_a_macro(self):
        version = re.search(r"VERSION (\d+)\.(\d+)\.(\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
        text = (self.prefix / "include" / "spook" / "version.hpp").read_text()
        for part, number in zip(("MAJOR", "MINOR", "PATCH"), version.groups()):
            self.assertIn(f"#define SPOOK_VERSION_{part} {number}\n", text)

    def test_as_a_subdirectory_it_takes_the_users_flags_and_neither_warns_nor_needs_the_programs_libraries(self):
        lists = block("cmake").replace("find_package(spook 1.0 REQUIRED)", SUBDIRECTORY.format(ROOT))
        self.assertIn("add_subdirectory", lists)
        consumer = self.consumer("subdirectory", lists)
        launcher = [sys.executable, Path(__file__).with_name("copy_object.py"), Tree("release").path / "compile_commands.json"]
        self.configured(consumer, "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS=-O0 -g0", "-DBUILD_SHARED_LIBS=ON",
                        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
                        *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("CLI11", "nlohmann_json", "GTest")),
                        f"-DCMAKE_CXX_COMPILER_LAUNCHER={';'.join(map(str, launcher))}")
        self.built(consumer)
        prefix = self.scratch / "of_the_user"
        installed = run("cmake", "--install", consumer.folder / "build", "--prefix", prefix)
        self.assertEqual(installed.returncode, 0, installed.stderr)
        self.assertEqual([path for path in prefix.rglob("*") if path.is_file()], [])  # it did not ask for our files
        library = next(consumer.folder.rglob("libspook.so"))
        names = run("nm", "-DC", "--defined-only", library).stdout.splitlines()
        self.assertGreater(len(names), 100)
        self.assertEqual([name for name in names if "spook::" not in name], [])
        commands = run("ninja", "-C", consumer.folder / "build", "-t", "commands", "slope").stdout
        self.assertNotIn("-Werror", commands)
        self.assertNotRegex(commands, r"/scenes/|-O[123]|-march")


if __name__ == "__main__":
    unittest.main()
