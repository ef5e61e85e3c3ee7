"""Run the renderer like the `veldt` command: as a child process that reports its progress through a pipe."""

import json
import os
import resource
import shutil
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pictures import read_planes
from processes import PATIENCE_S
from planner.bake.baked import read_scene, read_track
from planner.config import ROOT

BLENDER = os.environ.get("BLENDER") or shutil.which("blender") or "blender"

PLANES = (
    "Scene.IndexOB.X",
    "Scene.IndexMA.X",
    "Scene.Depth.Z",
    "Scene.Normal.X",
    "Scene.Normal.Y",
    "Scene.Normal.Z",
)


@dataclass
class Run:
    """The result of a run of the renderer."""

    code: int
    plan: Path
    out: Path
    events: list[dict]
    log: str

    def planes(self, clip: str, frame: int) -> dict[str, np.ndarray]:
        """The passes of one frame."""
        return read_planes(self.out / clip / f"{frame:06d}.exr")

    def meaning(self, clip: str) -> dict:
        """The camera of a clip, its poses (frames, 4, 4), and what indices mean, by the names of a manifest."""
        scene = read_scene(self.plan / "scene")
        track = read_track(self.plan / "tracks" / clip, scene)
        listed = {kind: scene.header[kind] for kind in ("objects", "materials")}
        return listed | {
            "camera": track.camera or scene.header["camera"],
            "camera_to_world": track.camera_to_world,
        }


def _limit_files(size_bytes: int | None) -> None:
    """Limit the size of files that a child process can write, as if the disk were full; called before it starts."""
    if size_bytes is not None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size_bytes, size_bytes))


def plan(folder: Path, config: dict, *options: str) -> subprocess.CompletedProcess:
    """Plan a resolved config into `folder`/plan."""
    (folder / "plan").mkdir(parents=True)
    command = [sys.executable, "-B", str(ROOT / "blender_scripts" / "plan_scene.py"), "--config", "-"]
    command += ["--out", str(folder / "plan"), "--processes", "2", "--blender", BLENDER, *options]
    return subprocess.run(command, input=json.dumps(config), capture_output=True, text=True, check=False)


def render(
    folder: Path,
    config: dict,
    *options: str,
    threads: int = 2,
    out: Path | None = None,
    largest_file_bytes: int | None = None,
    script: Path | None = None,
) -> Run:
    """Plan a resolved config and render all its clips, by default into `folder`/out.

    `options` go to render_passes.py, or to `script` instead; with --clip among them, only those clips are rendered.
    """
    planned = plan(folder, config)
    assert planned.returncode == 0, planned.stderr
    out = out or folder / "out"
    script = script or ROOT / "blender_scripts" / "render_passes.py"
    clips = (
        []
        if "--clip" in options
        else ["--clip", *(clip["id"] for clip in json.loads(planned.stdout)["clips"])]
    )
    settings = ["--supersample", str(config["render"]["supersample"])]
    settings += ["--actor-layer"] if config["render"]["actor_layer"] else []
    reader, writer = os.pipe()
    command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-t", str(threads)]
    command += ["--python", str(script), "--", "--plan", str(folder / "plan"), "--out", str(out)]
    command += ["--events-fd", str(writer), *settings, *options, *clips]
    with open(reader, encoding="utf-8") as events:  # a pipe holds 64 KiB, far more than these few events
        done = subprocess.run(
            command,
            pass_fds=[writer],
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
            preexec_fn=lambda: _limit_files(largest_file_bytes),
        )
        os.close(writer)
        parsed = [json.loads(line) for line in events]
    return Run(done.returncode, folder / "plan", out, parsed, done.stdout + done.stderr)
