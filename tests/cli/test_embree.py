"""`--engine embree`: the same dataset however it is made, and without Blender."""

import signal

import pytest

import fake_blender
from configs import CLIPS, FRAMES, tiny
from datasets import content_of
from program import Veldt, check_fault, files_below

_NO_BLENDER = {"PATH": "/nonexistent"}


def _arguments(*options, command="generate", out="out") -> list[str]:
    return [command, "config.json", "--out", out, "--engine", "embree", "--quiet", *options]


def _make(veldt, *options, command="generate", out="out") -> None:
    done = veldt(*_arguments(*options, command=command, out=out), env=_NO_BLENDER)
    assert (done.code, done.out, done.err) == (0, "", "")


def _config() -> dict:
    """With plants, actors and everything that depends on them."""
    config = tiny()
    config["render"]["actor_layer"] = True
    return config


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("usual"))
    veldt.write("config.json", _config())
    _make(veldt)
    return veldt


@pytest.fixture(autouse=True)
def _ready(veldt):
    veldt.write("config.json", _config())


def test_a_dataset_is_made_and_says_by_what(usual):
    assert usual("validate", "out").code == 0
    assert len(set(usual.pixels("out").values())) == 1 + len(CLIPS)
    assert usual.read("out/dataset.json")["config"]["render"]["engine"] == "embree"
    assert not (usual.folder / "out" / "passes").exists()
    labels = usual.read("out/annotations.json")["annotations"]
    assert labels and all("visibility" in label for label in labels)


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_change_nothing(veldt, usual, threads):
    _make(veldt, "--threads", threads)
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


def test_shards_are_merged_to_the_same_dataset(veldt, usual):
    for shard in ("1/2", "0/2"):
        _make(veldt, "--shard", shard, out=f"shard{shard[0]}")
    assert veldt("merge", "shard0", "shard1", "--out", "merged", "--quiet").code == 0
    assert veldt.pixels("merged") == usual.pixels("out")


def test_clips_are_made_in_any_order(veldt, usual):
    for clip in reversed(CLIPS):
        _make(veldt, "--clips", clip)
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


@pytest.mark.parametrize("command", ["render", "generate"])
def test_passes_convert_to_the_same_pixels(veldt, usual, command):
    _make(veldt, *(["--keep-passes"] if command == "generate" else []), command=command)
    kept = [f"{clip}/{name}" for clip in CLIPS for name in ("000000.exr", "000007.exr", "manifest.json")]
    assert set(kept) < set(files_below(veldt.folder / "out" / "passes"))
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    done = veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert veldt.pixels("converted") == usual.pixels("out")
    annotations = [veldt.folder / "converted", usual.folder / "out"]
    assert len({(folder / "annotations.json").read_bytes() for folder in annotations}) == 1


def _at_a_shore() -> dict:
    """A slanting view over the water, which mirrors the far shore."""
    config = _config()
    config["sensor"] = {"preset": "boson_640_14mm"}
    flight = {"pattern": "orbit", "centre_m": [0, 0], "radius_m": 26, "altitude_m": 10}
    config["clips"] = [{"id": "shore", "season": "winter", "frames": 2, "frame_rate_hz": 9, "flight": flight}]
    return config


@pytest.mark.parametrize("sampling", ["full", "adaptive"])
def test_what_water_mirrors_is_the_same_from_kept_passes(veldt, sampling):
    config = _at_a_shore()
    config["terms"] = dict.fromkeys(("variation", "sky", "angular", "mirror", "path"), "on")
    config["render"] |= {"supersample": 2, "sampling": sampling}
    veldt.write("config.json", config)
    _make(veldt)
    _make(veldt, "--keep-passes", "--threads", 3, out="kept")
    assert veldt.pixels("kept") == veldt.pixels("out")
    assert veldt.read("kept/passes/shore/manifest.json")["mirror_layer"] == "Mirror"
    _make(veldt, "--set", "terms.mirror=off", out="without")
    assert veldt.pixels("without") != veldt.pixels("out")
    settings = ["--config", "config.json", "--quiet", "--set", "render.engine=embree"]
    done = veldt("convert", "kept/passes/shore", "--out", "converted", *settings)
    assert (done.code, done.err) == (0, "")
    assert veldt.pixels("converted") == veldt.pixels("out")


def test_render_goes_on_where_it_was_stopped(veldt):
    _make(veldt, command="render")
    folder = veldt.folder / "out" / "passes" / CLIPS[0]
    whole = {file.name: file.read_bytes() for file in folder.iterdir()}
    kept = folder / "000002.exr"
    time_ns = kept.stat().st_mtime_ns
    for frame in (3, FRAMES - 1):
        (folder / f"{frame:06d}.exr").unlink()
    _make(veldt, command="render")
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == whole
    assert kept.stat().st_mtime_ns == time_ns


@pytest.mark.parametrize("frame", [0, 3, FRAMES - 1])
def test_killed_it_goes_on_to_the_same_dataset(veldt, usual, gate, frame):
    run = gate.start(veldt, f"out/clips/{CLIPS[1]}.part/ir16/{frame:06d}.png", *_arguments())
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    _make(veldt)
    assert files_below(veldt.folder / "out") == files_below(usual.folder / "out")
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


def _leave_open(veldt, **render) -> None:
    veldt.write("config.json", _config() | {"render": {"actor_layer": True, **render}})


def test_it_is_chosen_where_the_config_names_no_engine(veldt, usual):
    _leave_open(veldt)
    chosen = "engine: embree (the ray caster, which draws all of this config)\n"
    arguments = ["config.json", "--progress", "none", "--out"]
    for command in (["generate", *arguments, "out", "--dry-run"], ["plan", *arguments, "plan"]):
        assert chosen in veldt(*command, env=_NO_BLENDER).out
    done = veldt("generate", *arguments, "out", env=_NO_BLENDER)
    assert (done.code, done.out, done.err) == (0, chosen + "out: 2 clips made, 16 frames\n", "")
    assert veldt.read("out/dataset.json") == usual.read("out/dataset.json")
    _make(veldt)
    done = veldt("generate", *arguments, "out", "--engine", "auto", env=_NO_BLENDER)
    assert done.out == chosen + "out: nothing to do, 2 clips already existed\n"


def test_blender_is_chosen_for_what_the_rays_do_not_reach(veldt):
    _leave_open(veldt, overscan_px=8)
    why = "because of render.overscan_px = 8 px: embree draws nothing beyond the picture"
    arguments = ["config.json", "--progress", "none", "--out", "out"]
    assert f"engine: blender ({why})\n" in veldt("generate", *arguments, "--dry-run", env=_NO_BLENDER).out
    blender = fake_blender.install(veldt.folder)
    done = veldt("render", *arguments, "--blender", blender, env=_NO_BLENDER)
    assert done.out.startswith(f"engine: blender ({why})\n")
    assert veldt.read("out/passes/config.json")["render"]["engine"] == "blender"
    done = veldt("generate", *arguments, env=_NO_BLENDER)
    assert (done.code, done.out) == (1, f"engine: blender ({why})\n")
    assert done.err.startswith("veldt: no blender on PATH")


def test_a_dataset_by_blender_says_how_to_go_on(veldt):
    fake_blender.generate(veldt, fake_blender.install(veldt.folder), "--engine", "blender", "--clips", "down")
    _leave_open(veldt)
    arguments = ["generate", "config.json", "--out", "out", "--progress", "none"]
    done = veldt(*arguments)
    assert done.code == 2
    assert 'render.engine is "embree" here and "blender" there' in done.err
    assert done.err.endswith(
        "; expected the same config with --set render.engine=blender, or another folder\n"
    )
    done = veldt(*arguments, "--engine", "blender", "--blender", veldt.folder / "fake_blender")
    assert done.out == "out: 1 clip made, 8 frames; 1 already existed\n"


def test_passes_of_another_config_are_not_removed(veldt, usual):
    _make(veldt, "--set", "render.supersample=2", "--clips", CLIPS[0], command="render")
    passes = {
        file: (veldt.folder / "out" / file).stat().st_mtime_ns
        for file in files_below(veldt.folder / "out")
        if file.startswith("passes/")
    }
    for _ in range(2):
        _make(veldt)
        assert {file: (veldt.folder / "out" / file).stat().st_mtime_ns for file in passes} == passes
    assert veldt.pixels("out") == usual.pixels("out")


def test_a_converted_dataset_names_no_engine_that_was_not_asked_for(veldt):
    _make(veldt, command="render")
    _leave_open(veldt)
    convert = ["convert", "out/passes", "--config", "config.json", "--quiet", "--out"]
    for out, settings, engine in (
        ("open", [], "auto"),
        ("named", ["--set", "render.engine=blender"], "blender"),
    ):
        done = veldt(*convert, out, *settings)
        assert (done.code, done.err) == (0, "")
        assert veldt.read(f"{out}/dataset.json")["config"]["render"]["engine"] == engine
        assert veldt(*convert, out, *settings).code == 0
    assert veldt.pixels("open") == veldt.pixels("named")


def test_a_dataset_keeps_its_engine(veldt, usual):
    _make(veldt)
    done = veldt(*_arguments("--set", "render.actor_layer=false"), env=_NO_BLENDER)
    assert done.code == 2
    done = veldt("generate", "config.json", "--out", "out", "--engine", "blender", "--blender", "/bin/true")
    assert done.code == 2
    assert 'render.engine is "blender" here and "embree" there' in done.err
    assert veldt.pixels("out") == usual.pixels("out")


def test_adaptive_sampling_gives_the_labels_of_full_sampling(veldt):
    for sampling in ("full", "adaptive"):
        finer = ["--set", "render.supersample=2", "--set", f"render.sampling={sampling}"]
        _make(veldt, *finer, out=sampling)
    assert veldt.pixels("full") != veldt.pixels("adaptive")
    full, adaptive = (veldt.read(f"{out}/annotations.json")["annotations"] for out in ("full", "adaptive"))
    # Contrast is against what is beside an actor, where pixels of plants and edges differ by 41 mK rms at most.
    for one, other in zip(full, adaptive):
        del one["contrast_noise"], other["contrast_noise"]
        assert one.pop("contrast_k") == pytest.approx(other.pop("contrast_k"), abs=0.041)
    assert full == adaptive


def test_kept_adaptive_passes_change_no_pixel(veldt):
    finer = ["--set", "render.supersample=2", "--set", "render.sampling=adaptive"]
    _make(veldt, *finer)
    _make(veldt, *finer, "--keep-passes", out="kept")
    assert veldt.pixels("kept") == veldt.pixels("out")
    folders = [f"kept/passes/{clip}" for clip in CLIPS]
    done = veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert veldt.pixels("converted") == veldt.pixels("out")


def test_adaptive_sampling_needs_this_engine(veldt):
    done = veldt("generate", "config.json", "--out", "out", "--set", "render.sampling=adaptive")
    check_fault(
        done,
        2,
        'config.json: render.sampling = "adaptive"; expected "full", or render.engine = "embree"',
    )


def test_an_unknown_engine_is_refused(veldt):
    done = veldt("generate", "config.json", "--out", "out", "--engine", "cycles")
    assert done.code == 2
    assert "blender" in done.err and "embree" in done.err
