"""Other engines for ./course plot peers: the installed ones, and a build tree configured for them."""

import sys

from engine import RELEASE
from errors import CourseError
from install import install_line
from needs import PEER_NEEDS
from terminal import fold

NAME = "peers"  # the experiment, and its folder in plots/


def require() -> None:
    """Raises CourseError, with what to install, if none is installed; names the missing ones if some are."""
    missing = [need.package for need in PEER_NEEDS if not need.there()]
    if len(missing) == len(PEER_NEEDS):
        raise CourseError(f"{NAME} needs at least one other engine, which ./course start does not install:  "
                          f"{install_line(missing)}")
    if missing:
        print(fold(f"Not compared, since not installed: {', '.join(missing)}. To install:  {install_line(missing)}"),
              file=sys.stderr)
    # CMake looks anew for what it had not found, and forgets nothing that it had.
    found = " ".join(need.package for need in PEER_NEEDS if need.there())
    if RELEASE.setting("SPOOK_PEERS") != "ON" or RELEASE.setting("SPOOK_PEERS_FOUND") != found:
        RELEASE.configure("-DSPOOK_PEERS=ON", f"-DSPOOK_PEERS_FOUND:STRING={found}")


def any_there() -> bool:
    return any(need.there() for need in PEER_NEEDS)
