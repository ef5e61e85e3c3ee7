"""The configs that come with Veldt can be generated: they pass all checks that `generate` makes before it renders."""

import json

import pytest

from program import ROOT

CONFIGS = [
    file
    for file in sorted((ROOT / "configs").glob("*.json"))
    if "variants" not in json.loads(file.read_text())
]


# Planning all clips takes long, and they are drawn alike.
def fewer_clips(config):
    clips = json.loads(config.read_text()).get("clips", [])
    counts = [(i, clip.get("count", 1)) for i, clip in enumerate(clips)]
    return [f"clips[{i}].count=8" for i, count in counts if count > 8]


@pytest.mark.parametrize("config", CONFIGS, ids=lambda file: file.stem)
def test_it_is_valid(veldt, config):
    settings = [f"--set={setting}" for setting in fewer_clips(config)]
    done = veldt("validate", config, *settings, "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith(f"{config}: ")


def test_there_are_such_configs():
    assert {"demo", "savanna", "airsim_w"} <= {file.stem for file in CONFIGS}
