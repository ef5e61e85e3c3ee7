"""A long night of faults: run after run is disturbed, and one run without faults must make good what is left.

    /usr/bin/python3 tests/faults/night.py --hours 2 --seed 7 --log night.jsonl
    /usr/bin/python3 tests/faults/night.py --seed 7 --only-round 12

Each round has a line in the log. A round that fails leaves its folder, with the messages and, in `disturbed`, the
state before the resumed run. Moments depend on the machine, so repeat it a few times. A disturbed run that reports
success must have made the whole dataset, but may leave a temporary folder that it names. The exit code is 1 if anything
was lost.

Finished pictures whose bytes change in silence are not looked for: `veldt validate` finds those. Faults by preloading
follow the orders in fault_shim.c and machine_shim.c.
"""

from __future__ import annotations

import argparse
import collections
import json
import random
import shutil
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1] / "support")]

# pylint: disable=wrong-import-position
import folder_faults
import process_faults
import system_faults
from checker import committed, left_over_in, problems
from processes import adopt_orphans
from runs import left_over
from states import STEPS, Scenes, copy
from shims import Shims, can_compile
from trial import DONE, Kind, Outcome, Trial

KINDS: dict[str, Kind] = {**process_faults.KINDS, **system_faults.KINDS, **folder_faults.KINDS}


@dataclass
class Round:
    """What happened in a round; a line of the log."""

    round: int
    seed: int
    kind: str
    state: str
    where: str = ""
    faults: int = 0
    codes: list = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    resumed: int | None = None
    recovered: bool = False
    losses: list[str] = field(default_factory=list)


class Night:
    """Rounds in a folder, one after the other."""

    def __init__(self, folder: Path, scenes: Scenes, shims: Shims, seed: int):
        self._folder, self._scenes, self._shims, self._seed = folder, scenes, shims, seed

    def round(self, number: int, kinds: list[str]) -> Round:
        """A disturbed run and one that resumes it. The same number and seed give the same faults."""
        numbers = random.Random(f"{self._seed}/{number}")
        name = numbers.choice(kinds)
        state = numbers.choice([one for one in self._scenes.states if KINDS[name].suits(one)])
        done = Round(number, self._seed, name, state.where())
        folder = self._folder / "rounds" / str(number)
        trial = Trial(state, folder / "work", numbers, self._shims)
        copy(state.before, trial.work)
        outcome = KINDS[name].inject(trial)
        try:
            self._judge(trial, outcome, done)
        finally:
            outcome.clean_up()
        done.recovered = not done.losses
        if done.recovered:
            shutil.rmtree(folder)
        return done

    @staticmethod
    def _judge(trial: Trial, outcome: Outcome, done: Round) -> None:
        done.where, done.faults = outcome.where, outcome.injected
        done.codes = [one.code for one in outcome.ended]
        done.said = [one.last_line() for one in outcome.ended]
        done.losses += [f"process left: {name}" for name in left_over()]
        done.losses += [f"ended with {code}" for code in done.codes if code not in outcome.allowed]
        outcome.undo()
        state = trial.state
        if done.codes and set(done.codes) == {DONE} and outcome.finished and "shards" not in done.kind:
            named = left_over_in([one.err for one in outcome.ended], trial.work)
            found = problems(trial.work, state.after, {}, named)
            done.losses += [f"reported as done, {loss}" for loss in found]
        earlier = committed(trial.work)
        copy(trial.work, trial.work.parent / "disturbed")
        resumed = trial.run()
        done.resumed = resumed.code
        if resumed.code != DONE or resumed.err:
            done.losses.append(f"resumed: {resumed.code}, {resumed.last_line()}")
        done.losses += problems(trial.work, state.after, earlier)
        done.losses += [f"process left by the resumed run: {name}" for name in left_over()]


def table(rounds: list[Round]) -> str:
    """Faults, recoveries and losses by kind."""
    columns: dict[str, collections.Counter] = {}
    for one in rounds:
        counter = columns.setdefault(one.kind, collections.Counter())
        counter.update(rounds=1, hit=one.faults > 0, faults=one.faults, recovered=one.recovered)
        counter["lost"] += not one.recovered
    lines = [f"{'kind':24}{'rounds':>8}{'hit':>8}{'faults':>10}{'recovered':>11}{'lost':>6}"]
    rows = sorted(columns.items())
    rows.append(("all", sum(columns.values(), collections.Counter())))
    for kind, count in rows:
        lines.append(
            f"{kind:24}{count['rounds']:8}{count['hit']:8}{count['faults']:10}{count['recovered']:11}{count['lost']:6}"
        )
    return "\n".join(lines)


def main(arguments: list[str]) -> int:
    """Run the night and return its exit code."""
    parser = argparse.ArgumentParser(description="Disturb runs, and check what a resumed run makes of it.")
    parser.add_argument("--hours", type=float, help="begin no round after this time")
    parser.add_argument("--rounds", type=int, help="at most so many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only-round", type=int, help="one round, whose folder is kept")
    parser.add_argument("--kinds", default=",".join(KINDS), help="comma-separated")
    parser.add_argument("--scenes", default=",".join(STEPS), help="comma-separated")
    parser.add_argument("--log", type=Path, help="a line of JSON for each round")
    parser.add_argument("--folder", type=Path, help="work here instead of in a temporary folder")
    options = parser.parse_args(arguments)
    if not can_compile():
        print("skipped: no C compiler")
        return 0
    folder = options.folder or Path(tempfile.mkdtemp(prefix="veldt-night-"))
    rounds = _night(options, folder.resolve())
    print(table(rounds))
    lost = [one for one in rounds if not one.recovered]
    if lost:
        print(f"lost in rounds {', '.join(str(one.round) for one in lost)}, kept in {folder}/rounds")
    elif options.folder is None:
        shutil.rmtree(folder)
    return 1 if lost else 0


def _night(options: argparse.Namespace, folder: Path) -> list[Round]:
    adopt_orphans()
    folder.mkdir(parents=True, exist_ok=True)
    shims = Shims.compiled(folder)
    night = Night(folder, Scenes(folder, shims, options.scenes.split(",")), shims, options.seed)
    end = time.monotonic() + 3600 * (options.hours if options.hours is not None else 1000)
    most = options.rounds if options.rounds is not None else sys.maxsize
    numbers = [options.only_round] if options.only_round is not None else range(most)
    rounds = []
    for number in numbers:
        if time.monotonic() > end:
            break
        rounds.append(night.round(number, options.kinds.split(",")))
        _report(rounds[-1], options.log)
    return rounds


def _report(done: Round, log: Path | None) -> None:
    if log is not None:
        with open(log, "a", encoding="utf-8") as file:
            file.write(json.dumps(vars(done)) + "\n")
    if not done.recovered:
        print(json.dumps(vars(done), indent=1), flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
