"""All relevant differences between Blender versions."""

from __future__ import annotations

import signal

import bpy
import numpy as np

VERSION = bpy.app.version
# The channel of the object index in files.
OBJECT_INDEX = "Object Index.X" if VERSION >= (5, 0, 0) else "IndexOB.X"


def fill_triangles(mesh: bpy.types.Mesh, triangles: np.ndarray) -> None:
    """Add triangles (m, 3) as faces to a mesh that has points only."""
    count = len(triangles)
    mesh.loops.add(3 * count)
    mesh.polygons.add(count)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(triangles, np.int32).ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    if VERSION < (3, 6, 0):  # later versions derive the sizes of faces from their starts
        mesh.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))


def new_geometry_socket(tree: bpy.types.NodeTree, in_out: str) -> None:
    """Add a group socket `Geometry`; in_out is INPUT or OUTPUT."""
    if VERSION >= (4, 0, 0):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    else:
        sockets = tree.inputs if in_out == "INPUT" else tree.outputs
        sockets.new("NodeSocketGeometry", "Geometry")


def use_nodes(shaded: bpy.types.Material | bpy.types.World) -> bpy.types.NodeTree:
    """The node tree of a material or a sky, empty."""
    if VERSION < (5, 0, 0):  # from this version on, all have nodes
        shaded.use_nodes = True
    shaded.node_tree.nodes.clear()
    return shaded.node_tree


def write_png(settings: bpy.types.ImageFormatSettings) -> None:
    """Set the output to PNG, 8 bits per channel."""
    if VERSION >= (5, 0, 0):
        settings.media_type = "IMAGE"
    settings.file_format = "PNG"
    settings.color_mode, settings.color_depth = "RGB", "8"


def write_multilayer_exr(settings: bpy.types.ImageFormatSettings, packed: bool) -> None:
    """Set the output to multilayer EXR, 32-bit floats; compression, if any, is lossless.

    RLE takes 0.03 s for a picture of 640 x 512 pixels; ZIP takes 0.15 s for two thirds of the size.
    """
    if VERSION >= (5, 0, 0):
        settings.media_type = "MULTI_LAYER_IMAGE"
        settings.use_exr_interleave = True  # a single part with all channels, as in earlier versions
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "RLE" if packed else "NONE"


def stop_rendering(scene: bpy.types.Scene) -> None:
    """Stop the current animation render before its next frame; called by handlers."""
    if not bpy.app.binary_path:  # as a Python module, Blender leaves signals to Python
        scene.frame_current = scene.frame_end
    else:
        signal.raise_signal(signal.SIGINT)  # like Ctrl-C


def import_gltf(path: str) -> None:
    """Import a .glb file into the scene; RuntimeError if Blender cannot read it."""
    # Other shading modes fail in Debian's 3.4.1, whose importer needs an older NumPy; only shapes matter here.
    bpy.ops.import_scene.gltf(filepath=path, import_shading="FLAT")


def import_obj(path: str) -> None:
    """Import a .obj file, with y up, into the scene; RuntimeError if Blender cannot read it."""
    if VERSION >= (3, 3, 0):
        bpy.ops.wm.obj_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
    else:
        bpy.ops.import_scene.obj(filepath=path, axis_forward="-Z", axis_up="Y")
