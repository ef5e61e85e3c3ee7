"""A plan and its folder."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from pathlib import Path

from .. import assets
from ..config import ROOT, input_files
from ..model_meshes import ModelMeshes
from ..outlines import outline_of
from ..plan import Outlook, plan_clips
from ..workers import Cores
from ..world import World, plan_world
from .forms import PLAN, VERSION
from .pictures import bake_pictures
from .scene import bake_scene
from .tracks import bake_track

Planned = Callable[[str, int, int], None]  # see plan_clips()


def plan(config: dict, cores: Cores = Cores(), planned: Planned = lambda *_: None) -> dict:
    """The plan of a resolved config, without its baked scene. ConfigError if the config is invalid."""
    world = plan_world(config, cores)
    shares = cores.start(lambda: outline_of(world))
    return _described(world, plan_clips(world, cores, planned=planned), shares())


def bake_plan(
    config: dict,
    folder: Path,
    models: ModelMeshes,
    cores: Cores = Cores(),
    planned: Planned = lambda *_: None,
    preview: bool = False,
) -> dict:
    """Write the plan of a resolved config, its scene and its tracks into an empty folder, and return the plan.

    ConfigError if the config is invalid. plan.json is written last.
    """
    world = plan_world(config, cores, with_ground=True)
    outline = cores.start(lambda: outline_of(world))
    bake_scene(world, models.mesh, folder / "scene")
    (folder / "tracks").mkdir()
    everyone = config["render"]["posed_actors"] == "all"

    def bake(outlook: Outlook) -> None:
        name, camera = outlook.clip["id"], outlook.clip.get("camera")
        bake_track(world, name, outlook.flight, folder / "tracks" / name, everyone, camera)

    found = _described(world, plan_clips(world, cores, bake, planned), outline())
    if preview:
        (folder / "preview").mkdir()
        bake_pictures(world, folder / "preview")
    (folder / "plan.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    return found


def _described(world: World, clips: list[dict], outline: dict) -> dict:
    return {
        "format": PLAN,
        "version": VERSION,
        "config": world.config,
        "files": _files(world.config, world.plantings),
        "clips": clips,
        "actors": len(world.actors),
        "plants": sum(len(planting.scale) for planting in world.plantings.values()),
        "outline": outline,
    }


def _files(config: dict, standing: Iterable[str]) -> dict[str, str]:
    """SHA-256 of every file, besides the config, that determines the plan: absolute paths, or relative to the
    installation.
    """
    scene = config["scene"]
    named = dict.fromkeys(("species", group["species"]) for group in scene["groups"])
    named |= dict.fromkeys(("sites", site["kind"]) for site in scene.get("sites", []))
    named |= dict.fromkeys((assets.kind_of(name), name) for name in standing)
    models = [assets.load(kind, name).get("model", {}).get("path") for kind, name in named]
    ours = [ROOT / "assets" / kind / f"{name}.json" for kind, name in named]
    ours += sorted((ROOT / "blender_scripts" / "planner").rglob("*.py"))
    given = [*input_files(config), *(Path(path) for path in models if path)]
    return {str(path.relative_to(ROOT)): _digest(path) for path in ours} | {
        str(path): _digest(path) for path in given
    }


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
