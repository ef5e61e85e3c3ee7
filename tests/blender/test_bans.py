"""Scene code uses neither clocks nor hidden random state, and plans without Blender."""

import ast
from pathlib import Path

import pytest

from planner.config import ROOT

SCRIPTS = ROOT / "blender_scripts"
SCENE_CODE = sorted([*SCRIPTS.glob("planner/**/*.py"), *SCRIPTS.glob("veldt_bl/*.py")])
BANNED_MODULES = {"random", "secrets", "time", "datetime", "uuid"}
ALLOWED_RANDOM = {"Generator", "PCG64", "SeedSequence"}


def _imports(tree: ast.AST):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name.split(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0]


def _numpy_random_uses(tree: ast.AST):
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Attribute)
            and isinstance(node.value, ast.Attribute)
            and node.value.attr == "random"
        ):
            yield node.attr


@pytest.mark.parametrize("path", SCENE_CODE, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_scene_code_is_deterministic(path: Path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert not BANNED_MODULES & set(_imports(tree))
    assert set(_numpy_random_uses(tree)) <= ALLOWED_RANDOM


@pytest.mark.parametrize("path", sorted(SCRIPTS.glob("planner/**/*.py")), ids=lambda path: path.name)
def test_planning_needs_no_blender(path: Path):
    assert not {"bpy", "mathutils", "veldt_bl"} & set(_imports(ast.parse(path.read_text(encoding="utf-8"))))


def test_the_scan_sees_what_it_bans():
    tree = ast.parse("import time, numpy as np\nfrom random import choice\nnp.random.seed(1)")
    assert set(_imports(tree)) & BANNED_MODULES == {"time", "random"}
    assert list(_numpy_random_uses(tree)) == ["seed"]
