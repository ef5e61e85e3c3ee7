"""Plans and datasets from configs."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any, NamedTuple

import veldt._core as _core
from .home import home

Source = dict[str, Any] | str | PathLike[str]


class Progress(NamedTuple):
    """Progress of a run."""

    stage: str
    """Unit of the counts: "planning", "ground maps" or "frames"."""
    clip: str
    """The current clip."""
    done: int
    total: int


@dataclass(frozen=True)
class Outcome:
    """Result of a run."""

    made: list[str]
    """Clips made in this run."""
    already_there: list[str]
    """Clips that were complete before."""
    failed: dict[str, str]
    """Clips that could not be made, with the reason; the next run tries again."""
    frames_made: int
    complete: bool
    """The dataset now has all its clips."""


def plan(
    config: Source,
    folder: str | PathLike[str],
    *,
    settings: Iterable[str] = (),
    threads: int = 0,
    progress: Callable[[Progress], None] | None = None,
) -> list[str]:
    """Plan a config into `folder`, as `veldt plan` does; returns the ids of its clips. An unchanged existing plan is
    reused. Arguments and errors are those of generate().
    """
    return _core.plan_config(_sources(config, settings), fspath(folder), threads, _report_to(progress))


def generate(
    config: Source | None = None,
    out: str | PathLike[str] = "dataset",
    *,
    plan_folder: str | PathLike[str] | None = None,
    settings: Iterable[str] = (),
    clips: Iterable[str] = (),
    jobs: int = 1,
    threads: int = 0,
    keep_passes: bool = False,
    blender: str | PathLike[str] = "",
    progress: Callable[[Progress], None] | None = None,
) -> Outcome:
    """Make or complete a dataset, as `veldt generate` does.

    config: a config or its file, or `plan_folder`: the folder of plan(). settings: "key=value", as of --set, such as
    "render.engine=blender". clips: only these. jobs: Blender processes. threads: in total; 0: all cores. progress:
    called from time to time, never concurrently; its exceptions end the run. So does Ctrl-C. Finished clips are kept,
    and the next call continues.

    ConfigError for an invalid config, before anything is made; IoError, TryAgainError. Clips that cannot be made are in
    the outcome.
    """
    if (config is None) == (plan_folder is None):
        raise _core.ConfigError("generate: expected a config or plan_folder, and not both")
    chosen = _core.RunSettings(list(clips), fspath(blender), jobs, threads, keep_passes)
    report = _report_to(progress)
    if plan_folder is not None:
        made = _core.generate_plan(fspath(plan_folder), home(), fspath(out), chosen, report)
    else:
        made = _core.generate_config(_sources(config, settings), fspath(out), chosen, report)
    return Outcome(**made)


def _report_to(progress: Callable[[Progress], None] | None) -> Callable[..., None] | None:
    return progress and (lambda *now: progress(Progress(*now)))


def _sources(config: Source, settings: Iterable[str]) -> _core.Sources:
    text, name = document_of(config, "config")
    folder = Path.cwd() if isinstance(config, dict) else Path(fspath(config)).absolute().parent
    return _core.Sources(text, name, str(folder), list(settings), home())


def document_of(source: Source, name: str) -> tuple[str, str]:
    """The JSON of a document or its file, and its name in messages."""
    if isinstance(source, dict):
        return json_of(source, name), name
    file = fspath(source)
    return _core.read_json(file), file


def json_of(document: Any, name: str) -> str:
    """A document as JSON text; ConfigError for values that JSON cannot represent."""
    try:
        return json.dumps(document, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise _core.ConfigError(
            f"{name}: {error}; expected texts, finite numbers, lists and dictionaries"
        ) from error
