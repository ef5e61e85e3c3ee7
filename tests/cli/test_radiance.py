"""`radiance` answers to the last digit of a double, in named units, both ways."""

import json
import math

import pytest


def _values(veldt, *arguments):
    done = veldt("radiance", *arguments, "--json")
    assert (done.code, done.err) == (0, "")
    return done.json()["values"]


def test_json_names_units_and_holds_doubles_exactly(veldt):
    text = veldt("radiance", "--temperature-k", "300", "--json").out
    report = json.loads(text)
    assert (report["band_um"], report["emissivity"]) == ([8.0, 14.0], 1.0)
    (value,) = report["values"]
    assert list(value) == [
        "temperature_k",
        "radiance_w_m2_sr",
        "d_radiance_d_temperature_w_m2_sr_k",
        "ln_radiance",
        "relative_error_bound",
    ]
    # 8 to 14 um, by adaptive quadrature in 30 digits: 54.93346137683966(9). The contract is 1e-12 relative.
    assert value["radiance_w_m2_sr"] == pytest.approx(54.933461376839669, rel=1e-12)
    # The logarithm is taken on its own way, which loses nothing where the radiance itself underflows.
    assert value["ln_radiance"] == pytest.approx(math.log(value["radiance_w_m2_sr"]), rel=1e-14)
    assert repr(value["radiance_w_m2_sr"]) in text  # the shortest digits that read back as the same double


def test_each_method_keeps_within_the_bound_it_states(veldt):
    exact = 54.93346137683968611858  # 8 to 14 um at 300 K, 60 digits
    for method, largest in (("reference", 1e-14), ("table", 1e-6)):
        report = veldt("radiance", "--temperature-k", "300", "--method", method, "--json").json()
        (value,) = report["values"]
        assert report["method"] == method
        assert 0 < value["relative_error_bound"] < largest
        assert value["radiance_w_m2_sr"] == pytest.approx(exact, rel=value["relative_error_bound"], abs=0)


def test_the_table_holds_the_same_digits(veldt):
    header, row = veldt("radiance", "--temperature-k", "300").out.splitlines()
    assert header.split() == "temperature [K] radiance [W/m2/sr] derivative [W/m2/sr/K]".split()
    (value,) = _values(veldt, "--temperature-k", "300")
    assert [float(column) for column in row.split()] == list(value.values())[:3]


def test_several_temperatures_keep_their_order(veldt):
    values = _values(veldt, "--temperature-k", "310,270,300")
    assert [value["temperature_k"] for value in values] == [310, 270, 300]


def test_radiance_is_turned_back_into_temperature(veldt):
    """The inverse is good to 1e-6 K by contract, from 1 K, where radiance is 1e-618, out of reach, up to 1e5 K."""
    for temperature_k in (30.0, 273.15, 1000.0, 1e5):
        (there,) = _values(veldt, "--temperature-k", temperature_k)
        (back,) = _values(veldt, "--radiance", repr(there["radiance_w_m2_sr"]))
        assert back["temperature_k"] == pytest.approx(temperature_k, abs=1e-6)


def test_emissivity_scales_radiance_and_its_derivative(veldt):
    (black,) = _values(veldt, "--temperature-k", "290")
    (grey,) = _values(veldt, "--temperature-k", "290", "--emissivity", "0.5")  # halving is exact
    assert grey["radiance_w_m2_sr"] == black["radiance_w_m2_sr"] / 2
    assert grey["d_radiance_d_temperature_w_m2_sr_k"] == black["d_radiance_d_temperature_w_m2_sr_k"] / 2
    (back,) = _values(veldt, "--radiance", repr(grey["radiance_w_m2_sr"]), "--emissivity", "0.5")
    assert back["temperature_k"] == pytest.approx(290, abs=1e-6)


def test_bands_add_up(veldt):
    parts = [_values(veldt, "--temperature-k", "300", "--band-um", band)[0] for band in ("8:11", "11:14")]
    (whole,) = _values(veldt, "--temperature-k", "300")
    total = sum(part["radiance_w_m2_sr"] for part in parts)
    assert total == pytest.approx(whole["radiance_w_m2_sr"], rel=3e-12)  # each of the three to 1e-12


def test_a_flat_response_curve_is_a_band(veldt):
    veldt.write("response.csv", "# made up\nwavelength_um,response\n8,1\n14,1\n")
    (curve,) = _values(veldt, "--temperature-k", "300", "--response", "response.csv")
    (band,) = _values(veldt, "--temperature-k", "300", "--band-um", "8:14")
    assert curve["radiance_w_m2_sr"] == pytest.approx(band["radiance_w_m2_sr"], rel=2e-12)  # each to 1e-12


def test_absolute_zero(veldt):
    (value,) = _values(veldt, "--temperature-k", "0")
    assert (value["radiance_w_m2_sr"], value["ln_radiance"]) == (0, None)  # JSON has no minus infinity


BAND = "expected A:B with 0 < A < B"
POSITIVE = "expected a finite number, at least 0"
FAULTS = {
    "nothing asked": ([], "nothing asked; expected --temperature-k T,… or --radiance L,…"),
    "below absolute zero": (["--temperature-k", "300,-5"], f"--temperature-k = -5 K; {POSITIVE} K"),
    "no number": (["--temperature-k", "nan"], f"--temperature-k = nan K; {POSITIVE} K"),
    "infinitely hot": (["--temperature-k", "inf"], f"--temperature-k = inf K; {POSITIVE} K"),
    "negative radiance": (
        ["--radiance", "-1"],
        f"--radiance = -1 W m^-2 sr^-1; {POSITIVE} W m^-2 sr^-1",
    ),
    "band the wrong way round": (
        ["--temperature-k", "300", "--band-um", "14:8"],
        f"--band-um = 14:8 um; {BAND}",
    ),
    "band of one number": (["--temperature-k", "300", "--band-um", "8"], f"--band-um = 8 um; {BAND}"),
    "emissivity of zero": (
        ["--temperature-k", "300", "--emissivity", "0"],
        "--emissivity = 0; expected above 0 and at most 1",
    ),
    "more than a blackbody": (
        ["--temperature-k", "300", "--emissivity", "1.1"],
        "--emissivity = 1.1; expected above 0 and at most 1",
    ),
    "response without a header": (
        ["--temperature-k", "300", "--response", "response.csv"],
        'response.csv:1 = "8,1"; expected the header wavelength_um,response',
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(veldt, name):
    arguments, message = FAULTS[name]
    veldt.write("response.csv", "8,1\n14,1\n")
    done = veldt("radiance", *arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err == f"veldt: {message}\n"


def test_a_response_that_is_missing(veldt):
    done = veldt("radiance", "--temperature-k", "300", "--response", "none.csv")
    assert (done.code, done.out, done.err) == (
        1,
        "",
        "veldt: cannot read none.csv: No such file or directory\n",
    )
