"""What is no plane of indices, or no numbers, is refused by name, whatever its type, shape and strides.

With VELDT_ARRAY_ROUNDS=77000 it calls the package's functions a million times with arrays of any type, shape and order.
"""

import itertools
import os

import numpy as np
import pytest

import passes
from configs import tiny
from veldt import (
    Band,
    Camera,
    ConfigError,
    Converter,
    DataError,
    Error,
    HeatOfDay,
    VideoChain,
    World,
    instances,
    plan,
)

ROUNDS = int(os.environ.get("VELDT_ARRAY_ROUNDS", "60"))
WHOLE = "expected a whole number from 0 to 32767"
TYPES = ["?", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g", ">i4", ">f8"]


def _plane(pixel, dtype) -> np.ndarray:
    plane = np.full((3, 4), 1, dtype)
    plane[1, 2] = pixel
    return plane


@pytest.mark.parametrize(
    "pixel, dtype",
    [
        (32768, "u2"),
        (65535, "u2"),
        (65536 + 101, "i4"),
        (65536 + 101, "u4"),
        (-65435, "i8"),
        (2**63 + 1, "u8"),
    ]
    + [(101.9, "f4"), (101.9, "f8"), (np.nan, "f4"), (np.inf, "f8"), (-1, "i1")],
)
def test_what_is_no_index_is_named_with_its_pixel(pixel, dtype):
    plane = _plane(pixel, dtype)
    value = f"{plane[1, 2]:.7g}" if plane.dtype.kind == "f" else plane[1, 2]
    with pytest.raises(DataError) as fault:
        instances(plane, [1])
    assert str(fault.value) == f"index_plane at pixel (2, 1) = {value}; {WHOLE}"
    with pytest.raises(DataError, match=rf"object_index at pixel \(2, 1\) = .*; {WHOLE}"):
        Converter(passes.manifest()).convert(0, object_index=plane)
    with pytest.raises(DataError, match=rf"actors at pixel \(1, 0\) = .*; {WHOLE}"):
        instances(np.ones((2, 2)), [1, pixel])


@pytest.mark.parametrize("dtype", TYPES)
def test_indices_of_any_type_and_order_are_the_same(dtype):
    plane = np.tile(np.array([[0, 1, 1], [0, 1, 1]]), (4, 5)).astype(dtype)
    expected = [(1, (1, 0, 14, 8), 80)]
    for same in (plane, np.asfortranarray(plane), plane.repeat(2, 1)[:, ::2], plane[::-1], plane.tolist()):
        assert [(one.index, one.box_px, one.area_px) for one in instances(same, [1])] == expected


@pytest.mark.parametrize(
    "plane, message",
    [
        ("text", "index_plane = an array of <U4; expected numbers"),
        ([[1], [1, 2]], "index_plane: setting an array element with a sequence"),
        (np.array([[None]]), "index_plane = an array of object; expected numbers"),
        (np.array([[1j]]), "index_plane = an array of complex128; expected numbers"),
        (
            np.zeros((0, 4)),
            r"index_plane = shape \(0, 4\); expected \(height, width\), 1 to 256 million pixels",
        ),
        (np.zeros(4), r"index_plane = shape \(4,\)"),
        (5, r"index_plane = shape \(\)"),
        (
            np.broadcast_to(np.uint8(1), (1 << 20, 1 << 20)),
            r"index_plane = shape \(1048576, 1048576\); expected at most",
        ),
    ],
)
def test_what_is_no_plane_is_refused(plane, message):
    with pytest.raises(ConfigError, match=f"^{message}"):
        instances(plane, [1])


def _anything(random: np.random.Generator) -> object:
    """An array, a list or a value of any type, shape, order and content."""
    shape = tuple(random.integers(0, 6, random.integers(0, 4)))
    content = random.choice([1, 100, 4e4, 1e20]) * random.standard_normal(shape)
    content = np.where(random.random(shape) < 0.05, random.choice([np.nan, np.inf, -np.inf, 0.5]), content)
    dtype = random.choice([*TYPES, "c8", "O", "U3", "M8[s]", "m8[s]", "V4", "S2"])
    with np.errstate(all="ignore"):
        try:
            array = np.asarray(content).astype(dtype)
        except (TypeError, ValueError):
            array = np.zeros(shape, dtype)
    changes = [
        np.asfortranarray,
        lambda a: a[..., ::-1] if a.ndim else a,
        lambda a: a.T,
        lambda a: a,
        np.ndarray.tolist,
    ]
    return changes[random.integers(len(changes))](array)


@pytest.fixture(name="functions", scope="module")
def _functions(veldt):
    """Everything that takes arrays."""
    band, heat = Band(), HeatOfDay()
    converter = Converter(passes.manifest(frames=2))
    camera = Camera(settings={"camera": {"width_px": 4, "height_px": 3}})
    material = heat.materials[0]
    chain = VideoChain({"link": {"standard": "ntsc"}})
    plan(tiny(), veldt.folder / "arrays", settings=["render.engine=embree", "render.posed_actors=all"])
    world = World(veldt.folder / "arrays", "down")
    return [
        lambda a, b: instances(a, b if isinstance(b, list) else [1]),
        lambda a, b: converter.convert(0, object_index=a, depth_m=b),
        lambda a, b: converter.convert(0, passes.object_index(0), normal=a, actor_index=b),
        lambda a, b: camera.expose(a),
        lambda a, b: camera.expose(np.ones((3, 4)), time_s=a),
        lambda a, b: Band(response=a),
        lambda a, b: (band.radiance(a), band.derivative(a), band.temperature(b), band.table_radiance(b)),
        lambda a, b: (world.restart(), world.capture(np.eye(4), b)),
        lambda a, b: (world.restart(), world.capture(a, world.flight_s[0])),
        lambda a, b: chain(a),
        lambda a, b: band.relative_error_bound(a),
        lambda a, b: heat.air_k(a),
        lambda a, b: heat.temperature_k(material, a, sky_view=b),
        lambda a, b: heat.temperature_k(material, 3, normal=a, moisture=b),
    ]


def _check_answer(function, one, other):
    with np.errstate(all="ignore"):
        try:
            function(one, other)
        except Error as fault:
            assert "expected" in str(fault) or "shape" in str(fault)


def test_only_errors_of_the_package_come_back(functions):
    random = np.random.default_rng(0)
    for _ in range(ROUNDS):
        for function in functions:
            _check_answer(function, _anything(random), _anything(random))


def test_heat_takes_finite_numbers_that_broadcast():
    heat = HeatOfDay()
    with pytest.raises(ConfigError, match="solar_h = nan; expected finite numbers"):
        heat.temperature_k("soil", [3, np.nan])
    with pytest.raises(ConfigError, match="solar_h = inf; expected finite numbers"):
        heat.air_k(np.inf)
    for arguments in ({"sky_view": [1, 1, 1]}, {"normal": (0, 0, 0, 1)}, {"normal": 1}):
        with pytest.raises(
            ConfigError, match=r"^shapes .*; expected some that broadcast, and \(…, 3\) of normal$"
        ):
            heat.temperature_k("soil", [3, 4], **arguments)


def test_documents_hold_what_json_can():
    circle: dict = {}
    circle["circle"] = circle
    for weather, reason in [
        (circle, "Circular"),
        ({"rain_days_ago": np.nan}, "float"),
        ({"x": {1, 2}}, "set"),
    ]:
        with pytest.raises(ConfigError, match=rf"^weather: .*{reason}"):
            HeatOfDay(weather=weather)
    deep: list = []
    for _ in itertools.repeat(None, 5000):
        deep = [deep]
    with pytest.raises(ConfigError, match="settings: "):
        Camera(settings={"sensor": deep})


def test_cameras_refuse_impossible_clips():
    for name, value in [
        ("frame_rate_hz", 0),
        ("frame_rate_hz", np.nan),
        ("air_k", -3),
        ("brightest_w_m2_sr", 0),
    ]:
        with pytest.raises(ConfigError, match=f"^{name} = "):
            Camera(**{name: value})
