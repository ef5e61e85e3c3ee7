"""A system that refuses: calls that fail, full disks, no memory, jumping clocks, missing permissions."""

from __future__ import annotations

import contextlib
import errno
import os
import resource
import signal
import subprocess
from pathlib import Path

from runs import pause
from shims import Orders, crashed_in, is_root
from small_disk import SmallDisk
from trial import ANY_CLEAN, DONE, FAILED, REJECTED, TRY_AGAIN, WRONG_USE, Kind, Outcome, Trial

_ERRORS = {  # that a call may report, by kind of call
    "open": (errno.EIO, errno.EMFILE, errno.ENOSPC, errno.EACCES),
    "read": (errno.EIO, errno.EINTR),
    "write": (errno.EIO, errno.ENOSPC, errno.EDQUOT, errno.EINTR),
    "flush": (errno.EIO, errno.ENOSPC),
    "close": (errno.EIO, errno.ENOSPC, errno.EINTR),
    "fsync": (errno.EIO, errno.ENOSPC),
    "rename": (errno.EIO, errno.ENOSPC, errno.EACCES),
    "mkdir": (errno.EIO, errno.ENOSPC, errno.EACCES),
    "unlink": (errno.EIO, errno.EACCES),
    "link": (errno.EIO, errno.EMLINK, errno.ENOSPC),
    "lock": (errno.EIO, errno.ENOLCK),
}
_NOT_LOADED = 127  # from the system, before the program begins
_FULL = (errno.ENOSPC, errno.EDQUOT)


def _failing_call(trial: Trial) -> Outcome:
    (program, call), count = trial.random.choice(sorted(trial.state.calls.items()))
    at, error = trial.random.randint(1, count), trial.random.choice(_ERRORS[call])
    how_many = trial.random.choice((1, 1, 1, 2, 5, 1000000)) if error != errno.EINTR else 1
    values = {"PROGRAM": program, "CALL": call, "AT": at, "COUNT": how_many, "ERROR": error}
    ended = trial.run(env=trial.preloaded(Orders(values=values)))
    where = f"{program} at {call} {at} of {count}: {errno.errorcode[error]}, {how_many} times"
    allowed = (DONE, FAILED, REJECTED, TRY_AGAIN)
    if error in _FULL:
        allowed = (DONE, TRY_AGAIN)
    return Outcome([ended], where, trial.injected(), allowed)


def _short_calls(trial: Trial) -> Outcome:
    """Pieces instead of the whole, which every caller must expect."""
    call = trial.random.choice(("read", "write"))
    values = {"CALL": call, "AT": trial.random.randint(1, 50), "COUNT": 1000000, "SHORT": 1}
    ended = trial.run(env=trial.preloaded(Orders(values=values)))
    return Outcome([ended], f"{call} from {values['AT']}", trial.injected(), (DONE,))


def _full_after_bytes(trial: Trial) -> Outcome:
    wanted = sum(file.stat().st_size for file in trial.state.after.rglob("*") if file.is_file())
    there = sum(file.stat().st_size for file in trial.state.before.rglob("*") if file.is_file())
    most = trial.random.randint(0, max(1, wanted - there))
    program = trial.random.choice(({}, {}, {"PROGRAM": "python3"}))
    ended = trial.run(env=trial.preloaded(Orders(values={"BYTES": most} | program)))
    return Outcome([ended], f"after {most} bytes", trial.injected(), (DONE, TRY_AGAIN))


def _small_disk(trial: Trial) -> Outcome:
    """The disk is full from the start, or fills up during the run."""
    kept = trial.work.parent / "kept"
    trial.work.rename(kept)
    trial.work.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", trial.work], check=True)
    subprocess.run(["cp", "-a", f"{kept}/.", trial.work], check=True)
    disk = SmallDisk(trial.work)
    left = trial.random.choice((trial.random.randint(0, 400_000), trial.random.randint(0, 8_000_000)))
    moment_s = trial.random.choice((0.0, trial.moment_s()))
    if moment_s == 0:
        disk.leave(left)
    run = trial.start()
    hit = moment_s == 0
    if moment_s > 0 and pause(moment_s, run):
        with contextlib.suppress(OSError):  # the run itself fills it first
            disk.leave(min(left, disk.left()))
        hit = True
    ended = trial.finish(run)

    def clean_up() -> None:
        """What is on the disk stays, on another."""
        subprocess.run(["rm", "-rf", kept], check=True)
        subprocess.run(["cp", "-a", trial.work, kept], check=True)
        subprocess.run(["umount", "-l", trial.work], check=True)
        trial.work.rmdir()
        kept.rename(trial.work)

    where = f"{left} bytes left after {moment_s:.2f} s"
    return Outcome([ended], where, int(hit), (DONE, TRY_AGAIN), undo=disk.free_space, clean_up=clean_up)


def _no_memory(trial: Trial) -> Outcome:
    """Allocations that fail, once or for ever. Before main() and in destructors, nothing but an abort can follow.

    Libraries may crash, as OpenSSL 3.0 does in EVP_MD_fetch(); our own code may not.
    """
    program = trial.random.choice(("veldt", "veldt", "python3"))
    least = trial.random.choice((1, 1000, 100_000, 1_000_000))
    most = {1: 300_000, 1000: 20_000, 100_000: 300, 1_000_000: 40}[least]
    values = {
        "PROGRAM": program,
        "LEAST": least,
        "MALLOC": int(most ** trial.random.random()),
        "COUNT": trial.random.choice((1, 10, 1000000)),
    }
    ended = trial.run(env=trial.preloaded(Orders("machine_shim", values)))
    where = f"{program}: {values['COUNT']} from {values['MALLOC']}, of {least} bytes and more"
    allowed = (-signal.SIGABRT, *ANY_CLEAN)
    if (file := crashed_in(trial.log)).startswith("lib"):
        where += f"; crash in {file}"
        allowed += (-signal.SIGSEGV,)
    return Outcome([ended], where, trial.injected(), allowed)


def _little_memory(trial: Trial) -> Outcome:
    most = trial.random.randint(60, 900) << 20
    ended = trial.run(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
    allowed = ANY_CLEAN + ((_NOT_LOADED,) if "loading shared libraries" in ended.err else ())
    return Outcome([ended], f"{most >> 20} MiB of addresses", int(ended.code != 0), allowed)


def _jumping_clock(trial: Trial) -> Outcome:
    days = trial.random.choice((1, 400, 5000))
    ended = trial.run(env=trial.preloaded(Orders("machine_shim", {"CLOCK": days})))
    return Outcome([ended], f"{days} days", trial.injected(), (DONE,))


def _no_permission(trial: Trial) -> Outcome:
    """A folder that may not be written to, or not be looked into, from the start or during the run."""
    moment_s = trial.random.choice((0.0, trial.moment_s()))
    mode = trial.random.choice((0o555, 0o000, 0o666))
    changed: list[Path] = []

    def forbid() -> None:
        folders = [trial.work, *(path for path in trial.work.rglob("*") if path.is_dir())]
        changed.append(trial.random.choice(sorted(folders)))
        try:
            changed[0].chmod(mode)
        except FileNotFoundError:  # a temporary folder, gone meanwhile
            pass

    if moment_s == 0:
        forbid()
    run = trial.start(under=["setpriv", "--bounding-set=-dac_override,-dac_read_search"])
    if moment_s > 0:
        pause(moment_s, run)
        forbid()
    ended = trial.finish(run)
    where = f"{os.path.relpath(changed[0], trial.work)} has mode {mode:o} after {moment_s:.2f} s"

    def undo() -> None:
        for path in [trial.work, *trial.work.rglob("*")]:
            if path.is_dir():
                path.chmod(0o755)

    return Outcome([ended], where, 1, (DONE, FAILED, WRONG_USE, REJECTED), undo)


KINDS = {
    "failing call": Kind(_failing_call),
    "short calls": Kind(_short_calls),
    "disk full after bytes": Kind(_full_after_bytes),
    "small disk": Kind(_small_disk, needs_root=True),
    "no memory": Kind(_no_memory),
    "little memory": Kind(_little_memory),
    "jumping clock": Kind(_jumping_clock),
    "no permission": Kind(_no_permission, needs_root=True),
}
if not is_root():
    KINDS = {name: kind for name, kind in KINDS.items() if not kind.needs_root}
