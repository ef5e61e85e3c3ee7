"""All that Blender has in memory, as JSON: to compare before and after. Inside Blender only."""

from __future__ import annotations

import bpy

# What changes by looking, names of places in memory, or the shape of meshes, which is large.
_LEFT_OUT = {
    "rna_type",
    "session_uid",
    "is_evaluated",
    "original",
    "id_data",
    "depsgraph",
    "preview",
    "bl_rna",
}
_DEEPEST = 6


def dump() -> dict[str, dict]:
    """Every data-block but those of Blender's windows, by kind and name."""
    kinds = [name for name, prop in bpy.data.bl_rna.properties.items() if prop.type == "COLLECTION"]
    kinds = [name for name in kinds if name not in ("window_managers", "screens", "workspaces", "images")]
    return {name: {each.name: _struct(each, 0) for each in getattr(bpy.data, name)} for name in kinds}


def _struct(struct, depth: int):
    if isinstance(struct, bpy.types.Mesh):
        return [struct.users, [list(vertex.co) for vertex in struct.vertices]]
    values = {}
    for prop in struct.bl_rna.properties:
        if prop.identifier in _LEFT_OUT:
            continue
        try:
            values[prop.identifier] = _value(getattr(struct, prop.identifier), prop, depth)
        except (AttributeError, RuntimeError, TypeError):
            continue  # not for this kind of struct
    return values


def _value(value, prop, depth: int):
    if prop.type == "POINTER":
        return _pointed(value, depth)
    if prop.type == "COLLECTION":
        return [_pointed(each, depth) for each in value]
    if prop.type == "ENUM" and prop.is_enum_flag:
        return sorted(value)
    if getattr(prop, "is_array", False):
        return [_plain(each) for each in value]
    return _plain(value)


def _plain(value):
    """A number or a text; a row of a matrix as a list."""
    return list(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _pointed(value, depth: int):
    if value is None:
        return None
    if isinstance(value, bpy.types.ID) and not value.is_embedded_data:
        return value.name
    return _struct(value, depth + 1) if depth < _DEEPEST else str(type(value))
