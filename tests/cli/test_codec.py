"""`output.codec`: 8-bit frames pass through a lossy video codec, with the same bits however a dataset is made."""

import json

import numpy as np
import pytest

import fake_blender
import passes
from configs import tiny
from datasets import content_of
from pictures import read_grey
from processes import wait_until
from program import Veldt, check_fault

CODEC = {"name": "h264", "bitrate_kbit_s": 60}
SHUTTER = {"interval_s": 0.5, "freeze_s": 0.3}  # some of the eight frames are frozen


def _with_codec(config: dict) -> None:
    config["output"] = {"codec": CODEC}
    config["sensor"] = {"shutter": SHUTTER}


def _run(veldt, *options) -> list[str]:
    blender = ["--blender", str(veldt.folder / "fake_blender")]
    return ["generate", "config.json", "--out", str(veldt.folder / "out"), *blender, "--quiet", *options]


def _generate(veldt, *options) -> None:
    done = veldt(*_run(veldt, *options))
    assert (done.code, done.out, done.err) == (0, "", "")


def _prepare(veldt) -> None:
    fake_blender.install(veldt.folder)
    veldt.write("config.json", tiny(_with_codec))


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory) -> Veldt:
    """A place with the dataset of an undisturbed run."""
    veldt = Veldt(tmp_path_factory.mktemp("usual"))
    _prepare(veldt)
    _generate(veldt)
    return veldt


@pytest.fixture(autouse=True)
def _ready(veldt):
    _prepare(veldt)


def _pictures(veldt, kind: str, dataset="out", clip="down") -> list[np.ndarray]:
    return [read_grey(file) for file in sorted((veldt.folder / dataset / "clips" / clip / kind).iterdir())]


def _lines(veldt, dataset="out", clip="down") -> list[dict]:
    text = (veldt.folder / dataset / "clips" / clip / "frames.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def test_only_8_bit_frames_pass_through_the_codec(veldt, usual):
    veldt.write("config.json", tiny(lambda config: config.update(sensor={"shutter": SHUTTER})))
    _generate(veldt)
    for clip in ("down", "side"):
        for with_codec, without in zip(
            _pictures(usual, "ir16", clip=clip), _pictures(veldt, "ir16", clip=clip)
        ):
            assert np.array_equal(with_codec, without)
        for with_codec, without in zip(
            _pictures(usual, "ir8", clip=clip), _pictures(veldt, "ir8", clip=clip)
        ):
            assert not np.array_equal(with_codec, without)
            assert np.abs(with_codec.astype(float) - without).mean() < 12
    assert veldt.read("out/annotations.json") == usual.read("out/annotations.json")
    assert usual("validate", "out").code == 0


def test_the_record_names_the_codec_and_the_size_of_each_frame(usual):
    assert usual.read("out/dataset.json")["config"]["output"] == {"codec": CODEC}
    sizes = [line["encoded_bytes"] for line in _lines(usual)]
    assert min(sizes) > 0
    assert sizes[0] == max(sizes)  # the keyframe


def test_frozen_frames_are_encoded_like_others(usual):
    lines = _lines(usual)
    frozen = [k for k, line in enumerate(lines) if line["ffc"]]
    assert frozen
    for k in frozen:
        assert lines[k]["ir16_sha256"] == lines[k - 1]["ir16_sha256"]
        assert lines[k]["encoded_bytes"] > 0


@pytest.mark.parametrize("options", [["--jobs", "2"], ["--threads", "1"], ["--threads", "4"]])
def test_jobs_and_threads_make_the_same_dataset(veldt, usual, options):
    _generate(veldt, *options)
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


def test_shards_make_the_same_dataset(veldt, usual):
    for shard in ("1/2", "0/2"):
        _generate(veldt, "--shard", shard)
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


def test_killed_in_a_clip_it_goes_on_to_the_same_dataset(veldt, usual):
    fake_blender.hold_after(veldt.folder, "down", 3)
    run = veldt.start(*_run(veldt))
    made = veldt.folder / "out" / "clips" / "down.part" / "ir8"
    assert wait_until(lambda: made.exists() and len(list(made.iterdir())) == 4)
    run.kill()
    run.communicate()
    _generate(veldt)
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


def test_a_size_that_the_codec_refuses_is_reported_before_rendering(veldt):
    done = veldt(*_run(veldt), "--set", "camera.width_px=8192", "output.codec.name=mpeg4")
    check_fault(
        done,
        2,
        'output.codec = "mpeg4" with 60 kbit/s; expected what the codec takes for 8192 x 80 px: Invalid argument',
    )
    assert not (veldt.folder / "out" / "clips").exists()


def test_an_unknown_codec_is_reported(veldt):
    done = veldt(*_run(veldt), "--set", "output.codec.name=mpeg2")
    assert done.code == 2
    assert 'output.codec.name = "mpeg2"; expected one of h264, mpeg4, mjpeg' in done.err


@pytest.mark.parametrize("name", ["h264", "mpeg4", "mjpeg"])
def test_passes_convert_with_a_codec_whatever_the_threads(veldt, name):
    folder = passes.write_clip(veldt.folder / "one")
    for threads in ("1", "3"):
        codec = [f"output.codec.name={name}", "output.codec.bitrate_kbit_s=20"]
        done = veldt("convert", folder, "--out", threads, "--threads", threads, "--quiet", "--set", *codec)
        assert (done.code, done.out, done.err) == (0, "", "")
    assert content_of(veldt.folder / "1") == content_of(veldt.folder / "3")
    assert _pictures(veldt, "ir8", "1", "one")[0].shape == (passes.HEIGHT, passes.WIDTH)


def test_variants_may_differ_in_the_codec(veldt):
    folder = passes.write_clip(veldt.folder / "one")
    variants = [{"name": "plain"}, {"name": "coded", "output": {"codec": CODEC | {"name": "mjpeg"}}}]
    veldt.write("variants.json", {"variants": variants})
    done = veldt("convert", folder, "--out", "out", "--variants", "variants.json", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert veldt.pixels("out/plain") != veldt.pixels("out/coded")
    for plain, coded in zip(*(_pictures(veldt, "ir16", f"out/{one}", "one") for one in ("plain", "coded"))):
        assert np.array_equal(plain, coded)
