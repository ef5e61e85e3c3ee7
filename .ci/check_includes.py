"""Checks that no modules of a library include each other in a circle. A module is a header with its source.

Standard input names the files, one a line, relative to the root. Exit 0 when all is well; 1 with one line a circle:
`<module> -> <module> -> …; expected a type that two need in a header of its own`.
"""

import re
import sys
from pathlib import Path

ROOT = "thermal_core/"
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)

Graph = dict[str, set[str]]


def module_of(name: str) -> str:
    """The header or source without its ending."""
    return name.rsplit(".", 1)[0]


def includes_of(files: list[str]) -> Graph:
    """The modules that each module includes."""
    graph: Graph = {module_of(file.removeprefix(ROOT)): set() for file in files}
    for file in files:
        own = module_of(file.removeprefix(ROOT))
        named = map(module_of, INCLUDE.findall(Path(file).read_text(encoding="utf-8")))
        graph[own] |= {name for name in named if name in graph and name != own}
    return graph


def circles_in(graph: Graph) -> list[list[str]]:
    """One circle for each module that begins one, found by depth-first search."""
    state: dict[str, str] = {}
    circles = []

    def visit(module: str, path: list[str]) -> None:
        state[module] = "open"
        for other in sorted(graph[module]):
            if state.get(other) == "open":
                circles.append([*path[path.index(other) :], other])
            elif other not in state:
                visit(other, [*path, other])
        state[module] = "done"

    for module in sorted(graph):
        if module not in state:
            visit(module, [module])
    return circles


def main() -> int:
    """Check all C++ files of the library among those on standard input."""
    named = sys.stdin.read().splitlines()
    files = [file for file in named if file.startswith(ROOT) and file.endswith((".h", ".cpp"))]
    graph = includes_of(files)
    circles = circles_in(graph)
    for circle in circles:
        print(f"{' -> '.join(circle)}; expected a type that two need in a header of its own")
    if not circles:
        print(f"{len(graph)} modules without a circle")
    return 1 if circles else 0


if __name__ == "__main__":
    sys.exit(main())
