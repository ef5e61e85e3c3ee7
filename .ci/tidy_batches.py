"""Batches for clang-tidy of the sources that are named on standard input: one a library, as its time goes into headers.

Writes them to build/tidy, with how the release build compiles that library, and prints their paths.
"""

import json
import re
import sys
from pathlib import Path

ROOT = Path.cwd()


def sources_of(file: Path) -> list[Path]:
    """A source, or those that a batch of the release build includes."""
    included = re.findall(r'#include "(.+\.cpp)"', file.read_text(encoding="utf-8"))
    return [Path(one) for one in included] or [file]


def main() -> None:
    """Group by library."""
    wanted = {ROOT / line.strip() for line in sys.stdin}
    folder = ROOT / "build/tidy"
    folder.mkdir(exist_ok=True)
    compiled = json.loads((ROOT / "build/release/compile_commands.json").read_text(encoding="utf-8"))
    chosen: dict[str, list[Path]] = {}
    entries = {}
    for entry in compiled:
        found = [source for source in sources_of(Path(entry["file"])) if source in wanted]
        library = re.search(r"CMakeFiles/(\w+)\.dir", entry["command"])[1]
        if found and "/tests/" not in entry["file"]:
            batch = str(folder / f"{library}.cpp")
            chosen.setdefault(batch, []).extend(found)
            entries[batch] = entry | {
                "file": batch,
                "command": entry["command"].replace(entry["file"], batch),
            }
    for batch, sources in chosen.items():
        Path(batch).write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
        print(batch)
    (folder / "compile_commands.json").write_text(json.dumps(list(entries.values())), encoding="utf-8")


main()
