"""Compute air_and_sky.csv, path_transmittance.csv and angular_factor.csv with 30 digits from the published formulas,
implemented independently; run `python3 air_and_angle.py` (needs mpmath 1.3).

Path: FLIR's form after Passman and Larmore, coefficients of Tran et al., Sensors 17, 2017. Below 30 m Beer's law
through the value at 30 m, by design: the fit's slope at 0 is infinite. Sky: Idso, Water Resour. Res. 17, 295, 1981;
Kimball, Idso and Aase, Water Resour. Res. 18, 931, 1982. Vapour: WMO-No. 8, 2018. Water: Fresnel's equations and
Snell's law, indices of Hale and Querry, Appl. Opt. 12, 555, 1973.
"""

from pathlib import Path

import mpmath as mp

mp.mp.dps = 30
HERE = Path(__file__).parent

# Air temperature [K], relative humidity: the two nights of Table 1, dry, saturated, and what exceeds 25 g m^-3.
AIRS = [
    ("273", "0.6"),
    ("293", "0.7"),
    ("283", "0"),
    ("268", "1"),
    ("303", "0.4"),
    ("308", "0.9"),
    ("318", "1"),
]
CLOUDS = ["0", "0.25", "1"]
RANGES_M = ["0", "1", "5", "29.9", "30", "30.1", "61", "122", "300", "1000", "1500"]
COSINES = [
    "1",
    "0.99",
    "0.9",
    "0.75",
    "0.5",
    "0.42261826174069944",
    "0.25",
    "0.1",
    "0.01",
    "0",
]  # the sixth: 65 deg

# Complex index of water at 8, 9 … 14 um.
WATER = [
    ("1.291", "0.0343"),
    ("1.262", "0.0399"),
    ("1.218", "0.0508"),
    ("1.153", "0.0968"),
    ("1.111", "0.199"),
    ("1.123", "0.305"),
    ("1.171", "0.370"),
]


def vapour_pressure_hpa(air_k, humidity):
    """Magnus form over water."""
    celsius = air_k - mp.mpf("273.15")
    return humidity * mp.mpf("6.112") * mp.exp(mp.mpf("17.62") * celsius / (mp.mpf("243.12") + celsius))


def water_g_m3(air_k, humidity):
    """Water content the path model is fitted to, at most 25."""
    t = air_k - mp.mpf("273.15")
    cubic = mp.polyval([mp.mpf("6.8455e-7"), mp.mpf("-2.7816e-4"), mp.mpf("0.06939"), mp.mpf("1.5587")], t)
    return min(mp.mpf(25), humidity * mp.exp(cubic))


def transmittance(air_k, humidity, range_m):
    """Of a level path."""
    if range_m < 30:
        return transmittance(air_k, humidity, mp.mpf(30)) ** (range_m / 30)
    root_range = mp.sqrt(min(range_m, mp.mpf(1000)))
    root_water = mp.sqrt(water_g_m3(air_k, humidity))
    first = mp.exp(-root_range * (mp.mpf("0.006569") + mp.mpf("-0.002276") * root_water))
    second = mp.exp(-root_range * (mp.mpf("0.01262") + mp.mpf("-0.00667") * root_water))
    return min(mp.mpf(1), max(mp.mpf(0), mp.mpf("1.9") * first + (1 - mp.mpf("1.9")) * second))


def zenith_emissivity(air_k, humidity):
    """Of a clear sky, 8 to 14 um."""
    pressure_hpa = vapour_pressure_hpa(air_k, humidity)
    return min(mp.mpf(1), mp.mpf("0.24") + mp.mpf("2.98e-8") * pressure_hpa**2 * mp.exp(3000 / air_k))


def clouded(clear, cloud):
    """With a share of the sky under cloud."""
    return clear + mp.mpf("0.84") * (1 - clear) * cloud


def water_emissivity(cosine):
    """Share of unpolarised light that enters water, mean of seven wavelengths."""
    total = mp.mpf(0)
    for real, imaginary in WATER:
        n = mp.mpc(real, imaginary)
        inside = mp.sqrt(1 - (1 - cosine**2) / n**2)  # Snell's law: cosine of the refracted wave
        across = abs((cosine - n * inside) / (cosine + n * inside)) ** 2
        along = abs((n * cosine - inside) / (n * cosine + inside)) ** 2
        total += 1 - (across + along) / 2
    return total / len(WATER)


def text(value):
    """Twenty digits: more than the precision of a double."""
    return mp.nstr(value, 20, min_fixed=0, max_fixed=0)


def row(inputs, values):
    """One line of a CSV."""
    return ",".join([*inputs, *(text(value) for value in values)])


def write(name, what, header, rows):
    """One CSV that says where it is from."""
    lines = [f"# {what} Written by air_and_angle.py.", header, *rows]
    (HERE / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def sky_rows():
    """Every air under every cloud."""
    for air, humidity in AIRS:
        state = mp.mpf(air), mp.mpf(humidity)
        zenith = zenith_emissivity(*state)
        hemisphere = zenith * (mp.mpf("1.4") - mp.mpf("0.4") * zenith)
        for cloud in CLOUDS:
            skies = [clouded(clear, mp.mpf(cloud)) for clear in (zenith, hemisphere)]
            yield row([air, humidity, cloud], [vapour_pressure_hpa(*state), water_g_m3(*state), *skies])


def main():
    """Write the three files."""
    write(
        "air_and_sky.csv",
        "Vapour, water content, and emissivity of the sky.",
        "air_temperature_k,relative_humidity,cloud_fraction,vapour_hpa,water_g_m3,zenith_emissivity,sky_emissivity",
        list(sky_rows()),
    )
    write(
        "path_transmittance.csv",
        "In-band transmittance of level paths.",
        "air_temperature_k,relative_humidity,range_m,transmittance",
        [
            row([air, humidity, range_m], [transmittance(mp.mpf(air), mp.mpf(humidity), mp.mpf(range_m))])
            for air, humidity in AIRS
            for range_m in RANGES_M
        ],
    )
    write(
        "angular_factor.csv",
        "Emissivity of water at an angle over that at the normal.",
        "cosine,factor",
        [
            row([cosine], [water_emissivity(mp.mpf(cosine)) / water_emissivity(mp.mpf(1))])
            for cosine in COSINES
        ],
    )


if __name__ == "__main__":
    main()
