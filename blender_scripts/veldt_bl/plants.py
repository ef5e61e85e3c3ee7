"""Plants as geometry-node instances: thousands cost little more than a few."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import mathutils
import numpy as np

from planner.bake.baked import BakedScene
from planner.camera import Intrinsics
from planner.plants.views import circles_seen, held_circles

from . import compat
from .meshes import add_twin, new_object, new_points

EVERYWHERE_M = 1e6


@dataclass(frozen=True)
class Flora:
    """All plants of a scene: their positions, the object that controls which of them are shown, and their reach.

    The reach is the largest distance of any plant's points from its root.
    """

    places: list[bpy.types.Object]
    view: bpy.types.Object
    reach_m: float


def add_flora(scene: BakedScene, meshes: list[bpy.types.Mesh]) -> Flora:
    """Add all plants of a baked scene to Blender's."""
    view = bpy.data.objects.new("view", None)
    bpy.context.scene.collection.objects.link(view)
    places, reach_m = [], 0.0
    for plants in scene.header["plants"]:
        kind, upright = _instances(scene, plants)
        variants = np.unique(kind)
        places.append(_add_species(plants, meshes, variants, _points(plants["name"], upright, kind), view))
        reach_m = max(reach_m, upright.size.max() * max(_reach_m(meshes[k]) for k in variants))
    return Flora(places, view, float(reach_m))


def circles_needed(
    flora: Flora, scene: BakedScene, intrinsics: Intrinsics, camera_to_world: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and radii (n,) of circles that contain all plants that a camera may see in poses (n, 4, 4).

    Cycles synchronises all meshes again, including the ground, whenever the number of instances changes; therefore one
    circle is reused for many frames.
    """
    low_m, high_m = scene.heights_m
    centres_m, radii_m = circles_seen(intrinsics, camera_to_world, low_m, high_m + flora.reach_m)
    return held_circles(centres_m, np.minimum(radii_m + flora.reach_m, EVERYWHERE_M))


def show_within(flora: Flora, centre_m: np.ndarray, radius_m: float) -> None:
    """Show only the plants in a circle.

    Blender iterates over all instances before each frame, which for a whole savanna takes longer than rendering.
    Therefore the node trees show only plants within a circle, given by the location and scale of an empty.
    """
    place, scale = mathutils.Vector((*centre_m, 0.0)), mathutils.Vector((radius_m,) * 3)
    if (flora.view.location, flora.view.scale) != (place, scale):  # avoids re-evaluating the plants
        flora.view.location, flora.view.scale = place, scale


@dataclass(frozen=True)
class _Upright:
    """Instances that are turned about z by turn_rad (n,), scaled by size (n,) and moved to points_m (n, 3)."""

    points_m: np.ndarray
    turn_rad: np.ndarray
    size: np.ndarray


def _instances(scene: BakedScene, plants: dict) -> tuple[np.ndarray, _Upright]:
    """The mesh (n,) of each plant of a species, and how it stands.

    Angles and sizes are single-precision numbers, so they can be restored exactly from the plan's matrices.
    """
    matrix = scene.arrays[plants["transform"]]
    cos, sin = matrix[:, 0, 0], matrix[:, 1, 0]
    turn_rad = np.arctan2(sin, cos)
    turn_rad = np.where(turn_rad < 0, turn_rad + 2.0 * np.pi, turn_rad)
    return scene.arrays[plants["mesh"]], _Upright(matrix[:, :, 3], turn_rad, matrix[:, 2, 2])


def _reach_m(mesh: bpy.types.Mesh) -> float:
    """The largest distance of a mesh's points from its origin."""
    return max(vertex.co.length for vertex in mesh.vertices)


def _add_species(
    plants: dict, meshes: list[bpy.types.Mesh], variants: np.ndarray, points: bpy.types.Mesh, view
) -> bpy.types.Object:
    """Add one species to the scene; instances have the object index of the variant they copy."""
    name, index = plants["name"], plants["object"]
    # Not linked to the scene: only its instances are visible.
    variants_of = bpy.data.collections.new(f"{name} variants")
    for k, number in enumerate(variants):
        # Instances refer to the collection's objects by index, in the order of their names.
        new_object(f"{name} {k:03d}", meshes[number], index, variants_of)
        # If a mesh has a single user, Cycles transforms its points to world space, which changes the last bits of
        # depth. Two more users that no camera ray meets keep depths the same for any number of plants of a species.
        for _ in range(2):
            add_twin(meshes[number], index)
    placed = new_object(f"{name} places", points, index)
    placed.modifiers.new("plants", "NODES").node_group = _instancer(name, variants_of, view)
    # The points themselves have no faces; otherwise Cycles would synchronise them, and all meshes, when they change.
    placed.show_instancer_for_render = False
    return placed


def _points(name: str, plants: _Upright, mesh: np.ndarray) -> bpy.types.Mesh:
    """One point per plant, with attributes `turn`, `size` and `variant`."""
    points = new_points(f"{name} places", plants.points_m)
    turn = np.zeros((len(mesh), 3), np.float32)
    turn[:, 2] = plants.turn_rad
    points.attributes.new("turn", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", turn.ravel())
    size = plants.size.astype(np.float32)
    points.attributes.new("size", "FLOAT", "POINT").data.foreach_set("value", size)
    variant = np.unique(mesh, return_inverse=True)[1].astype(np.int32)
    points.attributes.new("variant", "INT", "POINT").data.foreach_set("value", variant)
    return points


def _instancer(name: str, variants: bpy.types.Collection, view: bpy.types.Object) -> bpy.types.NodeTree:
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
    tree.links.new(_is_in(tree, view), place.inputs["Selection"])
    tree.links.new(copies.outputs[0], place.inputs["Instance"])  # its name differs between versions
    for attribute, kind, socket in (
        ("variant", "INT", "Instance Index"),
        ("turn", "FLOAT_VECTOR", "Rotation"),
        ("size", "FLOAT", "Scale"),
    ):
        tree.links.new(_attribute(tree, attribute, kind), place.inputs[socket])
    tree.links.new(place.outputs["Instances"], result.inputs["Geometry"])
    return tree


def _is_in(tree: bpy.types.NodeTree, view: bpy.types.Object) -> bpy.types.NodeSocket:
    """Node output: whether a point is above or below the view's circle."""
    circle = tree.nodes.new("GeometryNodeObjectInfo")
    circle.inputs["Object"].default_value = view
    here = tree.nodes.new("GeometryNodeInputPosition").outputs["Position"]
    aside = _vector(tree, "SUBTRACT", here, circle.outputs["Location"])
    level = _vector(tree, "MULTIPLY", aside.outputs["Vector"], (1.0, 1.0, 0.0))
    distance = _vector(tree, "LENGTH", level.outputs["Vector"]).outputs["Value"]
    radius = _vector(tree, "DOT_PRODUCT", circle.outputs["Scale"], (1.0, 0.0, 0.0)).outputs["Value"]
    less = tree.nodes.new("ShaderNodeMath")
    less.operation = "LESS_THAN"
    tree.links.new(distance, less.inputs[0])
    tree.links.new(radius, less.inputs[1])
    return less.outputs["Value"]


def _vector(tree: bpy.types.NodeTree, operation: str, *values) -> bpy.types.Node:
    """A vector-math node; values are sockets or constants."""
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = operation
    for socket, value in zip(node.inputs, values):
        if isinstance(value, tuple):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    return node


def _attribute(tree: bpy.types.NodeTree, name: str, kind: str) -> bpy.types.NodeSocket:
    """The output of a named-attribute node: of its outputs, one per type, the enabled one."""
    node = tree.nodes.new("GeometryNodeInputNamedAttribute")
    node.data_type = kind
    node.inputs["Name"].default_value = name
    return next(output for output in node.outputs if output.enabled and output.name == "Attribute")
