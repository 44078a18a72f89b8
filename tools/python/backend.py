"""The backend of `pip install .`: CMake builds and installs the module, a wheel is that folder as a zip (PEP 427, 517).

It needs the packages that ./course start installs, and pybind11-dev and python3-dev. Nothing else is downloaded, so
pip works without a network where NumPy is installed.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
_TAG = (f"cp{sys.version_info.major}{sys.version_info.minor}-cp{sys.version_info.major}{sys.version_info.minor}-"
        + sysconfig.get_platform().replace("-", "_").replace(".", "_"))
_METADATA = f"""Metadata-Version: 2.1
Name: spook
Version: {VERSION}
Summary: A rigid-body engine by the SPOOK method: worlds to build, and scenes that know their own answers
License: MIT
Requires-Python: >=3.10
Requires-Dist: numpy>=1.21
"""
_WHEEL = f"Wheel-Version: 1.0\nGenerator: spook\nRoot-Is-Purelib: false\nTag: {_TAG}\n"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None) -> str:
    about = Path(metadata_directory, f"spook-{VERSION}.dist-info")
    about.mkdir()
    (about / "METADATA").write_text(_METADATA, encoding="utf-8")
    (about / "WHEEL").write_text(_WHEEL, encoding="utf-8")
    return about.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    name = f"spook-{VERSION}-{_TAG}.whl"
    with tempfile.TemporaryDirectory(prefix="spook-wheel-") as folder:
        _install(Path(folder))
        files = {str(path.relative_to(folder)): path.read_bytes()
                 for path in sorted(Path(folder).rglob("*")) if path.is_file()}
    about = f"spook-{VERSION}.dist-info"
    files |= {f"{about}/METADATA": _METADATA.encode(), f"{about}/WHEEL": _WHEEL.encode()}
    files[f"{about}/RECORD"] = "".join([*map(_recorded, files.items()), f"{about}/RECORD,,\n"]).encode()
    with zipfile.ZipFile(Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name


def build_sdist(sdist_directory, config_settings=None) -> str:
    """Archives the files that git tracks, as PEP 517 requires."""
    name = f"spook-{VERSION}"
    known = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    with tempfile.NamedTemporaryFile() as about, tarfile.open(Path(sdist_directory, f"{name}.tar.gz"), "w:gz") as archive:
        for path in filter(None, known.split("\0")):
            archive.add(ROOT / path, f"{name}/{path}", recursive=False)
        about.write(_METADATA.encode())
        about.flush()
        archive.add(about.name, f"{name}/PKG-INFO")
    return f"{name}.tar.gz"


def _install(folder: Path) -> None:
    # A tree of its own for each Python; it is kept, so that the next time only what changed is compiled.
    tree = Path(os.environ.get("COURSE_BUILD") or ROOT / "build") / f"wheel-{sys.implementation.cache_tag}"
    for command in (["--preset", "python", "-B", str(tree), f"-DPython3_EXECUTABLE={sys.executable}"],
                    ["--build", str(tree), "--target", "python_module"],
                    ["--install", str(tree), "--component", "python", "--prefix", str(folder)]):
        subprocess.run(["cmake", *command], cwd=ROOT, check=True)


def _recorded(file: tuple[str, bytes]) -> str:
    path, content = file
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{path},sha256={digest},{len(content)}\n"
