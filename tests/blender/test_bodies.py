"""Bodies: closed surfaces, left-right symmetry, effects of variants, and the angles of files."""

import numpy as np
import pytest

from creatures import CART, PONY
from planner import assets
from planner.anatomy.bodies import body_of, build_body, draw_variant, variant_names
from planner.anatomy.skeleton import has_own_shapes
from planner.geometry.shapes import NOTHING, ellipsoid, joined, sheet, tube

KINDS = [(species, variant) for species in assets.names("species") for variant in variant_names(species)]
MARE = body_of(PONY, "mare")


def _bone(body, name: str):
    return next(bone for bone in body.bones if bone.name == name)


def _is_closed_and_faces_outward(mesh) -> bool:
    edges = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    forth, back = {tuple(e) for e in edges}, {tuple(e[::-1]) for e in edges}
    a, b, c = np.moveaxis(mesh.points_m[mesh.triangles], 1, 0)
    volume = (a * np.cross(b, c)).sum() / 6
    return forth == back and len(forth) == len(edges) and volume > 0


@pytest.mark.parametrize("species, variant", KINDS)
def test_surfaces_are_closed_and_face_outward(species, variant):
    meshes = [bone.mesh for bone in build_body(species, variant).bones if len(bone.mesh.triangles)]
    assert meshes and all(_is_closed_and_faces_outward(mesh) for mesh in meshes)


def test_an_ellipsoid_has_its_radii():
    mesh = ellipsoid([1, 2, 3], [3, 2, 1], rings=60, sides=120)
    # The first ring is half a ring's angle from the pole, the rings lie half an angle off the equator: 1 - cos.
    assert np.ptp(mesh.points_m, axis=0) == pytest.approx([6, 4, 2], rel=1 - np.cos(np.pi / 60))


def test_a_tube_keeps_to_its_rings():
    mesh = tube(np.array([[0, 0, 0, 1, 2], [5, 0, 0, 1, 2]]), sides=40, roundness=0.5)
    low, high = mesh.points_m.min(axis=0), mesh.points_m.max(axis=0)
    # Caps stand out by half the smaller half axis, times the sine of the last cap ring's 89 degrees.
    assert (low[0], high[0]) == pytest.approx((-0.5, 5.5), abs=1e-4)
    assert (low[1:], high[1:]) == (pytest.approx([-1, -2]), pytest.approx([1, 2]))


def test_a_sheet_fills_its_outline_and_faces_outward():
    square = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    mesh = sheet(square, 0.1, [0, 3, 0])
    # Through the corners of a square, the smooth outline bulges by an eighth of a side between them.
    assert np.ptp(mesh.points_m, axis=0) == pytest.approx([2.5, 0.1, 2.5])
    assert mesh.points_m.mean(axis=0) == pytest.approx([0, 3, 0])
    assert _is_closed_and_faces_outward(mesh)


def test_nothing_joined_is_nothing():
    assert joined([]).points_m.shape == NOTHING.points_m.shape == (0, 3)


def test_pairs_are_mirror_images():
    left, right = _bone(MARE, "fore_upper.left"), _bone(MARE, "fore_upper.right")
    assert np.array_equal(left.joint_m * [1, -1, 1], right.joint_m)
    assert np.array_equal(left.mesh.points_m * [1, -1, 1], right.mesh.points_m)
    legs = MARE.legs
    assert np.array_equal(legs[0].toe_m * [1, -1, 1], legs[1].toe_m)
    assert [leg.phase for leg in legs] == [0.25, 0.75, 0.0, 0.5]


def test_the_parent_of_a_bone_is_on_the_same_side():
    names = [bone.name for bone in MARE.bones]
    parents = {bone.name: names[bone.parent] for bone in MARE.bones if bone.parent >= 0}
    assert parents["fore_foot.right"] == "fore_lower.right" and parents["fore_upper.right"] == "trunk"


def test_shapes_of_other_variants_are_left_out():
    tails = [_bone(body_of(PONY, variant), "tail").mesh for variant in ("mare", "foal")]
    assert len(tails[0].triangles) > len(tails[1].triangles)


def test_a_stretched_bone_grows_about_its_joint_and_takes_its_children_along():
    long = PONY | {"variants": {"long": {"share": 1, "size_range": [1, 1], "stretch": {"neck": 1.5}}}}
    body = body_of(long, "long")
    neck, head = _bone(body, "neck"), _bone(body, "head")
    assert np.array_equal(neck.joint_m, _bone(MARE, "neck").joint_m)
    assert head.joint_m - neck.joint_m == pytest.approx([1.5 * 0.35, 0, 1.5 * 0.35])
    assert head.mesh.points_m == pytest.approx(1.5 * _bone(MARE, "head").mesh.points_m)


def test_a_bone_may_be_stretched_along_each_axis():
    wide = PONY | {
        "variants": {"wide": {"share": 1, "size_range": [1, 1], "stretch": {"neck": [1.0, 1.5, 2.0]}}}
    }
    neck, head = (_bone(body_of(wide, "wide"), name) for name in ("neck", "head"))
    assert neck.mesh.points_m == pytest.approx(_bone(MARE, "neck").mesh.points_m * [1.0, 1.5, 2.0])
    assert head.joint_m - neck.joint_m == pytest.approx([0.35, 0, 2.0 * 0.35])


def _changed(bone: str, **shape) -> dict:
    """The pony with keys of the first shape of a bone."""
    first, *others = PONY["bones"][bone]["shapes"]
    return PONY | {
        "bones": PONY["bones"] | {bone: PONY["bones"][bone] | {"shapes": [first | shape, *others]}}
    }


def test_patches_are_triangles_of_another_part_in_a_box():
    patch = {"part": "mane", "from_m": [-9, 0.0, 1.3], "to_m": [9, 9, 9]}
    body = body_of(_changed("neck", patches=[patch]), "mare")
    mesh = _bone(body, "neck").mesh
    middle_m = (mesh.points_m[mesh.triangles] + _bone(body, "neck").joint_m).mean(axis=1)
    inside = (middle_m[:, 1] >= 0.0) & (middle_m[:, 2] >= 1.3)
    assert 0 < inside.sum() < len(inside)
    assert [body.parts[slot] for slot in mesh.slot] == ["mane" if each else "torso" for each in inside]
    assert np.array_equal(mesh.points_m, _bone(MARE, "neck").mesh.points_m)


def test_shapes_of_a_posture_are_drawn_in_it_alone():
    data = _changed("head", only=["lie"])
    heads = [_bone(body_of(data, "mare", posture), "head").mesh for posture in ("walk", "lie")]
    assert [len(mesh.triangles) > 0 for mesh in heads] == [False, True]
    assert (
        has_own_shapes(data, "lie") and not has_own_shapes(data, "float") and not has_own_shapes(PONY, "lie")
    )


def test_a_variant_holds_angles_in_every_posture_and_move():
    mare = PONY["variants"]["mare"]
    held = PONY | {"variants": {"mare": mare | {"holds_deg": {"neck": [0, 5, 0], "hind_upper": [0, 9, 0]}}}}
    body = body_of(held, "mare")
    place = {bone.name: k for k, bone in enumerate(body.bones)}
    for posture in ("walk", "lie"):
        turn_rad = body.postures[posture].turn_rad
        assert turn_rad[place["neck"]] == pytest.approx(np.radians([0, 5, 0]))
        assert turn_rad[place["hind_upper.right"]] == pytest.approx(np.radians([0, 9, 0]))
    assert [body.bones[move.bone].name for move in body.moves] == ["tail"]


@pytest.mark.parametrize("bone", ["trunk", "fore_upper", "hind_lower"])
def test_a_stretched_body_stands_on_the_ground(bone):
    long = PONY | {"variants": {"long": {"share": 1, "size_range": [1, 1], "stretch": {bone: 1.3}}}}
    assert min(leg.toe_m[2] for leg in body_of(long, "long").legs) == pytest.approx(0.0, abs=1e-12)


def test_angles_of_a_pair_are_mirrored():
    ears = {"turn_deg": {"fore_upper": [10, 20, 30], "nowhere": [1, 1, 1]}}
    turned = body_of(PONY | {"postures": {"stand": ears}}, "mare").postures["stand"].turn_rad
    place = {bone.name: k for k, bone in enumerate(MARE.bones)}
    assert turned[place["fore_upper.left"]] == pytest.approx(np.radians([10, 20, 30]))
    assert turned[place["fore_upper.right"]] == pytest.approx(np.radians([-10, 20, -30]))
    assert np.count_nonzero(turned) == 6


def test_every_body_can_walk_and_graze():
    assert {"walk", "graze"} <= set(body_of(CART, "plain").postures)


def test_variants_come_as_often_as_their_shares_say():
    species = "elephant"
    drawn = [draw_variant(species, 7, "herd", k, "walk") for k in range(2000)]
    shares = {name: entry["share"] for name, entry in assets.load("species", species)["variants"].items()}
    for name, share in shares.items():
        expected = share / sum(shares.values())
        # Five standard deviations of a binomial share: one false alarm in a million.
        assert drawn.count(name) / 2000 == pytest.approx(expected, abs=5 * np.sqrt(0.25 / 2000))
    assert drawn[:9] == [draw_variant(species, 7, "herd", k, "walk") for k in range(9)]


@pytest.mark.parametrize("species, variant", KINDS)
def test_legs_bear_all_of_a_body_that_does_not_roll(species, variant):
    body = build_body(species, variant)
    assert body.wheels or body.borne == list(range(len(body.bones)))
