"""Damage to what an earlier run has left: caches and temporary files. The next run must make it good by itself."""

from __future__ import annotations

import shutil
from pathlib import Path

from states import State, copy
from trial import ANY_CLEAN, WRONG_USE, Kind, Outcome, Trial

_GARBAGE = b"\x00garbage\xff" * 100


def _plan_of(folder: Path) -> Path:
    return folder / "out" / "plan"


def _has_plan(state: State) -> bool:
    """Whether the step uses a plan that an earlier one has made, and may make it again."""
    return state.is_making() and (_plan_of(state.before) / "plan.json").exists()


def _files_below(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file())


def _nothing_ended(where: str) -> Outcome:
    return Outcome([], where, 1)


def _damage(trial: Trial, plan: Path) -> str:
    """A file of the plan cut short, emptied, or with other bytes."""
    file = trial.random.choice(_files_below(plan))
    content = bytearray(file.read_bytes())
    how = trial.random.choice(("cut", "emptied", "flipped", "zeros"))
    if how == "cut":
        content = content[: trial.random.randrange(len(content))]
    elif how == "emptied":
        content = bytearray()
    elif how == "flipped":
        for _ in range(trial.random.choice((1, 20))):
            content[trial.random.randrange(len(content))] ^= 1 << trial.random.randrange(8)
    else:  # what a file system may leave after a power failure
        begin = trial.random.randrange(len(content))
        content[begin:] = bytes(len(content) - begin)
    file.write_bytes(content)
    return f"{file.relative_to(trial.work)} {how}"


def _swap(trial: Trial, plan: Path) -> str:
    """Files of the plan renamed, removed, or swapped with another."""
    how = trial.random.choice(("removed", "renamed", "swapped", "tracks swapped", "folder emptied"))
    files = _files_below(plan)
    file = trial.random.choice(files)
    if how == "removed":
        file.unlink()
    elif how == "renamed":
        file.rename(file.with_name(file.name + ".old"))
    elif how == "folder emptied":
        shutil.rmtree(file.parent)
        file.parent.mkdir()
    else:
        tracks = [one for one in files if one.parent.name == "tracks" and one.suffix == ".bin"]
        if how == "swapped":
            tracks = [one for one in files if one.suffix == file.suffix]
        file, other = trial.random.sample(tracks, 2)
        pairs = [(file, other)]
        if how == "tracks swapped":
            pairs.append((file.with_suffix(".json"), other.with_suffix(".json")))
        for one, another in pairs:
            kept = one.read_bytes()
            another.replace(one)
            another.write_bytes(kept)
    return f"{file.relative_to(trial.work)} {how}"


def _damaged_cache(trial: Trial) -> Outcome:
    return _nothing_ended(_damage(trial, _plan_of(trial.work)))


def _swapped_files(trial: Trial) -> Outcome:
    return _nothing_ended(_swap(trial, _plan_of(trial.work)))


def _damaged_plan(trial: Trial) -> Outcome:
    """The plan of other machines, which a shard cannot make again: the run is refused, or does not need the file."""
    plan, kept = trial.work / "plan", trial.work.parent / "kept"
    copy(plan, kept)
    where = trial.random.choice((_damage, _swap))(trial, plan)
    ended = trial.run()
    return Outcome([ended], where, 1, (*ANY_CLEAN, WRONG_USE), undo=lambda: copy(kept, plan))


def _clips_of(state: State) -> list[str]:
    """Clips that the step makes, or finds. A shard leaves the others alone: another run may be making them."""
    known, there = (
        {clip.name for clip in folder.glob("out/clips/*")} for folder in (state.after, state.before)
    )
    return sorted(known - there if "--shard" in state.step else known)


def _garbage(trial: Trial) -> Outcome:
    """Temporary files and folders of a run that was killed, or of an older program."""
    known = ["plan.part/plan.json", "plan.part/deep/er", "dataset.json.tmp", "annotations.json.tmp"]
    clip = trial.random.choice(_clips_of(trial.state))
    known += [f"clips/{clip}.part/ir16/000000.png", f"clips/{clip}.part/clip.json"]
    left = trial.random.sample(known, trial.random.randint(1, len(known)))
    for name in left:
        file = trial.work / "out" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(_GARBAGE)
    return _nothing_ended(", ".join(left))


KINDS = {
    "damaged cache": Kind(_damaged_cache, _has_plan),
    "swapped files": Kind(_swapped_files, _has_plan),
    "damaged plan": Kind(_damaged_plan, lambda state: "--plan" in state.step),
    "garbage": Kind(_garbage, lambda state: state.is_making() and (state.after / "out").is_dir()),
}
