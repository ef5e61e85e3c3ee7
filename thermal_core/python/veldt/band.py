"""In-band radiance of blackbodies, and its inverse."""

from __future__ import annotations

from os import PathLike, fspath

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core


class Band:
    """The spectral response of a camera: a flat band, or a response curve.

    >>> Band(8, 14).temperature(Band(8, 14).radiance(300.0))
    array(300.)
    """

    def __init__(self, begin_um: float = 8, end_um: float = 14, *, response: ArrayLike | None = None) -> None:
        """A flat band from begin_um to end_um [um], 0 < begin_um < end_um; or `response`: (n, 2) samples of
        wavelength [um] and relative response, n >= 2, wavelengths rising. ConfigError otherwise."""
        self._band = _core.Band([(begin_um, 1), (end_um, 1)] if response is None else response)

    @classmethod
    def of_file(cls, file: str | PathLike[str]) -> Band:
        """A CSV with the columns wavelength_um and response. ConfigError names its line; IoError if unreadable."""
        band = cls()
        band._band = _core.Band.of_file(fspath(file))
        return band

    @property
    def begin_um(self) -> float:
        """The band's short-wave end [um]."""
        return self._band.begin_um

    @property
    def end_um(self) -> float:
        """The band's long-wave end [um]."""
        return self._band.end_um

    def radiance(self, temperature_k: ArrayLike) -> NDArray[np.float64]:
        """In-band radiance [W m^-2 sr^-1] of temperatures [K] of any shape: the reference, about 1 us each. 0 for 0 K
        and below, NaN for NaN, infinity for infinity. Its error is at most relative_error_bound()."""
        return self._band.radiances(temperature_k)

    def table_radiance(self, temperature_k: ArrayLike) -> NDArray[np.float32]:
        """The same in single precision, by the table used for frames: a hundred times as fast from 180 K to 436 K, the
        reference elsewhere. Off by at most 5e-8 of the radiance before rounding to single precision.
        """
        return self._band.table_radiances(temperature_k)

    def derivative(self, temperature_k: ArrayLike) -> NDArray[np.float64]:
        """dL/dT [W m^-2 sr^-1 K^-1] at temperatures [K]."""
        return self._band.derivatives(temperature_k)

    def relative_error_bound(self, temperature_k: ArrayLike) -> NDArray[np.float64]:
        """Bound of radiance()'s relative error against the true integral of the inputs as written in decimals."""
        return self._band.relative_error_bounds(temperature_k)

    def temperature(self, radiance_w_m2_sr: ArrayLike) -> NDArray[np.float64]:
        """Temperature [K] of the blackbody with this in-band radiance, off by at most 1e-9 of it from 1 K to 1e6 K.
        0 for 0 and below, NaN for NaN, infinity for infinity."""
        return self._band.temperatures(radiance_w_m2_sr)
