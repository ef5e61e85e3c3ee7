"""The script that measures merging and validating many frames, with few."""

import re
import subprocess
import sys

from program import ROOT, Veldt

SCRIPT = ROOT / "tests" / "bench" / "many_frames.py"


def test_few_frames_are_measured(tmp_path):
    size = ["--clips", "5", "--frames", "4", "--shards", "2", "--labels", "3.5", "--folder", tmp_path]
    done = subprocess.run([sys.executable, "-B", SCRIPT, *size], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    rows = done.stdout.splitlines()
    for name, row in zip(("merge", "validate"), rows[2:]):
        assert re.fullmatch(rf"\| `veldt {name}` \| \d+ s \| \d+ MB \|", row)
    assert rows[4] == "20 frames with 70 labels"
    assert list(tmp_path.iterdir()) == []


def test_its_dataset_is_one_that_other_commands_read(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(SCRIPT.parent))
    import many_frames  # pylint: disable=import-outside-toplevel,import-error

    many_frames.measure(many_frames.Size(clips=3, frames=4, shards=2, labels=3.5), tmp_path)
    veldt = Veldt(tmp_path)
    done = veldt("export", "whole", "--format", "coco", "--out", "coco", "--quiet")
    assert (done.code, done.err) == (0, "")
    labels = veldt.read("whole/annotations.json")
    assert [video["name"] for video in labels["videos"]] == [f"clip_{k:06d}" for k in range(3)]
    assert len({label["id"] for label in labels["annotations"]}) == 3 * 14
    boxes = [
        [label["bbox"] for label in veldt.read(f"whole/clips/clip_00000{k}/labels.json")["annotations"]]
        for k in range(2)
    ]
    assert boxes[0] != boxes[1]
