"""A Slurm of one node in a folder of its own: munge's key and socket, a controller and a node on free ports."""

import contextlib
import os
import pwd
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol")


def lacking() -> str:
    """Returns why Slurm cannot be started here; empty if it can."""
    missing = [program for program in PROGRAMS if not _which(program)]
    if missing:
        return f"{missing[0]} is not installed (slurm-wlm, munge)"
    return "" if os.geteuid() == 0 else "a node of Slurm needs root"


class OneNode:
    """Runs `tasks` at a time, on any machine."""

    def __init__(self, folder: Path, tasks: int = 2):
        self._folder, self._processes = folder, []
        host = socket.gethostname().split(".")[0]
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir(parents=True)
        self._start_munge(folder / "munge")
        controller, node = _free_port(), _free_port()
        conf = folder / "slurm.conf"
        conf.write_text(f"""ClusterName=course
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder / 'munge' / 'socket'}
CredType=cred/munge
StateSaveLocation={folder / 'state'}
SlurmdSpoolDir={folder / 'spool'}
SlurmctldPidFile={folder / 'slurmctld.pid'}
SlurmdPidFile={folder / 'slurmd.pid'}
SlurmctldLogFile={folder / 'slurmctld.log'}
SlurmdLogFile={folder / 'slurmd.log'}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1,sched_min_interval=10000
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MailProg=/bin/true
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs={tasks} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        version = _slurm_version()
        if version >= (22, 5):  # since then it looks for cgroups, which a container may lack, unless told not to
            plugin = "disabled" if version >= (24, 5) else "cgroup/v1"  # which looks for them when it is used
            (folder / "cgroup.conf").write_text(f"CgroupPlugin={plugin}\n")
        self.environment = os.environ | {"SLURM_CONF": str(conf)}
        self.host = host
        self._start("slurmctld", "-D", "-f", str(conf))
        self.start_node()
        self._wait_until_idle()

    def start_node(self) -> None:
        self._node = self._start("slurmd", "-D", "-f", self.environment["SLURM_CONF"])

    def cut_the_power(self, process: int) -> None:
        """Kills the node and everything that it runs: the session of `process`, and its parents up to this process."""
        family = []
        while process > 1 and process != os.getpid():
            family.append(process)
            process = int(Path("/proc", str(process), "stat").read_text().rpartition(")")[2].split()[1])
        for one in (self._node.pid, *reversed(family)):  # from the outside in: nobody notes how another ended
            with contextlib.suppress(ProcessLookupError):
                os.kill(one, signal.SIGKILL)
        self._node.wait()

    def close(self) -> None:
        """Stops the node and its jobs first."""
        with contextlib.suppress(OSError):
            subprocess.run([_which("scancel"), "--full", "--user=root"], env=self.environment, capture_output=True,
                           timeout=10)
        for process in reversed(self._processes):
            process.terminate()
        for process in self._processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def log(self) -> str:
        return "".join((self._folder / name).read_text(errors="replace")[-3000:]
                       for name in ("slurmctld.log", "slurmd.log") if (self._folder / name).exists())

    def _start(self, program: str, *words: str) -> subprocess.Popen:
        process = subprocess.Popen([_which(program), *words], env=getattr(self, "environment", os.environ),
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self._processes.append(process)
        return process

    def _start_munge(self, folder: Path) -> None:
        """Starts munge as its own user, with a key that only this user may read, in folders that others may not write
        to."""
        user = pwd.getpwnam("munge")
        key = folder / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        for path in (folder, key):
            os.chown(path, user.pw_uid, user.pw_gid)
        folder.chmod(0o755)
        words = ["--foreground", f"--key-file={key}", f"--socket={folder / 'socket'}", f"--pid-file={folder / 'pid'}",
                 f"--log-file={folder / 'log'}", f"--seed-file={folder / 'seed'}", "--num-threads=2", "--force"]
        self._processes.append(subprocess.Popen(
            [_which("setpriv"), f"--reuid={user.pw_uid}", f"--regid={user.pw_gid}", "--clear-groups",
             _which("munged"), *words],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        _wait(lambda: (folder / "socket").exists(), "munge does not answer", 20)

    def _wait_until_idle(self) -> None:
        def idle() -> bool:
            told = subprocess.run([_which("scontrol"), "show", "node", self.host], env=self.environment,
                                  capture_output=True, text=True).stdout
            return "State=IDLE" in told
        _wait(idle, "the node does not become idle", 60, self.log)


def _slurm_version() -> tuple[int, int]:
    said = subprocess.run([_which("slurmd"), "-V"], capture_output=True, text=True, check=True).stdout
    year, month = re.search(r"(\d+)\.(\d+)", said).groups()
    return int(year), int(month)


def _wait(holds, otherwise: str, seconds: float, more=lambda: "") -> None:
    deadline = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > deadline:
            raise RuntimeError(f"{otherwise}\n{more()}")
        time.sleep(0.1)


def _which(program: str) -> str | None:
    return shutil.which(program, path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin")


def _free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]
