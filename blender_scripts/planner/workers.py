"""Parallel work on independent items, in forked processes."""

from __future__ import annotations

import ctypes
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import TypeVar

from .faults import ProcessLost

Item = TypeVar("Item")
Result = TypeVar("Result")

_MOST_AT_ONCE = 16  # items handed to a process at once
_PR_SET_PDEATHSIG = 1


class Cores:
    """Work on one or more cores; results are the same for any number."""

    def __init__(self, processes: int = 1):
        self._processes = processes
        self._started: list[_Worker] = []

    def map(self, act: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[Result]:
        """in_order() on all cores."""
        return in_order(act, items, self._processes, self._started)

    def start(self, act: Callable[[], Result]) -> Callable[[], Result]:
        """Start `act` in another process, if there is more than one core, and return a function that waits for its
        result; without a second core, or if `act` fails there, that function calls `act` itself. ProcessLost if the
        process ends early, also from map().
        """
        if self._processes < 2:
            return act
        try:
            worker = _Worker(lambda _: act(), range(1))
        except OSError:  # the system allows no more processes
            return act
        worker.hand(0, range(1))
        self._started.append(worker)

        def wait() -> Result:
            self._started.remove(worker)
            try:
                _, results, _ = worker.take()
            finally:
                worker.end()
            return results[0] if results else act()

        return wait


def in_order(
    act: Callable[[Item], Result], items: Sequence[Item], processes: int, others: Sequence[_Worker] = ()
) -> Iterator[Result]:
    """The results of `act` for all items, in their order; the same whatever `processes` is.

    Results are pickled; `act` and the items are not, so they may be large. Not for Blender, whose threads do not
    survive a fork. Exceptions are raised here, with their location in the scripts. ProcessLost as soon as a process, or
    one of `others`, ends before its work is done.
    """
    done, processes = 0, min(processes, len(items))
    if processes > 1:
        for results in _by_workers(act, items, processes, others):
            yield from results
            done += len(results)
    for item in items[done:]:  # an item that failed in a worker fails again here, with a useful traceback
        yield act(item)


class _Worker:
    """A process that calls `act` on parts of the items. It ends with this process."""

    def __init__(self, act: Callable, items: Sequence):
        self._connection, theirs = _multiprocessing().Pipe()
        order = (act, items, theirs, os.getpid())
        self._process = _multiprocessing().Process(target=_serve, args=order, daemon=True)
        try:
            self._process.start()
        finally:
            theirs.close()  # so that the connection ends with the process
        self._owed = 0
        self._taken: tuple | None = None

    @property
    def is_owing(self) -> bool:
        """Whether results are outstanding."""
        return self._owed > 0

    def fileno(self) -> int:
        """For multiprocessing.connection.wait()."""
        return self._connection.fileno()

    def hand(self, number: int, part: range) -> None:
        """Assign it some items."""
        try:
            self._connection.send((number, part))
        except OSError:
            raise self._lost() from None
        self._owed += 1

    def look(self) -> None:
        """Receive a result that has arrived, for take(). ProcessLost if there will be none."""
        try:
            self._taken = self._connection.recv()
        except (EOFError, OSError):
            raise self._lost() from None
        self._owed -= 1

    def take(self) -> tuple[int, list, bool]:
        """Wait for the results of a part: its number, those up to the first failure, and whether these are all."""
        if self._taken is None:
            self.look()
        taken, self._taken = self._taken, None
        return taken

    def end(self) -> None:
        """Terminate the process."""
        self._process.kill()
        self._process.join()
        self._connection.close()

    def _lost(self) -> ProcessLost:
        self._process.join()
        return ProcessLost("a worker process", self._process.exitcode)


def _multiprocessing():
    import multiprocessing  # pylint: disable=import-outside-toplevel # takes as long as planning a short flight

    return multiprocessing.get_context("fork")


def end_with(parent: int) -> None:
    """Have the kernel kill this process when its parent ends."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it has ended already
        os.kill(os.getpid(), signal.SIGKILL)


def _serve(act: Callable, items: Sequence, connection, parent: int) -> None:
    """A worker's loop: call `act` on request until the end."""
    end_with(parent)
    while True:
        number, part = connection.recv()
        try:
            connection.send((number, *_results(act, items, part)))
        except Exception:  # pylint: disable=broad-exception-caught # results that cannot be pickled
            connection.send((number, [], False))


def _results(act: Callable, items: Sequence, part: range) -> tuple[list, bool]:
    """The results up to the first failure, and whether these are all."""
    results = []
    for place in part:
        try:
            results.append(act(items[place]))
        except Exception:  # pylint: disable=broad-exception-caught # it is raised again by in_order()
            return results, False
    return results, True


def _by_workers(act: Callable, items: Sequence, processes: int, others: Sequence[_Worker]) -> Iterator[list]:
    """The results of one part of the items after the other, up to the first failure."""
    at_once = max(1, min(_MOST_AT_ONCE, len(items) // (4 * processes)))
    parts = [range(first, min(first + at_once, len(items))) for first in range(0, len(items), at_once)]
    workers: list[_Worker] = []
    try:
        with suppress(OSError):  # the system allows no more processes: use the existing ones
            for _ in range(processes):
                workers.append(_Worker(act, items))
        yield from _parts_in_order(workers, parts, others)
    finally:
        for worker in workers:
            worker.end()


def _parts_in_order(
    workers: Sequence[_Worker], parts: Sequence[range], others: Sequence[_Worker]
) -> Iterator[list]:
    left = iter(enumerate(parts))
    for worker in [*workers, *workers]:  # a worker gets its next part when it has finished one
        _hand_next(worker, left)
    found: dict[int, list] = {}
    for place in range(len(parts) if workers else 0):
        while place not in found:
            for worker in _ready(workers, others):
                number, *results = worker.take()
                found[number] = results
                _hand_next(worker, left)
        results, is_whole = found.pop(place)
        yield results
        if not is_whole:
            return


def _hand_next(worker: _Worker, left: Iterator[tuple[int, range]]) -> None:
    for number, part in left:
        worker.hand(number, part)
        return


def _ready(workers: Sequence[_Worker], others: Sequence[_Worker]) -> list[_Worker]:
    """Workers with results. Those of `others` are stored for them."""
    from multiprocessing.connection import wait  # pylint: disable=import-outside-toplevel

    ready = wait([worker for worker in [*workers, *others] if worker.is_owing])
    for worker in ready:
        worker.look()
    return [worker for worker in workers if worker in ready]
