"""`veldt.VideoChain`: what is drawn for a picture is a function of seed and number."""

import numpy as np
import pytest

from configs import QUIET_LINK
from veldt import ConfigError, VideoChain

DRAWN = {
    "processing": {"noise_filter_sigma_px": {"uniform": [0, 0.9]}, "unsharp_amount": {"uniform": [0.5, 1.5]}},
    "link": {"choice": [None, {"standard": "pal", "noise_levels": {"uniform": [2, 8]}}]},
    "field_motion_px": {"uniform": [-3, 3]},
}


def _picture() -> np.ndarray:
    rows, columns = np.mgrid[:40, :60]
    return (60 + columns + rows + 40 * (columns > 30)).astype(np.uint8)


def test_the_same_number_gives_the_same_picture_in_any_process_and_order():
    chain, other = VideoChain(DRAWN, seed=5), VideoChain(DRAWN, seed=5)
    pictures = [chain(_picture()) for _ in range(8)]
    for number in reversed(range(8)):
        assert np.array_equal(other(_picture(), number), pictures[number])
    assert not np.array_equal(pictures[0], pictures[1])
    assert not np.array_equal(VideoChain(DRAWN, seed=6)(_picture()), pictures[0])


def test_without_settings_a_picture_is_copied():
    picture = _picture()
    copy = VideoChain({})(picture)
    assert np.array_equal(copy, picture) and copy is not picture
    assert np.array_equal(VideoChain({"link": QUIET_LINK})(picture), picture)


def test_noise_is_white_without_a_filter_and_coloured_with_one():
    grey = np.full((200, 300), 128, np.uint8)
    white = VideoChain({"noise_levels": 12})(grey).astype(float) - 128
    assert white.std() == pytest.approx(12, rel=0.02)  # 5 deviations of 60,000 values are 1.5 %
    assert abs((white[:, 1:] * white[:, :-1]).mean()) < 0.02 * 144
    sigma_px = 0.8
    coloured = (
        VideoChain({"noise_levels": 12, "processing": {"noise_filter_sigma_px": sigma_px}})(grey) - 128.0
    )
    assert coloured.std() == pytest.approx(12 / (2 * np.sqrt(np.pi) * sigma_px), rel=0.05)
    next_px = (coloured[:, 1:] * coloured[:, :-1]).mean() / coloured.var()
    assert next_px == pytest.approx(np.exp(-1 / (4 * sigma_px**2)), abs=0.03)


def test_rows_are_combed_by_the_motion_from_field_to_field():
    columns = np.tile(np.arange(20, 120, 2, dtype=np.uint8), (30, 1))
    combed = VideoChain({"link": QUIET_LINK, "field_motion_px": 4})(columns).astype(int)
    assert np.all(combed[::2, 5:-5] - combed[1::2, 5:-5] == 8)


def test_an_unsharp_mask_leaves_halos():
    sharp = VideoChain({"processing": {"unsharp_amount": 1}})(_picture()).astype(int)
    step = sharp[20] - _picture()[20]
    assert step[30] < -5 and step[31] > 5
    assert abs(step[10]) <= 1


@pytest.mark.parametrize(
    "settings, message",
    [
        ({"lnk": {}}, "settings: lnk is not a known key"),
        ({"link": {}}, "settings: link.standard"),
        ({"noise_levels": -1}, "settings: noise_levels = -1"),
        ({"processing": {"unsharp_amount": -1}}, "settings: processing.unsharp_amount = -1"),
        ({"field_motion_px": {"uniform": [1]}}, "settings: field_motion_px"),
        ({"link": {"standard": "secam"}}, 'settings: link.standard = "secam"'),
    ],
)
def test_what_is_no_chain_is_refused(settings, message):
    with pytest.raises(ConfigError) as fault:
        VideoChain(settings)
    assert str(fault.value).startswith(message)


def test_what_is_no_picture_is_refused():
    with pytest.raises(ConfigError, match="picture = an array of float64; expected uint8"):
        VideoChain({})(np.zeros((3, 4)))
