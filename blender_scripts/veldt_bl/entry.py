"""What the scripts that Blender runs have in common: how they end."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from pathlib import Path

from veldt.events import Events
from veldt.faults import ConfigError


def run(act: Callable[[], None], events: Events) -> int:
    """Acts, tells how that ended, and returns the exit code: 0 done, 1 failed, 2 the config is at fault."""
    try:
        act()
    except ConfigError as error:
        return _fail(events, "config", error, 2)
    except Exception as error:  # pylint: disable=broad-exception-caught
        traceback.print_exc()
        return _fail(events, "internal", error, 1)
    events.tell("done")
    return 0


def own_arguments() -> list[str]:
    """Those after Blender's own."""
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []


def _fail(events: Events, kind: str, error: Exception, code: int) -> int:
    """Tells of an error, and of the place in these scripts that it came out of."""
    here = str(Path(__file__).resolve().parents[1])
    ours = [step for step in traceback.extract_tb(error.__traceback__) if step.filename.startswith(here)]
    message = str(error) or type(error).__name__
    events.tell(
        "error", kind=kind, message=message, where=f"{Path(ours[-1].filename).name}:{ours[-1].lineno}"
    )
    print(message, file=sys.stderr)
    return code
