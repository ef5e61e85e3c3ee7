"""`budget` prints the effect of each physical term on a config's pictures, and which terms it keeps."""

import pytest

from configs import tiny

TERMS = ["place", "facing", "variation", "parts", "sky", "angular", "mirror", "path", "smear", "falloff"]
THIRD_OF_NETD_MK = 40 / 3


def _physical(config):
    config["sensor"] = {"model": "physical", "netd_mk": 40}
    config["scene"]["temperatures"] = "table_1"
    config["render"] = {"engine": "embree"}


def _budget(veldt, change=_physical):
    veldt.write("config.json", tiny(change))
    done = veldt("budget", "config.json", "--json")
    assert (done.code, done.err) == (0, "")
    report = done.json()
    return {line["term"]: line for line in report["terms"]}, report["dropped_mk"]


def test_json_has_an_entry_per_term_with_units_in_its_keys(veldt):
    lines, _ = _budget(veldt)
    assert list(lines) == TERMS
    for line in lines.values():
        assert list(line) == ["term", "choice", "spread_mk", "actor_shift_mk", "kept"]
        assert line["choice"] == "auto"


def test_a_term_is_kept_where_it_spreads_by_more_than_a_third_of_the_netd(veldt):
    lines, dropped_mk = _budget(veldt)
    for line in lines.values():
        assert line["kept"] == (line["spread_mk"] > THIRD_OF_NETD_MK)
    assert dropped_mk == pytest.approx(sum(line["spread_mk"] for line in lines.values() if not line["kept"]))


def test_what_water_mirrors_needs_an_engine_that_traces_it(veldt):
    def blender(config):
        _physical(config)
        config["render"] = {"engine": "blender"}

    traced, untraced = _budget(veldt)[0]["mirror"], _budget(veldt, blender)[0]["mirror"]
    assert untraced["spread_mk"] == traced["spread_mk"] > THIRD_OF_NETD_MK
    assert (traced["kept"], untraced["kept"]) == (True, False)
    assert untraced["impossible"] == "the engine blender does not trace what water mirrors"


def _heated(config):
    _physical(config)
    config["scene"]["temperatures"] = "heat_balance"


def test_place_and_direction_count_where_the_weather_makes_temperatures(veldt):
    heated, table = _budget(veldt, _heated)[0], _budget(veldt)[0]
    for term in ("place", "facing"):
        assert heated[term]["kept"] and heated[term]["spread_mk"] > 300
        assert (table[term]["spread_mk"], table[term]["kept"]) == (0, False)
    assert heated["facing"]["actor_shift_mk"] > 300 and heated["place"]["actor_shift_mk"] == 0


def test_table_1_knows_no_places(veldt):
    def demanded(config):
        _physical(config)
        config["terms"] = {"place": "on"}

    veldt.write("config.json", tiny(demanded))
    done = veldt("budget", "config.json", "--json")
    assert done.code == 2
    assert "terms.place = on; expected off or auto, because temperatures are those of Table 1" in done.err


def test_a_worse_camera_needs_fewer_terms(veldt):
    def blunt(config):
        _physical(config)
        config["sensor"]["netd_mk"] = 10000

    sharp, _ = _budget(veldt)
    dull, _ = _budget(veldt, blunt)
    assert sharp["path"]["kept"] and not dull["path"]["kept"]
    # Fall-off is a share of the camera's own noise: the one spread that grows with it.
    ratio = dull["falloff"]["spread_mk"] / sharp["falloff"]["spread_mk"]
    assert ratio == pytest.approx(10000 / 40, rel=1e-12)
    for term in TERMS[:-1]:
        assert dull[term]["spread_mk"] == sharp[term]["spread_mk"]


def test_a_tripod_five_metres_up_needs_no_air(veldt):
    def tripod(config):
        _physical(config)
        config["scene"]["groups"] = []
        config["clips"] = config["clips"][:1]
        # Lanes as far apart as the picture is wide there.
        config["clips"][0]["flight"].update(altitude_m=5, lane_spacing_m=3)

    lines, _ = _budget(veldt, tripod)
    assert not lines["path"]["kept"]
    assert lines["sky"]["kept"]


def test_on_and_off_take_precedence_over_the_rule(veldt):
    def decided(config):
        _physical(config)
        config["terms"] = {"path": "off", "falloff": "on"}

    lines, dropped_mk = _budget(veldt, decided)
    assert (lines["path"]["choice"], lines["path"]["kept"]) == ("off", False)
    assert (lines["falloff"]["choice"], lines["falloff"]["kept"]) == ("on", True)
    assert dropped_mk >= lines["path"]["spread_mk"]


def test_the_published_preset_drops_everything(veldt):
    lines, _ = _budget(veldt, None)
    assert {line["choice"] for line in lines.values()} == {"off"}
    assert not any(line["kept"] for line in lines.values())


def test_temperatures_of_the_heat_balance_change_what_terms_are_worth(veldt):
    def balanced(config):
        _physical(config)
        del config["scene"]["temperatures"]

    table, _ = _budget(veldt)
    heated, _ = _budget(veldt, balanced)
    assert heated["parts"]["actor_shift_mk"] != table["parts"]["actor_shift_mk"]
    assert heated["parts"]["kept"]


def test_the_weather_of_the_config_decides(veldt):
    def overcast(config):
        _physical(config)
        config["weather"] = {"cloud_fraction": 1}

    clear, _ = _budget(veldt)
    cloudy, _ = _budget(veldt, overcast)
    # The sky's emissivity rises from .341 to .895 in winter's air and from .557 to .929 in summer's, and what is
    # reflected with it: by factors of 2.6 and 1.7, to a few percent, as apparent temperature is not quite linear.
    # Water, at the lower end of the spread, mirrors a slanted sky, which clouds change a little less.
    assert 1.55 < cloudy["sky"]["spread_mk"] / clear["sky"]["spread_mk"] < 2.7


def test_the_plain_table_holds_the_same_figures_and_marks_what_is_kept(veldt):
    lines, dropped_mk = _budget(veldt)
    done = veldt("budget", "config.json")
    assert (done.code, done.err) == (0, "")
    text = done.out.splitlines()
    assert (
        text[0]
        == "NETD 40 mK: an automatic term is kept if it differs by more than 13.3 mK across the pictures"
    )
    rows = {row.split()[0]: row.split()[1:] for row in text[3 : 3 + len(TERMS)]}
    for term, line in lines.items():
        kept = "kept" if line["kept"] else "dropped"
        assert rows[term] == ["auto", f"{line['spread_mk']:.1f}", f"{line['actor_shift_mk']:.1f}", kept]
    assert f"dropped in total: {dropped_mk:.1f} mK" in text


def test_the_plain_table_shows_each_material_in_each_night(veldt):
    veldt.write("config.json", tiny(_physical))
    text = veldt("budget", "config.json").out
    winter, summer = text.split("\nair at ")[1:]
    assert winter.startswith("273 K, humidity 0.6, range 40 m [mK]\n")
    assert summer.startswith("293 K, humidity 0.7, range ")
    for night, soil, human in ((winter, "+1601", "+232"), (summer, "+3284", "+490")):
        rows = {row.split()[0]: row.split()[1:] for row in night.splitlines()[2:]}
        # Sky reflection of level surfaces on Table 1's nights, computed in 60 digits.
        assert (rows["soil"][0], rows["human"][0]) == (soil, human)
        assert set(rows) == {
            "acacia",
            "elephant",
            "grass",
            "human",
            "shrub",
            "soil",
            "water",
            "wet_soil",
            "zebra",
        }


def test_faults_are_the_config_s(veldt):
    done = veldt("budget", "none.json")
    assert (done.code, done.out, done.err) == (
        2,
        "",
        "veldt: cannot read none.json: No such file or directory\n",
    )
    veldt.write("config.json", tiny(lambda config: config.update(sensor={"response": "flat_8_15um"})))
    done = veldt("budget", "config.json")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith('veldt: config.json: sensor.response = "flat_8_15um"; expected one of ')
