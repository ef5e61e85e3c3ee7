"""The meshes of models from the user's files, which Blender reads once for each version of a file."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .bake import arrays
from .config import ROOT
from .faults import ConfigError, ProcessLost
from .geometry.shapes import Mesh
from .workers import end_with

FORMAT, VERSION = "veldt-model", 1
_SCRIPT = ROOT / "blender_scripts" / "import_model.py"
_CONFIG_FAULT = 2


@dataclass(frozen=True)
class ModelMeshes:
    """Meshes by their files' contents, kept in `folder`; those in `earlier`, of another plan, are reused.

    blender: the program, or an empty string if there is none.
    """

    folder: Path
    earlier: Path | None
    blender: str

    def mesh(self, where: str, data: dict) -> Mesh:
        """The mesh of a species' or plant's model. `where` is the asset file.

        ConfigError if Blender cannot read the model's file or if it differs from its description; RuntimeError if
        Blender is missing or fails, ProcessLost if it is killed.
        """
        self.folder.mkdir(exist_ok=True)
        path = self.folder / _key(data)
        if not path.with_suffix(".json").exists():
            if not self._take_over(path):
                self._import(where, data, path)
        _, found = arrays.read(path)
        return Mesh(*(np.array(found[name]) for name in ("points_m", "triangles", "slot")))

    def _take_over(self, path: Path) -> bool:
        """Copy a mesh of the earlier plan, if it exists."""
        if self.earlier is None or not (self.earlier / path.name).with_suffix(".json").exists():
            return False
        for suffix in (".bin", ".json"):
            shutil.copyfile((self.earlier / path.name).with_suffix(suffix), path.with_suffix(suffix))
        return True

    def _import(self, where: str, data: dict, path: Path) -> None:
        if not self.blender:
            raise RuntimeError(
                f'{where}: model.file = "{data["model"]["file"]}": only Blender can read it, and it is missing'
            )
        order = json.dumps({"where": where, "data": data, "out": str(path)})
        done = subprocess.run(
            [
                self.blender,
                "--background",
                "--factory-startup",
                "--disable-autoexec",
                "--python-exit-code",
                "1",
            ]
            + ["--python", str(_SCRIPT)],
            input=order,
            capture_output=True,
            text=True,
            check=False,
            preexec_fn=partial(end_with, os.getpid()),
        )
        answer = next((line for line in done.stdout.splitlines() if line.startswith("{")), None)
        if done.returncode == _CONFIG_FAULT and answer is not None:
            raise ConfigError(json.loads(answer)["error"])
        lost = ProcessLost(f"{where}: Blender", done.returncode)
        if lost.killed:
            raise lost
        if done.returncode != 0 or not path.with_suffix(".json").exists():
            raise RuntimeError(
                f"{where}: Blender failed to read the model: {(done.stderr or done.stdout)[-500:]}"
            )


def write_mesh(path: Path, mesh: Mesh) -> None:
    """Write a model's mesh; Blender calls this."""
    values = {
        "points_m": mesh.points_m.astype("<f8"),
        "triangles": mesh.triangles.astype("<u4"),
        "slot": mesh.slot.astype("<u4"),
    }
    arrays.write(path, {"format": FORMAT, "version": VERSION}, values)


def _key(data: dict) -> str:
    """Hash of a model's file, and of all other inputs of its mesh."""
    digest = hashlib.sha256(Path(data["model"]["path"]).read_bytes())
    entry = {key: value for key, value in data["model"].items() if key != "path"}
    digest.update(json.dumps(entry, sort_keys=True).encode())
    return digest.hexdigest()[:32]
