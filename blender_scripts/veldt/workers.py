"""Work on many independent things on all cores, in processes forked from this one."""

from __future__ import annotations

import ctypes
import signal
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from .faults import ConfigError

Item = TypeVar("Item")
Result = TypeVar("Result")

_MOST_AT_ONCE = 16  # items handed to a process at once
_PR_SET_PDEATHSIG = 1

_work: dict = {}  # in a worker: what it does, and with what


def in_order(act: Callable[[Item], Result], items: Sequence[Item], processes: int) -> Iterator[Result]:
    """The results of `act` for all items, in their order; the same whatever `processes` is.

    Results are pickled; `act` and the items are not, so they may be large. Not for Blender, whose threads a fork does
    not copy. An exception is raised here, with its place in the scripts. If a worker is killed, this process goes on
    alone.
    """
    done = 0
    processes = min(processes, len(items))
    if processes > 1:
        try:
            for result in _by_workers(act, items, processes):
                yield result
                done += 1
        except ConfigError:
            raise
        except Exception:  # pylint: disable=broad-exception-caught
            pass  # it is raised again below, where its traceback leads to its place
    for item in items[done:]:
        yield act(item)


def _by_workers(act: Callable[[Item], Result], items: Sequence[Item], processes: int) -> Iterator[Result]:
    # pylint: disable=import-outside-toplevel
    import multiprocessing  # takes as long as planning a short flight
    from concurrent.futures import ProcessPoolExecutor

    at_once = max(1, min(_MOST_AT_ONCE, len(items) // (4 * processes)))
    with ProcessPoolExecutor(
        processes, multiprocessing.get_context("fork"), initializer=_begin, initargs=(act, items)
    ) as pool:
        yield from pool.map(_act_on, range(len(items)), chunksize=at_once)


def _begin(act: Callable, items: Sequence) -> None:
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    _work.update(act=act, items=items)


def _act_on(place: int):
    return _work["act"](_work["items"][place])
