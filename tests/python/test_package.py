"""The package as installed."""

import ast
from pathlib import Path

import veldt
from veldt import _core


def test_stubs_name_what_the_compiled_part_has():
    stub = ast.parse(Path(veldt.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))
    named = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef | ast.FunctionDef)}
    assert set(named) == {name for name in dir(_core) if not name.startswith("_")}
    for name, node in named.items():
        if isinstance(node, ast.ClassDef) and not issubclass(getattr(_core, name), Exception):
            members = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
            has = {one for one in vars(getattr(_core, name)) if not one.startswith("_")}
            assert members - {"__init__"} == has, name


def test_stubs_document_errors_as_the_compiled_part_does():
    stub = ast.parse(Path(veldt.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    errors = [node for node in classes if issubclass(getattr(_core, node.name), Exception)]
    assert len(errors) == 6
    for node in errors:
        assert ast.get_docstring(node) == getattr(_core, node.name).__doc__, node.name


def test_all_names_are_documented():
    for name in veldt.__all__:
        assert getattr(veldt, name).__doc__, name
        assert getattr(veldt, name).__module__.startswith("veldt"), name
    assert (Path(veldt.__file__).parent / "py.typed").exists()
