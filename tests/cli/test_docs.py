"""What `./run docs` uses beside Sphinx and Doxygen: Markdown of notebooks, and which warnings and links are errors."""

import json
import sys

from program import ROOT

DOCS = ROOT / "cli" / "docs"
sys.path.insert(0, str(DOCS))

# pylint: disable=wrong-import-position
from build_docs import has_no_warnings, has_sound_links
from pages import notebook_to_markdown, without_folder_links

PNG = {"output_type": "display_data", "data": {"image/png": "aGk=\n", "text/plain": ["<Figure>"]}}
JPEG = {"output_type": "display_data", "data": {"image/jpeg": ["aG\n", "k="], "text/plain": ["<Figure>"]}}


def cell(kind: str, source: list[str], outputs: list[dict] | None = None) -> dict:
    """A cell of a notebook."""
    return {"cell_type": kind, "source": source} | ({} if outputs is None else {"outputs": outputs})


def test_notebook_becomes_text_code_and_outputs():
    printed = {"output_type": "stream", "text": ["12\n", "13\n"]}
    value = {"output_type": "execute_result", "data": {"text/plain": ["[14]"]}}
    cells = [
        cell("markdown", ["# Title\n", "Text."]),
        cell("code", ["print(12)\n", "[14]"], [printed, value, PNG, JPEG]),
    ]
    assert notebook_to_markdown(json.dumps({"cells": cells})) == (
        "# Title\nText.\n\n```python\nprint(12)\n[14]\n```\n\n```text\n12\n13\n```\n\n```text\n[14]\n```\n\n"
        "![Output](data:image/png;base64,aGk=)\n\n![Output](data:image/jpeg;base64,aGk=)\n"
    )


def test_links_to_folders_become_text(tmp_path):
    (tmp_path / "plants").mkdir()
    (tmp_path / "page.md").touch()
    text = (
        "[`plants`](plants), [a page](page.md), [a place](page.md#place), ![picture](plants), [x](https://y)"
    )
    assert without_folder_links(text, tmp_path) == text.replace("[`plants`](plants)", "`plants`")


def test_warnings_of_doxygen_count_but_for_members(tmp_path, capsys):
    log = tmp_path / "log"
    staged = "/a/build/docs/include/veldt/base/rng.h"
    member = f"{staged}:3: warning: Member x (variable) of struct thermal::R is not documented."
    others = [
        ":2: warning: Compound thermal::R is not documented.",
        ":9: warning: Member f() (function) of namespace thermal is not documented.",
    ]
    lines = [staged + other for other in others]
    log.write_text("\n".join([member, *lines, lines[0]]), encoding="utf-8")
    assert not has_no_warnings(log)
    assert capsys.readouterr().out == "".join(f"thermal_core/base/rng.h{other}\n" for other in others)
    log.write_text(member, encoding="utf-8")
    assert has_no_warnings(log)
    assert capsys.readouterr().out == "no warnings that count\n"


def test_broken_links_are_named(tmp_path, capsys):
    (tmp_path / "a.html").write_text(
        '<a id="here" href="#here">1</a><a href="b.html#there">2</a><a href="https://example.org/x">3</a>'
        '<a href="#gone">4</a><a href="b.html#gone">5</a><img src="gone.png">',
        encoding="utf-8",
    )
    (tmp_path / "b.html").write_text('<p id="there">', encoding="utf-8")
    assert not has_sound_links(tmp_path)
    faults = ("#gone", "b.html#gone", "gone.png")
    assert capsys.readouterr().out == "".join(f"a.html: {link} leads nowhere\n" for link in faults)
    (tmp_path / "a.html").unlink()
    assert has_sound_links(tmp_path)
    assert capsys.readouterr().out == "1 pages, all of whose links are sound\n"


def test_a_folder_without_pages_is_no_site(tmp_path, capsys):
    assert not has_sound_links(tmp_path)
    assert capsys.readouterr().out == f"{tmp_path} has no pages; expected a site\n"
