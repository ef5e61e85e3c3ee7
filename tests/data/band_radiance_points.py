"""Compute band_radiance_points.csv, 200 in-band radiances with 50 digits, by an independent method: Gauss-Legendre over
wavelength, in panels that follow Planck's law, by two rules that must agree to 40 digits.

Run `python3 band_radiance_points.py` (needs mpmath 1.3; where Debian's is missing, from
`python3 -m venv V && V/bin/pip install mpmath`); one minute. Every input is the double nearest to the decimal in the
CSV, so that a test which reads it sees no input error.
"""

from pathlib import Path

import mpmath as mp

mp.mp.dps = 60
OUT = Path(__file__).with_suffix(".csv")
SPREAD_POINTS = 194

# Exact SI 2019: h, c, k.
C1 = 2 * mp.mpf("6.62607015e-34") * mp.mpf(299792458) ** 2
C2 = mp.mpf("6.62607015e-34") * 299792458 / mp.mpf("1.380649e-23")

# Responses over a band, as (share of the band's width, response); "box" has steep edges that end at zero.
SHAPES = {
    "flat": [(0, 1), (1, 1)],
    "triangle": [(0, 0), (0.4, 1), (1, 0)],
    "box": [(0, 0), (0.05, 1), (0.95, 1), (1, 0)],
    "camera": [(0, 0), (0.1, 0.55), (0.35, 1), (0.6, 0.9), (0.8, 0.5), (1, 0)],
    "gap": [(0, 1), (0.2, 0), (0.55, 0), (0.7, 0.8), (1, 0.3)],
}
# Emissivity spectra the same way; the band may end inside them.
SPECTRA = [
    [],
    [(-0.5, 0.75), (0.23, 0.75), (0.26, 0.97), (1.5, 0.97)],
    [],
    [(0, 0.2), (0.5, 0.9), (0.52, 0), (1, 0.6)],
]

# Ramps that a hot body fills near their short-wave end, where they are next to nothing.
RAMPS = [[(0.5, 0.0), (100.0, 1.0)], [(1.0, 0.0), (50.0, 1.0), (100.0, 0.0)]]
RAMP_TEMPERATURES_K = [300.0, 1e4, 1e6]


def spread(number, base):
    """Van der Corput's sequence: share of the way through an interval, evenly filling it."""
    share, digit = 0.0, 1.0 / base
    while number:
        number, rest = divmod(number, base)
        share += rest * digit
        digit /= base
    return share


def samples_of(shape, begin_um, width_um):
    """A shape over a band: wavelengths [um] as written in the CSV, positive, and values."""
    wavelengths_um = [max(begin_um / 2, begin_um + share * width_um) for share, _ in shape]
    return [(float(f"{um:.12g}"), float(value)) for um, (_, value) in zip(wavelengths_um, shape)]


def points():
    """Temperature [K], response, emissivity: widths 1 pm to 100 um, 1 K to 1e6 K, each log-uniform; then ramps."""
    for n in range(1, SPREAD_POINTS + 1):
        temperature_k = float(f"{10 ** (6 * spread(n, 2)):.6g}")
        width_um = 10 ** (-6 + 8 * spread(n, 3))
        begin_um = round(10 ** (-0.3 + 1.6 * spread(n, 5)), 3)
        shape = list(SHAPES.values())[n % len(SHAPES)]
        spectrum = SPECTRA[n % len(SPECTRA)]
        yield temperature_k, samples_of(shape, begin_um, width_um), samples_of(spectrum, begin_um, width_um)
    for response in RAMPS:
        for temperature_k in RAMP_TEMPERATURES_K:
            yield temperature_k, response, []


def line(samples, wavelength_um):
    """Value of straight lines between samples; 1 where there are none."""
    if not samples:
        return mp.mpf(1)
    for (left_um, left), (right_um, right) in zip(samples, samples[1:]):
        if left_um <= wavelength_um <= right_um:
            share = (wavelength_um - mp.mpf(left_um)) / (mp.mpf(right_um) - mp.mpf(left_um))
            return left + (mp.mpf(right) - left) * share
    raise ValueError(f"{wavelength_um} um is outside the samples")


def panels(begin_um, end_um, temperature_k):
    """Edges [um] from the long-wave end on: at most 2 in x = c2 / (wavelength T) apart, and 1.5 in ratio; ends where
    e^-x has fallen by 1e-60 from the larger of x at the first edge and Planck's peak."""
    to_x = C2 * 10**6 / temperature_k
    edges = [mp.mpf(end_um)]
    last_x = max(to_x / end_um, 3) + 140
    while edges[-1] > begin_um and to_x / edges[-1] < last_x:
        x = to_x / edges[-1]
        edges.append(max(mp.mpf(begin_um), to_x / min(x + 2, x * 1.5)))
    return list(zip(edges[1:], edges))


def integrals(temperature_k, response, emissivity, rule):
    """Radiance [W m^-2 sr^-1] and its derivative [.. K^-1]."""
    inner = [um for um, _ in emissivity if response[0][0] < um < response[-1][0]]
    knots = sorted({um for um, _ in response} | set(inner))
    radiance = derivative = mp.mpf(0)
    warmest_end = max(knots)
    for begin_um, end_um in zip(knots, knots[1:]):
        if C2 * 10**6 / temperature_k * (1 / mp.mpf(end_um) - 1 / mp.mpf(warmest_end)) > 140:
            continue  # 1e-60 of what the long-wave end gives
        for left_um, right_um in panels(begin_um, end_um, temperature_k):
            middle, half = (left_um + right_um) / 2, (right_um - left_um) / 2
            for node, weight in rule:
                um = middle + half * node
                x = C2 * 10**6 / (um * temperature_k)
                planck = C1 * mp.mpf(10) ** 24 / (um**5 * mp.expm1(x))
                value = half * weight * line(response, um) * line(emissivity, um) * planck
                radiance += value
                derivative += value * x / (-mp.expm1(-x)) / temperature_k
    return radiance, derivative


def gauss_rule(count):
    """Nodes and weights of Gauss-Legendre on [-1, 1], by Newton's method on the polynomial."""
    rule = []
    for n in range(count):
        node = mp.cos(mp.pi * (n + mp.mpf("0.75")) / (count + mp.mpf("0.5")))
        for _ in range(8):
            before, here = mp.mpf(1), node
            for k in range(2, count + 1):
                before, here = here, ((2 * k - 1) * node * here - (k - 1) * before) / k
            slope = count * (node * here - before) / (node * node - 1)
            node -= here / slope
        rule.append((node, 2 / ((1 - node * node) * slope * slope)))
    return rule


def text(value):
    """Twenty-one digits: more than the precision of a double."""
    return mp.nstr(value, 21, min_fixed=0, max_fixed=0)


def curve_text(samples):
    """Samples as one cell: "8:0 10:1"."""
    return " ".join(f"{um!r}:{value!r}" for um, value in samples)


def main():
    """Write the CSV."""
    rules = gauss_rule(40), gauss_rule(46)
    rows = []
    for temperature_k, response, emissivity in points():
        rough, _ = integrals(temperature_k, response, emissivity, rules[0])
        radiance, derivative = integrals(temperature_k, response, emissivity, rules[1])
        assert abs(rough / radiance - 1) < mp.mpf(10) ** -40, (temperature_k, response)
        values = [text(value) for value in (radiance, derivative, mp.log(radiance))]
        rows.append(",".join([repr(temperature_k), curve_text(response), curve_text(emissivity), *values]))
    lines = [
        "# In-band radiance of bands of any shape and width; written by band_radiance_points.py, 60-digit arithmetic.",
        "temperature_k,response,emissivity,radiance_w_m2_sr,derivative_w_m2_sr_k,ln_radiance",
        *rows,
    ]
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
