"""`balance` selects frames so that classes of targets are spread evenly over all videos."""

import json

import pytest

import passes

SIDES = {"small": 10, "medium": 20, "large": 60}  # px: 100, 400 and 3600 px of box
ANIMAL, HUMAN = "0,1", "1,0"  # class and species
HERD, WALKER = ("small", ANIMAL), ("medium", HUMAN)


@pytest.fixture(name="videos")
def _videos(veldt):
    """Write a BIRDSAI folder: videos by name, each a list of frames, each a list of targets."""

    def write(folder: str, videos: dict) -> str:
        annotations = veldt.folder / folder / "annotations"
        annotations.mkdir(parents=True)
        for name, frames in videos.items():
            rows = [row for number, frame in enumerate(frames) for row in _rows(number, frame)]
            (annotations / f"{name}.csv").write_text("".join(rows), encoding="utf-8")
        return folder

    return write


def _rows(number: int, targets) -> list[str]:
    """Rows of a frame; the n-th target of a kind is the n-th track of it."""
    seen: dict = {}
    rows = []
    for size, kind in targets:
        seen[size, kind] = seen.get((size, kind), 0) + 1
        track = 100 * sorted(SIDES).index(size) + 10 * int(kind[0]) + seen[size, kind]
        rows.append(f"{number},{track},5,5,{SIDES[size]},{SIDES[size]},{kind},0,0\n")
    return rows


@pytest.fixture(name="two_nights")
def _two_nights(videos):
    """A night with a herd of two in every frame, and one with single animals, pairs by a walker, walkers."""
    herd = {"herd": [[HERD, HERD]] * 20}
    alone = {"alone": [[HERD]] * 8 + [[HERD, HERD, WALKER]] * 4 + [[WALKER]] * 3}
    return videos("herds", herd), videos("walks", alone)


def _frames(veldt, file: str) -> dict:
    return {
        (dataset["path"], video["name"]): video["frames"]
        for dataset in veldt.read(file)["datasets"]
        for video in dataset["videos"]
    }


TABLE = """\
taken/all     frames  small animal  medium animal  large animal  small poacher  medium poacher  large poacher
herds: herd     5/20         10/40              -             -              -               -              -
walks: alone    9/15         10/16              -             -              -             7/7              -
all            14/35         20/56              -             -              -             7/7              -
objective: 0 (most labels from one video minus fewest from a video with labels left, summed over classes)
lower bound: 0, gap 0.00 %, """


def test_videos_give_alike(veldt, two_nights):
    bounds = ["small_animal=20:20", "medium_poacher=7:7"]
    done = veldt("balance", *two_nights, "--per-class", *bounds, "--out", "even.json")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith(TABLE)
    assert done.out.endswith(" s\neven.json: written\n")
    frames = _frames(veldt, "even.json")
    assert len(frames["herds", "herd"]) == 5
    alone = frames["walks", "alone"]
    assert alone == sorted(set(alone))
    assert len(alone) == 9 and alone[2:] == list(range(8, 15))  # every walker, and two animals more


def test_json_says_the_same(veldt, two_nights):
    done = veldt("balance", *two_nights, "--per-class", "small_animal=20:20", "--out", "a.json", "--json")
    assert (done.code, done.err) == (0, "")
    report = done.json()
    assert (report["objective"], report["bound"], report["gap"], report["in_time"]) == (0, 0, 0, True)
    assert report["per_class"]["small_animal"] == {"at_least": 20, "at_most": 20}
    assert [(video["dataset"], video["video"]) for video in report["videos"]] == [
        ("herds", "herd"),
        ("walks", "alone"),
    ]
    taken = [video["taken"]["small_animal"] for video in report["videos"]]
    assert taken == [10, 10]
    assert report["all"]["available"]["small_animal"] == 56
    selection = veldt.read("a.json")
    assert (selection["format"], selection["version"], selection["objective"]) == ("veldt-selection", 1, 0)
    assert selection["per_class"]["small_animal"] == {
        "at_least": 20,
        "at_most": 20,
        "available": 56,
        "taken": 20,
    }
    assert selection["totals"]["frames"] == report["all"]["frames_taken"]


def _bytes(veldt, *arguments) -> bytes:
    done = veldt("balance", *arguments, "--per-class", "small_animal=20:20", "--out", "s.json", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return (veldt.folder / "s.json").read_bytes()


def test_the_same_input_gives_the_same_bytes(veldt, two_nights):
    first = _bytes(veldt, *two_nights)
    assert _bytes(veldt, *two_nights) == first  # and a selection may be replaced
    assert _bytes(veldt, *two_nights, "--seed", 1) != first


def test_frames_are_a_matter_of_the_video_alone(veldt, two_nights, videos):
    _bytes(veldt, *two_nights)
    first = _frames(veldt, "s.json")
    _bytes(veldt, *reversed(two_nights), videos("empty", {"nothing": []}))
    assert _frames(veldt, "s.json") == first | {("empty", "nothing"): []}


def test_videos_of_the_same_name_stay_apart(veldt, videos):
    one = videos("one", {"night": [[HERD]] * 6})
    two = videos("two", {"night": [[HERD]] * 9})
    _ = veldt("balance", one, two, "--per-class", "small_animal=10:10", "--out", "s.json")
    assert {path: len(frames) for (path, _), frames in _frames(veldt, "s.json").items()} == {
        "one": 5,
        "two": 5,
    }


@pytest.mark.parametrize("people", ["small_poacher", "small_human"])
def test_our_own_datasets(veldt, people):
    """The class is called by what is hunted for, the category by what it is: both are understood."""
    folder = passes.write_clip(veldt.folder / "passes", "one")
    assert veldt("convert", folder, "--out", "out", "--quiet").code == 0
    done = veldt("balance", "out", "--per-class", f"{people}=2:2", "--out", "s.json")
    assert (done.code, done.err) == (0, "")
    assert len(_frames(veldt, "s.json")["out", "one"]) == 2


@pytest.mark.parametrize("limit_s", [0.02, 0.2])
def test_a_time_limit_is_reported(veldt, videos, limit_s):
    """The best of forty videos with animals and people in all mixtures, to the last label, in no time.

    After 0.02 s the solver claims that nothing better exists, which it cannot know.
    """
    many = {
        f"v{i}": [[HERD] * (1 + (i * 7 + n) % 9) + [WALKER] * ((i + n) % 3) for n in range(30)]
        for i in range(40)
    }
    done = veldt(
        *["balance", videos("many", many), "--per-class", "small_animal=900:900", "medium_poacher=470:470"],
        *["--out", "s.json", "--gap", 0, "--time-limit-s", limit_s],
    )
    if done.code == 2:  # a busy machine did not even find out whether the bounds can be met
        assert f"time_limit_s = {limit_s} s; expected more" in done.err
        return
    assert done.code == 0
    assert done.err.startswith(f"veldt: stopped after {limit_s} s with a gap of ")
    assert done.err.endswith(" %; 0 % was requested\n")
    assert veldt.read("s.json")["gap"] > 0


FAULTS = {
    "LO above HI": (["9:5"], '--per-class = "9:5"; expected LO:HI with LO at most HI'),
    "no bounds": (
        ["many"],
        '--per-class = "many"; expected LO:HI or CLASS=LO:HI, whole numbers from 0 to 1000000000',
    ),
    "half of them": (
        ["small_animal=5:"],
        '--per-class = "small_animal=5:"; expected LO:HI or CLASS=LO:HI, whole numbers from 0 to 1000000000',
    ),
    "unknown class": (
        ["smal_animal=1:5"],
        '--per-class = "smal_animal=1:5"; expected one of small_animal, medium_animal, large_animal, '
        'small_poacher, medium_poacher, large_poacher before =; did you mean "small_animal"?',
    ),
    "class twice": (
        ["small_animal=1:5", "small_animal=2:5"],
        '--per-class = "small_animal=2:5"; expected each class once',
    ),
    "all twice": (["1:5", "2:5"], '--per-class = "2:5"; expected one LO:HI for all classes'),
    "more than there are": (
        ["0:9", "small_animal=60:80"],
        "per-class small_animal: at least 60 requested, 56 available",
    ),
    "class without labels": (
        ["large_animal=1:9"],
        "per-class large_animal: at least 1 requested, 0 available",
    ),
    "not together": (
        ["small_animal=0:0", "medium_poacher=5:7"],
        "per-class medium_poacher: at least 5 requested, at most 3 possible with the other bounds",
    ),
}


@pytest.mark.parametrize("words, message", FAULTS.values(), ids=FAULTS.keys())
def test_bounds_that_cannot_be(veldt, two_nights, words, message):
    done = veldt("balance", *two_nights, "--per-class", *words, "--out", "s.json")
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")
    assert not (veldt.folder / "s.json").exists()


def test_each_class_that_misses_is_named(veldt, two_nights):
    done = veldt(
        "balance", *two_nights, "--per-class", "small_animal=60:80", "large_poacher=1:2", "--out", "s.json"
    )
    assert (done.code, done.err.splitlines()) == (
        2,
        [
            "veldt: per-class small_animal: at least 60 requested, 56 available",
            "veldt: per-class large_poacher: at least 1 requested, 0 available",
        ],
    )


def test_only_selections_are_replaced(veldt, two_nights):
    notes = veldt.write("notes.txt", "mine")
    done = veldt("balance", *two_nights, "--per-class", "0:9", "--out", "notes.txt")
    assert (done.code, done.err) == (
        2,
        "veldt: --out = notes.txt; expected a new file, or a selection to replace\n",
    )
    assert notes.read_text(encoding="utf-8") == "mine"


def test_a_folder_that_is_not_there(veldt, two_nights):
    done = veldt("balance", *two_nights, "--per-class", "0:9", "--out", "no/s.json")
    assert (done.code, done.err) == (
        2,
        "veldt: --out = no/s.json; expected a file in an existing folder\n",
    )


def test_a_dataset_twice(veldt, two_nights):
    done = veldt("balance", two_nights[0], f"./{two_nights[0]}", "--per-class", "0:9", "--out", "s.json")
    assert (done.code, done.err) == (2, "veldt: DATASET = ./herds; expected each dataset once\n")


def test_nothing_to_balance(veldt, videos):
    done = veldt("balance", videos("empty", {"night": []}), "--per-class", "0:9", "--out", "s.json")
    assert (done.code, done.err) == (
        1,
        "veldt: empty: no labels of animals or people that count; expected at least one\n",
    )


def test_what_does_not_count(veldt):
    """Vehicles, crowds and ignored targets are not labels, and frames with only these are never selected."""
    image = {"width": 200, "height": 100}
    box = {"bbox": [1, 1, 10, 10], "area": 100}
    document = {
        "images": [image | {"id": k, "file_name": f"{k}.png"} for k in (1, 2, 3, 4, 5)],
        "categories": [{"id": 1, "name": "lion"}, {"id": 2, "name": "vehicle"}],
        "annotations": [
            box | {"id": 1, "image_id": 1, "category_id": 1, "iscrowd": 0},
            box | {"id": 2, "image_id": 2, "category_id": 2, "iscrowd": 0},
            box | {"id": 3, "image_id": 3, "category_id": 1, "iscrowd": 1},
            box | {"id": 4, "image_id": 4, "category_id": 1, "iscrowd": 0, "ignore": True},
        ],
    }
    veldt.write("coco.json", document)
    done = veldt("balance", "coco.json", "--per-class", "0:0", "small_animal=1:9", "--out", "s.json")
    assert (done.code, done.err) == (0, "")
    assert "4 frames have no label that counts; none of them is selected" in done.out
    selection = json.loads((veldt.folder / "s.json").read_text(encoding="utf-8"))
    assert [video["frames"] for video in selection["datasets"][0]["videos"]] == [[0]]
