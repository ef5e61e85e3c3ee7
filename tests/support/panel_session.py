"""What a user does with the extension, inside Blender: … --python FILE -- CASE FOLDER PROGRAM [BLEND]

Each case is a function here; what it returns goes to FOLDER/result.json. The extension is enabled from the folder of
extensions that BLENDER_USER_RESOURCES names.
"""

import importlib
import json
import subprocess
import sys
from pathlib import Path
from types import MethodType, SimpleNamespace

import addon_utils
import bpy
from bpy_extras.object_utils import world_to_camera_view

from panel_layout import Layout
from scene_dump import dump

MODULE = "bl_ext.user_default.veldt_panel"


def _start(program: str) -> None:
    assert addon_utils.enable(MODULE, default_set=True) is not None
    _preferences().program = program
    assert bpy.ops.veldt.find_program() == {"FINISHED"}


def _preferences():
    return bpy.context.preferences.addons[MODULE].preferences


def _module(name: str):
    return importlib.import_module(f"{MODULE}.{name}")


def _settings(folder: Path):
    said = bpy.context.scene.veldt
    said.out, said.clip, said.lens, said.supersample = str(folder), "clip", "SCENE", 1
    return said


def _assign(thing: str, *names: str, is_one: bool = False) -> None:
    for each in bpy.context.scene.objects:
        each.select_set(each.name in names)
    brush = bpy.context.window_manager.veldt
    brush.thing, brush.is_one = thing, is_one
    assert bpy.ops.veldt.assign() == {"FINISHED"}


def _error_of(operator) -> str:
    """What an operator reports as an error."""
    try:
        operator()
    except RuntimeError as error:
        return str(error).removeprefix("Error: ").strip()
    return ""


def _camera(scene, frame: int):
    marked = [each for each in scene.timeline_markers if each.camera and each.frame <= frame]
    return max(marked, key=lambda each: each.frame).camera if marked else scene.camera


def _box(scene, camera, points) -> list[float]:
    """The box of points in px: x and y of its first corner, then of its last, y down."""
    share = scene.render.resolution_percentage / 100
    width, height = scene.render.resolution_x * share, scene.render.resolution_y * share
    seen = [world_to_camera_view(scene, camera, point) for point in points]
    x, y = [each.x * width for each in seen], [(1 - each.y) * height for each in seen]
    return [min(x), min(y), max(x), max(y)]


def _shapes(depsgraph):
    """Of all that is drawn: its maker, its source, its number there, and its points in the world."""
    for each in depsgraph.object_instances:
        if each.object.type == "MESH":
            maker = each.parent.name if each.is_instance else ""
            points = [each.matrix_world @ vertex.co for vertex in each.object.data.vertices]
            yield maker, each.object.name, each.persistent_id[0], points


def _boxes(groups: dict[str, list]) -> list[dict]:
    """Boxes of targets in each frame. `groups`: by target, the (maker, source) of its parts; maker * is each alone."""
    scene, boxes = bpy.context.scene, []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        points: dict[tuple, list] = {}
        for maker, source, number, found in _shapes(bpy.context.evaluated_depsgraph_get()):
            for name, parts in groups.items():
                if (maker, source) in parts:
                    points.setdefault((name, 0), []).extend(found)
                if ("*", source) in parts and maker:
                    points.setdefault((name, number), []).extend(found)
        camera = _camera(scene, frame)
        boxes += [
            {"frame": frame, "target": name, "box": _box(scene, camera, found)}
            for (name, _), found in points.items()
        ]
    return boxes


def human(folder: Path, blend: str) -> dict:
    """A file of somebody else's: assign, make, show."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene = bpy.context.scene
    scene.frame_end = 2
    for modifier in bpy.data.objects["Cube"].modifiers:
        if modifier.type == "SUBSURF":
            modifier.levels = (
                modifier.render_levels
            )  # so that the truth, by the viewport, is of what is rendered
    _assign("human", "Cube")
    _settings(folder)
    before = dump()
    assert bpy.ops.veldt.make_dataset() == {"FINISHED"}
    after = dump()
    assert bpy.ops.veldt.show_frames() == {"FINISHED"}
    image = bpy.data.images["Veldt frames"]
    return {
        "before": before,
        "after": after,
        "boxes": _boxes({"human": [("", "Cube")]}),
        "image": [image.source, image.filepath, list(image.size)],
    }


def hierarchy(folder: Path, blend: str) -> dict:
    """Cubes parented to each other are one target by their topmost parent, or each is one."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene = bpy.context.scene
    scene.frame_end = 1
    scene.camera.location *= 4  # so that all cubes are in the picture
    scene.objects[
        "Plane"
    ].hide_render = True  # would hide the foot of the lowest, which the truth does not know
    _settings(folder)
    cubes = [each.name for each in scene.objects if each.name.startswith("Cube")]
    _assign("elephant", *cubes)
    assigned = [name for name in cubes if scene.objects[name].veldt.kind != "unset"]
    before = dump()
    assert bpy.ops.veldt.make_dataset() == {"FINISHED"}
    return {
        "cubes": len(cubes),
        "assigned": assigned,
        "before": before,
        "after": dump(),
        "boxes": _boxes({"elephant": [("", name) for name in cubes]}),
    }


def stranger(folder: Path, blend: str) -> dict:
    """Rigs, instances and particles, assigned by names and by collection."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene = bpy.context.scene
    assert bpy.ops.veldt.guess_names() == {"FINISHED"}
    _settings(folder)
    bpy.context.view_layer.update()
    before = dump()
    assert bpy.ops.veldt.make_dataset() == {"FINISHED"}
    after = dump()
    bpy.data.objects["Impala"].veldt.kind = "unset"
    parts = [("", each.name) for each in bpy.data.objects["Elephant_rig"].children]
    boxes = _boxes(
        {
            "elephant": parts,
            **{
                f"zebra {name}": [(name, "Sphere.003"), (name, "Cube.004")]
                for name in ("Empty.000", "Empty.001")
            },
            "impala": [("*", "Impala")],
        }
    )
    names = {each.name: each.veldt.kind for each in [*bpy.data.objects, *bpy.data.collections]}
    return {"before": before, "after": after, "boxes": boxes, "kinds": names, "frame": scene.frame_current}


def faults(folder: Path, blend: str) -> dict:
    """Everything that goes wrong is said in words, and leaves the scene and finished work as they were."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene = bpy.context.scene
    scene.frame_end = 3
    said = _settings(folder)
    errors, ops = {}, bpy.ops.veldt
    errors["no passes"] = _error_of(ops.convert)
    errors["no frames"] = _error_of(ops.show_frames)
    errors["no config"] = _error_of(ops.generate)
    said.preset = "boson"
    errors["preset"] = _error_of(ops.make_dataset)
    said.preset, said.time = "boson_640_14mm", "3 am"
    errors["time"] = _error_of(ops.make_dataset)
    said.time, said.own_range, said.frame_start, said.frame_end = "", True, 3, 2
    errors["range"] = _error_of(ops.make_dataset)
    said.own_range = False
    camera, scene.camera = scene.camera, None
    errors["camera"] = _error_of(ops.make_dataset)
    scene.camera, camera.data.type = camera, "ORTHO"
    errors["ortho"] = _error_of(ops.render_passes)
    camera.data.type = "PERSP"
    (folder / "passes" / "clip").mkdir(parents=True)
    errors["in the way"] = _error_of(ops.render_passes)
    (folder / "passes" / "clip").rmdir()
    brush = bpy.context.window_manager.veldt
    brush.kind, brush.material, brush.category = "actor", "human", ""
    bpy.data.objects["Cube"].select_set(True)
    errors["category"] = _error_of(ops.assign)
    brush.material = "skin"
    errors["material"] = _error_of(ops.assign)
    before = dump()
    bpy.data.objects["Cube"].veldt.material = "nothing"
    bpy.data.objects["Cube"].veldt.kind = "ground"
    errors["convert"] = _error_of(ops.make_dataset).replace(str(folder), "OUT")
    for name in ("material", "kind"):
        bpy.data.objects["Cube"].veldt.property_unset(name)
    after = dump()
    frames = _stop_with_escape(folder / "passes" / "clip.part")
    kept = sorted(each.name for each in (folder / "passes" / "clip").iterdir())
    left = sorted(each.name for each in (folder / "passes").iterdir())
    _preferences().program = str(folder / "no_program")
    errors["program"] = _error_of(ops.find_program).replace(str(folder), "OUT")
    return {
        **{"errors": errors, "before": before, "after": after, "stopped": dump()},
        **{"part": frames, "kept": kept, "left": left},
    }


def _stop_with_escape(folder: Path) -> list[str]:
    """Render beside a window, as Blender would call it, and stop during the second frame; the files by then."""
    jobs, operators = _module("jobs"), _module("operators")
    running = SimpleNamespace(_job=jobs.render_passes(_request()), _timer=None, report=print)
    for name in ("modal", "_finish", "_fail", "_end"):
        setattr(running, name, MethodType(getattr(operators.JobOperator, name), running))
    for kind in ("TIMER", "MOUSEMOVE", "TIMER"):
        assert running.modal(bpy.context, SimpleNamespace(type=kind)) == {"RUNNING_MODAL"}
    files = sorted(each.name for each in folder.iterdir())
    assert running.modal(bpy.context, SimpleNamespace(type="ESC")) == {"CANCELLED"}
    assert bpy.context.window_manager.veldt.message == "Stopped"
    return files


def _request():
    operators = _module("operators")
    return operators.jobs.request_of(
        bpy.context.scene, bpy.context.view_layer, _module("properties").catalogue(bpy.context)
    )


def lenses(_: Path, blend: str) -> dict:
    """Where Blender's cameras see points, and the numbers that the manifest would have."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene, manifest, seen = bpy.context.scene, _module("manifest"), []
    render, camera = scene.render, scene.camera
    render.resolution_percentage, render.pixel_aspect_x, render.pixel_aspect_y = 100, 1, 1
    points = [(0, 0, 0), (1, 2, 3), (-1, 0.5, 1), (0.2, -3, -1)]
    vector = type(camera.location)
    for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
        for size in ((640, 512), (480, 640)):
            for shift in ((0, 0), (0.1, -0.2)):
                data = camera.data
                data.sensor_fit, data.sensor_width, data.sensor_height, data.lens = fit, 30, 20, 40
                (data.shift_x, data.shift_y), (render.resolution_x, render.resolution_y) = shift, size
                bpy.context.view_layer.update()
                lens = manifest.Lens(data.lens, 30, 20, fit, *shift)
                found = [world_to_camera_view(scene, camera, vector(point)) for point in points]
                seen.append(
                    {
                        "camera": vars(manifest.intrinsics_of(lens, *size)),
                        "camera_to_world": manifest.camera_to_world(camera.matrix_world.normalized()),
                        "points": points,
                        "seen_px": [[each.x * size[0], (1 - each.y) * size[1], each.z] for each in found],
                    }
                )
    return {"cases": seen}


def panels(folder: Path, blend: str) -> dict:
    """All that the panels show, in every state."""
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene, brush = bpy.context.scene, bpy.context.window_manager.veldt
    said = _settings(folder)
    shown = {}

    def look(state: str, **context) -> None:
        layout = Layout()
        seen = {"scene": scene, "window_manager": bpy.context.window_manager, "object": None}
        seen |= {"preferences": bpy.context.preferences} | context
        for panel in _module("panel").CLASSES:
            panel.draw(SimpleNamespace(layout=layout), SimpleNamespace(**seen))
        shown[state] = layout.shown

    look("nothing assigned")
    brush.kind, said.own_range, scene.unit_settings.scale_length = "actor", True, 0.1
    look("actor", object=scene.objects["Cube1"])
    _assign("elephant", *scene.objects.keys())
    look("assigned", object=scene.objects["Cube1"])
    brush.is_running, brush.progress, brush.message = True, 0.5, "passes: frame 2"
    look("running")
    brush.is_running, brush.is_error, brush.message = False, True, "one\ntwo"
    look("failed")
    _preferences().home = ""
    look("no program")
    layout = Layout()
    _module("properties").Preferences.draw(
        SimpleNamespace(layout=layout, home="", version="", program="", bl_rna=_preferences().bl_rna), None
    )
    shown["preferences"] = layout.shown
    addon_utils.disable(MODULE, default_set=True)
    return {"shown": shown, "is_gone": not hasattr(bpy.types.Object, "veldt")}


def config(folder: Path, file: str) -> dict:
    """A dataset of a config."""
    said = _settings(folder)
    said.config = file
    assert bpy.ops.veldt.generate() == {"FINISHED"}
    assert bpy.ops.veldt.show_frames() == {"FINISHED"}
    return {
        "message": bpy.context.window_manager.veldt.message,
        "image": bpy.data.images["Veldt frames"].filepath,
    }


def package(folder: Path, source: str) -> dict:
    """Blender's own tool checks the extension and packs it."""
    tool = Path(bpy.utils.system_resource("SCRIPTS", path="addons_core")) / "bl_pkg/cli/blender_ext.py"
    done = []
    for command in (["validate", source], ["build", "--source-dir", source, "--output-dir", str(folder)]):
        one = subprocess.run(
            [sys.executable, "-B", str(tool), *command], capture_output=True, text=True, check=False
        )
        done.append([one.returncode, one.stdout + one.stderr])
    return {"done": done, "files": sorted(each.name for each in folder.glob("*.zip"))}


CASES = (human, hierarchy, stranger, faults, lenses, panels, config, package)


def main(case: str, folder: str, program: str, *rest: str) -> None:
    """Run one case."""
    _start(program)
    result = next(each for each in CASES if each.__name__ == case)(Path(folder), *rest)
    (Path(folder) / "result.json").write_text(json.dumps(result), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
