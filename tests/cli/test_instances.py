"""Properties of labels other than box and mask, from made-up passes that are known to the last pixel."""

import numpy as np
import pytest

import passes
from labels import decode_rle
from pictures import read_grey, write_exr

IDEAL = ["sensor.optics.blur_sigma_px=0", "sensor.noise.amount=0"]
WALKER, COW = 7, 9  # tracks


@pytest.fixture(name="clip")
def _clip(veldt):
    """Passes of a clip with the actors alone in a layer of their own."""
    folder = passes.write_clip(veldt.folder / "one")
    passes.add_actor_layer(folder)
    return folder


def _labels(veldt, clip, *settings, out="out") -> dict:
    """Labels by (track, frame)."""
    done = veldt(
        "convert", clip, "--out", out, "--quiet", *(("--set", *IDEAL, *settings) if settings else ())
    )
    assert (done.code, done.out, done.err) == (0, "", "")
    labels = veldt.read(f"{out}/annotations.json")["annotations"]
    return {(label["track_id"], label["image_id"] - 1): label for label in labels}


def test_a_target_is_as_visible_as_its_share_of_the_actor_layer(veldt, clip):
    labels = _labels(veldt, clip)
    # Of the walker's 2 x 4 px the shrub hides the lower two of one column, then of both.
    assert [labels[WALKER, k]["visibility"] for k in range(3)] == [0.75, 0.5, 0.5]
    assert [labels[WALKER, k]["area"] for k in range(3)] == [6, 4, 4]
    assert [labels[WALKER, k]["bbox"] for k in range(3)] == [[8, 5, 2, 4], [9, 5, 2, 2], [10, 5, 2, 2]]
    assert [labels[WALKER, k]["amodal_bbox"] for k in range(3)] == [[8 + k, 5, 2, 4] for k in range(3)]
    assert all(labels[WALKER, k]["occluded"] for k in range(3))
    assert all(labels[WALKER, k]["truncated_fraction"] == 0 for k in range(3))
    cow = labels[COW, 0]
    assert (cow["visibility"], cow["occluded"], cow["truncated"]) == (1, False, True)
    # The share of the cow beyond the border is known from poses only.
    assert not {"amodal_bbox", "truncated_fraction", "range_m"} & set(cow)


def test_keys_come_in_their_order(veldt, clip):
    walker = _labels(veldt, clip)[WALKER, 0]
    assert list(walker) == [
        *("id", "image_id", "category_id", "bbox", "area", "segmentation", "iscrowd", "track_id"),
        *("amodal_bbox", "visibility", "occluded", "truncated", "truncated_fraction"),
        *("temperature_k", "contrast_k", "contrast_noise", "noisy", "ignore", "size_class"),
    ]


def test_a_frame_may_lack_the_layer(veldt, clip):
    write_exr(clip / "000001.exr", {passes.OBJECTS: passes.object_index(1)})
    labels = _labels(veldt, clip)
    assert ["visibility" in labels[WALKER, k] for k in range(3)] == [True, False, True]
    assert ["occluded" in labels[WALKER, k] for k in range(3)] == [True, False, True]
    assert labels[WALKER, 1]["amodal_bbox"] == [9, 5, 2, 2]  # as much as is known of it


def test_without_a_layer_labels_have_no_visibility(veldt):
    labels = _labels(veldt, passes.write_clip(veldt.folder / "one"))
    assert not any({"visibility", "occluded"} & set(label) for label in labels.values())
    assert not any(label["ignore"] for label in labels.values())


def test_the_layer_changes_no_pixel(veldt, clip):
    _labels(veldt, clip, out="layered")
    _labels(veldt, passes.write_clip(veldt.folder / "two", "one"), out="bare")
    assert veldt.pixels("layered") == veldt.pixels("bare")


def test_what_is_occluded_and_ignored_is_settable(veldt, clip):
    labels = _labels(veldt, clip, "labels.ignore_below_visibility=0.6", out="visible")
    assert [labels[WALKER, k]["ignore"] for k in range(3)] == [False, True, True]
    assert not labels[COW, 0]["ignore"]
    labels = _labels(veldt, clip, "labels.ignore_below_area_px=5", out="large")
    assert [labels[WALKER, k]["ignore"] for k in range(3)] == [False, True, True]
    labels = _labels(veldt, clip, "labels.occluded_below_visibility=0.5", out="hidden")
    assert not any(label["occluded"] for label in labels.values())
    assert veldt.read("hidden/dataset.json")["config"]["labels"]["occluded_below_visibility"] == 0.5


def test_a_target_is_as_warm_as_the_frame_shows_it(veldt, clip):
    """An ideal sensor's 16-bit frame holds apparent temperature, rounded to its step."""
    labels = _labels(veldt, clip, "seed=2")
    step_k = veldt.read("out/dataset.json")["kelvin_per_count"]
    for (_, k), label in labels.items():
        frame_k = step_k * read_grey(veldt.folder / "out" / "clips" / "one" / "ir16" / f"{k:06d}.png")
        shown_k = frame_k[decode_rle(label["segmentation"])]
        assert np.ptp(shown_k) == 0
        assert label["temperature_k"] == pytest.approx(shown_k[0], abs=0.5 * step_k + 1e-4)
        assert "contrast_noise" not in label  # there is no noise
    # About the walker there are sky, ground and shrub, all colder than a person.
    assert all(labels[WALKER, k]["contrast_k"] > 10 for k in range(3))


def test_contrast_in_units_of_noise_goes_by_the_netd(veldt, clip):
    white = [f"sensor.noise.{key}" for key in ("amount=1", "first_frame_ratio=0", "flicker_knee_hz=0")]
    once = _labels(veldt, clip, *white, "sensor.netd_mk=40", out="once")
    twice = _labels(veldt, clip, *white, "sensor.netd_mk=80", out="twice")
    for place, label in once.items():
        assert label["contrast_noise"] == pytest.approx(2 * twice[place]["contrast_noise"], abs=2e-4)
        # 40 mK of noise is at 300 K; between the two temperatures a kelvin is less radiance, by a quarter at the most.
        assert 0.75 < label["contrast_noise"] / (label["contrast_k"] / 0.04) < 1


BAD = {
    "a layer of another name": (
        {"layer": "Scene", "actor_layer": "Actor"},
        'actor_layer = "Actor"; expected a layer with an object index: Actors; did you mean "Actors"?',
    ),
    "the layer of everything": (
        {"actor_layer": "Scene"},
        "actor layer's object index at pixel (0, 2) = 1 (301 pixels); expected an index of the manifest's actors: "
        "0, 101, 102",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_wrong_layer_rejects_the_clip(veldt, clip, name):
    change, message = BAD[name]
    passes.write_manifest(clip, passes.manifest("one", frames=1) | change)
    done = veldt("convert", clip, "--out", "out", "--quiet")
    assert done.code == 1  # there was no other clip
    assert f"one/000000.exr: {message}" in done.err
    assert not (veldt.folder / "out" / "clips" / "one").exists()


@pytest.mark.parametrize(
    "setting, message",
    [
        (
            "labels.ignore_below_visibility=1.5",
            "labels.ignore_below_visibility = 1.5; expected at least 0 and at most 1",
        ),
        (
            "labels.ignore_below_area=3",
            "labels.ignore_below_area is not a known key; expected one of occluded_below_visibility, "
            "ignore_below_visibility, ignore_below_area_px",
        ),
    ],
)
def test_a_wrong_setting_is_a_usage_fault(veldt, clip, setting, message):
    done = veldt("convert", clip, "--out", "out", "--quiet", "--set", setting)
    assert (done.code, done.out) == (2, "")
    assert message in done.err
