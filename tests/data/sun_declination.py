"""Write sun_declination.csv: apparent declination of the sun by NREL's Solar Position Algorithm (Reda and Andreas,
Solar Energy 76, 577, 2004; within 0.0003 deg), by pvlib.

Run `python3 sun_declination.py` (needs pvlib 0.16, from `python3 -m venv V && V/bin/pip install pvlib`).
"""

from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np
from pvlib import spa  # pylint: disable=import-error

OUT = Path(__file__).with_suffix(".csv")
EPHEMERIS_MINUS_UNIVERSAL_S = {1950: 29.1, 2026: 69.2}


def declination_deg(moment: datetime) -> float:
    """Of the sun's apparent centre, seen from that of the Earth."""
    day = spa.julian_day(np.array([moment.timestamp()]))
    ephemeris_day = spa.julian_ephemeris_day(day, EPHEMERIS_MINUS_UNIVERSAL_S[moment.year])
    century = spa.julian_ephemeris_century(ephemeris_day)
    millennium = spa.julian_ephemeris_millennium(century)
    longitude = spa.geocentric_longitude(spa.heliocentric_longitude(millennium))
    latitude = spa.geocentric_latitude(spa.heliocentric_latitude(millennium))
    arguments = (
        spa.mean_elongation(century),
        spa.mean_anomaly_sun(century),
        spa.mean_anomaly_moon(century),
        spa.moon_argument_latitude(century),
        spa.moon_ascending_longitude(century),
    )
    nutation = np.empty((2, 1))  # of longitude and of the ecliptic's obliquity
    spa.longitude_obliquity_nutation(century, *arguments, nutation)
    obliquity = spa.true_ecliptic_obliquity(spa.mean_ecliptic_obliquity(millennium), nutation[1])
    aberration = spa.aberration_correction(spa.heliocentric_radius_vector(millennium))
    apparent = spa.apparent_sun_longitude(longitude, nutation[0], aberration)
    return float(spa.geocentric_sun_declination(apparent, obliquity, latitude)[0])


def main() -> None:
    """Every fifth day of two years."""
    lines = ["# Declination of the sun, by pvlib's Solar Position Algorithm. Written by sun_declination.py."]
    lines.append("year,utc_h,day_of_year,declination_rad")
    for year, hour in ((1950, 0), (2026, 12)):
        for day in range(1, 366, 5):
            moment = datetime(year, 1, 1, hour, tzinfo=timezone.utc) + timedelta(days=day - 1)
            lines.append(f"{year},{hour},{day},{np.radians(declination_deg(moment)):.6f}")
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
