"""Computes radiance_bounds.csv: in-band radiances of inputs as they are written, decimals that no double holds.

Flat bands from 1 pm to 99 um, and responses of 10 to a million samples, smooth and rough, whose samples follow from
their number (see `samples`). Gauss-Legendre over wavelength with 60 digits, as in band_radiance_points.py; the million
by six points a segment in 80-bit arithmetic (x86), whose pairwise sums agree with 60 digits at 10^5 samples to 1e-18.
Run `python3 radiance_bounds.py` (needs mpmath 1.3 and NumPy); five minutes.
"""

from pathlib import Path

import mpmath as mp
import numpy as np

from band_radiance_points import C1, C2, gauss_rule, integrals, text

OUT = Path(__file__).with_suffix(".csv")

BANDS_UM = [
    ("10", "10.000001"),
    ("9.3", "9.300001"),
    ("10", "10.001"),
    ("3.9", "3.901"),
    ("13.999", "14"),
    ("10.1", "10.11"),
    ("10.2", "10.4"),
    ("8.1", "13.9"),
    ("0.9", "99.9"),
]
TEMPERATURES_K = ["30.1", "77.7", "273.15", "300.1", "436.7", "1200.3", "99999.9", "1000000"]
SAMPLED_K = {10: ["30.1", "300.1", "99999.9"], 1000: ["30.1", "300.1", "99999.9"], 100_000: ["300.1"]}
LARGEST, LARGEST_K = 1_000_000, "300.1"


def samples(shape, count):
    """Wavelengths [um] and responses in millionths: count + 1 from 7.5 to 13.5 um. "smooth" is a parabola, "rough"
    three digits of a linear congruential generator."""
    state = 1
    for i in range(count + 1):
        state = (1103515245 * state + 12345) % 2**31
        response = (
            4_000_000 * i * (count - i) // count**2 if shape == "smooth" else (state >> 16) % 1000 * 1000
        )
        yield 7_500_000 + i * (6_000_000 // count), response


def sampled(shape, count, temperature_k, rule):
    """Radiance of a sampled response, scaled to a peak of 1, with mpmath."""
    pairs = list(samples(shape, count))
    peak = max(response for _, response in pairs)
    total = mp.mpf(0)
    for (left, low), (right, high) in zip(pairs, pairs[1:]):
        half = mp.mpf(right - left) / 2
        for node, weight in rule:
            um = (left + half * (1 + node)) / 10**6
            response = (low + (high - low) * (1 + node) / 2) / peak
            planck = C1 * mp.mpf(10) ** 24 / (um**5 * mp.expm1(C2 * 10**6 / (um * mp.mpf(temperature_k))))
            total += half / 10**6 * weight * response * planck
    return total


def sampled_in_80_bits(shape, count, temperature_k, rule):
    """The same with NumPy's long double."""
    long = np.longdouble
    c1, c2 = long(mp.nstr(C1 * mp.mpf(10) ** 24, 25)), long(mp.nstr(C2 * 10**6, 25))
    pairs = np.array(list(samples(shape, count)), dtype=np.int64).astype(long)
    left, right = pairs[:-1, 0], pairs[1:, 0]
    low, high = (pairs[:, 1] / pairs[:, 1].max())[:-1], (pairs[:, 1] / pairs[:, 1].max())[1:]
    half = (right - left) / 2
    total = long(0)
    for node, weight in ((long(mp.nstr(n, 25)), long(mp.nstr(w, 25))) for n, w in rule):
        um = (left + half * (1 + node)) / long(10**6)
        response = low + (high - low) * (1 + node) / 2
        planck = c1 / (um**5 * np.expm1(c2 / (um * long(temperature_k))))
        total += weight * (half / long(10**6) * response * planck).sum()
    return total


def main():
    """Writes the CSV."""
    assert np.finfo(np.longdouble).eps < 2e-19, "80-bit arithmetic is needed"
    wide, narrow = gauss_rule(46), gauss_rule(6)
    rows = []
    for begin_um, end_um in BANDS_UM:
        for temperature_k in TEMPERATURES_K:
            band = [(mp.mpf(begin_um), 1), (mp.mpf(end_um), 1)]
            radiance, _ = integrals(mp.mpf(temperature_k), band, [], wide)
            rows.append(f"{begin_um},{end_um},,0,{temperature_k},{text(radiance)}")
    for shape in ("smooth", "rough"):
        for count, temperatures_k in SAMPLED_K.items():
            for temperature_k in temperatures_k:
                radiance = sampled(shape, count, temperature_k, wide if count <= 1000 else narrow)
                rows.append(f"7.5,13.5,{shape},{count},{temperature_k},{text(radiance)}")
        largest = np.format_float_scientific(
            sampled_in_80_bits(shape, LARGEST, LARGEST_K, narrow), precision=18
        )
        rows.append(f"7.5,13.5,{shape},{LARGEST},{LARGEST_K},{largest}")
        check = mp.mpf(str(sampled_in_80_bits(shape, count, temperature_k, narrow)))
        assert abs(check / radiance - 1) < mp.mpf("1e-18"), mp.nstr(check / radiance - 1, 5)
    lines = [
        "# In-band radiances of inputs as written, not as doubles hold them; written by radiance_bounds.py, 60 digits.",
        "begin_um,end_um,shape,count,temperature_k,radiance_w_m2_sr",
        *rows,
    ]
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
