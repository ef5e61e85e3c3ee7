"""Sphinx's settings for the site of `./run docs`: the repository's Markdown files, the pages of this folder, and the
Python package from its docstrings. The root of the repository is Sphinx's source folder, so that links between files
work in a checkout, too.
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[2] / "thermal_core/python")]

# pylint: disable=invalid-name,wrong-import-position,import-error
from pygments.lexers.special import TextLexer
from pages import notebook_to_markdown, without_folder_links
from stub import load_stub

load_stub("veldt._core", Path(__file__).parents[2] / "thermal_core/python/veldt/_core.pyi")

project = "Veldt"
version = "0.1"
root_doc = "cli/docs/index"
extensions = ["sphinx.ext.autodoc", "myst_parser"]
source_suffix = {".rst": "restructuredtext", ".md": "markdown", ".ipynb": "markdown"}
include_patterns = [
    "*.md",
    "assets/**.md",
    "blender_scripts/**.md",
    "cli/docs/*.md",
    "cli/README.md",
    "cli/docs/*.rst",
    "configs/*.ipynb",
    "configs/*.md",
    "tests/README.md",
    "tests/THREATS.md",
    "tests/fuzz/found/ORIGIN.md",
    "thermal_core/*.md",
    "thermal_core/python/README.md",
]
exclude_patterns = ["build", ".git"]
myst_heading_anchors = 4
suppress_warnings = ["misc.highlighting_failure"]  # for JSON abbreviated with …

# Backquotes mark code; types of other projects are not linked, because the site is built without network.
default_role = "code"
nitpick_ignore_regex = [("py:.*", r"(?!veldt\.).*")]
autoclass_content = "both"
autodoc_member_order = "bysource"
autodoc_mock_imports = [
    "datasets",
    "gymnasium",
    "pyarrow",
    "pymavlink",
    "supervision",
    "torch",
    "torchvision",
]
autodoc_type_aliases = {"ArrayLike": "ArrayLike", "Source": "Source"}
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = "Veldt"
html_static_path = ["style.css"]
html_css_files = ["style.css"]
html_copy_source = False
html_show_copyright = False
html_additional_pages = {"index": "to_first_page.html"}
templates_path = ["templates"]


def read_source(app, name: str, source: list[str]) -> None:
    """Convert notebooks to Markdown, and unlink folders, which have no pages on a site."""
    file = Path(app.env.doc2path(name))
    if file.suffix == ".ipynb":
        source[0] = notebook_to_markdown(source[0])
    source[0] = without_folder_links(source[0], file.parent)


def hide_constructor(_app, what: str, _name: str, item, *_) -> tuple[str, str] | None:
    """Hide the constructor arguments of classes that only the package instantiates."""
    is_made = what == "class" and (item.__init__.__doc__ or "").startswith("Made by ")
    return ("", "") if is_made else None


def setup(app) -> None:
    """Called by Sphinx."""
    app.add_lexer("mermaid", TextLexer)  # diagrams are shown as text: Pygments has no lexer for them
    app.connect("source-read", read_source)
    app.connect("autodoc-process-signature", hide_constructor)
