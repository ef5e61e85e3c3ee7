"""Import models from the user's files into Blender; one that differs from its box by over one percent is rejected."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import bpy
import numpy as np

from planner.faults import ConfigError
from planner.models import check_mapped, in_body_axes, part_names
from planner.geometry.shapes import Mesh, facets, joined

from . import compat

_TOLERANCE = 0.01  # of a side: less than the margin of the actors' boxes


def load(where: str, data: Mapping) -> Mesh:
    """The mesh of a species' or plant's model in body axes; the origin is on the ground below the middle of its box.

    Slots are indices into `part_names`; `where` is the asset file. All imported data are removed from Blender again.
    ConfigError names the file and the reason if Blender cannot read it, if a material in it has no part, or if its size
    differs from the given one.
    """
    model, where = data["model"], f'{where}: model.file = "{data["model"]["file"]}"'
    before = _everything()
    try:
        _import(where, Path(model["path"]))
        mesh = _mesh(where, [thing for thing in bpy.data.objects if thing not in before], data)
    finally:
        bpy.data.batch_remove(_everything() - before)
    points = in_body_axes(mesh.points_m, model)
    low, high = points.min(axis=0), points.max(axis=0)
    _check_size(where, high - low, model["size_m"])
    return Mesh(points - [*0.5 * (low + high)[:2], low[2]], mesh.triangles, mesh.slot)


def _everything() -> set[bpy.types.ID]:
    """All existing data blocks."""
    tables = [entry.identifier for entry in bpy.data.bl_rna.properties if entry.type == "COLLECTION"]
    return {
        block for table in tables for block in getattr(bpy.data, table) if isinstance(block, bpy.types.ID)
    }


def _import(where: str, path: Path) -> None:
    try:
        if path.suffix.lower() == ".blend":
            _append(path)
        else:
            {".glb": compat.import_gltf, ".obj": compat.import_obj}[path.suffix.lower()](str(path))
    except Exception as error:  # pylint: disable=broad-exception-caught
        # Importers are third-party scripts and may raise anything for a broken file.
        lines = [
            line for line in str(error).splitlines() if line.strip() and not line.startswith("Location:")
        ]
        reason = lines[-1].strip() if lines else type(error).__name__
        raise ConfigError(f"{where}; expected a file Blender can read ({reason})") from error


def _append(path: Path) -> None:
    with bpy.data.libraries.load(str(path), link=False) as (there, here):
        here.objects = there.objects
    for thing in here.objects:
        bpy.context.scene.collection.objects.link(thing)


def _mesh(where: str, things: list[bpy.types.Object], data: Mapping) -> Mesh:
    """All renderable meshes among new objects, in world positions."""
    bpy.context.view_layer.update()
    shapes = {bone.custom_shape for thing in things if thing.pose for bone in thing.pose.bones}
    seen = [
        thing for thing in things if thing.type == "MESH" and not thing.hide_render and thing not in shapes
    ]
    whole = joined([_one_mesh(where, thing, data) for thing in sorted(seen, key=lambda thing: thing.name)])
    if not len(whole.triangles) or not np.isfinite(whole.points_m).all():
        raise ConfigError(f"{where}; expected meshes with faces, and it has none")
    return whole


def _one_mesh(where: str, thing: bpy.types.Object, data: Mapping) -> Mesh:
    """An object's mesh with modifiers applied, in the scene's axes, with each triangle in its part's slot."""
    final = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = final.to_mesh()
    mesh.calc_loop_triangles()
    points, count = np.empty(3 * len(mesh.vertices)), len(mesh.loop_triangles)
    triangles, material = np.empty(3 * count, np.int32), np.empty(count, np.int32)
    mesh.vertices.foreach_get("co", points)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    mesh.loop_triangles.foreach_get("material_index", material)
    final.to_mesh_clear()
    matrix = np.array(final.matrix_world)
    triangles = triangles.reshape(-1, 3)
    if np.linalg.det(matrix[:3, :3]) < 0:  # mirrored: its faces point inward
        triangles = triangles[:, ::-1]
    placed = facets(points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], triangles.astype(np.int64))
    slots = {k: _slot(where, _name(final, thing, k), data) for k in np.unique(material).tolist()}
    return Mesh(placed.points_m, placed.triangles, np.array([slots[k] for k in material.tolist()], np.int64))


def _name(final: bpy.types.Object, thing: bpy.types.Object, k: int) -> str:
    """Name of the material in a slot, or of the object if there is none."""
    slots = final.material_slots
    material = slots[min(k, len(slots) - 1)].material if slots else None
    return material.name if material else thing.name


def _slot(where: str, name: str, data: Mapping) -> int:
    parts = data["model"]["parts"]
    if name not in parts:  # Blender appends a number to names that already exist
        name = re.sub(r"\.\d{3}$", "", name)
    check_mapped(where, name, parts)
    return part_names(data).index(parts[name])


def _check_size(where: str, found_m: np.ndarray, size_m: list[float]) -> None:
    if not np.allclose(found_m, size_m, rtol=_TOLERANCE, atol=0.0):
        found, planned = (", ".join(f"{side:.3f}" for side in sides) for sides in (found_m, size_m))
        raise ConfigError(f"{where}; expected model.size_m = [{found}], which it is, not [{planned}] m")
