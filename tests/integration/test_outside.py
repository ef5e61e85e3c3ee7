"""Nothing is written outside --out, whatever names and links there are."""

import pytest

import passes
from program import NO_LINKS

NAME = "expected 1 to 200 letters, digits, _ or -, not beginning with -"


def _state(folder):
    """Every entry below a folder: its kind, content and time of change."""
    state = {}
    for place in [folder, *folder.rglob("*")]:
        status = place.lstat()
        content = place.read_bytes() if place.is_file() and not place.is_symlink() else None
        state[str(place.relative_to(folder))] = (status.st_mode, status.st_mtime_ns, content)
    return state


@pytest.fixture(name="elsewhere")
def _elsewhere(veldt):
    """A folder that must not be modified, with a file of each name that a dataset has, and a clip."""
    folder = veldt.folder / "elsewhere"
    (folder / "ir8").mkdir(parents=True)
    for name in ("kept", "ir8/000000.png", "dataset.json", "annotations.json"):
        (folder / name).write_text("kept", encoding="utf-8")
    return folder


# --- names ------------------------------------------------------------------------------------------------------------

NAMES = ["../x", "/tmp/veldt-x", "a/b", "..", ".", "", "a\\b", "one.part", "x\n"]


def _around(veldt):
    """Everything but the dataset's own folder."""
    return {
        name: entry
        for name, entry in _state(veldt.folder).items()
        if not name.startswith("out") and name != "."
    }


@pytest.mark.parametrize("name", NAMES)
def test_a_clip_name_that_is_a_path(veldt, elsewhere, name):
    folder = passes.write_clip(veldt.folder / "one")
    passes.write_manifest(folder, passes.manifest() | {"clip": name})
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out")
    shown = name.replace("\\", "\\\\").replace("\n", "\\n")
    assert (done.code, done.err) == (1, f'veldt: one/manifest.json: clip = "{shown}"; {NAME}\n')
    assert _around(veldt) == before and elsewhere.exists()
    assert not (veldt.folder / "out").exists()


@pytest.mark.parametrize("name", NAMES)
def test_a_variant_name_that_is_a_path(veldt, name):
    passes.write_clip(veldt.folder / "one")
    veldt.write("variants.json", {"variants": [{"name": name}]})
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--variants", "variants.json")
    shown = name.replace("\\", "\\\\").replace("\n", "\\n")
    assert (done.code, done.err) == (2, f'veldt: variants.json: variants[0].name = "{shown}"; {NAME}\n')
    assert _around(veldt) == before
    assert not (veldt.folder / "out").exists()


@pytest.mark.parametrize("name", NAMES)
def test_a_clip_name_of_a_config_that_is_a_path(veldt, name):
    passes.write_clip(veldt.folder / "one")
    veldt.write("config.json", {"name": "x", "clips": [{"id": name, "season": "winter", "frames": 3}]})
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--config", "config.json")
    shown = name.replace("\\", "\\\\").replace("\n", "\\n")
    assert (done.code, done.err) == (2, f'veldt: config.json: clips[0].id = "{shown}"; {NAME}\n')
    assert _around(veldt) == before
    assert not (veldt.folder / "out").exists()


# --- links ------------------------------------------------------------------------------------------------------------


def _link(veldt, place, target):
    link = veldt.folder / "out" / place
    link.parent.mkdir(parents=True, exist_ok=True)
    link.symlink_to(veldt.folder / target)


@pytest.mark.parametrize("place", ["clips", ".lock"])
@pytest.mark.parametrize("target", ["elsewhere", "elsewhere/kept", "nowhere"])
def test_a_link_where_things_are_made_is_refused(veldt, elsewhere, place, target):
    passes.write_clip(veldt.folder / "one")
    _link(veldt, place, target)
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--quiet")
    link = f"out/{place} = a link to {veldt.folder / target}"
    assert (done.code, done.err) == (1, f"veldt: {link}; {NO_LINKS}\n")
    assert _around(veldt) == before and elsewhere.exists()
    assert not (veldt.folder / "nowhere").exists()


@pytest.mark.parametrize("target", ["elsewhere", "nowhere"])
def test_a_link_instead_of_a_variants_folder_is_refused(veldt, elsewhere, target):
    passes.write_clip(veldt.folder / "one")
    veldt.write("variants.json", {"variants": [{"name": "dry"}, {"name": "wet"}]})
    _link(veldt, "wet", target)
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--variants", "variants.json", "--quiet")
    link = f"out/wet = a link to {veldt.folder / target}"
    assert (done.code, done.err) == (1, f"veldt: {link}; {NO_LINKS}\n")
    assert _around(veldt) == before and elsewhere.exists()
    assert not (veldt.folder / "nowhere").exists()


@pytest.mark.parametrize("target", ["elsewhere", "nowhere", "elsewhere/kept"])
@pytest.mark.parametrize(
    "place",
    [
        "clips/one.part",
        "clips/one.part/ir8",
        "clips/one.part/ir8/000000.png",
        "clips/one",
        "clips/one/ir8",
        "annotations.json",
        "annotations.json.tmp",
        "dataset.json.tmp",
    ],
)
def test_a_link_where_things_are_put_when_whole_is_replaced(veldt, elsewhere, place, target):
    passes.write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    _link(veldt, place, target)
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert _around(veldt) == before and elsewhere.exists()
    assert not (veldt.folder / "nowhere").exists()
    assert veldt.pixels("out") == veldt.pixels("usual")
    assert not any(found.is_symlink() for found in (veldt.folder / "out").rglob("*"))


@pytest.mark.parametrize("target", ["usual/dataset.json", "elsewhere/dataset.json"])
def test_an_index_that_is_a_link_is_refused(veldt, elsewhere, target):
    passes.write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    _link(veldt, "dataset.json", target)
    before = _around(veldt)
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert (done.code, done.err) == (
        1,
        f"veldt: out/dataset.json = a link to {veldt.folder / target}; {NO_LINKS}\n",
    )
    assert _around(veldt) == before and elsewhere.exists()


def test_a_clip_that_is_a_link_is_neither_read_nor_made_again(veldt):
    folder = passes.write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    (veldt.folder / "out" / "clips" / "one").rename(veldt.folder / "moved")
    _link(veldt, "clips/one", "moved")
    (folder / "000001.exr").touch()  # so that the clip would be made again
    before = _around(veldt)
    for command in (["convert", "one", "--out", "out", "--quiet"], ["validate", "out"]):
        done = veldt(*command)
        assert (done.code, done.err) == (
            1,
            f"veldt: out/clips/one = a link to {veldt.folder / 'moved'}; {NO_LINKS}\n",
        )
    assert _around(veldt) == before


def test_passes_and_the_dataset_itself_may_be_links(veldt):
    passes.write_clip(veldt.folder / "one")
    (veldt.folder / "linked").symlink_to("one")
    (veldt.folder / "disk").mkdir()
    (veldt.folder / "out").symlink_to("disk")
    done = veldt("convert", "linked", "--out", "out", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert (veldt.folder / "disk" / "dataset.json").exists()
