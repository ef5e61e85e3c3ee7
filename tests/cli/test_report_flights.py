"""The map of a report: tracks are drawn on the place they were flown over, and on no other."""

import base64
import re

import numpy as np
import OpenImageIO
import pytest

import passes
from program import Veldt
from resolved import resolve
from reports import Page, change, flown_config, make_dataset, terrain_of


def _flights(veldt: Veldt) -> dict:
    """The flights in a report of the dataset `out`."""
    done = veldt("report", "out", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return Page(veldt.folder / "out" / "report.html").figures["flights"]


def test_without_poses_there_is_no_map(veldt):
    make_dataset(veldt)
    flights = _flights(veldt)
    assert flights["map"] == {"absent": "The passes of this dataset have no camera poses."}
    assert [track["points_m"] for track in flights["tracks"]] == [[], []]


def test_tracks_lie_on_the_map_of_their_place(veldt):
    make_dataset(veldt, flown_config())
    flights = _flights(veldt)
    down, side = flights["tracks"]
    assert down["points_m"] == [[20, -10], [20, -5], [20, 0]] and side["points_m"][2] == [30, -10]
    # 12 and 8 px off the middle, 30 px focal length, 40 m up: 16 m east and west, 10.67 m north and south.
    assert down["seen_m"] == [[4, 5.67], [36, 5.67], [36, -15.67], [4, -15.67]]
    place, window = flights["map"]["place"], flights["map"]["window"]
    assert (place["west_m"], place["south_m"], place["side_m"]) == (-60, -60, 120)
    corners = np.array([*down["seen_m"], *side["seen_m"]])
    low = np.array([window["west_m"], window["south_m"]])
    assert (corners > low).all() and (corners < low + window["side_m"]).all()


def test_a_known_point_is_where_the_map_shows_it(veldt):
    """Water has its position in the terrain: x to the right, y upwards, in the picture of the whole place."""
    config = flown_config()
    make_dataset(veldt, config)
    place = _flights(veldt)["map"]["place"]
    file = veldt.folder / "place.jpg"
    file.write_bytes(base64.b64decode(place["picture"].split(",", 1)[1]))
    rgb = np.asarray(OpenImageIO.ImageBuf(str(file)).get_pixels()).astype(float)
    side_px = rgb.shape[0]
    along_m = (np.arange(side_px) + 0.5) / side_px * place["side_m"]
    x_m, y_m = np.meshgrid(place["west_m"] + along_m, place["south_m"] + along_m[::-1])
    shore_m = terrain_of(resolve(config)).shore_m(x_m, y_m)
    blue = rgb[..., 2] > rgb[..., 0]
    assert (
        blue[shore_m < -1].all() and not blue[shore_m > 1].any()
    )  # a JPEG's border is a few pixels, 1 m, wide
    assert not np.array_equal(blue, blue[::-1])  # otherwise it would not detect a flipped map


@pytest.mark.parametrize("other", ["seed", "relief"])
def test_another_place_than_the_cameras_is_not_drawn(veldt, other):
    """Passes of one place, converted with the config of another."""
    dataset = make_dataset(veldt, flown_config())

    def move(record):
        if other == "seed":
            record["config"]["seed"] += 1
        else:
            record["config"]["scene"]["terrain"]["relief_m"] *= 2

    change(dataset / "dataset.json", move)
    flights = _flights(veldt)
    assert re.fullmatch(
        r"The ground of the config's place differs by up to \d\.\d m from the ground below the camera, so the passes "
        r"are not of that place, and it is not drawn\.",
        flights["map"]["absent"],
    )
    assert len(flights["tracks"][0]["points_m"]) == passes.FRAMES


def test_without_heights_the_place_cannot_be_verified(veldt):
    dataset = make_dataset(veldt, flown_config())
    frames = dataset / "clips" / "side" / "frames.jsonl"
    frames.write_text(frames.read_text(encoding="utf-8").replace('"agl_m":40.0,', ""), encoding="utf-8")
    assert _flights(veldt)["map"] == {
        "absent": "The passes do not say how high the camera flew above ground, so it is unknown whether they show "
        "the place of the config, and it is not drawn."
    }


def test_a_map_that_cannot_be_drawn_says_why(veldt):
    dataset = make_dataset(veldt, flown_config())

    def lose_heightmap(record):
        record["config"]["scene"]["terrain"]["heightmap"] = {"file": "missing.png", "height_m": [0, 5]}

    change(dataset / "dataset.json", lose_heightmap)
    reason = _flights(veldt)["map"]["absent"]
    assert reason.startswith("The place could not be drawn: ") and "missing.png" in reason
    done = veldt("report", "out", "--quiet", env={"VELDT_PYTHON": "/none"})
    assert (done.code, done.err) == (0, "")
    assert Page(dataset / "report.html").figures["flights"]["map"] == {
        "absent": "The place could not be drawn: no python3 on PATH."
    }
