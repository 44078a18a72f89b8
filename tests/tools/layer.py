"""A folder laid over another, at the same place, that only the commands run in it see: an overlay in a mount namespace.

What they write goes into the layer and is gone with it; what is below is there at once, build trees included, which
would be stale anywhere else.
"""

import os
import subprocess
from pathlib import Path

_MOUNT = """mount -t overlay overlay -o "lowerdir=$0,upperdir=$1/upper,workdir=$1/work$2" "$0" &&
echo mounted && exec cat"""  # until this process closes the pipe, or ends


class Layer:
    def __init__(self, below: Path, scratch: Path):
        """Throws OSError if the kernel or a container does not allow it."""
        if set(":,\\") & set(str(below)):
            raise OSError("an overlay's folders are divided by colons and commas")
        for name in ("upper", "work"):
            (scratch / name).mkdir()
        root = os.geteuid() == 0
        self._below = below
        self._user = [] if root else ["--user", "--preserve-credentials"]
        alone = ["unshare", "--mount"] if root else ["unshare", "--user", "--map-root-user", "--mount"]
        self._holder = subprocess.Popen(
            [*alone, "sh", "-c", _MOUNT, str(below), str(scratch), "" if root else ",userxattr"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd="/")
        if self._holder.stdout.readline() != "mounted\n":
            self.close()
            raise OSError("no overlay can be mounted here")
        # What is in the layer, for those who are not in its namespace.
        self.root = Path(f"/proc/{self._holder.pid}/root{below}")

    def close(self) -> None:
        self._holder.stdin.close()
        self._holder.wait()
        self._holder.stdout.close()

    def inside(self, command: list[str], cwd: Path | None = None) -> list[str]:
        """Returns a command line that runs inside, from the folder's root or from another folder."""
        return ["nsenter", "--target", str(self._holder.pid), "--mount", "--root", "--wd", *self._user,
                "sh", "-c", 'cd "$0" && exec "$@"', str(cwd or self._below), *command]
