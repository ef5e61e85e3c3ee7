"""Compute the golden values beside this file, with 60 digits: run `python3 make_golden.py` (needs mpmath 1.3).

Every input is the double nearest to the decimal in the CSV, so that a test which reads it sees no input error.
"""

from pathlib import Path

import mpmath as mp

mp.mp.dps = 60
HERE = Path(__file__).parent

# Exact SI 2019: h, c, k.
PLANCK = mp.mpf("6.62607015e-34")
LIGHT = mp.mpf(299792458)
BOLTZMANN = mp.mpf("1.380649e-23")
C1 = 2 * PLANCK * LIGHT**2
C2 = PLANCK * LIGHT / BOLTZMANN

# Wavelength [um] and temperature [K]: x = c2 / (wavelength T) from 1.4e-5 to 640.
SPECTRAL_POINTS = [
    *((um, k) for um in (8.0, 9.4, 10.6, 14.0) for k in (30.0, 80.0, 273.15, 300.0, 1000.0, 1e5)),
    *((um, k) for um in (0.5, 3.7) for k in (300.0, 5772.0)),
    (7.5, 3.0),
    (0.1, 300.0),
    (1000.0, 1e6),
]

# Response samples [um, 1] of bands that are not flat 8-14 um, by name.
RESPONSES = {
    "10nm": [(10.0, 1), (10.01, 1)],
    "1pm": [(10.0, 1), (10.000001, 1)],
    "triangle": [(8.0, 0), (10.5, 1), (14.0, 0)],
    "zero_ends": [(7.0, 0), (7.5, 0), (9.0, 1), (12.0, 0.5), (13.5, 0), (20.0, 0)],
    "gap": [(8.0, 1), (9.0, 0), (11.0, 0), (12.5, 0.8), (14.0, 1)],
}
BAND_TEMPERATURES_K = (3.0, 30.0, 273.15, 300.0, 1000.0, 1e5)

# Table 1's temperatures, both seasons, and two outside it.
SCRIPT_TEMPERATURES_K = (30.0, 273.0, 278.0, 288.0, 290.0, 292.0, 293.0, 300.0, 307.0, 1000.0)


def spectral_radiance(wavelength_um, temperature_k):
    """Planck's law [W m^-2 sr^-1 um^-1] at mpmath's precision."""
    wavelength_m = mp.mpf(wavelength_um) / 10**6
    return C1 / (wavelength_m**5 * mp.expm1(C2 / (wavelength_m * temperature_k))) / 10**6


def photon_tails(x):
    """Integrals of x^2 / (e^x - 1) and x^3 / (e^x - 1) from x on: sums over n of e^-nx times polynomials
    (Widger and Woodall, BAMS 57, 1217, 1976)."""
    square, cube, n, ratio = mp.mpf(0), mp.mpf(0), 1, mp.exp(-x)
    factor = ratio
    while factor > mp.mpf(10) ** -80 * ratio:
        square += factor * (x**2 / n + 2 * x / n**2 + mp.mpf(2) / n**3)
        cube += factor * (x**3 / n + 3 * x**2 / n**2 + 6 * x / n**3 + mp.mpf(6) / n**4)
        n, factor = n + 1, factor * ratio
    return square, cube


def band_radiance(samples, temperature_k):
    """Integral of a response, straight between its samples, times Planck [W m^-2 sr^-1]."""
    total = mp.mpf(0)
    for (begin_um, begin), (end_um, end) in zip(samples, samples[1:]):
        begin_m, end_m = mp.mpf(begin_um) / 10**6, mp.mpf(end_um) / 10**6
        slope = (mp.mpf(end) - mp.mpf(begin)) / (end_m - begin_m)
        constant = mp.mpf(begin) - slope * begin_m
        square, cube = (
            late - early
            for late, early in zip(
                photon_tails(C2 / (end_m * temperature_k)), photon_tails(C2 / (begin_m * temperature_k))
            )
        )
        per_kelvin = temperature_k / C2
        total += C1 * per_kelvin**3 * (constant * per_kelvin * cube + slope * square)
    return total


def script_radiance(temperature_k):
    """The published script's own sum: 600 points 0.01 um apart, trapezoid, its own constants."""
    c1, c2, step = mp.mpf("1.19104e8"), mp.mpf("1.43879e4"), mp.mpf("0.01")
    values = []
    for point in range(600):
        um = 8 + step * point
        values.append(c1 / (um**5 * mp.expm1(c2 / (um * temperature_k))))
    return step * (sum(values) - (values[0] + values[-1]) / 2)


def text(value):
    """Twenty-one digits: more than the precision of a double."""
    return mp.nstr(value, 21, min_fixed=0, max_fixed=0)


def write(name, what, header, rows):
    """One CSV that says where it is from."""
    lines = [f"# {what} Written by make_golden.py, 60-digit arithmetic.", header, *rows]
    (HERE / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    """Write every file of golden values."""
    write(
        "planck_spectral.csv",
        "Spectral radiance of a blackbody, exact SI 2019 constants.",
        "wavelength_um,temperature_k,radiance_w_m2_sr_um",
        [f"{um},{k},{text(spectral_radiance(um, mp.mpf(k)))}" for um, k in SPECTRAL_POINTS],
    )
    write(
        "band_radiance_responses.csv",
        "In-band radiance of a blackbody for the responses listed in make_golden.py.",
        "response,temperature_k,radiance_w_m2_sr",
        [
            f"{name},{k},{text(band_radiance(samples, mp.mpf(k)))}"
            for name, samples in RESPONSES.items()
            for k in BAND_TEMPERATURES_K
        ],
    )
    write(
        "script_radiance.csv",
        "In-band radiance as the published AirSim-W script sums it.",
        "temperature_k,radiance_w_m2_sr",
        [f"{k},{text(script_radiance(mp.mpf(k)))}" for k in SCRIPT_TEMPERATURES_K],
    )


if __name__ == "__main__":
    main()
