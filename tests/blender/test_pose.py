"""Poses: legs reach the ground and bend the right way, on slopes and in turns, without jumps."""

from dataclasses import replace

import numpy as np
import pytest

from creatures import CART, PONY, Hills, apart, circle
from planner import assets
from planner.anatomy.bodies import body_of, build_body, variant_names
from planner.anatomy.gait import stride_m
from planner.anatomy.pose import Motion, Walker, feet, pose

MARE, WAGON = body_of(PONY, "mare"), body_of(CART, "plain")
KINDS = [
    (species, variant)
    for species in assets.names("species")
    for variant in variant_names(species)
    if build_body(species, variant).legs
]
STEEPEST = np.tan(np.radians(25.0))
GROUNDS = {
    "level": Hills(0.0),
    "uphill": Hills(0.0, tilt=(0.0, STEEPEST)),
    "across": Hills(0.0, tilt=(STEEPEST, 0.0)),
    "hills": Hills(STEEPEST, wave_m=60.0),
}


def _length_m(body) -> float:
    """Of a body, from nose to tail; of those that walk upright, from head to foot."""
    return float(np.ptp(body.rest().points_m[:, 2 if len(body.legs) == 2 else 0]))


def _walker(body, ground, speed_m_s=1.1, scale=1.0, radius_m=None) -> Walker:
    """On a path northward at first, which turns as tightly as three body lengths if no radius is given."""
    radius_m = radius_m or 3.0 * scale * _length_m(body)
    return Walker(body, scale, stride_m(speed_m_s, scale * body.leg_m), 0.3, circle(radius_m), ground)


def _motion(walked_m, pace=1.0, head_down=0.0, time_s=0.0, posture="walk") -> Motion:
    walked_m = np.asarray(walked_m, float)
    pace, head_down, time_s = (np.broadcast_to(v, walked_m.shape) for v in (pace, head_down, time_s))
    return Motion(walked_m, time_s, pace, head_down, posture)


def _walk(walker: Walker, strides=3, steps=200) -> Motion:
    walked_m = np.linspace(0, strides * walker.stride_m, strides * steps)
    return _motion(walked_m, time_s=walked_m / 1.1)


def _moment(motion: Motion, k: int) -> Motion:
    """One moment of a motion."""
    values = (motion.walked_m, motion.time_s, motion.pace, motion.head_down)
    return Motion(*(each[k : k + 1] for each in values), motion.posture)


def _end(body, poses, bone: int, point_m: np.ndarray) -> np.ndarray:
    """Where in the world (n, 3) a point of a bone, given in body axes as drawn, is."""
    off = point_m - body.bones[bone].joint_m
    return poses.position_m[:, bone] + poses.scale[:, None] * (poses.rotation[:, bone] @ off)


@pytest.mark.parametrize("ground", GROUNDS)
@pytest.mark.parametrize("species, variant", KINDS)
def test_legs_are_whole_and_feet_where_they_should_be(species, variant, ground):
    """All species, all along: slopes up to 25 degrees, a turn of three body lengths, small and large ones."""
    body, speed = build_body(species, variant), assets.load("species", species)["speed_m_s"]
    for scale in (0.8, 1.1):
        walker = _walker(body, GROUNDS[ground], speed, scale)
        motion = _walk(walker)
        poses = pose(walker, motion)
        for leg, foot in zip(body.legs, apart(feet(walker, motion))):
            # A heel that strikes is off the ground where that curves: by 20 cm squared over a radius of 26 m, halved.
            for back_m, bearing, most_m in (
                (0.0, foot.bearing & (foot.strike_rad == 0.0), 1e-9),
                (leg.foot_m, foot.bearing & (foot.strike_rad > 0.0), 1e-3),
            ):
                sole_m = _end(body, poses, leg.bones[2], leg.toe_m - [back_m, 0.0, 0.0])
                slide = np.linalg.norm(np.diff(sole_m[:, :2], axis=0), axis=1) / np.diff(motion.walked_m)
                assert (
                    slide[bearing[1:] & bearing[:-1]].max(initial=0.0) < 1e-9
                )  # 5 % of the body's speed would do
                above = sole_m[:, 2] - GROUNDS[ground].height_m(*sole_m[:, :2].T)
                assert np.abs(above[bearing]).max(initial=0.0) < most_m  # 5 cm would do
            for upper, lower in zip(leg.bones, leg.bones[1:]):
                gap = _end(body, poses, upper, body.bones[lower].joint_m) - poses.position_m[:, lower]
                assert np.abs(gap).max() < 1e-9


@pytest.mark.parametrize("species, variant", KINDS)
def test_nothing_jumps(species, variant):
    """Ten times finer steps are ten times smaller: turns and places are continuous, and as fast as limbs can be."""
    body, speed = build_body(species, variant), assets.load("species", species)["speed_m_s"]
    walker = _walker(body, GROUNDS["hills"], speed)
    largest = []
    for steps in (400, 4000):
        poses = pose(walker, _walk(walker, strides=2, steps=steps))
        turn = np.linalg.norm(np.diff(poses.rotation, axis=0), axis=(2, 3)) / np.sqrt(2.0)
        move = np.linalg.norm(np.diff(poses.position_m, axis=0), axis=-1) / walker.stride_m
        largest.append((turn.max() * steps, move.max() * steps))
    (turn, move), (fine_turn, fine_move) = largest
    assert fine_turn < 1.2 * turn + 0.5 and fine_move < 1.2 * move + 0.5
    assert fine_turn < 45  # radians a stride; a swinging human shank does about 15
    assert fine_move < 6  # strides a stride; a foot in the air about 4


@pytest.mark.parametrize("species, variant", KINDS)
def test_knees_bend_to_the_side_they_are_drawn_on(species, variant):
    body = build_body(species, variant)
    walker = _walker(body, GROUNDS["level"], radius_m=1e6)
    poses = pose(walker, _walk(walker))
    carriage = poses.rotation[:, 0]
    for leg in body.legs:
        hip, knee, ankle = (body.bones[k].joint_m for k in leg.bones)
        along = (ankle - hip) / np.linalg.norm(ankle - hip)
        out = knee - hip - (knee - hip) @ along * along
        hips, knees, ankles = (np.swapaxes(poses.position_m, 0, 1)[k] for k in leg.bones)
        middle = hips + (ankles - hips) * (np.linalg.norm(knee - hip) / np.linalg.norm(ankle - hip))
        assert (((knees - middle) * (carriage @ out)).sum(axis=1) > 0).all()


def test_hips_ride_at_about_their_own_height():
    walker = _walker(MARE, GROUNDS["level"], radius_m=1e6)
    height_m = pose(walker, _walk(walker)).position_m[:, 0, 2]
    assert height_m.max() <= 1.0 + 1e-9
    assert height_m.min() > 0.88  # it sinks when a leg is spread out most


def test_a_body_lies_along_the_slope_as_much_as_its_file_says():
    walker = _walker(MARE, Hills(0.0, tilt=(0.2, 0.3)), radius_m=1e6)
    forward, left, _ = pose(walker, _motion([0.0])).rotation[0, 0].T
    assert np.arctan2(forward[2], np.hypot(*forward[:2])) == pytest.approx(np.arctan(0.3))
    assert left[2] == pytest.approx(np.sin(np.arctan(-0.4 * 0.2)) * np.cos(np.arctan(0.3)))


def test_feet_depend_only_on_the_distance_walked():
    """A walker that stops keeps its stance; periodic motion continues."""
    walker = _walker(MARE, GROUNDS["hills"])
    poses = pose(walker, _motion([2.2, 2.2], time_s=[0.0, 0.7]))
    moved = np.abs(np.diff(poses.rotation, axis=0)).max(axis=(0, 2, 3))
    assert [bone.name for bone, by in zip(MARE.bones, moved) if by > 0] == ["tail"]
    assert np.array_equal(*poses.position_m)


def test_strides_do_not_move_a_standing_body():
    walker = _walker(MARE, GROUNDS["level"])
    neck = [bone.name for bone in MARE.bones].index("neck")
    poses = pose(walker, _motion([0.3, 0.3], pace=[0.0, 1.0]))
    angles = np.arccos(
        np.clip((poses.rotation[:, 0] * poses.rotation[:, neck]).sum(axis=(1, 2)) / 2 - 0.5, -1, 1)
    )
    assert angles[0] == pytest.approx(0.0, abs=1e-6) and angles[1] > 0.01


def test_a_grazers_head_comes_down_bit_by_bit():
    walker = _walker(MARE, GROUNDS["level"])
    head = [bone.name for bone in MARE.bones].index("head")
    heights = pose(walker, _motion(np.zeros(5), 0.0, [0, 0.25, 0.5, 0.75, 1])).position_m[:, head, 2]
    assert (np.diff(heights) < -0.1).all()
    # The neck is drawn 0.495 m long at 45 degrees up, and comes down by 75.
    assert heights[0] - heights[-1] == pytest.approx(
        0.495 * (np.sin(np.radians(45)) + np.sin(np.radians(30))), abs=1e-3
    )


def test_a_lying_body_is_down_and_its_legs_are_folded():
    walker = _walker(MARE, Hills(0.0, tilt=(0.1, 0.0)))
    stands, lies = (pose(walker, _motion([0.0], 0.0, posture=posture)) for posture in ("walk", "lie"))
    # The body of one that stands is lower than drawn by what its legs are spread.
    assert (stands.position_m - lies.position_m)[0, 0, 2] == pytest.approx(0.7, abs=0.1)
    ankle = MARE.legs[0].bones[2]
    assert lies.position_m[0, ankle, 2] > stands.position_m[0, ankle, 2] - 0.3


@pytest.mark.parametrize("water_m, height_m", [(3.0, 3.0 - 1.0), (0.2, 0.0)])
def test_a_floating_body_is_level_in_the_water_or_stands_on_its_ground(water_m, height_m):
    walker = _walker(MARE, Hills(0.0, water_m=water_m), radius_m=1e6)
    poses = pose(walker, _motion([5.0], posture="float"))
    assert poses.position_m[0, 0, 2] == pytest.approx(height_m + 1.0)  # its trunk is drawn 1 m up
    sloping = _walker(MARE, Hills(0.0, tilt=(0.0, 0.3), water_m=water_m + 9.0), radius_m=1e6)
    assert pose(sloping, _motion([0.0], posture="float")).rotation[0, 0, 2, 2] == pytest.approx(1.0)


def test_wheels_roll_as_far_as_they_go_and_stay_on_the_ground():
    walker = _walker(WAGON, Hills(0.2, wave_m=40.0), radius_m=20.0)
    poses = pose(walker, _motion([0.0, 0.1]))
    for wheel in WAGON.wheels:
        hub = WAGON.bones[wheel.bone].joint_m
        off = pose(walker, _motion(np.linspace(0, 120, 300))).position_m[:, wheel.bone]
        # The hub of a wheel on a slope of 11 degrees is closer to the ground below it than the radius: 0.4 (1 - cos).
        gap = off[:, 2] - walker.ground.height_m(*off[:, :2].T)
        assert np.abs(gap - 0.4).max() < 0.05
        turned = poses.rotation[1, wheel.bone] @ poses.rotation[0, wheel.bone].T
        assert np.arccos(np.trace(turned) / 2 - 0.5) == pytest.approx(0.1 / wheel.radius_m, rel=0.05)
        assert hub[2] == wheel.radius_m


def test_a_bicycle_that_is_pushed_rolls_on_the_ground_however_its_owner_walks():
    body = build_body("bicycle", "pushed")
    walker = _walker(body, GROUNDS["level"], radius_m=1e6)
    poses = pose(walker, _walk(walker))
    for wheel in body.wheels:
        assert poses.position_m[:, wheel.bone, 2] == pytest.approx(wheel.radius_m, abs=1e-6)
    assert np.ptp(poses.position_m[:, 0, 2]) > 0.01  # hips rise and fall


def test_vertices_follow_their_bones():
    walker = _walker(MARE, GROUNDS["hills"], scale=0.9)
    poses = pose(walker, _motion([1.0, 2.0]))
    expected = [
        position + 0.9 * rotation @ vertex
        for bone, position, rotation in zip(MARE.bones, poses.position_m[1], poses.rotation[1])
        for vertex in bone.mesh.points_m
    ]
    assert poses.points_m(MARE, 1) == pytest.approx(np.array(expected))
    mesh = poses.mesh(MARE, 1)
    assert np.array_equal(mesh.points_m, poses.points_m(MARE, 1))
    assert np.array_equal(mesh.triangles, MARE.rest().triangles)


@pytest.mark.parametrize("body, posture", [(MARE, "walk"), (MARE, "lie"), (MARE, "float"), (WAGON, "walk")])
def test_walkers_of_one_body_are_posed_together_as_alone(body, posture):
    """Each of many moments has a walker of its own."""
    count, ground = 40, Hills(STEEPEST, wave_m=60.0, water_m=0.5)
    walkers = [_walker(body, ground, 0.8 + 0.01 * k, scale=0.8 + 0.01 * k) for k in range(count)]

    def path(walked_m):
        return tuple(
            np.stack(parts, axis=-2)
            for parts in zip(*(walker.path(walked_m[..., k]) for k, walker in enumerate(walkers)))
        )

    motion = _motion(
        np.linspace(0, 9, count), np.linspace(0, 1, count), np.linspace(1, 0, count), 2.0, posture
    )
    scale, stride_m, phase = np.array([(each.scale, each.stride_m, each.phase) for each in walkers]).T
    together = pose(Walker(body, scale, stride_m, phase + 0.01 * np.arange(count), path, ground), motion)
    for k, walker in enumerate(walkers):
        alone = pose(replace(walker, phase=walker.phase + 0.01 * k), _moment(motion, k))
        assert np.array_equal(together.position_m[k], alone.position_m[0])
        assert np.array_equal(together.rotation[k], alone.rotation[0])
        assert together.scale[k] == alone.scale[0]


def test_a_moment_alone_is_the_same_as_among_others():
    walker = _walker(MARE, GROUNDS["hills"])
    motion = _walk(walker)
    among, alone = pose(walker, motion), pose(walker, _moment(motion, 7))
    assert np.array_equal(among.position_m[7], alone.position_m[0])
    assert np.array_equal(among.rotation[7], alone.rotation[0])
