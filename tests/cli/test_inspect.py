"""`inspect` reports what passes contain and how `convert` would read them."""

import shutil

import numpy as np
import OpenImageIO
import pytest

import passes
from foreign_passes import MATTES, write_colours, write_cryptomatte, write_png
from pictures import write_exr

SIZE = passes.HEIGHT * passes.WIDTH
INDEX = np.array([[0, 1, 1], [1, 1, 7]])
NO_MANIFEST = [
    "  meanings   unknown: no manifest.json; to start one",
    "             veldt inspect one --starter-manifest one/manifest.json",
]


@pytest.fixture(name="clip")
def _clip(veldt):
    return passes.write_clip(veldt.folder / "one")


@pytest.fixture(name="folder")
def _folder(veldt):
    """An empty folder."""
    (veldt.folder / "one").mkdir()
    return veldt.folder / "one"


def _lines(veldt, *arguments):
    done = veldt("inspect", *arguments)
    assert (done.code, done.err) == (0, "")
    return done.out.splitlines()


def test_in_words(veldt, clip):
    index = passes.object_index(0)
    pixels = {number: f"{np.count_nonzero(index == number):>9} px" for number in (0, 1, 4, 101, 102)}
    assert _lines(veldt, "one/000000.exr") == [
        "one/000000.exr",
        "  24 x 16 px, compression none",
        "layer Scene",
        "  Depth                    Z          float  depth",
        "  IndexOB                  X          float  object index",
        "object indices",
        f"      0 {pixels[0]}  sky",
        f"      1 {pixels[1]}  ground",
        f"      4 {pixels[4]}  shrub",
        f"    101 {pixels[101]}  walker",
        f"    102 {pixels[102]}  cow",
        "depth",
        "  40.00 m to 40.00 m",
        "conversion",
        "  objects    Scene.IndexOB.X",
        "  materials  those of the objects",
        "  depth      Scene.Depth.Z",
        "  normals    none",
        "  meanings   the manifest's",
    ]
    assert clip.exists()


def test_a_folder_shows_its_first_frame_and_counts_them(veldt, clip):
    report = veldt("inspect", "one", "--json").json()
    assert (report["file"], report["files"], report["frames_read"]) == ("one/000000.exr", 3, 1)
    assert _lines(veldt, clip)[1] == "  24 x 16 px, compression none; the first of 3 files"


def test_all_frames(veldt, clip):
    (clip / "000001.exr").unlink()
    lines = _lines(veldt, "one", "--all-frames", "--progress", "none")
    both = sum(np.count_nonzero(passes.object_index(k) == passes.WALKER) for k in (0, 2))
    assert lines[1:3] == ["  24 x 16 px, compression none; the first of 2 files", "  missing: 000001.exr"]
    assert "object indices, of 2 frames" in lines
    assert f"    101 {both:>9} px  walker" in lines
    at = lines.index("depth, of 2 frames")
    assert lines[at + 1] == "  40.00 m to 42.00 m"


def test_progress_of_all_frames(veldt, clip):
    done = veldt("inspect", clip, "--all-frames", "--progress", "json")
    assert [line.split('"frames_done":')[1][0] for line in done.err.splitlines()] == ["1", "2", "3"]
    assert '"clip":"one"' in done.err and '"frames_total":3' in done.err


def test_in_json(veldt, clip):
    write_exr(
        clip / "000001.exr", {passes.OBJECTS: passes.object_index(1), "Scene.IndexMA.X": np.zeros((16, 24))}
    )
    report = veldt("inspect", "one/000001.exr", "--json").json()
    objects = report.pop("objects")
    channel = {"part": 0, "layer": "Scene", "component": "X", "type": "float", "compression": "ZIP"}
    assert report == {
        "file": "one/000001.exr",
        "files": 1,
        "missing": [],
        "frames_read": 1,
        "width_px": 24,
        "height_px": 16,
        "compression": "ZIP",
        "channels": [
            channel | {"name": "Scene.IndexMA.X", "pass": "IndexMA"},
            channel | {"name": "Scene.IndexOB.X", "pass": "IndexOB"},
        ],
        "materials": [{"index": 0, "pixels": SIZE}],
        "colours": [],
        "cryptomattes": [],
        "cryptomatte_faults": [],
        "depth": None,
        "bad_frames": [],
        "conversion": {
            "possible": True,
            "obstacle": None,
            "object_index": "Scene.IndexOB.X",
            "cryptomatte": None,
            "material_index": "Scene.IndexMA.X",
            "depth": None,
            "normal": None,
            "likely_object_index": [],
            "has_manifest": True,
        },
    }
    assert [entry["index"] for entry in objects] == [0, 1, 4, 101, 102]
    assert sum(entry["pixels"] for entry in objects) == SIZE


def test_overscan_is_reported(veldt, clip):
    document = passes.manifest() | {"overscan_px": 2}
    document["camera"] = document["camera"] | {"width_px": 20, "height_px": 12}
    passes.write_manifest(clip, document)
    assert _lines(veldt, "one")[2] == "  overscan: 2 camera px on every side"
    assert veldt("inspect", "one", "--json").json()["overscan_px"] == 2


def test_without_a_manifest(veldt, clip):
    (clip / "manifest.json").unlink()
    report = veldt("inspect", "one", "--json").json()
    assert [entry["name"] for entry in report["objects"]] == ["sky", "", "", "", ""]
    assert not report["conversion"]["has_manifest"]
    assert _lines(veldt, "one")[-2:] == NO_MANIFEST


def test_a_manifest_elsewhere(veldt, clip):
    shutil.move(clip / "manifest.json", veldt.folder / "elsewhere.json")
    lines = _lines(veldt, "one", "--manifest", "elsewhere.json")
    assert lines[-1] == "  meanings   the manifest's"
    assert any(line.endswith("walker") for line in lines)


def test_an_index_the_manifest_lacks_is_marked(veldt, clip):
    passes.change_index(clip, 0, 77)
    names = {entry["index"]: entry["name"] for entry in veldt("inspect", "one", "--json").json()["objects"]}
    assert names[77] == "not in the manifest"


# --- what other programs write ----------------------------------------------------------------------------------------


def test_several_layers(veldt, folder):
    planes = {f"{layer}.{name}": INDEX for layer in ("Far", "Near") for name in ("IndexOB.X", "Depth.Z")}
    write_exr(folder / "1.exr", planes | {"Near.Combined.R": INDEX, "Near.Combined.G": INDEX})
    lines = _lines(veldt, "one")
    assert lines[2:] == [
        "layer Far",
        "  Depth                    Z          float",
        "  IndexOB                  X          float",
        "layer Near",
        "  Combined                 G R        float",
        "  Depth                    Z          float",
        "  IndexOB                  X          float",
        "conversion",
        "  cannot be converted: IndexOB is in several layers: Far, Near; expected the manifest's"
        ' "layer" to name one',
        "  --layer Far inspects that one",
    ]
    lines = _lines(veldt, "one", "--layer", "Near")
    assert "  IndexOB                  X          float  object index" in lines
    assert "  objects    Near.IndexOB.X" in lines


def test_a_channel_of_whole_numbers_is_proposed(veldt, folder):
    write_exr(
        folder / "1.exr",
        {"id.V": INDEX, "flat.V": INDEX * 0 + 3, "half.V": INDEX / 2, "R": INDEX, "minus.V": -INDEX},
    )
    report = veldt("inspect", "one", "--json").json()
    assert report["conversion"]["likely_object_index"] == ["id.V"]
    assert _lines(veldt, "one")[-2:] == [
        "  cannot be converted: no object index channel; expected one such as Scene.IndexOB.X; the file has: R, flat.V,"
        " half.V, id.V, minus.V",
        '  id.V holds whole numbers: "channels": {"object_index": "id.V"} selects it',
    ]


def test_a_cryptomatte(veldt, folder):
    write_cryptomatte(folder / "1.exr")
    lines = _lines(veldt, "one")
    at = lines.index("cryptomatte ViewLayer.CryptoObject")
    assert lines[at : at + 5] == [
        "cryptomatte ViewLayer.CryptoObject",
        "          3 px  Ground",
        "          2 px  Elephant.001",
        "          1 px  (nothing)",
        "          0 px  thin wire",
    ]
    assert "  objects    cryptomatte ViewLayer.CryptoObject" in lines
    (found,) = veldt("inspect", "one", "--json").json()["cryptomattes"]
    assert found["name"] == "ViewLayer.CryptoObject"
    assert {matte["name"]: matte["pixels"] for matte in found["mattes"]} == MATTES | {None: 1}


CRYPTOMATTE_FAULTS = {
    "hash": 'hash = "md5"; expected "MurmurHash3_32"',
    "manifest": "manifest = 3 characters; expected a JSON object of names and their hashes",
}


@pytest.mark.parametrize("field", CRYPTOMATTE_FAULTS)
def test_a_cryptomatte_with_a_fault(veldt, folder, field):
    write_cryptomatte(folder / "1.exr", fields={field: "md5"})
    lines = _lines(veldt, "one")
    at = lines.index("cryptomatte faults")
    assert lines[at + 1] == f"  cryptomatte ViewLayer.CryptoObject: {CRYPTOMATTE_FAULTS[field]}"
    if field == "manifest":
        assert "          3 px  (3f000001, no name in the file)" in lines


def test_colours_of_a_picture(veldt, folder):
    write_colours(folder / "1.png")
    lines = _lines(veldt, "one")
    assert lines == [
        "one/1.png",
        "  3 x 2 px",
        "colours",
        "  [0, 255, 0]         3 px",
        "  [255, 0, 0]         2 px",
        "  [0, 0, 0]         1 px",
        "conversion",
        "  objects    the picture",
        "  materials  those of the objects",
        "  depth      none",
        "  normals    none",
        *NO_MANIFEST,
    ]


def test_greys_of_a_picture_are_indices(veldt, folder):
    write_png(folder / "1.png", INDEX.astype(np.uint16) * 300)
    assert [entry["index"] for entry in veldt("inspect", "one", "--json").json()["objects"]] == [0, 300, 2100]


def test_an_index_plane_that_is_not_set(veldt, folder):
    """Blender writes zeros if no object has a pass index; the cryptomatte identifies the objects."""
    write_cryptomatte(folder / "1.exr", planes={"ViewLayer.IndexOB.X": np.zeros((2, 3))})
    lines = _lines(veldt, "one")
    assert "  objects    cryptomatte ViewLayer.CryptoObject" in lines
    assert "  IndexOB                  X          float" in lines


def test_a_data_window_that_is_not_the_picture(veldt, folder):
    spec = OpenImageIO.ImageSpec(3, 2, 1, "float")
    spec.channelnames = ("IndexOB.X",)
    spec.x, spec.y, spec.full_x, spec.full_y, spec.full_width, spec.full_height = 4, 1, -1, 0, 10, 8
    out = OpenImageIO.ImageOutput.create(str(folder / "1.exr"))
    assert out.open(str(folder / "1.exr"), spec) and out.write_image(INDEX.astype(np.float32))
    out.close()
    lines = _lines(veldt, "one")
    assert lines[1:3] == ["  10 x 8 px, compression ZIP", "  pixels only in 3 x 2 px from (5, 1)"]
    window = {"x_px": 5, "y_px": 1, "width_px": 3, "height_px": 2}
    assert veldt("inspect", "one", "--json").json()["data_window"] == window


def test_long_lists_are_cut_in_words_alone(veldt, folder):
    write_exr(folder / "1.exr", {"IndexOB.X": np.arange(60).reshape(6, 10)})
    lines = _lines(veldt, "one")
    assert lines[2] == "no layer"
    at = lines.index("object indices")
    assert lines[at + 40 : at + 43] == [
        "     39         1 px",
        "  … and 20 more; --json lists them",
        "conversion",
    ]
    assert len(veldt("inspect", "one", "--json").json()["objects"]) == 60


def test_material_indices(veldt, folder):
    write_exr(folder / "1.exr", {"S.IndexOB.X": INDEX, "S.IndexMA.X": INDEX // 2})
    lines = _lines(veldt, "one")
    at = lines.index("material indices")
    assert lines[at + 1 : at + 3] == ["      0         5 px", "      3         1 px"]


def test_names_are_wide_as_they_must_be_and_lines_fit_a_terminal(veldt, clip):
    assert clip.exists()
    assert max(map(len, _lines(veldt, "one"))) <= 100


# --- what cannot be converted -----------------------------------------------------------------------------------------


def test_passes_that_cannot_be_converted_are_described_all_the_same(veldt, clip):
    write_exr(clip / "000000.exr", {"Scene.Depth.Z": np.full((16, 24), 12.5)})
    report = veldt("inspect", "one", "--json").json()
    assert report["objects"] == []
    assert report["depth"] == {"nearest_m": 12.5, "farthest_m": 12.5}
    assert report["conversion"]["obstacle"] == (
        "no object index channel; expected one such as Scene.IndexOB.X; the file has: Scene.Depth.Z"
    )


def test_an_invalid_index_is_reported(veldt, clip):
    passes.change_index(clip, 0, -3)
    report = veldt("inspect", "one", "--json").json()
    assert [channel["name"] for channel in report["channels"]] == [passes.OBJECTS]
    assert report["conversion"]["obstacle"] == (
        f"{passes.OBJECTS} at pixel (3, 2) = -3; expected a whole number from 0 to 32767"
    )


def test_bad_frames_of_all(veldt, clip):
    passes.change_index(clip, 1, -3)
    (clip / "000002.exr").write_bytes(b"not an EXR file")
    lines = _lines(veldt, "one", "--all-frames", "--progress", "none")
    at = lines.index("bad frames")
    assert lines[at + 1 : at + 4] == [
        f"  000001.exr: {passes.OBJECTS} at pixel (3, 2) = -3; expected a whole number from 0 to 32767",
        "  000002.exr: not an EXR file (wrong first bytes)",
        "conversion",
    ]


def test_another_size_than_the_manifests(veldt, clip):
    write_exr(clip / "000000.exr", {passes.OBJECTS: INDEX})
    assert veldt("inspect", "one", "--json").json()["conversion"]["obstacle"] == (
        "size = 3 x 2 px; expected the manifest's 24 x 16 px"
    )


FAULTS = {
    "missing": (
        ["none.exr"],
        2,
        'passes = none.exr; expected a folder of passes, files of passes or a pattern such as "passes/f_####.exr"',
    ),
    "no EXR": (["text.exr"], 1, "cannot read text.exr: not an EXR file (wrong first bytes)"),
    "folder without frames": (
        ["empty"],
        1,
        "empty holds no passes; expected .exr files, or .png files of indices",
    ),
    "none of what the manifest lists": (
        ["bare"],
        1,
        "bare holds none of the 3 files that its manifest lists",
    ),
    "more pixels than allowed": (
        ["one", "--max-megapixels", "0.0001"],
        1,
        "cannot read one/000000.exr: part 0: dataWindow = 24 x 16 px, 0.000384 megapixels; expected at most 0.0001 (see"
        " --max-megapixels)",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(veldt, clip, name):
    what, code, message = FAULTS[name]
    (veldt.folder / "empty").mkdir()
    (veldt.folder / "bare").mkdir()
    shutil.copy(clip / "manifest.json", veldt.folder / "bare")
    veldt.write("text.exr", "not an EXR file")
    done = veldt("inspect", *what)
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
