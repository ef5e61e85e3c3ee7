"""`veldt.generate` and `veldt.plan` do what the commands do."""

import pytest

from configs import tiny
from veldt import ConfigError, IoError, generate, open_dataset, plan

EMBREE = ["render.engine=embree"]


def _check_same(folder, dataset):
    again = open_dataset(folder)
    assert again.document["pixels_sha256"] == dataset.document["pixels_sha256"]
    assert again.document["annotations_sha256"] == dataset.document["annotations_sha256"]


def test_the_dataset_is_the_programs(tmp_path, generated):
    seen = []
    outcome = generate(tiny(), tmp_path / "out", settings=EMBREE, progress=seen.append)
    assert (outcome.made, outcome.failed, outcome.complete) == (["down", "side"], {}, True)
    assert [now.done for now in seen if now.stage == "frames"][-1] == outcome.frames_made == 16
    assert {now.stage for now in seen} == {"planning", "frames"}
    _check_same(tmp_path / "out", generated)
    again = generate(tiny(), tmp_path / "out", settings=EMBREE)
    assert (again.made, again.already_there) == ([], ["down", "side"])


def test_a_plan_does_too_and_clips_can_be_chosen(tmp_path, veldt, generated):
    assert plan(veldt.folder / "tiny.json", tmp_path / "plan", settings=EMBREE) == ["down", "side"]
    first = generate(plan_folder=tmp_path / "plan", out=tmp_path / "out", clips=["side"])
    assert (first.made, first.complete) == (["side"], False)
    assert generate(plan_folder=tmp_path / "plan", out=tmp_path / "out").complete
    _check_same(tmp_path / "out", generated)


def test_what_progress_raises_ends_the_run_and_the_next_one_goes_on(tmp_path, generated):
    def stop(now):
        if now.stage == "frames" and now.done == 9:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        generate(tiny(), tmp_path / "out", settings=EMBREE, progress=stop)
    rest = generate(tiny(), tmp_path / "out", settings=EMBREE)
    assert (rest.made, rest.already_there) == (["side"], ["down"])
    _check_same(tmp_path / "out", generated)


def test_faults_have_the_programs_words(tmp_path):
    with pytest.raises(ConfigError, match='config: sensr is not a known key; .*did you mean "sensor"'):
        generate(tiny() | {"sensr": {}}, tmp_path / "out")
    with pytest.raises(ConfigError, match="config or plan_folder, and not both"):
        generate(out=tmp_path / "out")
    with pytest.raises(IoError, match="nothing.json"):
        generate(tmp_path / "nothing.json", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_missing_blender_has_the_programs_words(tmp_path, monkeypatch):
    blender = {"settings": ["render.engine=blender"]}
    with pytest.raises(ConfigError, match="^blender = /nowhere/blender; expected an executable program$"):
        generate(tiny(), tmp_path / "out", blender="/nowhere/blender", **blender)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(IoError, match=r"^no blender on PATH; install it .* or name one with blender$"):
        generate(tiny(), tmp_path / "out", **blender)
