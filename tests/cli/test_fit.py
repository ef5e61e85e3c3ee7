"""`fit` finds the settings of a camera from frames of it."""

import pytest

from configs import tiny
from program import Veldt, check_fault

CAMERA = {"preset": "boson_640_14mm", "agc": {"mode": "percentile", "damping_s": 0}}
HIDDEN = {
    "noise": {"amount": {"uniform": [1.2, 1.8]}},
    "processing": {
        "noise_filter_sigma_px": {"uniform": [0.7, 0.9]},
        "unsharp_amount": {"uniform": [0.8, 1.2]},
    },
}


def _config(seed: int, **sensor) -> dict:
    """Eight clips of two frames, from all sides."""
    config = tiny()
    config["seed"] = seed
    config["camera"] = {"width_px": 160, "height_px": 128, "pixel_pitch_um": 60}
    config["render"] = {"actor_layer": True, "engine": "embree", "supersample": 2}
    config["sensor"] = CAMERA | sensor
    flight = config["clips"][1]["flight"] | {
        "look_angle_deg": {"uniform": [45, 80]},
        "altitude_m": {"uniform": [25, 40]},
        "azimuth_deg": {"uniform": [-180, 180]},
    }
    season = {"choice": ["winter", "summer"]}
    config["clips"] = [
        {"id": "round", "count": 8, "frames": 2, "frame_rate_hz": 1, "season": season, "flight": flight}
    ]
    return config


def _fit(veldt, *arguments, code: int = 0):
    done = veldt("fit", *arguments, "--progress", "none")
    assert (done.code, done.err) == (code, ""), done
    return done


@pytest.fixture(name="hidden", scope="module")
def _hidden(tmp_path_factory) -> Veldt:
    """Frames of a camera, and a config of the same scenes that knows nothing of it."""
    veldt = Veldt(tmp_path_factory.mktemp("fit"))
    veldt.write("hidden.json", _config(3, **HIDDEN))
    veldt.write("my.json", _config(3))
    done = veldt("generate", "hidden.json", "--out", "real", "--quiet")
    assert (done.code, done.err) == (0, "")
    return veldt


def _middle(value) -> float:
    return sum(value["uniform"]) / 2 if isinstance(value, dict) else value


def test_hidden_sharpening_is_found_again(hidden):
    arguments = ("real", "--config", "my.json", "--category", "elephant", "--trials", "150", "--json")
    found = _fit(hidden, *arguments, "--out", "fitted.json").json()
    fitted = hidden.read("fitted.json")
    assert found["distance_after"] < 0.6 * found["distance_before"]
    # Halos come of nothing else. Noise, its filter, the lens and a codec stand in for each other.
    assert _middle(fitted["sensor"]["processing"]["unsharp_amount"]) == pytest.approx(1, abs=0.3)
    assert hidden("validate", "fitted.json").code == 0


def test_configs_that_have_nothing_to_fit(hidden):
    arguments = ("fit", "real", "--config", "my.json", "--out", "none.json", "--progress", "none", "--set")
    check_fault(
        hidden(*arguments, "sensor.preset=airsim_w"),
        2,
        'my.json: sensor.model = "published"; expected physical, or a preset of a camera: the published model has '
        "nothing of what is fitted",
    )
    check_fault(
        hidden(*arguments, "render.engine=blender"),
        2,
        'my.json: render.engine = "blender"; expected "embree" or "auto"',
    )
    assert not (hidden.folder / "none.json").exists()
