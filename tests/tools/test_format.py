"""The layout of the files."""

import re
import shutil
import subprocess
import unittest

from sandbox import ROOT, our_files

CLANG_FORMAT_VERSION = "14"  # others lay out a few things differently
TEXT_WIDTH = 120


def find_clang_format() -> str | None:
    for name in (f"clang-format-{CLANG_FORMAT_VERSION}", "clang-format"):
        program = shutil.which(name)
        if program:
            said = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
            found = re.search(r"version (\d+)", said)
            if found and found[1] == CLANG_FORMAT_VERSION:
                return program
    return None


class Format(unittest.TestCase):
    def test_cpp_files_are_as_clang_format_lays_them_out(self):
        program = find_clang_format()
        if not program:
            self.skipTest(f"clang-format {CLANG_FORMAT_VERSION} is not installed")
        files = [str(name) for name in our_files() if name.suffix in (".cpp", ".hpp")]
        self.assertGreater(len(files), 0)
        result = subprocess.run([program, "--dry-run", "-Werror", *files],
                                capture_output=True, text=True, cwd=ROOT)
        first = [line for line in result.stderr.splitlines() if "error:" in line]
        self.assertEqual(result.returncode, 0, "\n".join(first))

    def test_text_files_are_tidy(self):
        for name in our_files():
            content = (ROOT / name).read_bytes()
            if b"\0" in content or not content:
                continue
            with self.subTest(str(name)):
                if not name.name.endswith("Makefile"):  # whose recipes begin with one
                    self.assertNotIn(b"\t", content, "a tab")
                if name.suffix == ".cmd":  # which Windows reads
                    content = content.replace(b"\r\n", b"\n")
                self.assertNotIn(b"\r", content, "a carriage return")
                self.assertIsNone(re.search(rb"[ ]$", content, re.MULTILINE), "a space at the end of a line")
                self.assertTrue(content.endswith(b"\n"), "no newline at the end")
                self.assertFalse(content.endswith(b"\n\n"), "an empty line at the end")

    def test_text_is_no_wider_than_it_may_be(self):
        for name in our_files():
            if name.suffix != ".md":
                continue
            fenced = False
            for number, line in enumerate((ROOT / name).read_text(encoding="utf-8").splitlines(), 1):
                fenced ^= line.startswith("```")
                # Formulas, tables and images cannot be broken.
                if not fenced and not line.startswith(("|", "![")):
                    self.assertLessEqual(len(line), TEXT_WIDTH, f"{name}, line {number}: {line}")


if __name__ == "__main__":
    unittest.main()
