"""Print what is on the map of a resolved config, as JSON: SHA-256 of its parts, and numbers of plants and actors.

    python3 map_checksums.py CONFIG FOLDER
"""

import hashlib
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blender_scripts"))

# pylint: disable=wrong-import-position
from planner.bake.pictures import bake_pictures
from planner.config import load
from planner.workers import Cores
from planner.world import plan_world


def main(config: Path, folder: Path) -> None:
    """Plan the config's world, and bake its map into the folder."""
    world = plan_world(load(config), Cores(2))
    bake_pictures(world, folder)
    plants = [vars(planting) for _, planting in sorted(world.plantings.items())]
    parts = {
        "relief": [world.terrain.heights_m.tobytes()],
        "places of plants": [
            one[kind].tobytes() for one in plants for kind in ("points_m", "yaw_rad", "scale", "variant")
        ],
        "lines and words": [(folder / f"sheet.{kind}").read_bytes() for kind in ("json", "bin")],
    }
    checksums = {name: hashlib.sha256(b"".join(part)).hexdigest() for name, part in parts.items()}
    counts = {"plants": sum(len(one["scale"]) for one in plants), "actors": len(world.actors)}
    print(json.dumps(checksums | counts))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
