"""Convert files for Sphinx to Markdown that it supports."""

import json
import re
from pathlib import Path

LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)#\s]+)\)")


def without_folder_links(text: str, folder: Path) -> str:
    """`text` of a file in `folder`, with links to folders replaced by their words."""
    return LINK.sub(lambda link: link[1] if (folder / link[2]).is_dir() else link[0], text)


def notebook_to_markdown(text: str) -> str:
    """A notebook (nbformat 4, language Python) with its outputs: text, PNG and JPEG pictures."""
    cells = json.loads(text)["cells"]
    return "\n\n".join(_cell_to_markdown(cell) for cell in cells) + "\n"


def _cell_to_markdown(cell: dict) -> str:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return source
    return "\n\n".join([_fenced(source, "python"), *map(_output_to_markdown, cell["outputs"])])


def _output_to_markdown(output: dict) -> str:
    if output["output_type"] == "stream":
        return _fenced("".join(output["text"]), "text")
    data = output["data"]
    for kind in ("image/png", "image/jpeg"):
        if kind in data:
            return f"![Output](data:{kind};base64,{''.join(data[kind]).replace(chr(10), '')})"
    return _fenced("".join(data["text/plain"]), "text")


def _fenced(text: str, language: str) -> str:
    return f"```{language}\n{text.rstrip()}\n```"
