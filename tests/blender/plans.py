"""Plans with their baked scenes, for the tests."""

from pathlib import Path

from planner.bake.folder import bake_plan
from planner.model_meshes import ModelMeshes


def bake(config: dict, folder: Path) -> Path:
    """Bake the plan of a resolved config into a new folder, which is returned."""
    folder.mkdir()
    bake_plan(config, folder, ModelMeshes(folder / "models", None, ""))
    return folder
