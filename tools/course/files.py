"""The files of the course."""

import subprocess
from pathlib import Path

from paths import ROOT

_NOT_OURS = {".git", "build", ".course"}


def course_files() -> list[Path]:
    """Every file of the course, relative to its root: tracked, or new and not ignored."""
    listing = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-coz", "--exclude-standard"],
                             capture_output=True, text=True)
    if listing.returncode == 0:
        names = sorted({Path(name) for name in listing.stdout.split("\0") if name})
    else:  # an archive without history
        names = sorted(path.relative_to(ROOT) for path in ROOT.rglob("*"))
        names = [name for name in names if not _NOT_OURS & set(name.parts)]
    return [name for name in names if (ROOT / name).is_file() and ".mine-" not in name.name]
