"""Plausible ranges, minimum and maximum, of quantities in external files: values outside are errors."""

LAND_M = (-500.0, 9000.0)  # above the sea, from the shore of the Dead Sea to the top of Mount Everest
ALTITUDE_M = (-1000.0, 10_000.0)  # of aircraft, above the sea, home or ground
SPEED_M_S = (0.1, 100.0)  # to fly at
LATITUDE_DEG = (-89.0, 89.0)  # east is undefined at a pole
LONGITUDE_DEG = (-180.0, 180.0)
