"""`veldt view`: the files of the page, what they say of each frame, and what is refused."""

from __future__ import annotations

import base64
import json
from pathlib import Path

import numpy as np
import pytest

import passes
from pictures import write_exr
from program import ROOT, check_fault, files_below
from reports import CLIPS, change, flown_config, make_dataset

CODE = ["style.css", "elements.js", "view.css", "png.js", "frames.js", "masks.js", "drawing.js", "panels.js"]
CODE += ["keys.js", "screen.js", "page.js"]
PALETTES = ["white_hot", "black_hot", "ironbow", "rainbow", "inferno", "viridis", "turbo"]


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips of made-up passes, without poses."""
    return make_dataset(veldt)


def _argument(file: Path, function: str) -> dict:
    """What a script of the page's data hands to a function, and nothing else is in it."""
    text = file.read_text(encoding="ascii")
    assert text.startswith(f"{function}(") and text.endswith(");\n")
    return json.loads(text[len(function) + 1 : -3])


def _page(folder: Path) -> dict:
    return _argument(folder / "data" / "dataset.js", "takeDataset")


def _frame(folder: Path, clip: str, frame: int) -> dict:
    return _argument(folder / "data" / clip / f"{frame:06d}.js", "takeFrame")


def _view(veldt, *options, out: str = "page"):
    return veldt("view", "out", "--out", out, "--progress", "none", *options)


def _make(veldt, *options, out: str = "page") -> Path:
    done = _view(veldt, "--quiet", *options, out=out)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt.folder / out


# --- files ------------------------------------------------------------------------------------------------------------


def test_the_page_and_its_data_are_one_folder(veldt, dataset):
    before = files_below(dataset)
    done = _view(veldt)
    page = veldt.folder / "page"
    kilobytes = -(-sum((page / name).stat().st_size for name in files_below(page)) // 1000)
    assert (done.code, done.err) == (0, "")
    assert done.out == f"page: 2 clips, 6 frames, {kilobytes} kB; open page/index.html in a browser\n"
    frames = [f"data/{clip}/{k:06d}.js" for clip in CLIPS for k in range(passes.FRAMES)]
    code = [f"code/{name}" for name in CODE]
    assert files_below(page) == sorted([*code, *frames, "data/dataset.js", "index.html", "view.json"])
    assert files_below(dataset) == before
    assert veldt.read("page/view.json") == {
        "format": "veldt-view",
        "version": 1,
        "veldt_version": veldt("--version").out.strip(),
        "dataset": "made_up",
        "clips": 2,
        "frames": 6,
    }


@pytest.mark.usefixtures("dataset")
def test_the_page_names_all_its_files_and_no_others(veldt):
    page = _make(veldt)
    text = (page / "index.html").read_text(encoding="utf-8")
    assert all(f'"code/{name}"' in text for name in CODE)
    assert "//" not in text  # of addresses elsewhere
    assert "default-src 'none'; script-src 'self'; style-src 'self';" in text
    for name in CODE[2:]:
        assert (page / "code" / name).read_bytes() == (ROOT / "assets" / "view" / name).read_bytes()


@pytest.mark.usefixtures("dataset")
def test_the_same_dataset_gives_the_same_bytes(veldt):
    pages = [_make(veldt, "--threads", threads, out=f"page_{threads}") for threads in ("1", "2")]
    names = files_below(pages[0])
    assert names == files_below(pages[1])
    assert all((pages[0] / name).read_bytes() == (pages[1] / name).read_bytes() for name in names)


@pytest.mark.usefixtures("dataset")
def test_an_earlier_page_is_replaced_as_a_whole(veldt):
    page = _make(veldt)
    (page / "data" / "old.js").write_text("", encoding="utf-8")
    _make(veldt, "--clips", "side", out="page/")
    assert not [name for name in files_below(page) if "down" in name or "old" in name]
    assert sorted(veldt.folder.glob("page*")) == [page]


def test_an_empty_folder_is_used(veldt, dataset):
    (veldt.folder / "page").mkdir()
    assert _page(_make(veldt))["name"] == "made_up" and dataset.exists()


def test_clips_can_be_chosen(veldt, dataset):
    assert [clip["id"] for clip in _page(_make(veldt, "--clips", "side,down,side"))["clips"]] == [
        "side",
        "down",
    ]
    done = veldt("view", dataset / "clips" / "side", "--out", "one", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert [clip["id"] for clip in _page(veldt.folder / "one")["clips"]] == ["side"]


# --- what they say ----------------------------------------------------------------------------------------------------


def test_clips_are_described(veldt, dataset):
    record = json.loads((dataset / "dataset.json").read_text(encoding="utf-8"))
    page = _page(_make(veldt))
    assert (page["name"], page["kelvin_per_count"]) == ("made_up", record["kelvin_per_count"])
    assert page["not_made"] == []
    assert [clip["id"] for clip in page["clips"]] == list(CLIPS)
    assert page["clips"][0] == {
        "id": "down",
        "season": record["clips"][0]["season"],
        "camera": record["config"]["sensor"].get("preset", record["config"]["sensor"]["model"]),
        "frame_rate_hz": 9.0,
        "width_px": 24,
        "height_px": 16,
        "black_hot": False,
        "agc_mode": record["config"]["sensor"]["agc"]["mode"],
        "frames": [[0, 3]],
        "closed": [],
        "seen": [[0, 3]],
        "categories": [{"name": "human", "colour": "#00e5ff"}, {"name": "elephant", "colour": "#7cff6b"}],
        "targets": [{"category": 0, "count": 1}, {"category": 1, "count": 1}],
    }


@pytest.mark.usefixtures("dataset")
def test_palettes_are_those_of_videos(veldt):
    palettes = {p["name"]: base64.b64decode(p["colours"]) for p in _page(_make(veldt))["palettes"]}
    assert list(palettes) == PALETTES
    grey = bytes(level for level in range(256) for _ in range(3))
    assert palettes["white_hot"] == grey and palettes["black_hot"] == grey[::-1]
    assert tuple(palettes["ironbow"][:3]) == (0, 0, 12) and tuple(palettes["ironbow"][-3:]) == (255, 254, 244)
    assert all(len(colours) == 768 for colours in palettes.values())


def test_frames_have_their_pictures_and_labels(veldt, dataset):
    page = _make(veldt)
    document = json.loads((dataset / "clips" / "down" / "labels.json").read_text(encoding="utf-8"))
    lines = (dataset / "clips" / "down" / "frames.jsonl").read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(map(json.loads, lines)):
        frame = _frame(page, "down", number)
        for kind in ("ir8", "ir16"):
            file = dataset / "clips" / "down" / kind / f"{number:06d}.png"
            assert base64.b64decode(frame[kind]) == file.read_bytes()
        assert (frame["clip"], frame["frame"], frame["time_s"]) == ("down", number, line["time_s"])
        assert "closed" not in frame and "agl_m" not in frame
        thresholds = np.array(line["agc"]["thresholds"]) * _page(page)["kelvin_per_count"]
        assert frame["levels_k"] == pytest.approx([thresholds[0], thresholds[-1]])
        own = [a for a in document["annotations"] if a["image_id"] == document["images"][number]["id"]]
        assert [(label["track"], label["box"], label["mask"]) for label in frame["labels"]] == [
            (a["track_id"], a["bbox"], a["segmentation"]["counts"]) for a in own
        ]
        assert [label.get("temperature_k") for label in frame["labels"]] == [a["temperature_k"] for a in own]


@pytest.mark.usefixtures("dataset")
def test_tracks_lie_where_targets_were(veldt):
    """Without poses: the middles of the walker's boxes; the elephant's are cut by the edge. A ninth of a second passes
    between frames, so that only the first and the newest point are kept."""
    page = _make(veldt)
    assert _frame(page, "down", 0)["trails"] == []
    boxes = [_frame(page, "down", k)["labels"][0]["box"] for k in (0, 2)]
    middles = [[x + width / 2, y + height / 2] for x, y, width, height in boxes]
    trail = {"category": 0, "track": 7, "points": [*middles[0], 0.2, *middles[1], 0]}
    assert _frame(page, "down", 2)["trails"] == [trail]


def test_heights_are_those_of_poses(veldt):
    make_dataset(veldt, flown_config())
    frame = _frame(_make(veldt), "down", 1)
    assert frame["agl_m"] == 40


def test_a_dataset_without_labels_has_a_page(veldt, dataset):
    for clip in CLIPS:
        change(dataset / "clips" / clip / "labels.json", lambda document: document.update(annotations=[]))
    page = _make(veldt)
    assert [(clip["seen"], clip["targets"]) for clip in _page(page)["clips"]] == [([], [])] * 2
    assert _frame(page, "side", 0)["labels"] == []


def test_frames_of_a_closed_shutter_are_marked(veldt, dataset):
    file = dataset / "clips" / "down" / "frames.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines()
    lines[1] = lines[1].replace('"ffc":false', '"ffc":true')
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    page = _make(veldt)
    assert [clip["closed"] for clip in _page(page)["clips"]] == [[[1, 1]], []]
    assert _frame(page, "down", 1)["closed"] is True and "closed" not in _frame(page, "down", 0)


def test_skipped_frames_are_gaps(veldt):
    folder = passes.write_clip(veldt.folder / "one", "one", 6)
    for frame in (0, 3, 4):
        (folder / f"{frame:06d}.exr").unlink()
    assert veldt("convert", folder, "--out", "out", "--quiet").code == 3
    page = _make(veldt)
    assert _page(page)["clips"][0]["frames"] == [[1, 2], [5, 1]]
    assert files_below(page / "data" / "one") == ["000001.js", "000002.js", "000005.js"]


def _write_wide(folder: Path) -> Path:
    """A clip of 48 x 20 px, of one frame."""
    passes.write_clip(folder, folder.name, 1)
    plane = np.full((20, 48), passes.GROUND, np.float32)
    plane[3:6, 40:44] = passes.WALKER
    write_exr(folder / "000000.exr", {passes.OBJECTS: plane, passes.DEPTH: np.full_like(plane, 40)})
    manifest = passes.manifest(folder.name, 1)
    manifest["camera"] |= {"width_px": 48, "height_px": 20, "cx_px": 24, "cy_px": 10}
    passes.write_manifest(folder, manifest)
    return folder


def test_clips_may_have_different_sizes(veldt):
    folders = [passes.write_clip(veldt.folder / "down", "down"), _write_wide(veldt.folder / "wide")]
    done = veldt("convert", *folders, "--out", "out", "--quiet")
    assert (done.code, done.err) == (0, "")
    page = _make(veldt)
    assert [(c["width_px"], c["height_px"]) for c in _page(page)["clips"]] == [(24, 16), (48, 20)]
    assert [label["box"] for label in _frame(page, "wide", 0)["labels"]] == [[40, 3, 4, 3]]


def test_local_gain_control_has_no_temperatures_of_levels(veldt):
    folder = passes.write_clip(veldt.folder / "one")
    done = veldt("convert", folder, "--out", "out", "--quiet", "--set", "sensor.agc.mode=clahe")
    assert (done.code, done.err) == (0, "")
    page = _make(veldt)
    assert _page(page)["clips"][0]["agc_mode"] == "clahe"
    assert "levels_k" not in _frame(page, "one", 0)


def test_names_are_text_whatever_is_in_them(veldt, dataset):
    hostile = '"); alert(1); //</script> \u2028 \\'
    change(dataset / "dataset.json", lambda record: record["config"].update(name=hostile))

    def rename(document):
        document["categories"][0]["name"] = hostile

    change(dataset / "clips" / "down" / "labels.json", rename)
    page = _page(_make(veldt))
    assert page["name"] == hostile and page["clips"][0]["categories"][0]["name"] == hostile


def test_a_clip_that_is_not_made_is_left_out_and_named(veldt, dataset):
    def fail(record):
        record["clips"][1] = {"id": "side", "status": "failed", "reason": "Blender was killed"}

    change(dataset / "dataset.json", fail)
    done = _view(veldt)
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("page: 1 clip, 3 frames, ")
    assert done.out.endswith("in a browser\nleft out, because not made: side\n")
    assert _page(veldt.folder / "page")["not_made"] == ["side"]
    check_fault(_view(veldt, "--clips", "side"), 1, "out: clip side is not made")
