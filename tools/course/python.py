"""./course python: builds the Python module, and runs Python with it."""

import os
import subprocess
import sys
from pathlib import Path

from errors import CourseError
from install import install
from needs import NEEDS, PYTHON_NEEDS
from paths import BUILD, ROOT, shown
from process import tail
from tree import Tree

FOLDER = BUILD / "python" / "site"  # to import spook from
_EXAMPLE = ROOT / "tools" / "python" / "examples" / "work_precision.py"


def python(arguments) -> int:
    install(NEEDS + PYTHON_NEEDS, arguments.yes)
    folder = built()
    path = os.pathsep.join(part for part in (str(folder), os.environ.get("PYTHONPATH", "")) if part)
    if arguments.words:
        sys.stdout.flush()
        return subprocess.run([sys.executable, *arguments.words], env=os.environ | {"PYTHONPATH": path}).returncode
    print(f"""The module is in {shown(folder)}, for {sys.executable}.

A file that imports spook:             ./course python {shown(_EXAMPLE)}
A notebook, an editor, a shell:        export PYTHONPATH={folder}
An environment of yours:               pip install {ROOT}""")
    return 0


def built() -> Path:
    """Builds the module, and returns the folder to import from."""
    tree = Tree("release")
    if tree.setting("SPOOK_PYTHON") != "ON":
        tree.configure("-DSPOOK_PYTHON=ON")
    done = tree.build(["python_module"], "building the Python module")
    if not done.ok:
        raise tree.own_failure(done)
    command = ["cmake", "--install", str(tree.path), "--component", "python", "--prefix", str(FOLDER)]
    installed = subprocess.run(command, capture_output=True, text=True)
    if installed.returncode != 0:
        raise CourseError(f"{shown(FOLDER)} could not be written", tail(installed.stderr))
    return FOLDER
