"""The configs that come with Veldt can be generated: they pass all checks that `generate` makes before it renders."""

import json

import pytest

from program import ROOT

CONFIGS = [
    file
    for file in sorted((ROOT / "configs").glob("*.json"))
    if "variants" not in json.loads(file.read_text())
]


@pytest.mark.parametrize("config", CONFIGS, ids=lambda file: file.stem)
def test_it_is_valid(veldt, config):
    done = veldt("validate", config, "--progress", "none")  # the savanna takes long
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith(f"{config}: ")


def test_there_are_such_configs():
    assert {"demo", "savanna", "airsim_w"} <= {file.stem for file in CONFIGS}
