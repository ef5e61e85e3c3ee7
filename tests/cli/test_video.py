"""`veldt video`: sizes and frames, what is drawn where, and what is refused."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest

from passes import FRAMES, HEIGHT, WIDTH
from pictures import read_grey
from processes import PATIENCE_S, interrupt
from program import files_below
from reports import make_dataset

HUMAN = (0, 229, 255)  # colours of boxes
ELEPHANT = (124, 255, 107)


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips of made-up passes, without poses."""
    return make_dataset(veldt)


def _frames(file: Path) -> list[np.ndarray]:
    """All frames of a video or picture, (height, width, 3), read by OpenImageIO."""
    opened = OpenImageIO.ImageInput.open(str(file))
    assert opened is not None, OpenImageIO.geterror()
    frames = []
    while opened.seek_subimage(len(frames), 0):
        frames.append(opened.read_image("uint8")[..., :3].astype(int))
    opened.close()
    return frames


def _still(veldt, *options, source="out/clips/down", out="still.png") -> np.ndarray:
    done = veldt("video", source, "--out", out, *options, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    (picture,) = _frames(veldt.folder / out)
    return picture


def _place(changed: np.ndarray) -> tuple[slice, slice]:
    """Rows and columns of the smallest rectangle that holds all that is true."""
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _picture_place(veldt) -> tuple[slice, slice]:
    """Where a clip's frame is: two fixed scales, all at one end and all at the other, differ there and nowhere else."""
    cold = _still(veldt, "--range", "9000:10000")
    hot = _still(veldt, "--range", "0:0.001")
    return _place((cold != hot).any(axis=2))


# --- videos -----------------------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("dataset")
def test_a_video_of_a_dataset_shows_its_clips_in_a_grid(veldt):
    before = files_below(veldt.folder)
    done = veldt("video", "out", "--out", "v.mp4", "--boxes", "--tracks", "--scale", "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("v.mp4: 2 clips, 1920 x ") and ", 3 frames, 0.3 s, " in done.out
    assert files_below(veldt.folder) == sorted([*before, "v.mp4"])
    frames = _frames(veldt.folder / "v.mp4")
    still = _still(veldt, "--boxes", "--tracks", "--scale", "--frame", "0", source="out")
    assert len(frames) == FRAMES
    assert frames[0].shape == still.shape
    # A constant rate factor of 20 loses some levels in a few places; colour is stored at half the size.
    assert np.abs(frames[0] - still).mean() < 2


@pytest.mark.usefixtures("dataset")
def test_the_same_request_gives_the_same_bytes(veldt):
    for out in ("one.mp4", "two.mp4"):
        assert (
            veldt("video", "out", "--out", out, "--boxes", "--scale", "--quiet", "--width-px", "640").code
            == 0
        )
    assert (veldt.folder / "one.mp4").read_bytes() == (veldt.folder / "two.mp4").read_bytes()


@pytest.mark.usefixtures("dataset")
def test_progress_counts_frames(veldt):
    done = veldt(
        "video", "out", "--out", "v.mp4", "--clips", "side", "--width-px", "320", "--progress", "json"
    )
    lines = [json.loads(line) for line in done.err.splitlines()]
    assert [(line["clip"], line["frames_done"], line["frames_total"]) for line in lines] == [
        ("v.mp4", k, FRAMES) for k in range(1, FRAMES + 1)
    ]
    assert done.out.startswith("v.mp4: 1 clip, 320 x ")


def test_a_clip_may_be_named_by_its_folder(veldt, dataset):
    by_id = _still(veldt, "--clips", "down", source="out")
    assert (_still(veldt) == by_id).all()
    assert (_still(veldt, source=dataset / "clips" / "down") == by_id).all()


@pytest.mark.usefixtures("dataset")
def test_a_file_that_is_there_is_replaced(veldt):
    (veldt.folder / "still.png").write_text("something else", encoding="utf-8")
    assert _still(veldt).shape[1] == 1280


def test_clips_side_by_side_have_headings(veldt, dataset):
    dataset.rename(veldt.folder / "one")
    done = veldt("video", "one", "--out", "still.png", "--side-by-side", "one", "--scale")
    assert (done.code, done.err) == (0, "") and done.out.startswith("still.png: 2 clips, 1920 x ")
    (picture,) = _frames(veldt.folder / "still.png")
    half = picture.shape[1] // 2
    # Two columns of the same width, with the same content: all but what rounding of half widths moves.
    column = (picture.shape[1] - 18) // 2
    assert (picture[:, 18 : half - 20] == picture[:, 18 + column : half - 20 + column]).all()


def test_a_skipped_frame_holds_the_one_before(veldt, dataset):
    """Frame 1 is taken out of the clip's records; what was frame 0 stays, its time too."""
    frames = dataset / "clips" / "down" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    first = _still(veldt, "--frame", "0")
    assert (_still(veldt, "--frame", "1") != first).any()
    frames.write_text("\n".join([lines[0], lines[2]]) + "\n", encoding="utf-8")
    assert (_still(veldt, "--frame", "1") == first).all()
    assert (_still(veldt, "--frame", "2") != first).any()


def test_asked_to_stop_it_leaves_nothing(veldt, dataset):
    # Long enough to be stopped on the way: 4000 frames, all but the last ones as frame 1.
    frames = dataset / "clips" / "down" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    frames.write_text("\n".join([*lines[:2], lines[2].replace('"frame_index":2', '"frame_index":4000')]))
    (dataset / "clips" / "down" / "ir8" / "000002.png").rename(
        dataset / "clips" / "down" / "ir8" / "004000.png"
    )
    before = files_below(veldt.folder)
    run = veldt.start("video", "out/clips/down", "--out", "v.mp4", "--progress", "json")
    run.stderr.readline()
    interrupt(run.pid, signal.SIGINT)
    _, err = run.communicate(timeout=PATIENCE_S)
    assert run.returncode == 128 + signal.SIGINT
    assert "the same command" in err
    assert files_below(veldt.folder) == before


# --- what is drawn ----------------------------------------------------------------------------------------------------


def test_a_frame_is_shown_through_the_palette(veldt, dataset):
    """Pixels' middles, where enlarging leaves levels as they are, to one level."""
    levels = read_grey(dataset / "clips" / "down" / "ir8" / "000001.png").astype(int)
    place = _picture_place(veldt)
    white, black = (
        _still(veldt, "--palette", name, "--frame", "1")[place] for name in ("white_hot", "black_hot")
    )
    scale = white.shape[1] / WIDTH
    assert white.shape[0] == round(HEIGHT * scale)
    rows = ((np.arange(HEIGHT) + 0.5) * white.shape[0] / HEIGHT).astype(int)
    columns = ((np.arange(WIDTH) + 0.5) * scale).astype(int)
    # A middle is at most half a pixel of the video off, a 2 x scale'th of the step to the next pixel.
    step = max(np.abs(np.diff(levels, axis=0)).max(), np.abs(np.diff(levels, axis=1)).max())
    assert np.abs(white[np.ix_(rows, columns)] - levels[..., None]).max() <= 1 + 2 * step / scale
    assert (white + black == 255).all()


@pytest.mark.usefixtures("dataset")
def test_a_fixed_range_maps_kelvin_to_levels(veldt):
    counts = read_grey(veldt.folder / "out" / "clips" / "down" / "ir16" / "000001.png")
    kelvin = counts * veldt.read("out/dataset.json")["kelvin_per_count"]
    low, high = 200, 320
    expected = np.clip(np.floor((kelvin - low) / (high - low) * 256), 0, 255)
    place = _picture_place(veldt)
    shown = _still(veldt, "--frame", "1", "--range", f"{low}:{high}")[place]
    scale = shown.shape[1] / WIDTH
    rows = ((np.arange(HEIGHT) + 0.5) * shown.shape[0] / HEIGHT).astype(int)
    columns = ((np.arange(WIDTH) + 0.5) * scale).astype(int)
    step = max(np.abs(np.diff(expected, axis=0)).max(), np.abs(np.diff(expected, axis=1)).max())
    error = np.abs(shown[np.ix_(rows, columns)][..., 0] - expected)
    assert error.max() <= 2 + 2 * step / scale  # and one where a count is at the edge of a level


@pytest.mark.usefixtures("dataset")
def test_a_box_is_drawn_around_what_the_label_says(veldt):
    labels = veldt.read("out/clips/down/labels.json")
    names = {category["id"]: category["name"] for category in labels["categories"]}
    plain, boxed = _still(veldt, "--frame", "1"), _still(veldt, "--frame", "1", "--boxes")
    place = _picture_place(veldt)
    plain, boxed = plain[place], boxed[place]
    scale_x, scale_y = plain.shape[1] / WIDTH, plain.shape[0] / HEIGHT
    (image,) = (image["id"] for image in labels["images"] if image["frame_index"] == 1)
    shown = [label for label in labels["annotations"] if label["image_id"] == image]
    assert len(shown) == 2
    for label in shown:
        x, y, width, height = label["bbox"]
        left, right = _nearest(x * scale_x), _nearest((x + width) * scale_x)
        top, bottom = _nearest(y * scale_y), _nearest((y + height) * scale_y)
        colour = HUMAN if names[label["category_id"]] == "human" else ELEPHANT
        middle = (left + right) // 2
        assert tuple(boxed[top - 1, middle]) == colour  # the line is outside, and touches
        assert tuple(boxed[bottom, middle]) == colour
        assert tuple(boxed[(top + bottom) // 2, right]) == colour
        inside = (slice(top, bottom), slice(left, right))
        assert (boxed[inside] == plain[inside]).all()  # and the target stays free


def _nearest(value: float) -> int:
    """Halves go up, as std::lround has it; Python's round() goes to even numbers."""
    return int(np.floor(value + 0.5))


def _tick_rows(picture: np.ndarray, bar: tuple[slice, slice]) -> np.ndarray:
    """Rows of the marks beside the bar: the middle one of each."""
    column = picture[:, bar[1].stop + 1]
    marked = (column == (150, 161, 172)).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], marked, [False]]).astype(int)))
    return edges[::2]


def _bar_place(veldt) -> tuple[slice, slice]:
    """Where the bar's colours are: the last columns that differ in another palette."""
    white, black = (_still(veldt, "--scale", "--palette", name) for name in ("white_hot", "black_hot"))
    differ = (white != black).any(axis=2)
    columns = differ.any(axis=0)
    end = np.flatnonzero(columns)[-1] + 1
    start = end - np.argmin(columns[:end][::-1])
    differ[:, :start] = False
    return _place(differ)


def test_labels_of_the_bar_are_true(veldt, dataset):
    """A frame's curve is made known: levels of 0.1 K from 270 K. Marks are then 2.5 K apart."""
    first_k, step_k = 270.0, 0.1

    def set_curve(line: str) -> str:
        frame = json.loads(line)
        frame["agc"]["thresholds"] = [round(100 * (first_k + step_k * k)) for k in range(255)]
        return json.dumps(frame)

    frames = dataset / "clips" / "down" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    frames.write_text("\n".join(map(set_curve, lines)) + "\n", encoding="utf-8")
    bar = _bar_place(veldt)
    picture = _still(veldt, "--scale")
    # The bar's bands: level 0 at its foot, 255 at its head, of equal height.
    height = bar[0].stop - bar[0].start
    shown = picture[bar][:, 3, 0]
    expected = 255 - np.floor((np.arange(height) + 0.5) * 256 / height)
    assert np.abs(shown - expected).max() <= 1
    # Where the curve says that 272.5 K … are: level 1 begins at the first threshold.
    kelvin = np.arange(270, 295.1, 2.5)
    place = (1 + (kelvin - first_k) / step_k) / 256
    rows = bar[0].stop - 1 - place * (height - 1)
    marks = _tick_rows(picture, bar)[::-1]
    assert len(marks) == len(kelvin)
    assert np.abs(marks - rows).max() <= 1
    # Other temperatures, the same places: the letters differ, and nothing but they.
    first_k = 170.0
    frames.write_text("\n".join(map(set_curve, lines)) + "\n", encoding="utf-8")
    other = _still(veldt, "--scale")
    changed = _place((picture != other).any(axis=2))
    assert changed[1].start > bar[1].stop
    assert (_tick_rows(other, bar)[::-1] == marks).all()


@pytest.mark.usefixtures("dataset")
def test_the_bar_of_a_fixed_range_ends_with_it(veldt):
    bar = _bar_place(veldt)
    marks = _tick_rows(_still(veldt, "--scale", "--range", "250:300"), bar)
    assert abs(marks[0] - bar[0].start) <= 1 and abs(marks[-1] - (bar[0].stop - 1)) <= 1
    assert np.abs(np.diff(marks, n=2)).max() <= 1  # evenly


def test_a_closed_shutter_is_marked(veldt, dataset):
    frames = dataset / "clips" / "down" / "frames.jsonl"
    before = _still(veldt, "--frame", "1")
    frames.write_text(
        frames.read_text(encoding="utf-8").replace('"ffc":false', '"ffc":true'), encoding="utf-8"
    )
    after = _still(veldt, "--frame", "1")
    assert (after == (255, 196, 0)).all(axis=2).any() and not (before == (255, 196, 0)).all(axis=2).any()


@pytest.mark.usefixtures("dataset")
def test_tracks_are_drawn_behind_targets(veldt):
    """The walker goes one pixel to the right a frame: his trail is to the left of his box, in his colour."""
    place = _picture_place(veldt)
    plain, tracked = (_still(veldt, "--frame", "2", *options)[place] for options in ((), ("--tracks",)))
    scale = plain.shape[1] / WIDTH
    rows, columns = _place((plain != tracked).any(axis=2))
    x, y, width, height = 10, 5, 2, 4  # of the walker in frame 2, as passes.py draws him
    assert columns.start >= (x - 2 + width / 2 - 0.5) * scale  # from the middle of his box two frames ago
    assert columns.stop <= round((x + width) * scale)
    assert rows.start >= y * scale and rows.stop <= (y + height) * scale
    line = tracked[rows, columns].reshape(-1, 3)
    assert (line[:, 2] > line[:, 0] + 60).any()  # cyan
