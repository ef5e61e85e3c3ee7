"""Entry point shared by the scripts that Blender runs: exit codes and error events.

Like planner.failures, it imports nothing but Python's standard library.
"""

from __future__ import annotations

import argparse
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from planner import failures
from planner.events import Events


def run(act: Callable[[], None], events: Events) -> int:
    """Run `act`, report its outcome, and return the exit code: 0 done, 1 failed, 2 the config is at fault."""
    code = failures.run(act, lambda error: _report(events, error))
    if code == 0:
        events.report("done")
    return code


@contextmanager
def reported_imports() -> Iterator[None]:
    """Reports imports that fail, such as that of a missing NumPy, as run() does, and exits."""
    try:
        yield
    except BaseException as error:  # pylint: disable=broad-exception-caught
        parser = argparse.ArgumentParser(add_help=False)
        parser.add_argument("--events-fd", type=int)
        sys.exit(_report(Events(parser.parse_known_args(own_arguments())[0].events_fd), error))


def own_arguments() -> list[str]:
    """The arguments after Blender's own."""
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []


def _report(events: Events, error: BaseException) -> int:
    """Write an event of the exception, and its traceback into the log."""
    failure = failures.failure_of(error)
    kind = "config" if failure.is_config_fault else "internal"
    hint = {"hint": failure.hint} if failure.hint else {}
    events.report("error", kind=kind, message=failure.message, where=failure.where, **hint)
    with suppress(OSError):  # the disk that holds the log may be full
        if kind == "internal":
            traceback.print_exception(error)
        print(failure.in_words(), file=sys.stderr)
    return failure.exit_code
