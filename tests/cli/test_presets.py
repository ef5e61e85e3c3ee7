"""The Python and the C++ side resolve a config alike."""

import json
import sys

import pytest

import passes
from program import ROOT

sys.path.insert(0, str(ROOT / "blender_scripts"))

from veldt.config import resolve  # pylint: disable=wrong-import-position

PRESETS = sorted(file.stem for file in (ROOT / "assets" / "sensors").glob("*.json"))


@pytest.mark.parametrize("preset", PRESETS)
def test_a_preset_means_the_same_on_both_sides(veldt, preset):
    config = {
        "name": "both",
        "sensor": {"preset": preset, "noise": {"row_ratio": 0.3}},
        "camera": {"distortion": {"k1": 0}},  # these passes have no overscan
        "clips": [{"id": "one", "season": "winter", "frames": passes.FRAMES}],
    }
    veldt.write("config.json", config)
    clip = passes.write_clip(veldt.folder / "one", "one")
    done = veldt("convert", clip, "--out", "out", "--config", "config.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    there = veldt.read("out/dataset.json")["config"]
    assert there["render"].pop("overscan_px") == 0  # worked out on that side alone
    assert there == json.loads(json.dumps(resolve(config)))
