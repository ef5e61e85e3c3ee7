"""Frames given by folder, file or pattern: selected files, their order, and missing frames."""

import shutil

import pytest

import passes

KEPT = {"frames"}


def _write(veldt, names, folder="r", **changes):
    """A folder with a frame under each name, and a manifest that does not list them."""
    (veldt.folder / folder).mkdir()
    passes.write_clip(veldt.folder / "source", frames=1)
    for name in names:
        shutil.copy(veldt.folder / "source" / "000000.exr", veldt.folder / folder / name)
    shutil.rmtree(veldt.folder / "source")
    document = {key: value for key, value in passes.manifest(folder).items() if key not in KEPT}
    passes.write_manifest(veldt.folder / folder, document | changes)


def _frames(veldt, clip="r"):
    """Times of the frames that were made, by their number."""
    lines = (veldt.folder / "out" / "clips" / clip / "frames.jsonl").read_text(encoding="utf-8").splitlines()
    return [line.split('"time_s":')[1].split(",")[0].strip(" }") for line in lines]


WAYS = {
    "folder and sequence": (["r"], {"sequence": "f_####.exr"}),
    "folder and any name": (["r"], {"sequence": "*.exr"}),
    "folder and manifest": (["r", "--manifest", "r/manifest.json"], {}),
    "files": ([f"r/f_{k:04}.exr" for k in (10, 8, 9)], {}),
    "glob": (["r/*.exr"], {}),
    "glob with a question mark": (["r/f_00?*.exr"], {}),
    "printf": (["r/f_%04d.exr"], {}),
    "hashes": (["r/f_####.exr"], {}),
    "a pattern and a file": (["r/f_000#.exr", "./r/f_0010.exr"], {}),
    "files, whatever the sequence": (["r/f_####.exr"], {"sequence": "g_#.exr"}),
}


@pytest.mark.parametrize("name", WAYS)
def test_the_same_three_frames_in_order(veldt, name):
    what, changes = WAYS[name]
    _write(veldt, ["f_0010.exr", "f_0009.exr", "f_0008.exr"], frame_rate_hz=4, **changes)
    done = veldt("convert", *what, "--out", "out", "--progress", "none")
    assert (done.code, done.out, done.err) == (0, "out: 1 clip made, 3 frames\n", "")
    assert [float(time) for time in _frames(veldt)] == [0, 0.25, 0.5]


def test_natural_order(veldt):
    _write(veldt, ["f_9.exr", "f_10.exr", "f_11.exr"])
    passes.change_index(veldt.folder / "r", 0, passes.SHRUB)
    (veldt.folder / "r" / "000000.exr").rename(veldt.folder / "r" / "f_9.exr")
    assert veldt("inspect", "r/*.exr", "--json").json()["file"] == "r/f_9.exr"


def test_pictures_where_there_is_no_exr_file(veldt):
    _write(veldt, [])
    for name in ("b.png", "a.png"):
        (veldt.folder / "r" / name).write_bytes(b"")
    done = veldt("inspect", "r")
    assert done.err.startswith("veldt: ") and "r/a.png" in done.err


def test_files_of_two_folders_are_two_clips(veldt):
    _write(veldt, ["1.exr", "2.exr"], "r")
    _write(veldt, ["1.exr"], "s")
    done = veldt("convert", "r/#.exr", "s/1.exr", "--out", "out", "--progress", "none")
    assert (done.code, done.out) == (0, "out: 2 clips made, 3 frames\n")


def test_a_file_whose_name_looks_like_a_pattern_is_meant_by_it(veldt):
    _write(veldt, ["f_#.exr", "f_1.exr", "f_2.exr"])
    report = veldt("inspect", "r/f_#.exr", "--json").json()
    assert (report["file"], report["files"]) == ("r/f_#.exr", 1)


def test_gaps_are_frames_that_are_missing(veldt):
    _write(veldt, ["f_0008.exr", "f_0010.exr", "f_0014.exr"], sequence="f_####.exr")
    assert veldt("inspect", "r").out.splitlines()[1:3] == [
        "  24 x 16 px, compression none; the first of 3 files",
        "  missing: f_0012.exr",
    ]
    assert veldt("inspect", "r", "--json").json()["missing"] == ["f_0012.exr"]
    done = veldt("convert", "r", "--out", "out", "--progress", "none")
    assert (done.code, done.out) == (3, "out: 1 clip made, 3 frames; 1 frame skipped\n")
    assert done.err == "veldt: clip r: frame 2 skipped: r/f_0012.exr: no such file\n"
    assert [float(time) for time in _frames(veldt)] == [0, 1 / 9, 3 / 9]


def test_a_pattern_stays_in_its_folder(veldt):
    """Neither a folder's name nor a file elsewhere is matched."""
    _write(veldt, ["f_1.exr"])
    (veldt.folder / "r" / "f_2.exr").mkdir()
    (veldt.folder / "f_3.exr").write_bytes(b"")
    assert veldt("inspect", "r/*.exr", "--json").json()["files"] == 1


TWO = "expected one file per number, or a pattern that leaves some out"
HOLDS = "which holds f_1.exr, f_2.exr, manifest.json"
FAULTS = {
    "no such folder": (
        ["none"],
        {},
        2,
        'passes = none; expected a folder of passes, files of passes or a pattern such as "passes/f_####.exr"',
    ),
    "no such file": (
        ["r/f_3.exr"],
        {},
        2,
        'passes = r/f_3.exr; expected a folder of passes, files of passes or a pattern such as "passes/f_####.exr"',
    ),
    "a pattern of no file": (
        ["r/f_%06d.exr"],
        {},
        2,
        f'passes = "r/f_%06d.exr"; expected a pattern of files in r, {HOLDS}',
    ),
    "a pattern in no folder": (
        ["*/f_#.exr"],
        {},
        2,
        'passes = "*/f_#.exr"; expected a pattern in an existing folder, and * is not one',
    ),
    "a pattern that cannot be meant": (
        ["r/f_%6d.exr"],
        {},
        2,
        'passes = "f_%6d.exr"; expected % only as in %d or %06d',
    ),
    "a sequence of no file": (
        ["r"],
        {"sequence": "g_#.exr"},
        1,
        f'r/manifest.json: sequence = "g_#.exr"; expected a pattern of files in r, {HOLDS}',
    ),
    "a sequence that cannot be meant": (
        ["r"],
        {"sequence": "#_#.exr"},
        1,
        'r/manifest.json: sequence = "#_#.exr"; expected one number, such as #### or %06d',
    ),
    "a sequence elsewhere": (
        ["r"],
        {"sequence": "../f_#.exr"},
        1,
        'r/manifest.json: sequence = "../f_#.exr"; expected text that matches ^[^/\\\\]*$',
    ),
    "frames and sequence": (
        ["r"],
        {"sequence": "f_#.exr", "frames": [{"file": "f_1.exr"}]},
        1,
        'r/manifest.json: sequence = "f_#.exr"; expected none, because frames lists the files',
    ),
    "neither": (
        ["r"],
        {},
        1,
        "r/manifest.json: frames and sequence are missing; expected one of them: a list of files, or a pattern of their"
        ' names such as "f_####.exr"',
    ),
    "files where the manifest lists them": (
        ["r/f_1.exr"],
        {"frames": [{"file": "f_1.exr"}]},
        2,
        "passes = r/f_1.exr; expected the folder, r: r/manifest.json lists its frames",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(veldt, name):
    what, changes, code, message = FAULTS[name]
    _write(veldt, ["f_1.exr", "f_2.exr"], **changes)
    done = veldt("convert", *what, "--out", "out")
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
    assert not (veldt.folder / "out").exists()


NAMES = {
    "one number twice": (["f_01.exr", "f_1.exr"], f"r: f_01.exr and f_1.exr both have number 1; {TWO}"),
    "no number beside numbers": (
        ["f_1.exr", "f_2.exr", "thumbnail.exr"],
        "r: thumbnail.exr has no number, and f_1.exr has one; expected one in all names, or a pattern that leaves some"
        " out",
    ),
    "a number too large": (
        ["f_1.exr", f"f_{10**18}.exr"],
        f"r: the number of f_{10**18}.exr has 19 digits; expected at most 18",
    ),
    "more gaps than there may be": (
        ["f_1.exr", "f_2.exr", "f_1000000000.exr"],
        "r: 3 files have numbers from 1 to 1000000000 in steps of 1, so 999999997 are missing; expected at most 30"
        " missing, or a manifest that lists the files in frames",
    ),
}


@pytest.mark.parametrize("name", NAMES)
def test_names_that_cannot_be_put_in_order(veldt, name):
    names, message = NAMES[name]
    _write(veldt, names)
    for command in (["convert", "--out", "out"], ["inspect"]):
        done = veldt(*command, "r/*.exr")
        assert (done.code, done.out, done.err) == (1, "", f"veldt: {message}\n")


def test_without_a_manifest(veldt):
    _write(veldt, ["f_1.exr"])
    (veldt.folder / "r" / "manifest.json").unlink()
    for what in ("r", "r/f_#.exr"):
        done = veldt("convert", what, "--out", "out")
        assert done.err == (
            "veldt: cannot read r/manifest.json: no such file; expected one that says what the passes mean,"
            ' such as "veldt inspect r --starter-manifest r/manifest.json" writes\n'
        )
        assert (done.code, done.out) == (1, "")


def test_one_manifest_is_for_one_folder(veldt):
    _write(veldt, ["1.exr"], "r")
    _write(veldt, ["1.exr"], "s")
    done = veldt("convert", "r/1.exr", "s/1.exr", "--manifest", "r/manifest.json", "--out", "out")
    assert (
        done.err == "veldt: --manifest = r/manifest.json; expected a single folder of passes with it, not 2\n"
    )
    assert done.code == 2
    done = veldt("inspect", "r/1.exr", "s/1.exr")
    assert done.err == "veldt: passes = r, s; expected one folder of passes, or files in one\n"
    assert done.code == 2


def test_a_folder_without_passes(veldt):
    _write(veldt, [])
    done = veldt("convert", "r", "--manifest", "r/manifest.json", "--out", "out")
    assert done.err == "veldt: r holds no passes; expected .exr files, or .png files of indices\n"
    assert done.code == 1
