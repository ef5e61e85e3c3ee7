"""`convert` reads cryptomattes: like an index plane where objects fill pixels, and as mean radiance elsewhere."""

import json

import numpy as np
import pytest

import mattes
import passes
from datasets import content_of
from pictures import read_grey
from program import ROOT

NAMES = {passes.GROUND: "ground", passes.SHRUB: "shrub", passes.WALKER: "walker", passes.ELEPHANT: "cow"}
IDEAL = ["sensor.optics.blur_sigma_px=0", "sensor.noise.amount=0"]


def _names(frame: int) -> np.ndarray:
    """What passes.object_index() shows, by name."""
    index = passes.object_index(frame)
    names = np.full(index.shape, "", dtype=object)
    for number, name in NAMES.items():
        names[index == number] = name
    return names


def _whole(frame: int) -> list[mattes.Rank]:
    """Every pixel belongs to a single object."""
    names = _names(frame)
    return [(names, (names != "").astype(np.float32))]


def _write(
    folder, ranks_of=_whole, manifest=None, listed=tuple(NAMES.values()), matte="ViewLayer.CryptoObject"
):
    """A clip whose frames are cryptomattes."""
    folder.mkdir()
    for frame in range(passes.FRAMES):
        planes = mattes.planes_of(ranks_of(frame), matte)
        mattes.write_exr_with_texts(folder / f"{frame:06d}.exr", planes, mattes.texts_of(listed, matte))
    document = passes.manifest(folder.name) | {"cryptomatte": "CryptoObject"} | (manifest or {})
    passes.write_manifest(folder, document)
    return folder


def _convert(veldt, folder, *options, out="out"):
    done = veldt("convert", folder.name, "--out", out, "--quiet", *options)
    assert (done.code, done.out, done.err) == (0, "", "")


def _same_as_by_index(veldt, folder, *options):
    """Check that the dataset equals that of an index plane, bit for bit."""
    _convert(veldt, folder, *options)
    passes.write_clip(veldt.folder / "index" / folder.name, has_depth=False)
    done = veldt("convert", f"index/{folder.name}", "--out", "by_index", "--quiet", *options)
    assert (done.code, done.err) == (0, "")
    assert veldt.pixels("out") == veldt.pixels("by_index")
    assert content_of(veldt.folder / "out") == content_of(veldt.folder / "by_index")


@pytest.fixture(autouse=True, name="index_folder")
def _index_folder(veldt):
    (veldt.folder / "index").mkdir()


def test_whole_pixels_make_the_dataset_of_an_index_plane(veldt):
    _same_as_by_index(veldt, _write(veldt.folder / "one"))


def test_names_in_a_file_beside_are_those_of_the_passes(veldt):
    """A pattern needs them. If they change, the clip is made again."""
    folder = _write(veldt.folder / "one", listed=None)
    key = next(iter(mattes.texts_of(None))).rsplit("/", 1)[0]
    for frame in range(passes.FRAMES):
        texts = mattes.texts_of(None) | {f"{key}/manif_file": "names.json"}
        mattes.write_exr_with_texts(folder / f"{frame:06d}.exr", mattes.planes_of(_whole(frame)), texts)
    document = passes.manifest("one") | {"cryptomatte": "CryptoObject"}
    document["objects"][1]["mattes"] = ["shr*"]
    passes.write_manifest(folder, document)
    names = {name: f"{mattes.murmur_hash(name):08x}" for name in NAMES.values()}
    (folder / "names.json").write_text(json.dumps(names), encoding="utf-8")
    _convert(veldt, folder)
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    (folder / "names.json").write_text("{}", encoding="utf-8")
    done = veldt("convert", "one", "--out", "out")
    assert done.code == 1
    assert "clip one: its manifest or its passes have changed; making it again\n" in done.err
    assert "expected the hash of a name among the manifest's objects: ground, shr*, walker, cow" in done.err


def test_names_missing_from_the_file_are_hashed(veldt):
    _same_as_by_index(veldt, _write(veldt.folder / "one", listed=None))


def test_a_cryptomatte_is_chosen_by_its_whole_name(veldt):
    whole_name = {"cryptomatte": "CryptoMaterial"}
    _same_as_by_index(veldt, _write(veldt.folder / "one", manifest=whole_name, matte="CryptoMaterial"))


def test_patterns_gather_names(veldt):
    """The ground consists of many pieces with different names."""

    def ranks_of(frame):
        ((names, coverage),) = _whole(frame)
        pieces = np.array(
            [[f"tile_{x % 5}.{y % 3}" for x in range(passes.WIDTH)] for y in range(passes.HEIGHT)], object
        )
        return [(np.where(names == "ground", pieces, names), coverage)]

    pieces = [f"tile_{x}.{y}" for x in range(5) for y in range(3)]
    document = passes.manifest("one")
    document["objects"][0]["mattes"] = ["tile_*"]
    folder = _write(
        veldt.folder / "one", ranks_of, {"objects": document["objects"]}, [*NAMES.values(), *pieces]
    )
    _same_as_by_index(veldt, folder)


def _edges(frame: int) -> list[mattes.Rank]:
    """The walker's pixels are 5/8 walker, 1/4 shrub and sky otherwise; the elephant's are 3/8 elephant."""
    names = _names(frame)
    coverage = (names != "").astype(np.float32)
    coverage[names == "walker"] = 0.625
    coverage[names == "cow"] = 0.375
    second = np.where(names == "walker", "shrub", "").astype(object)
    return [(names, coverage), (second, np.where(names == "walker", 0.25, 0).astype(np.float32))]


def _radiance(veldt, name: str) -> float:
    """Of a material in winter."""
    material = veldt.read(ROOT / "assets" / "materials" / f"{name}.json")
    asked = ["--temperature-k", material["winter_k"], "--emissivity", material["emissivity"], "--json"]
    return veldt("radiance", *asked).json()["values"][0]["radiance_w_m2_sr"]


def _apparent_k(veldt, radiance: float) -> float:
    return veldt("radiance", "--radiance", radiance, "--json").json()["values"][0]["temperature_k"]


def test_shared_pixels_are_the_mean_of_their_radiances(veldt):
    _convert(veldt, _write(veldt.folder / "one", _edges), "--set", *IDEAL)
    step_k = veldt.read("out/dataset.json")["kelvin_per_count"]
    frame = read_grey(veldt.folder / "out" / "clips" / "one" / "ir16" / "000000.png")
    sky, human, shrub, elephant = (_radiance(veldt, name) for name in ("sky", "human", "shrub", "elephant"))
    index = passes.object_index(0)
    expected = {
        passes.WALKER: 0.625 * human + 0.25 * shrub + 0.125 * sky,
        passes.ELEPHANT: 0.375 * elephant + 0.625 * sky,
        passes.SHRUB: shrub,
    }
    for number, radiance in expected.items():
        counts = np.unique(frame[index == number])
        assert len(counts) == 1
        # Half a count of rounding; radiance is stored as float32 after at most 5 roundings of 6e-8: 3e-7 of it, 3e-5 K
        # where dL/L is 1.6 % per K or more, or 3e-3 counts of 0.01 K.
        assert abs(counts[0] - _apparent_k(veldt, radiance) / step_k) <= 0.503


def test_labels_are_of_what_fills_most_of_a_pixel(veldt):
    """The elephant fills 3/8, and nothing 5/8: sky."""
    _convert(veldt, _write(veldt.folder / "one", _edges))
    labels = veldt.read("out/annotations.json")["annotations"]
    assert {label["track_id"] for label in labels} == {7}
    assert [label["area"] for label in labels][0] == int((passes.object_index(0) == passes.WALKER).sum())


BAD = {
    "a name of nothing": (
        {"objects": [o for o in passes.manifest()["objects"] if o["name"] != "cow"]},
        'one/000000.exr: ViewLayer.CryptoObject00.r at pixel (0, 10) = "cow" (20 pixels); expected a name among the '
        "manifest's objects: ground, shrub, walker",
    ),
    "a cryptomatte that is not there": (
        {"cryptomatte": "CryptoObjekt"},
        'one/000000.exr: cryptomatte = "CryptoObjekt"; expected one that the file has: ViewLayer.CryptoObject; did you '
        'mean "CryptoObject"?',
    ),
}


@pytest.mark.parametrize("what", BAD)
def test_what_cannot_be_meant_is_refused_by_name(veldt, what):
    change, message = BAD[what]
    _write(veldt.folder / "one", manifest=change)
    done = veldt("convert", "one", "--out", "out", "--quiet", "--strict")
    assert (done.code, done.out, message in done.err) == (1, "", True), done.err
    assert not (veldt.folder / "out" / "clips" / "one").exists()


def test_lossy_compression_is_refused(veldt):
    _write(veldt.folder / "one")
    for frame in range(passes.FRAMES):
        planes = mattes.planes_of(_whole(frame))
        mattes.write_exr_with_texts(
            veldt.folder / "one" / f"{frame:06d}.exr", planes, mattes.texts_of(["ground"]), "dwaa"
        )
    done = veldt("convert", "one", "--out", "out", "--quiet", "--strict")
    assert done.code == 1
    assert (
        "one/000000.exr: cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.r: compression = DWAA; expected "
        "one that keeps the bits of hashes: none, RLE, ZIPS, ZIP or PIZ" in done.err
    )
