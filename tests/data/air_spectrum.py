"""Fit the tables of radiometry/spectral_air.cpp to LOWTRAN 7 and write LOWTRAN's figures for bands, air_bands.csv.

Needs NumPy and `lowtran7`, LOWTRAN 7 (Kneizys et al., AFGL-TR-88-0177, 1988; in the public domain) as a Python module:
`f2py -c -m lowtran7 lowtran7.f` makes it from the Fortran file in the Python package lowtran 3.1.0.
Run `python3 air_spectrum.py`: prints the tables. LOWTRAN is in single precision, in steps of 5 cm^-1.
"""

from pathlib import Path

import lowtran7
import numpy as np

HERE = Path(__file__).parent
WAVELENGTHS_UM = np.arange(7.0, 14.51, 0.1)
WAVENUMBERS = (660, 1480)
FIT_RANGE_M = 200
FIT_AIRS = [(273, 0.6), (283, 0.6), (293, 0.7), (303, 0.4)]
TEST_AIRS = [(273, 0.6), (293, 0.7), (293, 0.3), (303, 0.4), (300, 1.0), (257.2, 0.8)]
TEST_RANGES_M = [61, 122, 300, 1000]
# Temperature [K] and humidity at the ground of LOWTRAN's model atmospheres.
MODELS = {
    1: (299.7, 0.75),
    2: (294.2, 0.76),
    3: (272.2, 0.77),
    4: (287.2, 0.75),
    5: (257.2, 0.80),
    6: (288.2, 0.46),
}
SUBARCTIC_WINTER = 5
BANDS_UM = [(8, 14), (7.5, 13.5), (7.5, 14), (10.5, 12.5), (8, 9), (10, 11)]
ANGLES_DEG = [0, 60, 75]


def lowtran(path_type, emission, model=0, air_k=293.0, humidity=0.0, angle_deg=0.0, range_m=0.0):
    """Transmittance and radiance [W cm^-2 sr^-1 um^-1] at our wavelengths, means over 0.1 um."""
    begin, end = WAVENUMBERS
    own = 1 if model == 0 else 0
    amounts = np.zeros(12, dtype="f4")
    amounts[0] = 100 * humidity
    result = lowtran7.lwtrn7(
        True, (end - begin) // 5 + 1, begin, end, 5, model, path_type, emission, own, 0, own,
        np.array([0], "f4"), np.array([1013], "f4"), np.array([air_k], "f4"), amounts, 0, 0, angle_deg, range_m / 1000,
    )  # fmt: skip
    transmittance, _, wavelengths, *_, radiance = result
    return at_wavelengths(wavelengths, transmittance[:, 8]), at_wavelengths(wavelengths, radiance)


def at_wavelengths(wavelengths, values):
    """Means over 0.1 um about each of WAVELENGTHS_UM."""
    means = []
    for middle in WAVELENGTHS_UM:
        inside = np.abs(wavelengths - middle) <= 0.05 + 1e-9
        if inside.sum() > 1:
            means.append(values[inside].mean())
        else:
            means.append(np.interp(middle, wavelengths[::-1], values[::-1]))
    return np.array(means)


def water_path(air_k, humidity, range_m):
    return lowtran(1, 0, air_k=air_k, humidity=humidity, range_m=range_m)[0]


def depth(transmittance):
    return -np.log(np.maximum(transmittance, 1e-6))


def planck(air_k):
    """[W cm^-2 sr^-1 um^-1]"""
    return 1.191042972e4 / (WAVELENGTHS_UM**5 * np.expm1(14387.7688 / (WAVELENGTHS_UM * air_k)))


def water_g_m3(air_k, humidity):
    t = air_k - 273.15
    return min(25.0, humidity * np.exp(1.5587 + 0.06939 * t - 2.7816e-4 * t**2 + 6.8455e-7 * t**3))


def vapour_hpa(air_k, humidity):
    celsius = air_k - 273.15
    return humidity * 6.112 * np.exp(17.62 * celsius / (243.12 + celsius))


def continuum(air_k, humidity):
    """[m^-1 per g m^-3], Roberts, Selby and Biberman 1976."""
    vapour = vapour_hpa(air_k, humidity) / 1013.25
    at_296_k = 4.18 + 5578 * np.exp(-7.87e-3 * 1e4 / WAVELENGTHS_UM)
    return 1e-4 * at_296_k * np.exp(1800 * (1 / air_k - 1 / 296)) * (vapour + 0.002 * (1 - vapour))


def fit_lines():
    found = []
    for air_k, humidity in FIT_AIRS:
        per_g = depth(water_path(air_k, humidity, FIT_RANGE_M)) / FIT_RANGE_M / water_g_m3(air_k, humidity)
        found.append(np.maximum(per_g - continuum(air_k, humidity), 0))
    return np.mean(found, axis=0)


def fit_gases():
    """What the subarctic winter absorbs near the ground, less its water vapour."""
    whole = depth(lowtran(1, 0, model=SUBARCTIC_WINTER, range_m=FIT_RANGE_M)[0]) / FIT_RANGE_M
    water = depth(water_path(*MODELS[SUBARCTIC_WINTER], FIT_RANGE_M)) / FIT_RANGE_M
    return np.maximum(whole - water, 0)


def sky(model, angle_deg):
    """Emissivity, relative to the air at the ground."""
    radiance = lowtran(3, 1, model=model, angle_deg=angle_deg)[1]
    return np.clip(radiance / planck(MODELS[model][0]), 0, 0.9999)


def fit_sky(lines):
    """Depths that the zenith of all models has beside each model's own multiple of the water near the ground."""
    per_g = {model: continuum(*air) + lines for model, air in MODELS.items()}
    depths = {model: -np.log(1 - sky(model, 0)) for model in MODELS}
    weights = {model: np.exp(-2 * depths[model]) for model in MODELS}  # errors of emissivity count
    window = (WAVELENGTHS_UM >= 7.85) & (WAVELENGTHS_UM <= 13.65)
    gases = np.zeros(len(WAVELENGTHS_UM))
    for _ in range(200):
        rest = 0
        for model in MODELS:
            use = window & (depths[model] < 2.5)
            weight = (weights[model] * per_g[model])[use]
            factor = max(
                (weight * (depths[model] - gases)[use]).sum() / (weight * per_g[model][use]).sum(), 0
            )
            rest = rest + weights[model] * (depths[model] - factor * per_g[model])
        gases = np.maximum(rest / sum(weights.values()), 0)
    return gases


def contrast(air_k):
    """Planck's law differentiated by the logarithm of temperature."""
    x = 14387.7688 / (WAVELENGTHS_UM * air_k)
    return planck(air_k) * x / -np.expm1(-x)


def band_mean(values, weights, band_um):
    begin, end = band_um
    weight = weights * ((WAVELENGTHS_UM > begin - 1e-6) & (WAVELENGTHS_UM < end + 1e-6))
    weight[np.isclose(WAVELENGTHS_UM, begin) | np.isclose(WAVELENGTHS_UM, end)] *= 0.5
    return (weight * values).sum() / weight.sum()


def write_bands(gases):
    """Writes air_bands.csv, which the tests compare with."""
    lines = [
        "# LOWTRAN 7 in bands. tests/data/air_spectrum.py.",
        "# sky: emissivity at an angle from the zenith [deg], weighted with Planck's law at the air's temperature.",
        "# path: transmittance of a range [m], weighted with its derivative with temperature.",
        "kind,air_temperature_k,relative_humidity,angle_or_range,"
        + ",".join(f"{a}-{b}" for a, b in BANDS_UM),
    ]

    def add(kind, air, at, values):
        weights = planck(air[0]) if kind == "sky" else contrast(air[0])
        lines.append(
            f"{kind},{air[0]},{air[1]},{at},"
            + ",".join(f"{band_mean(values, weights, b):.4f}" for b in BANDS_UM)
        )

    for model, air in MODELS.items():
        for angle_deg in ANGLES_DEG:
            add("sky", air, angle_deg, sky(model, angle_deg))
    for air in TEST_AIRS:
        for range_m in TEST_RANGES_M:
            add("path", air, range_m, water_path(*air, range_m) * np.exp(-gases * range_m))
    (HERE / "air_bands.csv").write_text("\n".join(lines) + "\n", encoding="ascii")


def main():
    lines, gases = fit_lines(), fit_gases()
    at_zenith = fit_sky(lines)
    for row in zip(lines, gases, at_zenith):
        print("{%.3g, %.3g, %.2g}," % (1e6 * row[0], 1e6 * row[1], row[2]))
    write_bands(gases)


if __name__ == "__main__":
    main()
