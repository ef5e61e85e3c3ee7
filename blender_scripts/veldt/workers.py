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


class Cores:
    """Work on one or more cores; results are the same for any number."""

    def __init__(self, processes: int = 1):
        self._processes = processes

    def map(self, act: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[Result]:
        """in_order() on all cores."""
        return in_order(act, items, self._processes)

    def start(self, act: Callable[[], Result]) -> Callable[[], Result]:
        """Start `act` in another process, if there is more than one core, and return a function that waits for its
        result; without a second core, or if that process fails, the function acts itself."""
        if self._processes < 2:
            return act
        reader, writer = _multiprocessing().Pipe(duplex=False)
        process = _multiprocessing().Process(target=_send, args=(act, writer), daemon=True)
        process.start()
        writer.close()

        def wait() -> Result:
            try:
                return reader.recv()
            except EOFError:
                return act()
            finally:
                reader.close()
                process.join()

        return wait


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


def _multiprocessing():
    import multiprocessing  # pylint: disable=import-outside-toplevel # takes as long as planning a short flight

    return multiprocessing.get_context("fork")


def _send(act: Callable, writer) -> None:
    die_with_parent()
    try:
        writer.send(act())
    except Exception:  # pylint: disable=broad-exception-caught
        writer.close()  # the parent acts itself, where a traceback leads to the place


def die_with_parent() -> None:
    """Have the kernel kill this process when the one that started it ends."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _by_workers(act: Callable[[Item], Result], items: Sequence[Item], processes: int) -> Iterator[Result]:
    from concurrent.futures import ProcessPoolExecutor  # pylint: disable=import-outside-toplevel

    at_once = max(1, min(_MOST_AT_ONCE, len(items) // (4 * processes)))
    with ProcessPoolExecutor(
        processes, _multiprocessing(), initializer=_begin, initargs=(act, items)
    ) as pool:
        yield from pool.map(_act_on, range(len(items)), chunksize=at_once)


def _begin(act: Callable, items: Sequence) -> None:
    die_with_parent()
    _work.update(act=act, items=items)


def _act_on(place: int):
    return _work["act"](_work["items"][place])
