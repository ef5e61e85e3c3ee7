#!/usr/bin/env python3
"""Checks that every link of a site leads to a file and an anchor that exist: `check_links.py FOLDER` prints broken ones
and exits with 1 if there are any. Links to other sites are not followed.
"""

import sys
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Links and anchors of a page."""

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


@cache
def page_at(file: Path) -> Page:
    """A page, read once."""
    return Page(file)


def is_broken(link: str, file: Path) -> bool:
    """Whether a link in `file` leads nowhere."""
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


def main() -> int:
    """Checks the site that the command line names."""
    folder = Path(sys.argv[1]).resolve()
    files = sorted(folder.rglob("*.html"))
    if not files:
        sys.exit(f"{folder} has no pages; expected a site")
    broken = [
        f"{file.relative_to(folder)}: {link} leads nowhere"
        for file in files
        for link in dict.fromkeys(page_at(file).links)
        if is_broken(link, file)
    ]
    print("\n".join(broken) or f"{len(files)} pages, all of whose links are sound")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
