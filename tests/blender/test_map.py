"""Plans of maps and stills: positions of labels, areas of shapes, poses of cameras."""

import numpy as np
import pytest

from raw_png import png_bytes
from planner import assets
from planner.groups.actors import track
from planner.camera import project
from planner.preview.colours import UNKNOWN, linear, mixed, signal_colours, surface_colour
from planner.preview.flat_shapes import band, box, disc, filled
from planner.preview.labels import Anchor, Label, place_labels
from planner.preview.legend import round_length_m
from planner.preview.map_layers import plan_map
from planner.blender_images import is_whole_png
from planner.preview.stills import INTRINSICS, plan_stills


def _area_m2(mesh) -> float:
    """Signed area seen from above: positive if triangles face up."""
    a, b, c = (mesh.points_m[mesh.triangles[:, k], :2] for k in range(3))
    return float(0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum())


# --- shapes -----------------------------------------------------------------------------------------------------------


def test_shapes_face_up_and_have_their_areas():
    ring = np.stack([np.cos(np.linspace(0, 2 * np.pi, 201)), np.sin(np.linspace(0, 2 * np.pi, 201))], axis=1)
    ring[-1] = ring[0]
    assert _area_m2(box(1, 2, 4, 7)) == pytest.approx(15)
    # 24 corners: 24/2 sin(15 deg) = 3.106, against pi
    assert _area_m2(disc((3, 4), 1)) == pytest.approx(12 * np.sin(np.radians(15)))
    assert _area_m2(band(np.array([[0.0, 0.0], [3.0, 4.0]]), 0.5)) == pytest.approx(2.5)
    # A closed band's inner and outer corners are as far from the ring as bisectors are: cos(0.9 deg) off.
    assert _area_m2(band(ring, 0.1)) == pytest.approx(2 * np.pi * 0.1, rel=2e-3)


def test_a_closed_band_has_no_seam():
    corners = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 0.0]])
    points_m = band(corners, 1.0).points_m
    assert points_m[[0, 4]] == pytest.approx(points_m[[3, 7]])
    assert band(corners[:3], 1.0).points_m[0] == pytest.approx([0.0, -0.5, 0.0])


def test_filled_cells_are_covered_once_and_others_not_at_all():
    cells = np.array([[1, 1, 0, 1], [0, 0, 0, 0], [0, 1, 1, 1], [1, 0, 1, 0]], bool)
    mesh = filled(cells, -2.0, 1.0)
    assert len(mesh.triangles) == 2 * 5  # runs: two, none, one, two
    assert _area_m2(mesh) == pytest.approx(cells.sum())
    lower = mesh.points_m.reshape(-1, 4, 3)[:, 0, :2] + 2.0
    upper = mesh.points_m.reshape(-1, 4, 3)[:, 2, :2] + 2.0
    covered = np.zeros((4, 4), int)
    for (x0, y0), (x1, y1) in zip(lower.astype(int), upper.astype(int)):
        covered[y0:y1, x0:x1] += 1
    assert (covered == cells).all()


def test_no_cells_make_no_shape():
    assert len(filled(np.zeros((3, 3), bool), 0.0, 1.0).triangles) == 0


# --- colours ----------------------------------------------------------------------------------------------------------


def test_linear_colours():
    assert linear("#000000") == (0, 0, 0) and linear("#ffffff") == (1, 1, 1)
    assert linear("#808080") == pytest.approx([0.2158605] * 3, abs=1e-6)  # IEC 61966-2-1
    assert linear("#0a0a0a") == pytest.approx([10 / 255 / 12.92] * 3)


def test_mixed_colours():
    assert mixed("#000000", "#ffffff", 0.0) == "#000000"
    assert mixed("#102030", "#304050", 0.5) == "#203040"
    assert mixed("#000000", "#ffffff", 0.25) == "#404040"


def test_parts_have_their_own_colour_or_the_materials():
    assert (
        surface_colour("elephant", "tusks")
        != surface_colour("elephant")
        == surface_colour("elephant", "none")
    )


def test_all_signal_colours_differ_and_start_over():
    colours = signal_colours([f"s{k}" for k in range(13)])
    assert len(set(colours.values())) == 12 and colours["s0"] == colours["s12"]


@pytest.mark.parametrize("material", assets.names("materials"))
def test_every_material_has_a_colour(material):
    assert surface_colour(material) != UNKNOWN


# --- words ------------------------------------------------------------------------------------------------------------


def _overlap(a: Label, b: Label) -> bool:
    return (
        a.plate_m[0] < b.plate_m[2]
        and b.plate_m[0] < a.plate_m[2]
        and a.plate_m[1] < b.plate_m[3]
        and b.plate_m[1] < a.plate_m[3]
    )


def test_labels_of_a_crowd_keep_apart_and_inside():
    anchors = [Anchor(f"group_{k}", (3.0 * (k % 3) - 48.0, 2.0 * (k // 3) - 48.0), 0.5) for k in range(9)]
    bounds = (-50.0, -50.0, 50.0, 50.0)
    labels = place_labels(anchors, [], bounds, 1.5)
    assert [label.text for label in labels] == [anchor.text for anchor in anchors]
    assert not any(_overlap(a, b) for k, a in enumerate(labels) for b in labels[:k])
    plates = np.array([label.plate_m for label in labels])
    assert plates[:, :2].min() >= -50.0 and plates[:, 2:].max() <= 50.0


def test_a_label_stays_off_what_is_taken():
    free, crowded = (
        place_labels([Anchor("x", (0.0, 0.0), 1.0)], taken, (-20, -20, 20, 20), 2.0)[0]
        for taken in ([], [(0.0, -3.0, 12.0, 3.0)])
    )
    assert free.x_m > 0 and crowded.plate_m[2] <= 0.0


def test_a_label_that_does_not_fit_is_still_placed():
    (label,) = place_labels([Anchor("a very long name", (0.0, 0.0), 1.0)], [], (-2, -2, 2, 2), 2.0)
    assert label.text == "a very long name"


@pytest.mark.parametrize("most_m, expected", [(241, 200), (200, 200), (199, 100), (18, 10), (0.7, 0.5)])
def test_scale_bars_are_round(most_m, expected):
    assert round_length_m(most_m) == pytest.approx(expected)


# --- the sheet --------------------------------------------------------------------------------------------------------


def test_a_map_names_everything(world):
    sheet = plan_map(world, 4.0)
    words = [label.text for label in sheet.labels]
    assert {
        "people",
        "herd",
        "zebras",
        "loop",
        "human: 2",
        "elephant: 2",
        "soil",
        "dense",
        "seed 7, at 4 s",
    } <= set(words)
    assert {f"path {name}" for name in world.config["scene"]["paths"]} <= {
        layer.name for layer in sheet.layers
    }


def test_everything_lies_on_the_sheet(world):
    sheet = plan_map(world, 0.0)
    half = 0.5 * np.array([sheet.width_m, sheet.height_m]) * (1 + 1e-9)
    for layer in sheet.layers:
        assert (np.abs(layer.mesh.points_m[:, :2] - sheet.centre_m) <= half).all(), layer.name


def test_paths_are_drawn_where_actors_walk(world):
    (path,) = [layer for layer in plan_map(world, 0.0).layers if layer.name == "path loop"]
    actor = world.actors[2]
    place = actor.route.at(np.array([actor.start_m]))[0]
    apart_m = np.linalg.norm(path.mesh.points_m[:, :2] - place, axis=1).min()
    assert apart_m < 0.002 * world.terrain.size_m  # the steps along a drawn path


def test_a_map_is_the_same_each_time(world):
    first, second = plan_map(world, 1.0), plan_map(world, 1.0)
    assert first.labels == second.labels
    for a, b in zip(first.layers, second.layers):
        assert (a.name, a.colour) == (b.name, b.colour) and np.array_equal(a.mesh.points_m, b.mesh.points_m)


# --- stills -----------------------------------------------------------------------------------------------------------


def test_there_is_a_still_of_each_species_and_an_overview(world):
    assert [still.name for still in plan_stills(world, 0.0)] == [
        "overview",
        "close_people",
        "close_herd",
        "close_zebras",
    ]


def test_stills_look_at_the_actor_they_are_named_after(world):
    """The middle of the body, by the box of its whole walk, is within a pixel of the picture's middle."""
    for still in plan_stills(world, 2.0)[1:]:
        actor = next(a for a in world.actors if still.name == f"close_{a.group}")
        middle = track(actor, np.array([2.0])).position_m[0] + [
            0,
            0,
            actor.bounds_m[:, 2].mean(),
        ]
        point, depth_m = project(INTRINSICS, still.camera_to_world, middle[None])
        assert point[0] == pytest.approx(INTRINSICS.centre_px, abs=1.0)
        assert 4.0 < depth_m[0] < 16.0


def test_no_plant_stands_between_a_still_and_its_actor(world):
    """Uses the drawn width of crowns; this place is open enough to look past all of them."""
    for still in plan_stills(world, 2.0)[1:]:
        eye, way = still.camera_to_world[:2, 3], still.camera_to_world[:2, 2]
        for name, planting in world.plantings.items():
            off = planting.points_m[:, :2] - eye
            apart_m = np.linalg.norm(off - np.clip(off @ way, 0.0, 4.0)[:, None] * way, axis=1)
            crown_m = 0.5 * assets.load("plants", name)["crown_diameter_m"] * planting.scale
            assert (apart_m > crown_m).all(), (still.name, name)


def test_stills_are_50_deg_wide():
    assert np.degrees(np.arctan(0.5 * INTRINSICS.width_px / INTRINSICS.focal_px[0])) == pytest.approx(25.0)


def test_stills_are_taken_from_eye_height(world):
    for still in plan_stills(world, 2.0)[1:]:
        x_m, y_m, z_m = still.camera_to_world[:3, 3]
        assert z_m - world.terrain.surface_m(x_m, y_m) == pytest.approx(1.7, abs=1e-6)


def test_the_overview_looks_down_at_45_deg_from_122_m(world):
    pose = plan_stills(world, 0.0)[0].camera_to_world
    assert pose[2, 2] == pytest.approx(-np.sin(np.radians(45)))
    target = pose[:3, 3] + 122.0 * np.sqrt(2) * pose[:3, 2]
    assert target[2] == pytest.approx(world.terrain.surface_m(*target[:2]), abs=1e-6)


# --- files ------------------------------------------------------------------------------------------------------------


def test_a_png_file_is_whole_from_its_signature_to_its_end(tmp_path):
    content = png_bytes(np.arange(12, dtype=np.uint8).reshape(3, 4))
    file = tmp_path / "picture.png"
    for written, expected in ((content, True), (content[:-1], False), (content[1:], False), (b"", False)):
        file.write_bytes(written)
        assert is_whole_png(file) == expected
    assert not is_whole_png(tmp_path / "nowhere.png")
