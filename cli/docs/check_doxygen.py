#!/usr/bin/env python3
"""Filters Doxygen's warnings: `check_doxygen.py LOG` prints those that count and exits with 1 if there are any.

Members of a documented class may have no docstring, if name and unit are enough; classes, and everything directly in a
namespace, need one.
"""

import re
import sys
from pathlib import Path

STAGED = re.compile(r"^\S*/build/docs/include/veldt/")
UNDOCUMENTED_MEMBER = re.compile(r" Member .* of (?:class|struct|union) .* is not documented\.$")


def faults(log: str) -> list[str]:
    """The warnings that count, without repetition, with file names relative to the repository."""
    lines = [line for line in log.splitlines() if not UNDOCUMENTED_MEMBER.search(line)]
    return list(dict.fromkeys(STAGED.sub("thermal_core/", line) for line in lines))


def main() -> int:
    """Checks the log that the command line names."""
    found = faults(Path(sys.argv[1]).read_text(encoding="utf-8"))
    print("\n".join(found) or "no warnings that count")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
