"""Processes that are killed, stopped, or asked to end."""

from __future__ import annotations

import signal
import subprocess
from dataclasses import dataclass

from runs import descendants, name_of, pause, send
from shims import Orders
from trial import DONE, TRY_AGAIN, ANY_CLEAN, Kind, Outcome, Trial

_ASKED = (signal.SIGTERM, signal.SIGINT)


@dataclass
class _Hit:
    """A run, and which of its processes got a signal; also the run itself."""

    run: subprocess.Popen
    process: int
    name: str
    was_there: int  # 0 if the run had ended before, else 1


def _hit(trial: Trial, moment_s: float, number: int) -> _Hit:
    """Start a run, and send a signal to some process of it at a moment."""
    run = trial.start()
    goes_on = pause(moment_s, run)
    process = trial.random.choice(descendants(run.pid))
    name = "veldt" if process == run.pid else name_of(process)
    return _Hit(run, process, name, int(goes_on and send(process, number)))


def _kill(trial: Trial) -> Outcome:
    moment_s = trial.moment_s()
    hit = _hit(trial, moment_s, signal.SIGKILL)
    ended = trial.finish(hit.run)
    return Outcome(
        [ended], f"{hit.name} after {moment_s:.2f} s", hit.was_there, (-signal.SIGKILL, *ANY_CLEAN)
    )


def _kill_at_call(trial: Trial) -> Outcome:
    """At a moment when a file is about to change, which random moments seldom hit."""
    (program, call), count = trial.random.choice(sorted(trial.state.calls.items()))
    at = trial.random.randint(1, count)
    values = {"PROGRAM": program, "CALL": call, "AT": at, "SIGNAL": int(signal.SIGKILL)}
    ended = trial.run(env=trial.preloaded(Orders(values=values)))
    where = f"{program} at {call} {at} of {count}"
    return Outcome([ended], where, trial.injected(), (-signal.SIGKILL, *ANY_CLEAN))


def _stop_and_continue(trial: Trial) -> Outcome:
    moment_s, length_s = trial.moment_s(), trial.random.uniform(0.1, 1.0)
    hit = _hit(trial, moment_s, signal.SIGSTOP)
    pause(length_s, hit.run)
    send(hit.process, signal.SIGCONT)
    ended = trial.finish(hit.run)
    where = f"{hit.name} after {moment_s:.2f} s for {length_s:.2f} s"
    return Outcome([ended], where, hit.was_there, (DONE,))


def _stop_and_kill(trial: Trial) -> Outcome:
    """Also another process than the one that is stopped."""
    moment_s, length_s = trial.moment_s(), trial.random.uniform(0.0, 0.5)
    hit = _hit(trial, moment_s, signal.SIGSTOP)
    pause(length_s, hit.run)
    killed = hit.run.pid if trial.random.random() < 0.5 else hit.process
    send(killed, signal.SIGKILL)
    send(hit.process, signal.SIGKILL)
    ended = trial.finish(hit.run)
    return Outcome(
        [ended], f"{hit.name} after {moment_s:.2f} s", hit.was_there, (-signal.SIGKILL, *ANY_CLEAN)
    )


def _ask(trial: Trial) -> Outcome:
    moment_s, number = trial.moment_s(), trial.random.choice(_ASKED)
    hit = _hit(trial, moment_s, number)
    if trial.random.random() < 0.3:  # impatient users ask again
        pause(trial.random.uniform(0.0, 0.1), hit.run)
        send(hit.process, number)
    ended = trial.finish(hit.run)
    where = f"{number.name} to {hit.name} after {moment_s:.2f} s"
    return Outcome([ended], where, hit.was_there, (128 + number, -number, *ANY_CLEAN))


def _two_runs(trial: Trial) -> Outcome:
    """The same command twice at once: one of them waits, has nothing to do, or exits with a request to try again."""
    delay_s = trial.random.choice((0.0, trial.moment_s()))
    first = trial.start("first")
    pause(delay_s, first)
    second = trial.start("second")
    killed = trial.random.random() < 0.3
    if killed:
        pause(trial.moment_s(), second)
        send(trial.random.choice((first.pid, second.pid)), signal.SIGKILL)
    ended = [trial.finish(first, "first"), trial.finish(second, "second")]
    allowed = (DONE, TRY_AGAIN) + ((-signal.SIGKILL,) if killed else ())
    where = f"the second after {delay_s:.2f} s{', one killed' if killed else ''}"
    if not killed and DONE not in [one.code for one in ended]:
        where += ", none did it"
        allowed = ()
    return Outcome(ended, where, 1, allowed, finished=False)


def _two_shards(trial: Trial) -> Outcome:
    """Two shards into one folder at once: both succeed, and nothing is left for the whole to do."""
    delay_s = trial.random.choice((0.0, trial.moment_s()))
    steps = [(*trial.state.step, "--shard", f"{k}/2") for k in range(2)]
    first = trial.start("first", steps[0])
    pause(delay_s, first)
    second = trial.start("second", steps[1])
    ended = [trial.finish(first, "first"), trial.finish(second, "second")]
    return Outcome(ended, f"the second after {delay_s:.2f} s", 1, (DONE,))


KINDS = {
    "kill": Kind(_kill),
    "kill at a call": Kind(_kill_at_call),
    "stop and continue": Kind(_stop_and_continue),
    "stop and kill": Kind(_stop_and_kill),
    "ask to end": Kind(_ask),
    "two runs": Kind(_two_runs),
    "two shards": Kind(_two_shards, lambda state: state.is_making() and "--shard" not in state.step),
}
