"""A scene in the manner of somebody who has never heard of Veldt; run by Blender: … --python FILE -- OUT.blend

An elephant of parts parented to an animated empty; two instances of a collection; particles and geometry nodes that
make instances; names such as Cube.001; EEVEE with motion blur, depth of field, a border, a compositor and two view
layers; a second camera that a marker switches to.
"""

import sys

import bpy


def main(out: str) -> None:
    """Build the scene and save it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    shared = bpy.data.materials.new("Material")
    ground = mesh("Plane.001", bpy.ops.mesh.primitive_plane_add, size=120)
    add_elephant(scene)
    add_zebras(scene)
    hidden = bpy.data.collections.new("Collection 2")
    scene.collection.children.link(hidden)
    add_impalas(hidden)
    add_trees(hidden)
    bpy.context.view_layer.layer_collection.children["Collection 2"].exclude = True
    for each in bpy.data.meshes:
        each.materials.append(shared)
    add_cameras(scene)
    set_up_render(scene)
    ground.pass_index = 7
    bpy.ops.wm.save_as_mainfile(filepath=out)


def mesh(name, add, location=(0, 0, 0), scale=(1, 1, 1), parent=None, **how):
    """A mesh object made by an operator."""
    add(location=location, **how)
    thing = bpy.context.object
    thing.name, thing.scale, thing.parent = name, scale, parent
    return thing


def move_to(thing, collection) -> None:
    """Link an object to this collection alone."""
    for each in list(thing.users_collection):
        each.objects.unlink(thing)
    collection.objects.link(thing)


def add_elephant(scene) -> None:
    """An empty that walks, and five parts parented to it."""
    rig = bpy.data.objects.new("Elephant_rig", None)
    scene.collection.objects.link(rig)
    mesh("Sphere.001", bpy.ops.mesh.primitive_uv_sphere_add, (0, 0, 2), (2, 1.2, 1.2), rig)
    mesh("Sphere.002", bpy.ops.mesh.primitive_uv_sphere_add, (2.2, 0, 2.6), (0.8, 0.7, 0.7), rig)
    for number, x in enumerate((-1.2, 1.2)):
        mesh(f"Cube.{number:03d}", bpy.ops.mesh.primitive_cube_add, (x, 0, 0.6), (0.3, 0.8, 0.6), rig)
    for frame, x in ((1, -8), (3, -6)):
        rig.location = (x, 6, 0)
        rig.keyframe_insert("location", frame=frame)


def add_zebras(scene) -> None:
    """A collection outside of the scene, of which two empties show instances."""
    model = bpy.data.collections.new("zebra_model")
    move_to(mesh("Sphere.003", bpy.ops.mesh.primitive_uv_sphere_add, (0, 0, 1), (1.1, 0.4, 0.5)), model)
    move_to(mesh("Cube.004", bpy.ops.mesh.primitive_cube_add, (1, 0, 1.5), (0.25, 0.2, 0.4)), model)
    for number, location in enumerate(((4, 6, 0), (9, 5, 0))):
        empty = bpy.data.objects.new(f"Empty.{number:03d}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", model
        empty.location, empty.rotation_euler.z = location, 0.5 * number
        scene.collection.objects.link(empty)


def add_impalas(hidden) -> None:
    """Three particles, each an instance of a hidden object."""
    model = mesh("Impala", bpy.ops.mesh.primitive_uv_sphere_add, (0, 0, -30), (0.8, 0.5, 0.6))
    move_to(model, hidden)
    emitter = mesh("Plane.002", bpy.ops.mesh.primitive_plane_add, (0, -4, 0.05), (9, 0.5, 1))
    emitter.modifiers.new("ParticleSystem", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 3, 1
    settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", model, 1
    settings.use_advanced_hair = True
    emitter.particle_systems[0].seed = 3


def add_trees(hidden) -> None:
    """Instances that geometry nodes put on the corners of a plane."""
    tree = mesh("Tree", bpy.ops.mesh.primitive_cone_add, (0, 0, -40), (1, 1, 2))
    move_to(tree, hidden)
    field = mesh("Plane.003", bpy.ops.mesh.primitive_plane_add, (0, 22, 0.05), (12, 3, 1))
    group = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        group.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    given, made = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    points = group.nodes.new("GeometryNodeMeshToPoints")
    instances, info = group.nodes.new("GeometryNodeInstanceOnPoints"), group.nodes.new(
        "GeometryNodeObjectInfo"
    )
    info.inputs[0].default_value, info.inputs["As Instance"].default_value = tree, True
    group.links.new(given.outputs[0], points.inputs[0])
    group.links.new(points.outputs[0], instances.inputs[0])
    group.links.new(info.outputs["Geometry"], instances.inputs["Instance"])
    group.links.new(instances.outputs[0], made.inputs[0])
    field.modifiers.new("GeometryNodes", "NODES").node_group = group


def add_cameras(scene) -> None:
    """Two cameras with depth of field; a marker switches to the second at frame 3."""
    for name, location in (("Camera", (0, -26, 22)), ("Camera.001", (4, -28, 24))):
        data = bpy.data.cameras.new(name)
        data.lens, data.dof.use_dof, data.dof.aperture_fstop, data.dof.focus_distance = 35, True, 0.1, 3
        camera = bpy.data.objects.new(name, data)
        camera.location, camera.rotation_euler = location, (0.87, 0, 0)
        scene.collection.objects.link(camera)
    scene.camera = bpy.data.objects["Camera"]
    scene.timeline_markers.new("first", frame=1).camera = bpy.data.objects["Camera"]
    scene.timeline_markers.new("second", frame=3).camera = bpy.data.objects["Camera.001"]


def set_up_render(scene) -> None:
    """Settings that passes cannot be rendered with."""
    render = scene.render
    render.engine = "BLENDER_EEVEE" if bpy.app.version >= (5, 0, 0) else "BLENDER_EEVEE_NEXT"
    render.resolution_x, render.resolution_y, render.resolution_percentage = 1280, 1024, 50
    render.use_motion_blur = render.use_border = render.use_crop_to_border = render.film_transparent = True
    render.border_max_x = 0.5
    scene.view_layers.new("Fog")
    if bpy.app.version >= (5, 0, 0):
        scene.compositing_node_group = bpy.data.node_groups.new("Compositing", "CompositorNodeTree")
        scene.compositing_node_group.nodes.new("CompositorNodeBlur")
    else:
        scene.use_nodes = True
        scene.node_tree.nodes.new("CompositorNodeBlur")


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
