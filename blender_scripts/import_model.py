"""Convert a user's model to a mesh of the baked scene. Run by Blender:

    blender -b --factory-startup --disable-autoexec --python-exit-code 1 --python import_model.py < ORDER

ORDER is a JSON object: `where`, the asset file for messages; `data`, its content; `out`, the path of the mesh without a
suffix. A fault of the model prints one JSON object {"error": "…"} and exits with code 2.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # write nothing into the scripts' folder
sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from planner.faults import ConfigError
from planner.model_meshes import write_mesh
from veldt_bl import models


def main() -> int:
    """Run the command and return its exit code."""
    order = json.load(sys.stdin)
    try:
        mesh = models.load(order["where"], order["data"])
    except ConfigError as error:
        print(json.dumps({"error": str(error)}))
        return 2
    write_mesh(Path(order["out"]), mesh)
    return 0


if __name__ == "__main__":
    sys.exit(main())
