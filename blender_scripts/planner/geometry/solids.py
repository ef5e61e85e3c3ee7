"""Solids as species and structure files list them. Lengths in m; x forward, or along the front of a structure, z up.

tube       `tube_m`: rings of x, y, z, half width, half height, joined by smooth curves; `sides`, `steps` (rings per
           given ring), `roundness` of its ends in half axes, `caps` (rings of each end, 2 or 3)
ellipsoid  `centre_m`, `radii_m`, `yaw_deg`, `tilt_deg`, `rings`, `sides`
sheet      `outline_m`: a closed curve through points in its own x and z; `thickness_m`, `centre_m`, `yaw_deg`,
           `tilt_deg`
panel      `panel_m`: corners of a side view as x, z, half width; `bevel_m`, `corner_m`, `y_m`
wheel      `centre_m`, `wheel_m`: radius and half width; `bevel_m`
"""

from __future__ import annotations

import numpy as np

from .panel_shapes import panel, wheel
from .shapes import Mesh, ellipsoid, sheet, tube


def solid_of(shape: dict) -> Mesh:
    """The mesh of a tube, panel, wheel, sheet or ellipsoid, in slot 0."""
    if "tube_m" in shape:
        fineness = {key: shape[key] for key in ("sides", "roundness", "steps", "caps") if key in shape}
        return tube(np.array(shape["tube_m"]), **fineness)
    if "panel_m" in shape:
        return panel(
            np.array(shape["panel_m"]), shape["bevel_m"], shape.get("corner_m", 0.0), shape.get("y_m", 0.0)
        )
    if "wheel_m" in shape:
        return wheel(shape["centre_m"], *shape["wheel_m"], shape["bevel_m"])
    turn = shape.get("yaw_deg", 0.0), shape.get("tilt_deg", 0.0)
    if "outline_m" in shape:
        return sheet(np.array(shape["outline_m"]), shape["thickness_m"], shape["centre_m"], *turn)
    fineness = {key: shape[key] for key in ("rings", "sides") if key in shape}
    return ellipsoid(shape["centre_m"], shape["radii_m"], *turn, **fineness)
