"""Plants as geometry-node instances: thousands cost little more than a few."""

from __future__ import annotations

import bpy
import numpy as np

from veldt.placement import Planting
from veldt.shapes import Mesh

from . import compat
from .meshes import new_mesh, new_object, new_points


def add_plants(
    name: str, planting: Planting, variants: list[Mesh], material: bpy.types.Material, index: int
) -> None:
    """Puts one species into the scene; instances carry the object index of the variant they copy."""
    variants_of = bpy.data.collections.new(
        f"{name} variants"
    )  # not linked to the scene: only its copies are seen
    for k, mesh in enumerate(variants):
        # Instances are picked by number from the collection's objects in order of their names.
        new_object(f"{name} {k:03d}", new_mesh(name, mesh, [material], smooth=False), index, variants_of)
    points = new_object(f"{name} places", _points(name, planting), index)
    points.modifiers.new("plants", "NODES").node_group = _instancer(name, variants_of)


def _points(name: str, planting: Planting) -> bpy.types.Mesh:
    """One point a plant, with attributes `turn`, `size` and `variant`."""
    points = new_points(f"{name} places", planting.points_m)
    turn = np.zeros((len(planting.scale), 3), np.float32)
    turn[:, 2] = planting.yaw_rad
    points.attributes.new("turn", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", turn.ravel())
    size = planting.scale.astype(np.float32)
    points.attributes.new("size", "FLOAT", "POINT").data.foreach_set("value", size)
    variant = planting.variant.astype(np.int32)
    points.attributes.new("variant", "INT", "POINT").data.foreach_set("value", variant)
    return points


def _instancer(name: str, variants: bpy.types.Collection) -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new(f"{name} instancer", "GeometryNodeTree")
    compat.new_geometry_socket(tree, "INPUT")
    compat.new_geometry_socket(tree, "OUTPUT")
    source, result = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    copies = tree.nodes.new("GeometryNodeCollectionInfo")
    copies.inputs["Collection"].default_value = variants
    copies.inputs["Separate Children"].default_value = True
    copies.inputs["Reset Children"].default_value = True
    place = tree.nodes.new("GeometryNodeInstanceOnPoints")
    place.inputs["Pick Instance"].default_value = True
    tree.links.new(source.outputs["Geometry"], place.inputs["Points"])
    tree.links.new(copies.outputs[0], place.inputs["Instance"])  # its name differs between versions
    for attribute, kind, socket in (
        ("variant", "INT", "Instance Index"),
        ("turn", "FLOAT_VECTOR", "Rotation"),
        ("size", "FLOAT", "Scale"),
    ):
        tree.links.new(_attribute(tree, attribute, kind), place.inputs[socket])
    tree.links.new(place.outputs["Instances"], result.inputs["Geometry"])
    return tree


def _attribute(tree: bpy.types.NodeTree, name: str, kind: str) -> bpy.types.NodeSocket:
    """Output that reads a named attribute; the node has one output for each kind, of which the enabled one counts."""
    node = tree.nodes.new("GeometryNodeInputNamedAttribute")
    node.data_type = kind
    node.inputs["Name"].default_value = name
    return next(output for output in node.outputs if output.enabled and output.name == "Attribute")
