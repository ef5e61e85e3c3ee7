"""`veldt.Camera` makes the program's pictures."""

import numpy as np
import pytest

import passes
from veldt import Band, Camera, ConfigError, open_dataset


_TABLE_1 = {  # emissivity, winter [K]
    0: (1.0, 235),  # sky
    passes.GROUND: (0.914, 278),
    passes.SHRUB: (0.986, 273),
    passes.WALKER: (0.985, 292),
    passes.ELEPHANT: (0.96, 290),
}


def _radiance(frame: int) -> np.ndarray:
    """What the published model makes of a frame: emissivity times a blackbody's radiance."""
    of_index = np.zeros(passes.ELEPHANT + 1, np.float32)
    for index, (emissivity, kelvin) in _TABLE_1.items():
        of_index[index] = emissivity * Band(8, 14).radiance(kelvin)
    return of_index[passes.object_index(frame).astype(int)]


def test_it_makes_the_programs_pictures_to_the_bit(converted):
    dataset = open_dataset(converted[0])
    config = dataset.config
    camera = Camera(
        "airsim_w",
        seed=config["seed"],
        clip="one",
        brightest_w_m2_sr=dataset["one"][0].values["agc"]["brightest_w_m2_sr"],
        settings={"camera": {"width_px": passes.WIDTH, "height_px": passes.HEIGHT}},
    )
    for frame in dataset["one"]:
        exposure = camera.expose(_radiance(frame.index))
        assert np.array_equal(exposure.ir16, frame.ir16())
        assert np.array_equal(exposure.ir8, frame.ir8())


def _small(**arguments) -> Camera:
    return Camera(settings={"camera": {"width_px": 40, "height_px": 32}}, **arguments)


def _uniform(camera, kelvin=290.0):
    return np.full((camera.height_px, camera.width_px), camera.band.radiance(kelvin))


def test_its_preset_says_what_it_is():
    camera = Camera("boson_640_14mm")
    assert (camera.width_px, camera.height_px, camera.kelvin_per_count) == (640, 512, 0.01)
    assert 7 < camera.band.begin_um < camera.band.end_um < 15
    assert camera.temperature_k(camera.band.radiance(300)) == pytest.approx(300, abs=1e-4)


def test_noise_follows_seed_clip_and_frame():
    first, second = _small(seed=3), _small(seed=3)
    radiance = _uniform(first)
    frames = [first.expose(radiance).ir16 for _ in range(3)]
    assert [np.array_equal(second.expose(radiance).ir16, frame) for frame in frames] == [True] * 3
    assert not np.array_equal(frames[0], frames[1])
    assert not np.array_equal(_small(seed=4).expose(radiance).ir16, frames[0])
    assert not np.array_equal(_small(seed=3, clip="b").expose(radiance).ir16, frames[0])


def test_time_goes_on_between_frames():
    every, some = _small(), _small()
    radiance = _uniform(every)
    third = [every.expose(radiance).ir16 for _ in range(3)][2]
    some.expose(radiance, time_s=0)
    assert np.array_equal(some.expose(radiance, time_s=2 / 9).ir16, third)
    with pytest.raises(ConfigError, match="time_s = 0.1 s; expected a multiple of 1/9 s from 0.333333 s on"):
        some.expose(radiance, time_s=0.1)


def test_any_array_of_the_right_shape_will_do():
    camera = _small()
    radiance = _uniform(camera)
    expected = camera.expose(radiance)
    for other in (radiance.astype(np.float32), np.asfortranarray(radiance), radiance.tolist()):
        assert np.array_equal(_small().expose(other).ir16, expected.ir16)
    with pytest.raises(ConfigError, match="radiance_w_m2_sr = 32 x 40 px; expected 40 x 32, as the camera"):
        camera.expose(radiance.T)
    with pytest.raises(
        ConfigError, match=r"radiance_w_m2_sr = shape \(1280,\); expected \(height, width\), 1 to "
    ):
        camera.expose(radiance.ravel())


def test_unknown_names_are_faults():
    with pytest.raises(ConfigError, match='sensor.preset = "bosn"'):
        Camera("bosn")
    with pytest.raises(ConfigError, match="camera: sensor.netd is not a known key"):
        Camera(settings={"sensor": {"netd": 30}})
