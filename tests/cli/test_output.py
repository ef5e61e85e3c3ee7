"""Standard output and standard error: closed, full, or with names in them that terminals would obey."""

import json
import re

import pytest

import passes
from datasets import content_of

ESCAPE = "\x1b[31m"
FULL = "veldt: cannot write standard output: No space left on device\n"


def _sh(line: str) -> tuple[str, ...]:
    """A command that runs the program with its streams redirected."""
    return ("sh", "-c", f'exec "$@" {line}', "sh")


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&-", ">&- 2>&-", "<&- 2>&-", "<&- >&- 2>&-"])
def test_closed_streams_change_nothing(veldt, closed):
    passes.write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "usual", "--progress", "plain").code == 0
    done = veldt("convert", "one", "--out", "out", "--progress", "plain", under=_sh(closed))
    assert done.code == 0
    assert content_of(veldt.folder / "out") == content_of(veldt.folder / "usual")
    assert (veldt.folder / "out" / ".lock").read_bytes() == (veldt.folder / "usual" / ".lock").read_bytes()


@pytest.mark.parametrize(
    "arguments",
    [
        ["radiance", "--temperature-k", "300", "--json"],
        ["radiance", "--temperature-k", "300"],
        ["--version"],
        ["help", "generate"],
        ["doctor", "--json"],
    ],
)
def test_a_full_standard_output_is_a_failure(veldt, arguments):
    done = veldt(*arguments, under=_sh("> /dev/full"))
    assert (done.code, done.err) == (1, FULL)


def test_a_reader_that_ends_early_is_not_told_about_it(veldt):
    """Killed by SIGPIPE, or done before the reader ended: `veldt … | head` prints no error either way."""
    done = veldt("help", "generate", under=("sh", "-c", '"$@" | :', "sh"))
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(name="rude")
def _rude(veldt):
    """Passes whose names hold what colours a terminal."""
    clip = passes.write_clip(veldt.folder / "one")
    manifest = json.loads((clip / "manifest.json").read_text())
    for thing in manifest["objects"]:
        thing["name"] += ESCAPE + "\x7f\x9b"
        if thing.get("category") == "human":
            thing["category"] = f"po{ESCAPE}acher\nranger"
    (clip / "manifest.json").write_text(json.dumps(manifest))
    return veldt


def _is_harmless(text: str) -> bool:
    return not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", text)


@pytest.mark.parametrize("style", [[], ["--json"]])
def test_tables_and_json_print_names_harmlessly(rude, style):
    done = rude("inspect", "one", *style)
    assert done.code == 0 and "walker" in done.out
    assert _is_harmless(done.out) and _is_harmless(done.err)
    if style:
        assert ESCAPE in json.dumps(done.json(), ensure_ascii=False).replace("\\u001b", "\x1b")


PLAIN = ("--progress", "plain")


@pytest.fixture(name="rude_dataset")
def _rude_dataset(rude):
    assert rude("convert", "one", "--out", "set", "--quiet").code == 0
    labels = rude.read("set/annotations.json")
    assert any(ESCAPE in category["name"] for category in labels["categories"])
    boxes = [
        {k: box[k] for k in ("image_id", "category_id", "bbox")} | {"score": 0.9}
        for box in labels["annotations"]
    ]
    rude.write("found.json", boxes)
    labels["videos"][0]["name"] = f"ni{ESCAPE}ght"
    labels["info"]["description"] = f"ni{ESCAPE}ght"
    for image in labels["images"]:
        image["file_name"] = "set/" + image["file_name"]
    rude.write("foreign.json", labels)
    return rude


@pytest.mark.parametrize(
    "arguments, code",
    [
        (["validate", "set"], 0),
        (["export", "set", "--format", "coco", "--out", "x", *PLAIN], 0),
        (["export", "set", "--format", "yolo", "--out", "x", *PLAIN], 0),
        (["export", "set", "--format", "mot", "--out", "x", *PLAIN], 0),
        (["export", "foreign.json", "--format", "coco", "--out", "x", *PLAIN], 0),
        (["export", "foreign.json", "--format", "mot", "--out", "x"], 1),
        (["evaluate", "--truth", "set", "--detections", "found.json"], 0),
        (["evaluate", "--truth", "foreign.json", "--detections", "found.json", "--json"], 0),
        (["balance", "foreign.json", "--per-class", "0:9", "--out", "s.json"], 0),
        (["report", "foreign.json", "--out", "r.html", *PLAIN], 0),
        (["video", "set", "--out", "v.mp4", "--boxes", *PLAIN], 0),
        (["view", "set", "--out", "v", *PLAIN], 0),
    ],
    ids=str,
)
def test_names_in_datasets_are_printed_harmlessly(rude_dataset, arguments, code):
    done = rude_dataset(*arguments)
    assert (done.code, _is_harmless(done.out), _is_harmless(done.err)) == (code, True, True), done


def test_many_faults_are_counted(veldt):
    clip = passes.write_clip(veldt.folder / "one")
    manifest = json.loads((clip / "manifest.json").read_text())
    manifest["objects"] += [{"index": 1000 + k, "name": "x", "class": "cloud"} for k in range(500)]
    (clip / "manifest.json").write_text(json.dumps(manifest))
    done = veldt("convert", "one", "--out", "out")
    lines = done.err.splitlines()
    assert done.code == 1 and len(lines) == 31
    assert re.fullmatch(r"veldt: … and \d+ more", lines[-1])
