"""Poses of cameras by angles, and by what an autopilot sends."""

import numpy as np
import pytest
from pymavlink.dialects.v20 import common
from pymavlink.quaternion import Quaternion

from earth import axes_at, earth_coordinates_m
from veldt import ConfigError
from veldt.mavlink import Vehicle
from veldt.poses import pose_looking, pose_of_attitude, rotation_of_attitude, rotation_of_quaternion

HOME = (-19.3, 23.1, 940.0)


def _is_rotation(matrix):
    return np.allclose(matrix @ matrix.T, np.eye(3)) and np.linalg.det(matrix) == pytest.approx(1)


def test_poses_have_no_roll_and_look_where_they_say():
    pose = pose_looking([1.0, 2.0, 30.0], np.pi / 2, np.pi / 6)
    assert np.allclose(pose[:3, 2], [0, np.cos(np.pi / 6), -0.5])
    assert np.allclose(pose[:3, 0], [1, 0, 0])
    assert _is_rotation(pose[:3, :3])
    assert pose[:3, 3].tolist() == [1, 2, 30]


def test_angles_are_those_of_aviation():
    east = pose_of_attitude([0, 0, 0], 0, 0, np.pi / 2)
    assert np.allclose(east[:3, 2], [1, 0, 0])  # looks east
    assert np.allclose(east[:3, 0], [0, -1, 0])  # right is south
    assert np.allclose(east[:3, 1], [0, 0, -1])  # the picture's bottom is down
    up = pose_of_attitude([0, 0, 0], 0, 0.3, 0)
    assert np.allclose(up[:3, 2], [0, np.cos(0.3), np.sin(0.3)])
    rolled = pose_of_attitude([0, 0, 0], 0.2, 0, 0)
    assert np.allclose(rolled[:3, 0], [np.cos(0.2), 0, -np.sin(0.2)])  # the right side goes down


def test_quaternions_and_angles_agree_with_pymavlink():
    angles_deg = [12.0, -34.0, 56.0]
    ours = rotation_of_attitude(*np.deg2rad(angles_deg))
    theirs = Quaternion(np.deg2rad(angles_deg))
    dcm = theirs.dcm
    assert np.allclose(
        ours, [[dcm.a.x, dcm.a.y, dcm.a.z], [dcm.b.x, dcm.b.y, dcm.b.z], [dcm.c.x, dcm.c.y, dcm.c.z]]
    )
    assert np.allclose(rotation_of_quaternion(*(3 * np.array(theirs.q))), ours)


class _Autopilot:
    """Encodes messages as an autopilot does."""

    def __init__(self, system=1):
        self._link = common.MAVLink(None, srcSystem=system)

    def __call__(self, name, **fields):
        message = getattr(common, f"MAVLink_{name}_message")(**fields)
        return message.pack(self._link)

    def position(self, latitude_deg=HOME[0], longitude_deg=HOME[1], height_m=HOME[2], speed_m_s=(0, 0, 0)):
        """speed_m_s: north, east, down."""
        return self.raw_position(
            lat=round(latitude_deg * 1e7), lon=round(longitude_deg * 1e7), alt=round(height_m * 1e3),
            **{name: round(100 * one) for name, one in zip(("vx", "vy", "vz"), speed_m_s)},
        )  # fmt: skip

    def raw_position(self, **fields):
        """At home and at rest but for these fields, in the message's units."""
        home = {"lat": -193_000_000, "lon": 231_000_000, "alt": 940_000, "vx": 0, "vy": 0, "vz": 0}
        return self("global_position_int", time_boot_ms=0, relative_alt=0, hdg=0, **home | fields)

    def attitude(self, roll=0.0, pitch=0.0, yaw=0.0, rates=(0, 0, 0)):
        """In radians."""
        rollspeed, pitchspeed, yawspeed = rates
        return self(
            "attitude", time_boot_ms=0, roll=roll, pitch=pitch, yaw=yaw,
            rollspeed=rollspeed, pitchspeed=pitchspeed, yawspeed=yawspeed,
        )  # fmt: skip

    def gimbal(self, angles_rad, flags, rates=(float("nan"),) * 3):
        """Angles: roll, pitch and yaw."""
        return self.raw_gimbal(list(Quaternion(angles_rad).q), flags, rates)

    def raw_gimbal(self, q, flags=0, rates=(0, 0, 0)):
        """Of a quaternion."""
        x, y, z = rates
        return self(
            "gimbal_device_attitude_status", target_system=0, target_component=0, time_boot_ms=0, flags=flags,
            q=q, angular_velocity_x=x, angular_velocity_y=y, angular_velocity_z=z,
            failure_flags=0,
        )  # fmt: skip


@pytest.fixture(name="autopilot")
def _autopilot():
    return _Autopilot()


def test_positions_are_metres_from_the_origin(autopilot):
    vehicle = Vehicle([5, 6, 7], HOME)
    vehicle.receive(autopilot.position(-19.295, 23.107, 1001), 0)
    vehicle.receive(autopilot.attitude(), 0)
    expected_m = axes_at(*HOME[:2]) @ (
        earth_coordinates_m(-19.295, 23.107, 1001) - earth_coordinates_m(*HOME)
    )
    assert np.allclose(vehicle.pose_at(0)[:3, 3], expected_m, atol=1e-6)


def test_without_an_origin_the_flight_begins_where_the_plan_says(autopilot):
    vehicle = Vehicle([5, 6, 71])
    vehicle.receive(autopilot.position(), 0)
    vehicle.receive(autopilot.attitude(), 0)
    assert vehicle.pose_at(0)[:3, 3].tolist() == [5, 6, 71]
    vehicle.receive(autopilot.position(height_m=HOME[2] + 10), 1)
    assert np.allclose(vehicle.pose_at(1)[:3, 3], [5, 6, 81], atol=1e-6)


def test_a_fixed_camera_looks_below_the_front_of_the_body(autopilot):
    vehicle = Vehicle([0, 0, 0], HOME, down_rad=0.5)
    vehicle.receive(autopilot.position(), 0)
    assert vehicle.pose_at(0) is None
    vehicle.receive(autopilot.attitude(pitch=-0.1, yaw=np.pi / 2), 0)
    assert np.allclose(vehicle.pose_at(0)[:3, 2], [np.cos(0.6), 0, -np.sin(0.6)], atol=1e-6)


@pytest.mark.parametrize(
    "flags, yaw_rad, heading_rad",
    [
        (common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME, 0.4, 0.4),
        (common.GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME, 0.4, 1.4),
        (common.GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME | common.GIMBAL_DEVICE_FLAGS_YAW_LOCK, 0.4, 1.4),
        (common.GIMBAL_DEVICE_FLAGS_YAW_LOCK, 0.4, 0.4),
        (0, 0.4, 1.4),
    ],
)
def test_a_gimbal_keeps_the_horizon_and_its_yaw_counts_as_its_flags_say(
    autopilot, flags, yaw_rad, heading_rad
):
    vehicle = Vehicle([0, 0, 0], HOME)
    vehicle.receive(autopilot.position() + autopilot.attitude(roll=0.3, pitch=-0.2, yaw=1), 0)
    vehicle.receive(autopilot.gimbal([0, -0.7, yaw_rad], flags), 0)
    assert np.allclose(vehicle.pose_at(0), pose_of_attitude([0, 0, 0], 0, -0.7, heading_rad), atol=1e-6)


def test_older_gimbals_send_degrees_from_the_front(autopilot):
    vehicle = Vehicle([0, 0, 0], HOME)
    vehicle.receive(autopilot.position() + autopilot.attitude(roll=0.3, yaw=1), 0)
    vehicle.receive(
        autopilot("mount_orientation", time_boot_ms=0, roll=0, pitch=-30, yaw=10, yaw_absolute=0), 0
    )
    expected = pose_of_attitude([0, 0, 0], 0, -np.pi / 6, 1 + np.deg2rad(10))
    assert np.allclose(vehicle.pose_at(0), expected, atol=1e-6)


def test_between_messages_the_drone_goes_on_for_a_second_at_most(autopilot):
    vehicle = Vehicle([0, 0, 0], HOME)
    vehicle.receive(autopilot.position(speed_m_s=(4, 3, -2)) + autopilot.attitude(rates=(0, 0, 0.5)), 10)
    vehicle.receive(autopilot.gimbal([0, -0.7, 0], common.GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME), 10)
    pose = vehicle.pose_at(10.1)
    assert np.allclose(pose[:3, 3], [0.3, 0.4, 0.2], atol=1e-9)
    assert np.allclose(pose, pose_of_attitude([0.3, 0.4, 0.2], 0, -0.7, 0.05), atol=1e-4)
    assert np.allclose(vehicle.pose_at(99)[:3, 3], [3, 4, 2], atol=1e-9)


def test_other_systems_and_noise_are_ignored(autopilot):
    vehicle = Vehicle([0, 0, 0], HOME)
    vehicle.receive(b"\x00\xfd\x13 no message", 0)
    vehicle.receive(autopilot.position() + autopilot.attitude(yaw=1), 0)
    before = vehicle.pose_at(0)
    other = _Autopilot(system=7)
    vehicle.receive(other.position(-19.2) + other.attitude(yaw=2), 0)
    broken = bytearray(autopilot.position(-19.1))
    broken[15] ^= 1
    vehicle.receive(bytes(broken), 0)
    assert np.array_equal(vehicle.pose_at(0), before)


def test_an_origin_off_the_earth_is_refused():
    with pytest.raises(ConfigError, match=r"^latitude = 93 deg; expected -89 to 89$"):
        Vehicle([0, 0, 0], (93, 23, 0))


NAN, INF = float("nan"), float("inf")
MOST_32, LEAST_32 = 2**31 - 1, -(2**31)


def _mount(autopilot, **angles_deg):
    angles_deg = {"roll": 0, "pitch": 0, "yaw": 0} | angles_deg
    return autopilot("mount_orientation", time_boot_ms=0, yaw_absolute=0, **angles_deg)


@pytest.mark.parametrize(
    "message, fault",
    [
        (lambda of: of.raw_position(lat=0, lon=0),
         "no fix: GLOBAL_POSITION_INT.lat, lon = 0, 0 deg; expected a position"),
        (lambda of: of.raw_position(lat=2_140_000_000),
         "out of range: GLOBAL_POSITION_INT.lat = 214 deg; expected -89 to 89"),
        (lambda of: of.raw_position(lat=MOST_32),
         "out of range: GLOBAL_POSITION_INT.lat = 214.748365 deg; expected -89 to 89"),
        (lambda of: of.raw_position(lat=895_000_000),
         "out of range: GLOBAL_POSITION_INT.lat = 89.5 deg; expected -89 to 89"),
        (lambda of: of.raw_position(lon=LEAST_32),
         "out of range: GLOBAL_POSITION_INT.lon = -214.748365 deg; expected -180 to 180"),
        (lambda of: of.raw_position(alt=MOST_32),
         "out of range: GLOBAL_POSITION_INT.alt = 2147483.65 m; expected -1000 to 20000"),
        (lambda of: of.raw_position(alt=LEAST_32),
         "out of range: GLOBAL_POSITION_INT.alt = -2147483.65 m; expected -1000 to 20000"),
        (lambda of: of.raw_position(lat=-192_000_000),
         "out of range: GLOBAL_POSITION_INT: place = 11071.1425 m; expected -10000 to 10000"),
        (lambda of: of.raw_position(vx=20_001),
         "out of range: GLOBAL_POSITION_INT.vx = 200.01 m/s; expected -200 to 200"),
        (lambda of: of.attitude(roll=NAN), "not a number: ATTITUDE.roll = nan rad; expected -628.318531 to 628.318531"),
        (lambda of: of.attitude(yaw=-INF), "out of range: ATTITUDE.yaw = -inf rad; expected -628.318531 to 628.318531"),
        (lambda of: of.attitude(pitch=1e30),
         "out of range: ATTITUDE.pitch = 1.00000002e+30 rad; expected -628.318531 to 628.318531"),
        (lambda of: of.attitude(rates=(0, INF, 0)),
         "out of range: ATTITUDE.pitchspeed = inf rad/s; expected -100 to 100"),
        (lambda of: of.raw_gimbal([NAN] * 4),
         "not a number: GIMBAL_DEVICE_ATTITUDE_STATUS: length of q = nan; expected 0.9 to 1.1"),
        (lambda of: of.raw_gimbal([0] * 4),
         "out of range: GIMBAL_DEVICE_ATTITUDE_STATUS: length of q = 0; expected 0.9 to 1.1"),
        (lambda of: of.raw_gimbal([3e38] * 4),
         "out of range: GIMBAL_DEVICE_ATTITUDE_STATUS: length of q = 6.00000001e+38; expected 0.9 to 1.1"),
        (lambda of: of.raw_gimbal([1, 0, 0, 0], rates=(0, 0, -1e9)), "out of range: "
         "GIMBAL_DEVICE_ATTITUDE_STATUS.angular_velocity_z = -1e+09 rad/s; expected -100 to 100"),
        (lambda of: _mount(of, pitch=NAN),
         "not a number: MOUNT_ORIENTATION.pitch = nan deg; expected -36000 to 36000"),
        (lambda _: _Autopilot(system=7).attitude(yaw=2),
         "another system: ATTITUDE: system = 7; expected 1, which came first"),
        (lambda of: of.attitude()[:-1], "not MAVLink: datagram = 12 bytes; expected MAVLink, or an object of JSON"),
        (lambda _: b"", "not MAVLink: datagram = 0 bytes; expected MAVLink, or an object of JSON"),
    ],
    ids=lambda one: one[:60] if isinstance(one, str) else "",
)  # fmt: skip
@pytest.mark.parametrize("origin", [HOME, None], ids=["origin", "first"])
def test_what_says_no_pose_is_dropped_with_its_reason_and_what_was_known_stays(
    autopilot, message, fault, origin
):
    vehicle = Vehicle([0, 0, 0], origin)
    vehicle.receive(autopilot.position() + autopilot.attitude(yaw=1), 0)
    vehicle.receive(autopilot.gimbal([0, -0.7, 0.2], 0), 0)
    before = vehicle.pose_at(0)
    used, faults = vehicle.receive(message(autopilot), 0)
    assert (used, [f"{one.reason}: {one}" for one in faults]) == (0, [fault])
    assert np.array_equal(vehicle.pose_at(0), before)
    assert vehicle.receive(autopilot.position(height_m=HOME[2] + 5), 1) == (1, [])
    assert vehicle.pose_at(1)[2, 3] == pytest.approx(5, abs=1e-6)


@pytest.mark.parametrize(
    "fields", [{"lat": 0, "lon": 0}, {"lat": MOST_32}, {"lat": 895_000_000}, {"alt": MOST_32}]
)
def test_a_first_position_without_a_fix_is_no_origin(autopilot, fields):
    vehicle = Vehicle([5, 6, 71])
    vehicle.receive(autopilot.attitude(), 0)
    assert vehicle.receive(autopilot.raw_position(**fields), 0).used == 0
    assert vehicle.pose_at(0) is None
    vehicle.receive(autopilot.position(), 0)
    assert vehicle.pose_at(0)[:3, 3].tolist() == [5, 6, 71]


def test_unknown_speeds_and_rates_are_0(autopilot):
    vehicle = Vehicle([0, 0, 0], HOME)
    vehicle.receive(autopilot.raw_position(vx=32_767, vy=-32_768, vz=32_767), 0)
    vehicle.receive(autopilot.attitude(yaw=1, rates=(NAN, NAN, NAN)), 0)
    assert np.array_equal(vehicle.pose_at(1), vehicle.pose_at(0))
    assert np.allclose(vehicle.pose_at(1)[:3, 3], 0, atol=1e-6)


def test_messages_of_other_kinds_are_neither_used_nor_faults(autopilot):
    heartbeat = autopilot(
        "heartbeat", type=2, autopilot=3, base_mode=0, custom_mode=0, system_status=4, mavlink_version=3
    )
    vehicle = Vehicle([0, 0, 0], HOME)
    assert vehicle.receive(heartbeat, 0) == (0, [])
    assert vehicle.receive(heartbeat + autopilot.attitude(), 0) == (1, [])


def test_whatever_a_message_says_the_pose_is_a_rotation_and_a_place_nearby(autopilot):
    rng = np.random.default_rng(5)
    floats = [NAN, INF, -INF, 0, 1e-45, 1e30, -3e38, 1, -3]
    whole = {"lat": (LEAST_32, MOST_32), "lon": (LEAST_32, MOST_32), "alt": (LEAST_32, MOST_32)}
    whole |= {name: (-32_768, 32_767) for name in ("vx", "vy", "vz")}
    vehicle, used = Vehicle([0, 0, 0], HOME), 0
    vehicle.receive(autopilot.position() + autopilot.attitude(), 0)
    for _ in range(300):
        some = rng.choice(list(whole), rng.integers(1, 3))
        fields = {name: int(rng.choice([0, *whole[name], rng.integers(*whole[name])])) for name in some}
        drawn = [float(rng.choice([rng.normal(), one])) for one in rng.choice(floats, 20)]
        junk = (
            rng.bytes(rng.integers(0, 60)) + bytes(rng.choice([253, 254], 1)) + rng.bytes(rng.integers(0, 60))
        )
        for message in (
            autopilot.raw_position(**fields), autopilot.attitude(*drawn[:3], drawn[3:6]),
            autopilot.raw_gimbal(drawn[6:10], int(rng.integers(65_536)), drawn[10:13]),
            _mount(autopilot, roll=drawn[13], pitch=drawn[14], yaw=drawn[15]), junk,
        ):  # fmt: skip
            used += vehicle.receive(message, 0).used
            pose = vehicle.pose_at(1)
            assert _is_rotation(pose[:3, :3])
            assert np.abs(pose[:3, 3]).max() <= 10_200
    assert used > 50
