"""The notebook of `configs`, whose outputs are in it: does its code still fit the package? Running it takes minutes."""

import ast
import base64
import inspect
import json

import pytest

import veldt
from program import ROOT

_FILE = ROOT / "configs" / "first_detector.ipynb"


def _cells() -> list[dict]:
    cells = json.loads(_FILE.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in cells if cell["cell_type"] == "code"]


def _tree() -> ast.Module:
    return ast.parse("\n".join("".join(cell["source"]) for cell in _cells()))


def _calls_of_veldt(tree: ast.Module) -> list[ast.Call]:
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return [call for call in calls if ast.unparse(call.func).startswith("veldt.")]


def test_each_cell_compiles():
    for cell in _cells():
        compile("".join(cell["source"]), _FILE.name, "exec")


def test_calls_fit_the_package():
    calls = _calls_of_veldt(_tree())
    assert {call.func.attr for call in calls} == {"generate", "open_dataset"}
    for call in calls:
        signature = inspect.signature(getattr(veldt, call.func.attr))
        signature.bind(*call.args, **{keyword.arg: keyword.value for keyword in call.keywords})


def test_frames_and_labels_have_what_it_reads(generated):
    read = {node.attr for node in ast.walk(_tree()) if isinstance(node, ast.Attribute)}
    frame = next(generated.frames())
    label = next(label for each in generated.frames() for label in each.labels)
    for thing, names in (
        (generated, {"frames"}),
        (frame, {"ir8", "ir16_k", "labels", "shutter_closed", "clip", "index"}),
        (label, {"category", "box_px", "values"}),
    ):
        assert names <= read
        assert all(hasattr(thing, name) for name in names)


def test_its_config_is_valid(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    functions = [node for node in _tree().body if isinstance(node, ast.FunctionDef) and node.name == "night"]
    names: dict = {}
    exec(compile(ast.Module(functions, []), _FILE.name, "exec"), names)  # pylint: disable=exec-used
    assert veldt.plan(names["night"](1, 2), "plan") == ["clip_0000", "clip_0001"]


@pytest.mark.parametrize("cell", _cells())
def test_outputs_are_small_and_whole(cell):
    assert cell["execution_count"] is not None
    for output in cell["outputs"]:
        assert output["output_type"] in ("stream", "display_data", "execute_result")
        picture = base64.b64decode(output.get("data", {}).get("image/jpeg", ""))
        assert len(picture) < 100_000
