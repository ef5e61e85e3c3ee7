"""Solids as species and structure files list them."""

from __future__ import annotations

import numpy as np

from .panel_shapes import panel, wheel
from .shapes import Mesh, ellipsoid, sheet, tube


def solid_of(shape: dict) -> Mesh:
    """The mesh of a tube, panel, wheel, sheet or ellipsoid, in slot 0; its keys are in blender_scripts/README.md."""
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
