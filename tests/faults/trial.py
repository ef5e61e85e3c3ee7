"""One disturbed run: what a kind of fault is given, and what it returns."""

from __future__ import annotations

import random
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from runs import Ended, finish, run_to_end, start
from states import State
from shims import Orders, Shims, injected

DONE, FAILED, WRONG_USE, REJECTED, TRY_AGAIN = 0, 1, 2, 3, 75
ANY_CLEAN = (DONE, FAILED, REJECTED, TRY_AGAIN)


@dataclass
class Trial:
    """A state to start from, in a folder of its own, and seeded random numbers."""

    state: State
    work: Path
    random: random.Random
    shims: Shims

    @property
    def log(self) -> Path:
        """What the preloaded libraries inject."""
        return self.work.parent / "injected.txt"

    def moment_s(self) -> float:
        """Some time of an undisturbed run."""
        return self.random.uniform(0.0, 1.05 * self.state.takes_s)

    def start(self, name: str = "run", step: Sequence[str] | None = None, **how) -> subprocess.Popen:
        """Start the step."""
        return start(step or self.state.step, self.work, name=name, **how)

    def finish(self, run: subprocess.Popen, name: str = "run") -> Ended:
        """Wait for it."""
        return finish(run, self.work, name)

    def run(self, **how) -> Ended:
        """Run the step to its end."""
        return run_to_end(self.state.step, self.work, **how)

    def preloaded(self, orders: Orders) -> dict[str, str]:
        """The environment of a run in which the program and its planner follow these orders."""
        env = self.shims.preloaded(orders, self.work, self.log)
        python = self.shims.python(self.work.parent / "python", env)
        return env | {"VELDT_PYTHON": str(python)}

    def injected(self) -> int:
        """Faults that the libraries have injected so far."""
        return injected(self.log)


@dataclass
class Outcome:
    """How a disturbed run ended, and with which exit codes it may."""

    ended: list[Ended]
    where: str
    injected: int
    allowed: tuple[int, ...] = ANY_CLEAN
    undo: Callable[[], object] = field(default=lambda: None)  # ends the fault, before the run is resumed
    clean_up: Callable[[], object] = field(default=lambda: None)  # at the end
    finished: bool = True  # whether a run that reports success must have done all of its work


@dataclass(frozen=True)
class Kind:
    """A kind of fault: what injects it, and when it can."""

    inject: Callable[[Trial], Outcome]
    suits: Callable[[State], bool] = field(default=lambda state: True)
    needs_root: bool = False
