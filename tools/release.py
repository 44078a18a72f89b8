"""Makes the files of a release, once its commit has its tag.

    python3 tools/release.py                # what is wrong with it, if anything is
    python3 tools/release.py --out dist     # dist/spook-course-1.0.0.tar.gz, dist/notes.md

The tag must be v and the version of CMakeLists.txt, and CHANGELOG.md must say what the release changes. The archive
holds what is committed; notes.md holds the release's part of CHANGELOG.md.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parent / "course"))

from errors import CourseError  # noqa: E402
from paths import ROOT  # noqa: E402
from version import version  # noqa: E402


def changes(release: str) -> str:
    """Reads the part of CHANGELOG.md about a release, without its heading; empty if there is none."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(release)}$(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1].strip() + "\n" if found and found[1].strip() else ""


def check() -> str:
    """Returns the version that is released here; raises if something is missing."""
    release = version()
    tags = _git("tag", "--points-at", "HEAD").split()
    if f"v{release}" not in tags:
        raise CourseError(f"CMakeLists.txt states {release}, and this commit has "
                          f"{'the tag ' + ', '.join(tags) if tags else 'no tag'}; tag it v{release}")
    if not changes(release):
        raise CourseError(f"CHANGELOG.md says nothing below '## {release}'; write there what changes")
    return release


def make(release: str, folder: Path) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    archive, notes = folder / f"spook-course-{release}.tar.gz", folder / "notes.md"
    _git("archive", "--format=tar.gz", f"--prefix=spook-course-{release}/", f"--output={archive.absolute()}", "HEAD")
    notes.write_text(changes(release), encoding="utf-8")
    return [archive, notes]


def _git(*words: str) -> str:
    done = subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise CourseError(f"git {words[0]} failed: {(done.stderr.strip().splitlines() or ['no reason given'])[0]}")
    return done.stdout


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, help="the folder to write to; without it, nothing is written")
    options = parser.parse_args(words)
    release = check()
    made = make(release, options.out) if options.out else []
    print(*(made or [f"{release} can be released"]), sep="\n")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except CourseError as error:
        print(f"release: {error}", file=sys.stderr)
        sys.exit(error.code)
