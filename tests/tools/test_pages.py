"""The reference pages: their statements about Eigen are compiled and run, and they are linked."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT

PAGES = ROOT / "chapters"
_BLOCK = re.compile(r"^```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_DOCSTRING = re.compile(r"((?:^///.*\n)+)((?:(?!///).*\n)*?.*[;{])", re.MULTILINE)
_CLAIM = re.compile(r"^(\s*)(\S.*);\s+// = (.+)$")
_MAIN = """\
#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <vector>

#include "11_direct/direct.hpp"

using namespace spook;

std::vector<double> numbers(double x) { return {x}; }
std::vector<double> numbers(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }
template <class Derived>
std::vector<double> numbers(const Eigen::DenseBase<Derived>& values) {
  const Eigen::MatrixXd all = values;
  return {all.reshaped().begin(), all.reshaped().end()};
}

int wrong = 0;
template <class Got>
void check(const char* place, const Got& got, const std::vector<double>& wanted) {
  const std::vector<double> found = numbers(got);
  bool same = found.size() == wanted.size();
  for (std::size_t k = 0; same && k < found.size(); ++k) same = std::abs(found[k] - wanted[k]) <= 1e-14;
  if (same) return;
  ++wrong;
  std::cout << place << " is";
  for (const double number : found) std::cout << ' ' << number;
  std::cout << '\\n';
}
"""


def program(page: Path) -> tuple[str, int]:
    """Returns all code of a page, each piece as a function whose claims are checked; and their number."""
    text = page.read_text(encoding="utf-8")
    functions, claims = [], 0
    for k, found in enumerate(_BLOCK.finditer(text)):
        line = text.count("\n", 0, found.start()) + 1
        body = []
        for code in found[1].splitlines():
            line += 1
            claim = _CLAIM.match(code)
            if claim:
                claims += 1
                place = f"{page.name}:{line}: {claim[2]}".replace("\\", "\\\\").replace('"', '\\"')
                code = f'check("{place}", {claim[2]}, {{{claim[3].strip("()")}}});'
            body.append(f'#line {line} "{page.name}"\n{code}')
        functions.append(f"void piece_{k}() {{\n" + "\n".join(body) + "\n}\n")
    calls = " ".join(f"piece_{k}();" for k in range(len(functions)))
    return f"{_MAIN}\n{''.join(functions)}\nint main() {{ {calls} return wrong; }}\n", claims


class Code(unittest.TestCase):
    def run_page(self, name: str, text: str | None = None) -> subprocess.CompletedProcess:
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder, name)
            page.write_text(text or (PAGES / name).read_text(encoding="utf-8"), encoding="utf-8")
            source, claims = program(page)
            self.assertGreater(claims, 0)
            file, out = Path(folder, "main.cpp"), Path(folder, "main")
            file.write_text(source, encoding="utf-8")
            command = [os.environ.get("CXX") or "c++", "-std=c++20", "-w", f"-I{PAGES}", "-I/usr/include/eigen3",
                       "-I/usr/local/include/eigen3", str(file), "-o", str(out)]
            built = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(built.returncode, 0, built.stderr)
            return subprocess.run([str(out)], capture_output=True, text=True)

    def test_what_they_say_is_so(self):
        for name in ("EIGEN.md", "NUMBERS.md"):
            with self.subTest(name):
                result = self.run_page(name)
                self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_what_is_not_so_is_told(self):
        text = "Text\n\n```cpp\nVec3 a(1, 2, 3);\na;   // = (1, 2, 4)\n2 > 1;   // = false\n```\n"
        result = self.run_page("page.md", text)
        self.assertEqual(result.stdout.splitlines(), ["page.md:5: a is 1 2 3", "page.md:6: 2 > 1 is 1"])


class Symbols(unittest.TestCase):
    def test_each_has_a_unit_and_an_equation_of_a_lesson(self):
        text = (PAGES / "SYMBOLS.md").read_text(encoding="utf-8")
        tags = {tag for lesson in PAGES.glob("[0-9][0-9]_*/README.md")
                for tag in re.findall(r"\\tag\{([0-9.]+[a-z]?)\}", lesson.read_text(encoding="utf-8"))}
        rows = [line for line in text.splitlines() if line.startswith("| ") and not line.startswith("| | is")]
        self.assertGreater(len(rows), 50)
        for row in rows:
            cells = [cell.strip() for cell in row.strip("|").split("|")]
            with self.subTest(cells[0]):
                self.assertEqual(len(cells), 5)
                entered = re.findall(r"\(([0-9]+\.[0-9]+[a-z]?)\)", cells[3])
                self.assertTrue(entered)
                self.assertEqual([tag for tag in entered if tag not in tags], [])
        self.assertEqual([tag for tag in re.findall(r"\(([0-9]+\.[0-9]+[a-z]?)\)", text) if tag not in tags], [])

    def test_what_it_names_in_code_is_there(self):
        text = (PAGES / "SYMBOLS.md").read_text(encoding="utf-8")
        headers = "".join(path.read_text(encoding="utf-8") for path in sorted(PAGES.glob("*/*.hpp")))
        for name in re.findall(r"`([^`]+)`", text):
            word = re.split(r"::|\.|\[", name)[-1 if "::" in name else 0]
            self.assertRegex(headers, rf"\b{re.escape(word)}\b", name)


class Numbers(unittest.TestCase):
    def test_headers_do_not_repeat_the_rules(self):
        """A docstring speaks of NaN only where the page says that this function has a rule of its own."""
        own = (PAGES / "NUMBERS.md").read_text(encoding="utf-8").partition("## Rules of their own")[2]
        known = set(re.findall(r"^\| `(\w+)`", own, re.MULTILINE))
        self.assertGreater(len(known), 3)
        for header in sorted(PAGES.glob("[0-9][0-9]_*/*.hpp")):
            for docstring, declared in _DOCSTRING.findall(header.read_text(encoding="utf-8")):
                if "NaN" in docstring:
                    function = re.search(r"(\w+)\(", declared)
                    self.assertIn(function and function[1], known, f"{header.name}: {docstring}")


class Linked(unittest.TestCase):
    def test_from_the_front_page(self):
        front = (ROOT / "README.md").read_text(encoding="utf-8")
        for page in sorted(PAGES.glob("*.md")):
            self.assertIn(f"(chapters/{page.name})", front)


if __name__ == "__main__":
    unittest.main()
