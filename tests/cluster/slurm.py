"""A Slurm cluster for tests: a controller and several nodes on this machine, reached through 127.0.0.1 alone.

Needs Slurm's daemons and MUNGE, but neither their services, nor files outside of a temporary folder, nor root. Every
daemon runs below a keeper (keeper.py) and ends with the test, whatever ends that.
"""

from __future__ import annotations

import os
import pwd
import shutil
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import keeper
from ports import free_port
from processes import PATIENCE_S, wait_until

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo", "scancel")
_SBIN = "/usr/local/sbin:/usr/sbin:/sbin"  # not on every user's PATH
_FOREIGN = ("SLURM", "SBATCH", "VELDT_")  # settings of another cluster, or of the program
_ENDED = {
    "COMPLETED",
    "FAILED",
    "CANCELLED",
    "TIMEOUT",
    "NODE_FAIL",
    "OUT_OF_MEMORY",
    "BOOT_FAIL",
    "DEADLINE",
}
_LOG_LINES = 8

# Short times: a node that has not answered for 20 s is down, which is more than a busy machine needs to answer; a
# requeued job waits 6 s, until the credential of its last run has expired (2 minutes by default). Jobs that ended stay
# listed for an hour. A node has one CPU and 4 GB, whatever the machine has.
_CONFIG = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
CommunicationParameters=NoCtldInAddrAny
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,sched_min_interval=0,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
SlurmdTimeout=20
MessageTimeout=10
SlurmctldTimeout=10
KillWait=2
MinJobAge=3600
JobRequeue=1
ReturnToService=2
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class CannotStart(Exception):
    """Why there is no cluster."""


def _search_path() -> str:
    return f"{os.environ.get('PATH', '')}:{_SBIN}"


class _Daemon:
    """A program and all that it starts, below a keeper."""

    def __init__(self, command: list, output: Path, environment: dict):
        with open(output, "ab") as log:
            self._keeper = subprocess.Popen(
                [sys.executable, "-B", keeper.__file__, *map(str, command)],
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=log,
                env=environment,
                start_new_session=True,
            )

    def runs(self) -> bool:
        """Whether the program has not ended by itself."""
        return self._keeper.poll() is None

    def kill(self) -> None:
        """SIGKILL for the program and all below it."""
        self._keeper.stdin.close()
        self._keeper.wait()


class Slurm:
    """A cluster whose nodes are called n0, n1, …"""

    def __init__(self, folder: Path, nodes: int):
        self.folder = folder
        self.nodes = [f"n{k}" for k in range(nodes)]
        self._config = folder / "slurm.conf"
        self._environment = {
            name: value for name, value in os.environ.items() if not name.startswith(_FOREIGN)
        }
        self._environment |= {"SLURM_CONF": str(self._config), "PATH": _search_path()}
        self._daemons: dict[str, _Daemon] = {}

    # --- commands -----------------------------------------------------------------------------------------------------

    def command(self, *arguments, cwd: Path | None = None, env: dict | None = None) -> str:
        """What a command prints that uses Slurm. Jobs are handed in with its folder and its environment."""
        done = subprocess.run(
            [*map(str, arguments)],
            env=self._environment | (env or {}),
            cwd=cwd or self.folder,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        assert done.returncode == 0, f"{arguments}: {done.stdout}{done.stderr}"
        return done.stdout

    def sbatch(self, script: Path, *options) -> str:
        """Hand in a script; the number of the job."""
        return self.command("sbatch", "--parsable", *options, script).strip()

    def jobs(self, job: str) -> dict[str, dict[str, str]]:
        """What Slurm says about a job by `ID`, or about every job of an array by `ID_INDEX`."""
        found = {}
        for line in self.command("scontrol", "--oneliner", "show", "job", job).splitlines():
            fields = dict(word.split("=", 1) for word in line.split() if "=" in word)
            index = fields.get("ArrayTaskId")
            found[fields["JobId"] if index is None else f"{fields['ArrayJobId']}_{index}"] = fields
        return found

    def states(self, job: str) -> dict[str, str]:
        """The states of the same jobs, such as RUNNING."""
        return {name: fields["JobState"] for name, fields in self.jobs(job).items()}

    def wait(self, job: str) -> dict[str, str]:
        """The states of the same jobs once all have ended; an assertion fails, with all logs, if they never do."""
        assert wait_until(
            lambda: set(self.states(job).values()) <= _ENDED
        ), f"{self.states(job)}\n{self.logs()}"
        return self.states(job)

    def node_state(self, node: str) -> str:
        """Such as idle, alloc or down; with * if it doesn't answer."""
        return self.command("sinfo", "--noheader", "--nodes", node, "--format", "%t").strip()

    # --- nodes --------------------------------------------------------------------------------------------------------

    def start_node(self, name: str) -> None:
        """Start a node, or start it again."""
        self._start(name, ["slurmd", "-D", "-f", self._config, "-N", name])

    def kill_node(self, name: str) -> None:
        """SIGKILL for everything that runs on a node, as when it loses power."""
        self._daemons.pop(name).kill()

    # --- from start to end --------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start all daemons; CannotStart with the last lines of the one that fails."""
        missing = [program for program in PROGRAMS if shutil.which(program, path=_search_path()) is None]
        if missing:
            raise CannotStart(f"no {', '.join(missing)}; install slurmctld, slurmd, slurm-client and munge")
        self._write_config()
        (self.folder / "state").mkdir()
        self._start("munged", self._munged())
        self._await("munged", (self.folder / "munge.socket").exists)
        self._start("slurmctld", ["slurmctld", "-D", "-f", self._config])
        for node in self.nodes:
            (self.folder / node).mkdir()
            self.start_node(node)
        for node in self.nodes:
            self._await(node, lambda node=node: self._answers(node))

    def stop(self) -> None:
        """Kill everything."""
        for name in list(self._daemons)[::-1]:
            self._daemons.pop(name).kill()

    def logs(self) -> str:
        """The last lines of all logs."""
        return "\n".join(
            f"--- {file.stem}\n{_last_lines(file)}" for file in sorted(self.folder.glob("*.log"))
        )

    def _munged(self) -> list:
        key = self.folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        files = {
            "socket": "socket",
            "key-file": "key",
            "pid-file": "pid",
            "seed-file": "seed",
            "log-file": "log",
        }
        return ["munged", "--foreground", *(f"--{o}={self.folder}/munge.{e}" for o, e in files.items())]

    def _write_config(self) -> None:
        ports: list[int] = []
        while len(ports) <= len(self.nodes):
            port = free_port(socket.SOCK_STREAM)
            ports += [port] if port not in ports else []
        host = socket.gethostname().partition(".")[0]
        nodes = [
            f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 RealMemory=4096 State=UNKNOWN"
            for name, port in zip(self.nodes, ports[1:])
        ]
        values = {
            "folder": self.folder,
            "host": host,
            "user": pwd.getpwuid(os.geteuid()).pw_name,
            "ports": ports,
        }
        config = _CONFIG.format(nodes="\n".join(nodes), **values)
        self._config.write_text(config, encoding="utf-8")

    def _start(self, name: str, command: list) -> None:
        program = shutil.which(command[0], path=_search_path())
        log = self.folder / f"{name}.out"
        self._daemons[name] = _Daemon([program, *command[1:]], log, self._environment)

    def _answers(self, node: str) -> bool:
        try:
            return self.node_state(node) == "idle"
        except AssertionError:  # the controller doesn't listen yet
            return False

    def _await(self, name: str, ready) -> None:
        crashed = lambda: [each for each, daemon in self._daemons.items() if not daemon.runs()]
        wait_until(lambda: crashed() or ready())
        for each in crashed():
            raise CannotStart(f"{each} ended: {self._said(each)}")
        if not ready():
            raise CannotStart(f"{name} never becomes ready: {self._said(name)}")

    def _said(self, name: str) -> str:
        files = [self.folder / f"{name}.{end}" for end in ("log", "out")]
        return "\n".join(_last_lines(file) for file in files if file.exists())


def _last_lines(file: Path) -> str:
    return "\n".join(file.read_text(encoding="utf-8", errors="replace").splitlines()[-_LOG_LINES:])


@contextmanager
def running_slurm(nodes: int = 3) -> Iterator[Slurm]:
    """A cluster; the test is skipped, with the reason, where none can be started."""
    with tempfile.TemporaryDirectory(prefix="slurm-") as name:  # short: sockets have paths of up to 107 bytes
        folder = Path(name)
        folder.chmod(0o755)  # munged requires it
        slurm = Slurm(folder, nodes)
        try:
            slurm.start()
            yield slurm
        except CannotStart as reason:
            pytest.skip(f"cannot start Slurm: {reason}")
        finally:
            slurm.stop()
