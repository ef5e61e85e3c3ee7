"""Random values depend only on seed, name and position."""

import numpy as np

from planner.noise import fractal_noise, gradient_noise, lattice_hash, lattice_uniform, stream


def test_hashes_are_the_same_on_every_machine():
    # Worked out with Python's own integers from the definition: two rounds of SplitMix64's finaliser.
    def mix(bits: int) -> int:
        bits = ((bits ^ bits >> 30) * 0xBF58476D1CE4E5B9) % 2**64
        bits = ((bits ^ bits >> 27) * 0x94D049BB133111EB) % 2**64
        return bits ^ bits >> 31

    key = 7 << 32 | 0x352441C2  # crc32 of "abc"
    for ix, iy in ((0, 0), (3, -5), (-1, 2**40)):
        expected = mix((mix(ix % 2**64 ^ key) + (iy % 2**64) * 0x9E3779B97F4A7C15) % 2**64)
        assert int(lattice_hash(7, "abc", np.int64(ix), np.int64(iy))) == expected


def test_lattice_values_are_uniform_and_unlike_for_unlike_names():
    ix, iy = np.meshgrid(np.arange(-150, 150), np.arange(-150, 150))
    values = lattice_uniform(1, "a", ix, iy)
    assert values.min() >= 0 and values.max() < 1
    # Mean of n uniforms: stddev 1 / sqrt(12 n); five of them.
    assert abs(values.mean() - 0.5) < 5 / np.sqrt(12 * values.size)
    others = lattice_uniform(1, "b", ix, iy)
    # Correlation of n independent pairs: stddev 1 / sqrt(n); five of them.
    assert abs(np.corrcoef(values.ravel(), others.ravel())[0, 1]) < 5 / np.sqrt(values.size)


def test_noise_depends_only_on_the_position_and_not_on_other_queries():
    x, y = np.linspace(-40, 40, 101), np.linspace(10, -30, 101)
    together = fractal_noise(3, "n", x, y, 11.0, 4)
    assert [float(fractal_noise(3, "n", x[k], y[k], 11.0, 4)) for k in range(101)] == together.tolist()


def test_gradient_noise_is_zero_on_its_lattice_and_bounded():
    whole = np.arange(-20.0, 20.0)
    assert not gradient_noise(3, "n", whole, whole[::-1]).any()
    x, y = np.meshgrid(np.linspace(-9, 9, 400), np.linspace(-9, 9, 400))
    noise = gradient_noise(3, "n", x, y)
    assert np.abs(noise).max() <= 1.0
    # Fade and planes are Lipschitz: |slope| <= 1.875 * 2 + 2 along an axis, times the 0.045 step.
    assert np.abs(np.diff(noise, axis=1)).max() < 5.75 * 18 / 399


def test_streams_are_keyed_by_entity():
    assert stream(1, "a", 2).random() == stream(1, "a", 2).random()
    values = {stream(*key).random() for key in ((1, "a", 2), (1, "a", 3), (1, "b", 2), (2, "a", 2), (1, "a"))}
    assert len(values) == 5
