"""`heat` prints how the temperatures of all surfaces go over the day."""

import xml.etree.ElementTree

import pytest

from configs import tiny
from program import check_fault


def _physical(config):
    config["sensor"] = {"model": "physical", "netd_mk": 40}


def _faulty(veldt, weather):
    def change(config):
        _physical(config)
        config["weather"] = weather

    veldt.write("config.json", tiny(change))
    return veldt("heat", "config.json")


def test_json_has_a_day_for_each_season_of_the_config(veldt):
    veldt.write("config.json", tiny(_physical))
    done = veldt("heat", "config.json", "--json")
    assert (done.code, done.err) == (0, "")
    winter, summer = done.json()["days"]
    assert (winter["season"], summer["season"]) == ("winter", "summer")
    soil, water = (winter["materials"][name]["hourly_k"] for name in ("soil", "water"))
    air = winter["air_hourly_k"]
    assert len(soil) == len(air) == 24
    assert air[3] == pytest.approx(273, abs=0.01)
    # On a clear dry night soil is 4 to 6 K below the air and water 10 to 12 K above; at noon it is the other way round.
    assert -6 < soil[3] - air[3] < -4
    assert 10 < water[3] - air[3] < 12
    assert soil[12] > air[12] > water[12]
    # Crowns are in air that is warmer than that near the ground, by how much is not well known.
    crown = winter["materials"]["acacia"]
    assert 0 < crown["hourly_k"][3] - air[3] < 2
    assert 0.4 < crown["uncertainty_k"] < 1.5
    pairs = {(line["warmer"], line["colder"]) for line in winter["crossovers"]}
    assert {("soil", "water"), ("water", "soil")} <= pairs


def test_the_table_has_a_line_per_material_and_the_plot_is_an_svg(veldt):
    veldt.write("config.json", tiny(_physical))
    done = veldt("heat", "config.json", "--plot", "day.svg")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("winter: 9 July, 19 deg S, ")
    assert "\nsummer: 15 January, 19 deg S, " in done.out
    assert [line for line in done.out.splitlines() if line.startswith("soil  ")]
    root = xml.etree.ElementTree.parse(veldt.folder / "day.svg").getroot()
    assert root.tag.endswith("svg")


def test_chosen_surfaces_are_shown_alone(veldt):
    veldt.write("config.json", tiny(_physical))
    done = veldt("heat", "config.json", "--surfaces", "soil,acacia wood", "--json")
    assert (done.code, done.err) == (0, "")
    assert [set(day["materials"]) for day in done.json()["days"]] == [{"soil", "acacia wood"}] * 2
    check_fault(
        veldt("heat", "config.json", "--surfaces", "sol"),
        2,
        "--surfaces = sol; expected surfaces that veldt heat lists without this option",
    )


def test_clouds_by_the_hour(veldt):
    def soil_k(weather):
        done = _faulty(veldt, weather)
        assert (done.code, done.err) == (0, "")
        days = veldt("heat", "config.json", "--json").json()["days"]
        return days[0]["materials"]["soil"]["hourly_k"], done.out

    clear, _ = soil_k({})
    even, _ = soil_k({"cloud_hourly": [0] * 24})
    assert even == clear
    # Overcast from 17:00 to 20:00: soil is warmer at dusk by kelvins, and nearly as cold as otherwise before sunrise.
    dusk, text = soil_k({"cloud_hourly": [1 if 17 <= hour <= 20 else 0 for hour in range(24)]})
    assert "cloud 0 to 1, rain" in text
    assert 2 < dusk[19] - clear[19] < 6
    assert abs(dusk[5] - clear[5]) < 1


@pytest.mark.parametrize(
    "weather, message",
    [
        (
            {"air_min_k": 290, "air_max_k": 280},
            "weather.air_min_k = 290 K; expected at most weather.air_max_k, 280 K",
        ),
        ({"latitude_deg": 95}, "weather.latitude_deg = 95 deg; expected at least -90 and at most 90 deg"),
        ({"date": "2026-02-30"}, 'weather.date = "2026-02-30"; expected a day of the calendar'),
        (
            {"dew_point_k": 280, "time": "03:00", "air_min_k": 270, "air_max_k": 290},
            "weather.dew_point_k = 280 K; expected at most that of the air at weather.time, ",
        ),
        (
            {"air_temperature_k": 280, "air_min_k": 270},
            "weather.air_temperature_k = 280 K; expected none beside the air of the whole day",
        ),
        (
            {"cloud_fraction": 0.5, "cloud_hourly": [0.5] * 24},
            "weather.cloud_hourly = 24 numbers; expected none beside weather.cloud_fraction",
        ),
        (
            {"relative_humidity": 0.5, "dew_point_k": 260},
            "weather.dew_point_k = 260 K; expected none beside weather.relative_humidity",
        ),
    ],
)
def test_impossible_weather_is_refused_by_name(veldt, weather, message):
    done = _faulty(veldt, weather)
    assert done.code == 2
    assert message in done.err
