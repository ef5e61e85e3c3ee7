"""NumPy meshes and flat materials as Blender data."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from . import compat

_TWIN_DEPTH_M = 10000.0


def new_material(name: str, index: int) -> bpy.types.Material:
    """A black material, the cheapest to render: only its index is used."""
    material = bpy.data.materials.new(name)
    material.pass_index = index
    tree = compat.use_nodes(material)
    black = tree.nodes.new("ShaderNodeEmission")
    black.inputs["Strength"].default_value = 0.0
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(black.outputs["Emission"], output.inputs["Surface"])
    return material


def new_mesh(
    name: str,
    points_m: np.ndarray,
    triangles: np.ndarray,
    slot: np.ndarray,
    materials: Sequence[bpy.types.Material],
    smooth: bool = True,
) -> bpy.types.Mesh:
    """A Blender mesh of points (n, 3) and triangles (m, 3); slot (m,) numbers their materials."""
    data = new_points(name, points_m)
    compat.fill_triangles(data, triangles)
    for material in materials:
        data.materials.append(material)
    data.polygons.foreach_set("material_index", slot.astype(np.int32))
    data.polygons.foreach_set("use_smooth", np.full(len(triangles), smooth))
    data.update(calc_edges=True)
    return data


def new_points(name: str, points_m: np.ndarray) -> bpy.types.Mesh:
    """A mesh of points without faces."""
    data = bpy.data.meshes.new(name)
    data.vertices.add(len(points_m))
    data.vertices.foreach_set("co", points_m.astype(np.float32).ravel())
    return data


def add_twin(mesh: bpy.types.Mesh, index: int) -> None:
    """Add another user of a mesh far below the ground, where no camera ray meets it."""
    twin = new_object(f"{mesh.name} twin", mesh, index)
    twin.location.z = -_TWIN_DEPTH_M
    twin.visible_camera = False


def new_object(
    name: str, data: bpy.types.ID, index: int, collection: bpy.types.Collection | None = None
) -> bpy.types.Object:
    """An object with an object index, linked to the collection, by default the scene's."""
    new = bpy.data.objects.new(name, data)
    new.pass_index = index
    (collection or bpy.context.scene.collection).objects.link(new)
    return new
