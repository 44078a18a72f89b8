"""The packages that the course needs: Debian's name, a sign that it is present, and the oldest sufficient version."""

import importlib.metadata
import importlib.util
import os
import re
import shutil
import subprocess
import sysconfig
from dataclasses import dataclass
from pathlib import Path

import javascript
import machine

# The library for drawing in a browser.
THREE, THREE_MIN = javascript.three(), javascript.three_min()
# The library for formulas, and the book's typeface.
KATEX = javascript.katex()
BOOK_FONTS = tuple(machine.fonts() / f"LinLibertine_{style}.otf" for style in ("R", "RI", "RB", "RBI"))
_HEADER_FOLDERS = machine.header_folders()


@dataclass(frozen=True)
class Need:
    package: str  # of Debian and Ubuntu
    kind: str  # command, header, module, file, or sanitizers, which `name`, a compiler, can link
    name: str  # of the command, header, module or file that the package, or the same thing from elsewhere, brings
    least: str = ""  # version; empty: any will do
    versions: tuple[str, ...] = ()  # of a header: files that may hold its version, as macros
    macros: str = ""  # of a header: which macros these are, a pattern

    def there(self) -> bool:
        if self.kind == "command":
            return machine.has_command(self.name)
        if self.kind == "header":
            return _find_header(self.name) is not None
        if self.kind == "file":
            return Path(self.name).exists()
        if self.kind == "sanitizers":
            return _links_sanitizers(self.name)
        return importlib.util.find_spec(self.name) is not None

    def version(self) -> str:
        """Returns the version as 3.25.1; empty if the program does not print one."""
        if self.kind == "command":
            said = subprocess.run([self.name, "--version"], capture_output=True, text=True, errors="replace").stdout
            return _number((said.splitlines() or [""])[0])
        if self.kind == "module":
            try:
                return importlib.metadata.version(self.name)
            except importlib.metadata.PackageNotFoundError:
                return ""
        return self._header_version()

    def _header_version(self) -> str:
        for name in self.versions:
            file = _find_header(name)
            text = file.read_text(encoding="utf-8", errors="replace") if file else ""
            found = re.findall(rf"^#\s*define\s+(?:{self.macros})\s+\"?([0-9.]+)", text, re.MULTILINE)
            if found:
                return ".".join(found)
        return ""

    def too_old(self) -> str:
        """Returns a sentence about a package that is too old; empty if it suffices, or prints no version."""
        version = self.version() if self.least else ""
        if not version or _parts(version) >= _parts(self.least):
            return ""
        return f"{self.package} {version} was found, and the course needs {self.least} or newer"


def _find_header(name: str) -> Path | None:
    return next((path for folder in _HEADER_FOLDERS if (path := Path(folder, name)).exists()), None)


def _number(line: str) -> str:
    """Returns the last version in a line such as `c++ (Debian 12.2.0-14) 12.2.0` or `v18.19.0`."""
    found = re.findall(r"(?<![\d.])\d+(?:\.\d+)+", line)
    return found[-1] if found else ""


def _parts(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", version))


def _links_sanitizers(compiler: str) -> bool:
    return subprocess.run([compiler, "-fsanitize=address,undefined", "-x", "c++", "-", "-o", os.devnull],
                          input="int main() {}", text=True, capture_output=True).returncode == 0


def _compiler() -> tuple[str, bool]:
    """Returns the compiler that CMake will use: the environment's CXX, or the system's c++; and if it is clang by
    another name."""
    name = os.environ.get("CXX") or "c++"
    return name, "clang" in Path(os.path.realpath(shutil.which(name) or name)).name


def compiler() -> Need:
    name, is_clang = _compiler()
    return Need("clang", "command", name, "14") if is_clang else Need("g++", "command", name, "11")


def sanitizers() -> tuple[Need, ...]:
    """Returns the package of the sanitizers. Debian's clang comes without them; g++ has its own."""
    name, is_clang = _compiler()
    return (Need("libclang-rt-dev", "sanitizers", name),) if is_clang else ()


# The oldest of each are those of Ubuntu 22.04 and Debian 12, where all tests are run.
NEEDS = (
    Need("cmake", "command", "cmake", "3.22"),
    Need("ninja-build", "command", "ninja", "1.10"),
    compiler(),
    Need("git", "command", "git"),
    Need("libeigen3-dev", "header", "Eigen/Core", "3.4", ("Eigen/Version", "Eigen/src/Core/util/Macros.h"),
         "EIGEN_(?:WORLD|MAJOR|MINOR)_VERSION"),
    Need("libgtest-dev", "header", "gtest/gtest.h"),
    Need("libcli11-dev", "header", "CLI/CLI.hpp", "2.1", ("CLI/Version.hpp",), "CLI11_VERSION"),
    Need("nlohmann-json3-dev", "header", "nlohmann/json.hpp", "3.10",
         ("nlohmann/json.hpp", "nlohmann/detail/abi_macros.hpp"), "NLOHMANN_JSON_VERSION_(?:MAJOR|MINOR|PATCH)"),
    Need("python3-numpy", "module", "numpy", "1.21"),
    Need("python3-matplotlib", "module", "matplotlib", "3.5"),
)
GRADE_NEEDS = (Need("bubblewrap", "command", "bwrap"),)
VIEW_NEEDS = (Need("libjs-three", "file", str(THREE_MIN)),)
# The Python module's; ./course python installs them.
PYTHON_NEEDS = (Need("pybind11-dev", "header", "pybind11/pybind11.h", "2.9", ("pybind11/detail/common.h",),
                     "PYBIND11_VERSION_(?:MAJOR|MINOR)"),
                Need("python3-dev", "file", str(Path(sysconfig.get_path("include"), "Python.h"))))
# Other engines, for ./course plot peers; any of them will do. DART finds contacts by ODE's functions.
PEER_NEEDS = (Need("libbullet-dev", "header", "bullet/btBulletDynamicsCommon.h"),
              Need("libode-dev", "header", "ode/ode.h"),
              Need("libdart-collision-ode-dev", "header", "dart/collision/ode/OdeCollisionDetector.hpp"),
              Need("libmujoco-dev", "header", "mujoco/mujoco.h"))
TEST_NEEDS = (*GRADE_NEEDS, *VIEW_NEEDS, *PYTHON_NEEDS, Need("libarchive-tools", "command", "bsdtar"),
              Need("clang-format", "command", "clang-format"), Need("codespell", "command", "codespell"), *sanitizers())
# Tests of the book are skipped where the system's packages have not all of these.
BOOK_NEEDS = (
    Need("python3-markdown-it", "module", "markdown_it"),
    Need("python3-mdit-py-plugins", "module", "mdit_py_plugins"),
    Need("python3-pygments", "module", "pygments"),
    Need("nodejs", "command", "node", "12"),
    Need("libjs-katex", "file", str(KATEX / "katex.js")),
    Need("fonts-linuxlibertine", "file", str(BOOK_FONTS[0])),
    Need("python3-fonttools", "module", "fontTools"),
    Need("python3-brotli", "module", "brotli"),
)
# Live figures of the book; without it they are films.
LIVE_NEEDS = (Need("emscripten", "command", "em++", "3.1.6"),)
# One node of it, which the tests of --slurm start for themselves.
SLURM_NEEDS = (Need("slurm-wlm", "command", "sbatch"), Need("munge", "command", "munge"))
# A browser that tests can drive. Ubuntu has none but as a snap, which they cannot: they are skipped there.
BROWSER_NEEDS = (Need("python3-selenium", "module", "selenium"), Need("chromium", "command", "chromium"),
                 Need("chromium-driver", "command", "chromedriver"))
