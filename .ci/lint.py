"""The checks of `./run lint`: of all files, but with clang-tidy and pylint what was changed in the last day.

    python3 .ci/lint.py [--fix|--all]
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path.cwd()
sys.path.insert(0, str(ROOT / "tests" / "support"))

# pylint: disable=wrong-import-position
from checks import Checks, fail, from_run, ran

TIDY = ROOT / "build" / "tidy"
SCRIPTS = re.compile(r"run|\.ci/(run|nightly|.*\.sh)|tests/fresh/.*\.sh")


def lines_of(*command: str) -> list[str]:
    """The lines that a program prints."""
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout.splitlines()


def git(*arguments: str) -> list[str]:
    """The lines that git prints. It refuses the checkout of another user, in which listing files is harmless."""
    return lines_of("git", "-c", "safe.directory=*", *arguments)


def all_files() -> list[str]:
    """The files of the repository, new ones included."""
    listed = git("ls-files", "--cached", "--others", "--exclude-standard")
    return [file for file in listed if Path(file).is_file()]


def changed_files(*patterns: str) -> list[str]:
    """Files that a commit of the last day before HEAD, or none yet, has changed."""
    day = int(git("log", "-1", "--format=%ct")[0]) - 86400
    since = git("rev-list", "-1", f"--before={day}", "HEAD") or ["HEAD"]
    return git("diff", "--name-only", "--diff-filter=d", *since, "--", *patterns)


def changed_sources() -> list[str]:
    """Changed C++ sources outside of tests; of a header, the source beside it."""
    patterns = (f"{folder}/*.{ending}" for folder in ("thermal_core", "cli") for ending in ("cpp", "h"))
    sources = {re.sub(r"\.h$", ".cpp", file) for file in changed_files(*patterns)}
    return sorted(file for file in sources if Path(file).is_file())


def pylint(files: list[str]) -> bool:
    """Run pylint, if there is something to check."""
    return not files or ran(sys.executable, "-m", "pylint", "--jobs", 2, "--score", "n", *files)


def sources_of(file: Path) -> list[Path]:
    """A source, or those that a batch of the release build includes."""
    included = re.findall(r'#include "(.+\.cpp)"', file.read_text(encoding="utf-8"))
    return [Path(one) for one in included] or [file]


def tidy_batches(files: list[str]) -> list[str]:
    """Batches of sources, written to build/tidy with how the release build compiles them: one a library, because
    clang-tidy's time goes into headers."""
    wanted = {ROOT / file for file in files}
    TIDY.mkdir(exist_ok=True)
    chosen: dict[str, list[Path]] = {}
    entries = {}
    for entry in json.loads((ROOT / "build/release/compile_commands.json").read_text(encoding="utf-8")):
        found = [source for source in sources_of(Path(entry["file"])) if source in wanted]
        library = re.search(r"CMakeFiles/(\w+)\.dir", entry["command"])[1]
        if found and "/tests/" not in entry["file"]:
            batch = str(TIDY / f"{library}.cpp")
            chosen.setdefault(batch, []).extend(found)
            command = entry["command"].replace(entry["file"], batch)
            entries[batch] = entry | {"file": batch, "command": command}
    for batch, sources in chosen.items():
        Path(batch).write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
    (TIDY / "compile_commands.json").write_text(json.dumps(list(entries.values())), encoding="utf-8")
    return list(chosen)


def tidy_batch(batch: str) -> bool:
    """Run clang-tidy. --quiet still counts the warnings in third-party headers; Clang takes no --param of GCC's."""
    options = ("--config-file=.clang-tidy", "--extra-arg=-Wno-unused-command-line-argument")
    command = ["clang-tidy", "--quiet", "-p", str(TIDY), *options, batch]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    counted = re.compile(r"^.*warnings? generated.*\n", re.MULTILINE)
    print(done.stdout + counted.sub("", done.stderr), end="")
    return done.returncode == 0


def tidy(files: list[str]) -> bool:
    """clang-tidy, as many at once as there are compilers in a build."""
    with ThreadPoolExecutor(int(lines_of(*from_run("job_count"))[0])) as pool:
        return all(list(pool.map(tidy_batch, tidy_batches(files))))


def main(options: list[str]) -> None:
    """Check, or format, all."""
    checks, files = Checks(), all_files()
    listed = "\n".join(files)
    cpp = [file for file in files if file.endswith((".cpp", ".h"))]
    python = [file for file in files if file.endswith(".py")]
    scripts = [file for file in files if SCRIPTS.fullmatch(file)]
    if not (cpp and python):
        fail(1, "git lists no source files here; lint needs a git checkout")
    black = (sys.executable, "-m", "black", "--quiet")
    if "--fix" in options:
        sys.exit(not (ran("clang-format", "-i", *cpp) and ran(*black, *python)))
    checks.check("shell scripts", ran, "shellcheck", *scripts)
    checks.check("files", ran, sys.executable, ".ci/check_tree.py", input=listed, text=True)
    checks.check("circles of includes", ran, sys.executable, ".ci/check_includes.py", input=listed, text=True)
    checks.check("C++ format", ran, "clang-format", "--dry-run", "--Werror", *cpp)
    checks.check("Python format", ran, *black, "--check", "--diff", *python)
    checks.check("Python", pylint, python if "--all" in options else changed_files("*.py"))
    with_warnings = os.environ | {"VELDT_WERROR": "1"}
    checks.check("C++ warnings", ran, *from_run("build_tests"), env=with_warnings)
    # Tests are checked for warnings and format only: clang-tidy over them would double the time of lint.
    if "--all" in options:
        checks.check("C++", tidy, cpp)
    else:
        checks.check("C++ of the last day", tidy, changed_sources())
    checks.conclude("lint")


if __name__ == "__main__":
    main(sys.argv[1:])
