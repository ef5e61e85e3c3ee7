"""Species: sizes as known, measured on the standing body, the parts that have temperatures, and sources."""

import json
import re

import numpy as np
import pytest

from creatures import Hills, circle
from planner import asset_checks, assets
from planner.anatomy.bodies import build_body, variant_names
from planner.anatomy.pose import Motion, Walker, pose
from planner.anatomy.skeleton import is_in
from planner.config import ROOT
from planner.faults import ConfigError

KINDS = [(species, variant) for species in assets.names("species") for variant in variant_names(species)]
FLAT = Hills(0.0)
SHOULDERS_M = {
    "elephant/bull": 3.2,
    "elephant/cow": 2.6,
    "elephant/calf": 1.4,
    "rhinoceros": 1.8,
    "hippopotamus": 1.5,
    "zebra": 1.3,
    "lion": 1.1,
    "impala": 0.9,
    "cattle/bull": 1.3,
    "cattle/cow": 1.2,
    "goat/buck": 0.7,
    "goat/doe": 0.63,
    "dog/male": 0.54,
    "dog/female": 0.48,
    "warthog/boar": 0.68,
    "warthog/sow": 0.6,
    "buffalo/bull": 1.5,
    "buffalo/cow": 1.4,
    "wildebeest/bull": 1.38,
    "wildebeest/cow": 1.25,
}
LENGTHS_M = {  # nose to rump
    "rhinoceros": 3.8,
    "hippopotamus": 3.5,
    "zebra": 2.4,
    "lion": 1.8,
    "baboon/male": 1.0,
    "baboon/female": 0.8,
    "warthog/boar": 1.35,
    "buffalo/bull": 2.7,
    "wildebeest/bull": 2.0,
}
TALLEST_M = {"giraffe": 5.0, "human": 1.75, "ostrich/cock": 2.3, "ostrich/hen": 1.85}
PARTS = {
    "human": {"face", "hands", "torso", "legs", "pack"},
    "elephant": {"ears", "trunk", "tusks", "torso", "legs"},
    "villager": {"face", "hands", "torso", "legs", "skirt", "blanket", "load", "stool"},
    "bicycle": {"frame", "tyres", "face", "torso", "legs"},
    "motorbike": {"engine", "exhaust", "tyres", "face", "torso", "legs"},
    "pickup": {"hood", "cabin", "bed", "tyres"},
    "lorry": {"hood", "cabin", "bed", "tyres"},
    "cattle": {"head", "torso", "legs", "tail", "hump", "horns", "udder"},
    "baboon": {"head", "face", "torso", "legs", "hands", "tail"},
    "ostrich": {"head", "neck", "torso", "wings", "thighs", "legs", "tail"},
}


def _of(table: dict) -> list:
    """The (species, variant, figure) of all entries of a table."""
    return [
        (*kind, table.get(kind[0], table.get("/".join(kind))))
        for kind in KINDS
        if kind[0] in table or "/".join(kind) in table
    ]


def _scales(species: str, variant: str) -> np.ndarray:
    return np.array(assets.load("species", species)["variants"][variant]["size_range"])


def _standing(species: str, variant: str, parts=None) -> np.ndarray:
    """Vertices (n, 3) of parts, by default all, of a body of medium size on level ground, facing +x, with
    its feet as in a short stride."""
    body, scale = build_body(species, variant), _scales(species, variant).mean()
    far_m = 1e7
    walker = Walker(body, scale, scale * body.leg_m, 0.0, circle(far_m), FLAT)
    mesh = pose(walker, Motion(*np.zeros((4, 1)))).mesh(body, 0)
    slots = [body.parts.index(part) for part in parts or body.parts if part in body.parts]
    x, y, z = mesh.points_m[np.unique(mesh.triangles[np.isin(mesh.slot, slots)])].T
    return np.stack([y, far_m - x, z], axis=1)


def _shoulder_m(species: str, variant: str) -> float:
    """Height of the torso's back over the fore legs."""
    torso = _standing(species, variant, ["torso"])
    fore_m = _scales(species, variant).mean() * max(leg.toe_m[0] for leg in build_body(species, variant).legs)
    near = np.abs(torso[:, 0] - fore_m) < 0.15 * np.ptp(torso[:, 0])
    return float(torso[near, 2].max())


@pytest.mark.parametrize("species, variant, shoulder_m", _of(SHOULDERS_M))
def test_shoulders_are_as_high_as_known(species, variant, shoulder_m):
    assert _shoulder_m(species, variant) == pytest.approx(shoulder_m, rel=0.1)


def test_calves_are_of_all_heights_between_those_of_the_young():
    scales = _scales("elephant", "calf")
    heights_m = _shoulder_m("elephant", "calf") * scales / scales.mean()
    assert heights_m == pytest.approx([1.2, 1.6], rel=0.1)


@pytest.mark.parametrize("species, variant, length_m", _of(LENGTHS_M))
def test_heads_and_bodies_are_as_long_as_known(species, variant, length_m):
    whole = _standing(species, variant, ["torso", "head", "face", "mane"])
    assert np.ptp(whole[:, 0]) == pytest.approx(length_m, rel=0.1)


@pytest.mark.parametrize("species, variant, height_m", _of(TALLEST_M))
def test_tall_ones_are_as_tall_as_known(species, variant, height_m):
    assert _standing(species, variant)[:, 2].max() == pytest.approx(height_m, rel=0.1)


def test_a_crocodile_is_4_m_long_and_low():
    assert np.ptp(_standing("crocodile", "adult")[:, 0]) == pytest.approx(4.0, rel=0.1)
    back = _standing("crocodile", "adult", ["torso"])
    assert back[:, 2].max() == pytest.approx(0.4, rel=0.1)
    assert np.ptp(back[:, 1]) == pytest.approx(0.7, rel=0.1)


@pytest.mark.parametrize("species, variant", KINDS)
def test_bodies_stand_on_the_ground(species, variant):
    # Hooves are rounded: they may be off the ground, or in it, by a fiftieth of the body's height at most.
    points = _standing(species, variant)
    assert abs(points[:, 2].min()) < 0.02 * points[:, 2].max()


@pytest.mark.parametrize("species, variant", KINDS)
def test_bodies_are_light(species, variant):
    for posture in build_body(species, variant).postures:
        body = build_body(species, variant, posture)
        assert 500 < sum(len(bone.mesh.triangles) for bone in body.bones) <= 4000


@pytest.mark.parametrize("species", assets.names("species"))
def test_all_parts_are_there_and_have_temperatures(species):
    needed = PARTS.get(species, {"head", "torso", "legs", "tail"})
    worn = set()
    for variant in variant_names(species):
        for posture in build_body(species, variant).postures:
            body = build_body(species, variant, posture)
            worn |= {body.parts[slot] for bone in body.bones for slot in np.unique(bone.mesh.slot)}
    assert needed <= worn
    assert worn == set(build_body(species, variant).parts)
    assets.load("materials", assets.load("species", species)["material"])


@pytest.mark.parametrize("species", assets.names("species"))
def test_figures_have_sources_or_are_called_estimates(species):
    source = assets.load("species", species)["source"]
    assert "speed_m_s" in source
    for text in source.values():
        assert re.search(r"estimate|\b(1[89]|20)\d\d\b", text)  # a year stands for a book or paper


@pytest.mark.parametrize("variant", variant_names("villager"))
@pytest.mark.parametrize("tilt", [(0.0, 0.0), (0.1, 0.05)])
def test_villagers_rest_on_the_ground_in_every_posture(variant, tilt):
    """Feet, seat or head are on it, and only those who stand are as tall as that."""
    ground, far_m = Hills(0.0, tilt=tilt), 1e7
    able = assets.load("species", "villager")["variants"][variant].get("behaviours")
    for posture in assets.load("species", "villager")["postures"]:
        if able and posture.split("_")[0] not in able:
            continue
        body = build_body("villager", variant, posture)
        walker = Walker(body, 1.0, 1.0, 0.0, circle(far_m), ground)
        poses = pose(walker, Motion(*np.zeros((4, 1)), posture=posture))
        above_m = {}
        for k, bone in enumerate(body.bones):
            points_m = poses.position_m[0, k] + bone.mesh.points_m @ poses.rotation[0, k].T
            above_m[bone.name] = points_m[:, 2] - ground.height_m(*points_m[:, :2].T)
        feet_m = min(above_m["foot.left"].min(), above_m["foot.right"].min())
        stands = posture.startswith(("stand", "graze"))
        assert (above_m["head"].max() > 1.6) == stands, posture
        if posture.startswith(("sit", "lie")) and posture != "sit_on_stool":
            assert (
                0.0 < poses.position_m[0, 0, 2] - ground.height_m(*poses.position_m[0, 0, :2]) < 0.3
            ), posture
        if body.postures[posture].on_feet:
            assert abs(feet_m) < 0.02, posture
        else:
            assert -0.08 < min(feet_m, above_m["head"].min()) < 0.12, posture


def test_one_who_sits_on_a_stool_has_it_on_the_ground():
    body = build_body("villager", "man", "sit_on_stool")
    walker = Walker(body, 1.0, 1.0, 0.0, circle(1e7), FLAT)
    poses = pose(walker, Motion(*np.zeros((4, 1)), posture="sit_on_stool"))
    (stool,) = (k for k, bone in enumerate(body.bones) if bone.name == "stool")
    height_m = (poses.position_m[0, stool] + body.bones[stool].mesh.points_m @ poses.rotation[0, stool].T)[
        :, 2
    ]
    assert height_m.min() == pytest.approx(0.0, abs=0.03)
    assert "stool" not in {bone.name for bone in build_body("villager", "man").bones}


@pytest.mark.parametrize(
    "species, posture",
    [("lion", "lie"), ("hippopotamus", "float"), ("crocodile", "float")]
    + [
        (kind, "lie")
        for kind in ("cattle", "goat", "dog", "baboon", "warthog", "ostrich", "buffalo", "wildebeest")
    ],
)
def test_those_that_lie_or_float_know_how(species, posture):
    for variant in variant_names(species):
        assert not build_body(species, variant).postures[posture].on_feet


@pytest.mark.parametrize(
    "place, change",
    [
        ("variants.male.turn_deg", lambda data: data["variants"]["male"].update(turn_deg={"nek": [0, 9, 0]})),
        ("postures.lie.turn_deg", lambda data: data["postures"]["lie"]["turn_deg"].update(nek=[0, 9, 0])),
        ("moves[0].bone", lambda data: data["moves"][0].update(bone="nek")),
        ("legs[1].bones[0]", lambda data: data["legs"][1]["bones"].__setitem__(0, "nek")),
    ],
)
def test_a_bone_that_is_named_but_not_drawn_is_a_fault(place, change):
    data = json.loads((ROOT / "assets" / "species" / "lion.json").read_text(encoding="utf-8"))
    change(data)
    with pytest.raises(ConfigError) as raised:
        asset_checks.check("lion.json", "species", data)
    known = ", ".join(sorted(data["bones"]))
    assert str(raised.value).startswith(f'lion.json: {place} = "nek"; expected a bone: {known}')


@pytest.mark.parametrize(
    "place, change",
    [
        ("moves[0].only[1]", lambda data: data["moves"][0].update(only=["ma*", "stnad*"])),
        ("bones.tail.only[0]", lambda data: data["bones"]["tail"].update(only=["stnad*"])),
        (
            "bones.tail.shapes[0].only[0]",
            lambda data: data["bones"]["tail"]["shapes"][0].update(only=["stnad*"]),
        ),
    ],
)
def test_a_pattern_that_is_no_variant_and_no_posture_is_a_fault(place, change):
    data = json.loads((ROOT / "assets" / "species" / "lion.json").read_text(encoding="utf-8"))
    change(data)
    with pytest.raises(ConfigError) as raised:
        asset_checks.check("lion.json", "species", data)
    known = ", ".join(sorted([*data["variants"], "walk", *data["postures"]]))
    assert str(raised.value).startswith(
        f'lion.json: {place} = "stnad*"; expected variants or postures: {known}'
    )


def test_a_pattern_stands_for_all_names_that_fit():
    assert is_in({"only": ["stand*"]}, "man", "stand_lunge")
    assert not is_in({"only": ["stand*"]}, "man", "sit")
    assert is_in({"only": ["ma*"]}, "man", "sit")


def test_a_part_without_a_temperature_is_a_fault():
    data = json.loads((ROOT / "assets" / "species" / "lion.json").read_text(encoding="utf-8"))
    data["bones"]["tail"]["shapes"][0]["part"] = "tial"
    with pytest.raises(ConfigError) as raised:
        asset_checks.check_parts("lion.json", data, ["legs", "mane", "tail"])
    known = 'head, legs, mane, tail, torso; did you mean "tail"?'
    assert str(raised.value) == f'lion.json: bones.tail.shapes[0].part = "tial"; expected a part: {known}'
