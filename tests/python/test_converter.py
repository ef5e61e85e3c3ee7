"""`veldt.Converter` makes in memory what the program makes from files."""

import json

import numpy as np
import pytest

import passes
from veldt import ConfigError, Converter, DataError, open_dataset

PHYSICAL = ["sensor.preset=boson_640_14mm", "season=summer"]


def _planes(frame: int) -> dict:
    depth_m = np.full((passes.HEIGHT, passes.WIDTH), 40.0 + frame)
    depth_m[:2] = 1e10
    return {"object_index": passes.object_index(frame), "depth_m": depth_m}


def _check_same(converter, clip):
    assert len(converter) == len(clip)
    for number, in_file in enumerate(clip):
        made = converter.convert(number, **_planes(number))
        assert np.array_equal(made.ir16, in_file.ir16())
        assert np.array_equal(made.ir8, in_file.ir8())
        assert made.shutter_closed == in_file.shutter_closed
        assert [(label.category, label.box_px) for label in made.labels] == [
            (label.category, label.box_px) for label in in_file.labels
        ]
        for label, in_labels in zip(made.labels, in_file.labels, strict=True):
            assert label.values.items() <= in_labels.values.items()
            assert np.array_equal(label.mask(), in_labels.mask())


def test_frames_are_the_programs_to_the_bit(converted):
    dataset, folder = converted
    _check_same(Converter(folder / "manifest.json"), open_dataset(dataset)["one"])


def test_frames_of_the_physical_model_too(veldt, converted):
    done = veldt("convert", converted[1], "--out", "physical", "--quiet", "--set", *PHYSICAL)
    assert (done.code, done.err) == (0, "")
    clip = open_dataset(veldt.folder / "physical")["one"]
    _check_same(Converter(passes.manifest(), settings=PHYSICAL), clip)
    assert clip[2].labels[0].values["range_m"] > 40


def test_frames_left_out_pass_unseen():
    converter = Converter(passes.manifest())
    converter.convert(0, **_planes(0))
    assert converter.convert(2, **_planes(2)).ir8.shape == (passes.HEIGHT, passes.WIDTH)
    with pytest.raises(ConfigError, match="frame = 2; expected a number from 3 to 2"):
        converter.convert(2, **_planes(2))


def test_a_bad_plane_costs_nothing(converted):
    converter = Converter(converted[1] / "manifest.json")
    converter.convert(0, **_planes(0))
    bad = _planes(1) | {"object_index": np.full((16, 24), 999)}
    with pytest.raises(DataError, match="999"):
        converter.convert(1, **bad)
    with pytest.raises(DataError, match="object_index = 24 x 15 px; expected 24 x 16, as the manifest's"):
        converter.convert(1, object_index=_planes(1)["object_index"][1:])
    made = converter.convert(1, **_planes(1))
    assert np.array_equal(made.ir16, open_dataset(converted[0])["one"][1].ir16())


def test_faults_name_the_document(tmp_path):
    with pytest.raises(DataError, match="manifest: frame_rate_hz = -1"):
        Converter(passes.manifest() | {"frame_rate_hz": -1})
    file = tmp_path / "night.json"
    file.write_text(json.dumps({"name": "night", "sensors": {}}), encoding="utf-8")
    with pytest.raises(ConfigError, match="night.json: sensors"):
        Converter(passes.manifest(), file).convert(0, **_planes(0))
