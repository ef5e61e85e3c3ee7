"""`veldt.HeatOfDay` has the program's temperatures."""

import numpy as np
import pytest

from configs import LEAST
from veldt import ConfigError, HeatOfDay
import json

HOURS = [0, 3.5, 12, 18]


def test_open_ground_is_as_warm_as_the_command_says(veldt):
    """The command computes days in twice as many steps, without tables between places."""
    (veldt.folder / "least.json").write_text(
        json.dumps(LEAST | {"sensor": {"preset": "boson_640_14mm"}}), encoding="utf-8"
    )
    hourly = veldt("heat", "least.json", "--json").json()["days"][0]
    day = HeatOfDay("winter")
    hours = np.arange(24)
    assert np.allclose(day.air_k(hours), hourly["air_hourly_k"], atol=1e-9)
    for material in ("soil", "road", "water"):
        off_k = day.temperature_k(material, hours) - hourly["materials"][material]["hourly_k"]
        assert np.abs(off_k).max() < 0.2, material


def test_arguments_broadcast():
    day = HeatOfDay("summer", {"cloud_fraction": 0.5})
    table = day.temperature_k("soil", np.array(HOURS)[:, None], sky_view=[1, 0.5, 0])
    assert table.shape == (4, 3)
    assert table[1, 2] == day.temperature_k("soil", 3.5, sky_view=0)
    slopes = day.temperature_k("soil", 15, normal=[(0, 0, 1), (0, 0.6, 0.8)])
    assert slopes.shape == (2,)
    assert slopes[0] == day.temperature_k("soil", 15)
    assert slopes[1] != slopes[0]


def test_faults():
    with pytest.raises(ConfigError, match='season = "monsoon"; expected winter or summer'):
        HeatOfDay("monsoon")
    with pytest.raises(ConfigError, match='did you mean "soil"'):
        HeatOfDay().temperature_k("soill", 3)
    with pytest.raises(ConfigError, match="weather.cloud_fraction = 2"):
        HeatOfDay("winter", {"cloud_fraction": 2})
