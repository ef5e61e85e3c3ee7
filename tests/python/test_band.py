"""`veldt.Band` has the program's radiances, in any shape."""

import numpy as np
import pytest

from veldt import Band, ConfigError, IoError

KELVIN = [0.5, 77, 273.15, 300, 655.35, 1e6]


def _rows(veldt, *arguments) -> list[dict]:
    texts = ",".join(map(str, KELVIN))
    return veldt("radiance", "--temperature-k", texts, *arguments, "--json").json()["values"]


def test_radiances_are_the_programs_to_the_bit(veldt):
    band = Band(7.5, 13.5)
    rows = _rows(veldt, "--band-um", "7.5:13.5")
    assert band.radiance(KELVIN).tolist() == [row["radiance_w_m2_sr"] for row in rows]
    slopes = [row["d_radiance_d_temperature_w_m2_sr_k"] for row in rows]
    assert band.derivative(KELVIN).tolist() == slopes


def test_the_table_is_the_programs_to_the_bit(veldt):
    rows = _rows(veldt, "--method", "table")
    assert Band(8, 14).table_radiance(KELVIN).tolist() == [row["radiance_w_m2_sr"] for row in rows]


def test_a_response_curve_counts_as_in_the_program(veldt):
    (veldt.folder / "curve.csv").write_text("wavelength_um,response\n8,0\n10,1\n13,0.4\n", encoding="utf-8")
    expected = [row["radiance_w_m2_sr"] for row in _rows(veldt, "--response", "curve.csv")]
    assert Band.of_file(veldt.folder / "curve.csv").radiance(KELVIN).tolist() == expected
    assert Band(response=[(8, 0), (10, 1), (13, 0.4)]).radiance(KELVIN).tolist() == expected


def test_shapes_are_kept_and_the_inverse_returns():
    kelvin = np.linspace(200, 400, 24).reshape((2, 3, 4))
    band = Band()
    back = band.temperature(band.radiance(kelvin))
    assert back.shape == (2, 3, 4)
    assert np.all(np.abs(back - kelvin) <= 1e-9 * kelvin)
    assert band.radiance(300.0).shape == ()
    assert band.radiance(kelvin[:, ::2, ::-1]).tolist() == band.radiance(kelvin)[:, ::2, ::-1].tolist()


def test_values_outside_the_domain():
    band = Band()
    radiances = band.radiance([-1, 0, np.inf, np.nan])
    assert radiances[:3].tolist() == [0, 0, np.inf]
    assert np.isnan(radiances[3])


def test_faults_have_the_librarys_words(tmp_path):
    with pytest.raises(ConfigError, match="wavelength"):
        Band(14, 8)
    with pytest.raises(IoError, match="nothing.csv"):
        Band.of_file(tmp_path / "nothing.csv")
