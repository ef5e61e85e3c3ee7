"""Builds the site in build/docs/html and checks it, for `./run docs`. Needs neither a compiler nor the program: a stub
stands in for the compiled part of the Python package.
"""

import re
import shutil
import sys
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "support"))

# pylint: disable=wrong-import-position
from checks import Checks, ran

BUILD = Path("build/docs")
STAGED = re.compile(r"^\S*/build/docs/include/veldt/")
UNDOCUMENTED_MEMBER = re.compile(r" Member .* of (?:class|struct|union) .* is not documented\.$")


def has_no_warnings(log: Path) -> bool:
    """Print Doxygen's warnings that count, each once, with files as they are called in the repository.

    All but one kind do: a member of a documented class may have no docstring, if its name and unit say what it is.
    Classes, and whatever stands in a namespace itself, need one.
    """
    lines = log.read_text(encoding="utf-8").splitlines()
    faults = [STAGED.sub("thermal_core/", line) for line in lines if not UNDOCUMENTED_MEMBER.search(line)]
    print("\n".join(dict.fromkeys(faults)) or "no warnings that count")
    return not faults


class Page(HTMLParser):
    """What a page links to, and the places in it."""

    def __init__(self, file: Path) -> None:
        """Read the page."""
        super().__init__()
        self.links: list[str] = []
        self.places: set[str] = set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Called for each element."""
        values = dict(attrs)
        self.links += [values[key] for key in ("href", "src") if values.get(key)]
        self.places |= {values[key] for key in ("id", "name") if values.get(key)}


page_at = cache(Page)


def is_broken(link: str, file: Path) -> bool:
    """Whether a link in `file` leads nowhere. Links to other sites are not followed."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return False
    target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    if not target.is_file():
        return True
    return (
        bool(parts.fragment)
        and target.suffix == ".html"
        and unquote(parts.fragment) not in page_at(target).places
    )


def has_sound_links(site: Path) -> bool:
    """Print links of a site that lead to no file, or to no place in it."""
    folder = site.resolve()
    files = sorted(folder.rglob("*.html"))
    broken = [
        f"{file.relative_to(folder)}: {link} leads nowhere"
        for file in files
        for link in dict.fromkeys(page_at(file).links)
        if is_broken(link, file)
    ]
    if not files:
        broken = [f"{folder} has no pages; expected a site"]
    print("\n".join(broken) or f"{len(files)} pages, all of whose links are sound")
    return not broken


def has_pages() -> bool:
    """Build the site."""
    options = "-n -W --keep-going -q -c cli/docs -d".split()
    return ran(sys.executable, "-m", "sphinx", *options, BUILD / "doctrees", ".", BUILD / "html")


def has_reference() -> bool:
    """The C++ reference, of the headers as they are installed. Doxygen's exit code does not count, its warnings do."""
    staged = (BUILD / "include" / "veldt").absolute()
    return (
        ran("cmake", "-D", f"staged={staged}", "-P", "cli/docs/stage_headers.cmake")
        and ran("doxygen", "cli/docs/Doxyfile")
        and has_no_warnings(BUILD / "doxygen.log")
    )


def check_docs(checks: Checks) -> None:
    """Build and check all."""
    shutil.rmtree(BUILD, ignore_errors=True)
    (BUILD / "html").mkdir(parents=True)
    checks.check("pages", has_pages)
    checks.check("C++ reference", has_reference)
    checks.check("links", has_sound_links, BUILD / "html")


def main() -> None:
    """`./run docs`."""
    checks = Checks()
    check_docs(checks)
    checks.conclude("docs")
    print("Open build/docs/html/index.html")


if __name__ == "__main__":
    main()
