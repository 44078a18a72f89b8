"""Finds and fetches releases: tags v1.2.3 of a git repository."""

import re
from dataclasses import dataclass
from pathlib import Path

from errors import BadInput, CourseError
from terminal import Live
from updating.git import asked, call, git, why

_VERSION = re.compile(r"v?(\d+)\.(\d+)\.(\d+)(-[0-9A-Za-z.-]+)?")
_OURS = "refs/course/releases"  # not among the student's own tags


@dataclass(frozen=True)
class Source:
    place: str  # what git is told: a remote's name, an address, a folder
    address: str

    def __str__(self) -> str:
        address = re.sub(r"//[^/@]*@", "//", self.address)  # without a password
        return address if self.place == self.address else f"{self.place} ({address})"


_OF_A_FORK = "if this remote is your own copy of the course, name the original: git remote add upstream ADDRESS"


def source(given: str | None) -> Source:
    """Returns the source given; else the remote `upstream` (a fork's original), `origin`, or the only remote."""
    remotes = asked("remote").split()
    if given in remotes:
        return Source(given, _address(given))
    if given:
        folder = Path(given)
        place = str(folder.absolute()) if folder.exists() else given
        return Source(place, place)
    chosen = next((name for name in ("upstream", "origin") if name in remotes), None)
    chosen = chosen or (remotes[0] if len(remotes) == 1 else None)
    if not chosen:
        known = f"none of {', '.join(remotes)} is called upstream or origin" if remotes else "git has no remote"
        raise CourseError(f"{known}; name where releases come from: ./course update --from ADDRESS")
    return Source(chosen, _address(chosen))


def offered(place: Source) -> list[str]:
    """Lists the versions there, oldest first."""
    live = Live(f"asking {place}")
    live.update()
    done = call("ls-remote", "--tags", "--refs", "--", place.place)
    live.done()
    if done.returncode != 0:
        raise CourseError(f"{place} could not be reached: {why(done)} (nothing was changed)")
    tags = [line.rpartition("refs/tags/")[2] for line in done.stdout.decode(errors="replace").splitlines()]
    return sorted((tag[1:] for tag in tags if tag.startswith("v") and _VERSION.fullmatch(tag)), key=order)


def check(wanted: str | None) -> None:
    if wanted is not None and not _VERSION.fullmatch(wanted):
        raise BadInput(f"update: {wanted!r} is not a release, such as 1.2.3")


def chosen(wanted: str | None, versions: list[str], place: Source) -> str:
    """Returns the version asked for; else the newest that is no trial version."""
    final = [version for version in versions if "-" not in version]
    if wanted is None:
        if not final:
            raise CourseError(f"{place} has no release, which is a tag such as v1.2.3; {_OF_A_FORK}")
        return final[-1]
    version = wanted.removeprefix("v")
    if version not in versions:
        known = f"the newest is {final[-1]}" if final else "it has none"
        raise BadInput(f"update: {place} has no release {wanted!r}; {known}")
    return version


def fetch(version: str, place: Source, what: str = "") -> str:
    """Fetches a release, and returns its commit."""
    name = f"{_OURS}/v{version}"
    live = Live(what or f"fetching {version}")
    live.update()
    done = call("fetch", "--no-tags", "--quiet", "--", place.place, f"+refs/tags/v{version}:{name}")
    live.done()
    if done.returncode != 0:
        raise CourseError(f"{version} could not be fetched from {place}: {why(done)} (nothing was changed)")
    return git("rev-parse", "--verify", f"{name}^{{commit}}")


def order(version: str) -> tuple:
    """Returns a key to sort versions by: 1.2.3-rc.1 comes before 1.2.3."""
    *numbers, trial = _VERSION.fullmatch(version).groups()
    return (*map(int, numbers), trial is None, trial or "")


def _address(place: str) -> str:
    return asked("remote", "get-url", place)
