"""Write the inputs of a preview besides the scene: the map's sheet, the poses of its stills, and actors at one moment.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import numpy as np

from ..flight.poses import Flight
from ..preview.map_layers import plan_map
from ..preview.stills import plan_stills
from ..world import World
from . import arrays
from .forms import PREVIEW, VERSION
from .tracks import bake_track

MOMENT = "moment"


def bake_pictures(world: World, folder: Path) -> None:
    """Write sheet.json and sheet.bin, and the track of the first moment of the first clip or flight, moment.json."""
    time_s = float([*world.config["clips"], *world.config["flights"]][0]["start_s"])
    sheet, stills = plan_map(world, time_s), plan_stills(world, time_s)
    meshes = {}
    for k, layer in enumerate(sheet.layers):
        meshes[f"layers/{k}/points_m"] = layer.mesh.points_m.astype("<f4")
        meshes[f"layers/{k}/triangles"] = layer.mesh.triangles.astype("<u4")
    header = {
        "format": PREVIEW,
        "version": VERSION,
        "width_m": sheet.width_m,
        "height_m": sheet.height_m,
        "centre_m": list(sheet.centre_m),
        "layers": [
            {key: vars(layer)[key] for key in ("name", "colour", "opacity")} for layer in sheet.layers
        ],
        "labels": [asdict(label) for label in sheet.labels],
        "stills": [
            {"name": still.name, "camera_to_world": still.camera_to_world.tolist()} for still in stills
        ],
    }
    arrays.write(folder / "sheet", header, meshes)
    # No camera: every actor is posed.
    moment = Flight(np.array([time_s]), np.eye(4)[None], np.zeros(1), np.zeros(1))
    bake_track(world, MOMENT, moment, folder / MOMENT, everyone=True)
