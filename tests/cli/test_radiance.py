"""`radiance` converts temperature to radiance and back, in named units and full double precision."""

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
    for method, largest in (("reference", 2e-14), ("table", 1e-6)):
        report = veldt("radiance", "--temperature-k", "300", "--method", method, "--json").json()
        (value,) = report["values"]
        assert report["method"] == method
        assert 0 < value["relative_error_bound"] < largest
        assert value["radiance_w_m2_sr"] == pytest.approx(exact, rel=value["relative_error_bound"], abs=0)


def test_the_bound_of_a_narrow_band_holds_for_its_edges_as_written(veldt):
    """10.001 is not a double: what rounding moves it by is 2e4 times as much of 1 nm. Exact: radiance_bounds.csv."""
    arguments = ("--temperature-k", "300.1", "--band-um", "10:10.001")
    exact = 9.9399557459240226576e-3
    (value,) = _values(veldt, *arguments)
    off = abs(value["radiance_w_m2_sr"] / exact - 1)
    assert 1e-14 < off < value["relative_error_bound"] < 3e-12


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
KELVIN = "expected a number from 0 K to 1000000 K"
WATT = "W m^-2 sr^-1"
FAULTS = {
    "nothing asked": ([], "nothing asked; expected --temperature-k T,… or --radiance L,…"),
    "below absolute zero": (["--temperature-k", "300,-5"], f"--temperature-k = -5 K; {KELVIN}"),
    "no number": (["--temperature-k", "nan"], f"--temperature-k = nan K; {KELVIN}"),
    "infinitely hot": (["--temperature-k", "inf"], f"--temperature-k = inf K; {KELVIN}"),
    "hotter than any matter": (["--temperature-k", "1e308"], f"--temperature-k = 1e+308 K; {KELVIN}"),
    "hotter than was checked": (["--temperature-k", "1000001"], f"--temperature-k = 1000001 K; {KELVIN}"),
    "negative radiance": (
        ["--radiance", "-1"],
        f"--radiance = -1 {WATT}; expected a number from 0 {WATT} to 4380575 {WATT},"
        " that of 1000000 K in this band",
    ),
    "radiance of nothing": (
        ["--radiance", "1e308", "--emissivity", "0.5"],
        f"--radiance = 1e+308 {WATT}; expected a number from 0 {WATT} to 2190287 {WATT},"
        " that of 1000000 K in this band",
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


def test_a_response_saved_by_excel(veldt):
    veldt.write("plain.csv", "wavelength_um,response\n8,1\n14,0.5\n")
    veldt.write("excel.csv", "\ufeffwavelength_um,response\r\n8,1\r\n14,0.5\r\n")
    plain, excel = (
        veldt("radiance", "--temperature-k", "300", "--response", name, "--json")
        for name in ("plain.csv", "excel.csv")
    )
    assert (excel.code, excel.err, excel.out) == (0, "", plain.out)


def test_responses_that_cannot_be_read_are_bad_usage(veldt):
    (veldt.folder / "folder").mkdir()
    with open(veldt.folder / "large.csv", "wb") as file:
        file.truncate((256 << 20) + 1)  # a hole: no disk space
    for name, message in {
        "none.csv": "cannot read none.csv: no such file",
        "folder": "cannot read folder: it is a folder; expected a file",
        "/dev/zero": "cannot read /dev/zero: it is a pipe or a device; expected a file",
        "large.csv": "large.csv = 268435457 bytes; expected at most 268435456 bytes (256 MiB)",
    }.items():
        done = veldt("radiance", "--temperature-k", "300", "--response", name)
        assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")
