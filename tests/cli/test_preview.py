"""`render --preview` with a stand-in for Blender: messages and files. With a real one: tests/integration."""

import json
import os
import signal

import pytest

import fake_blender
from configs import tiny
from processes import PATIENCE_S, running_with, wait_until
from program import files_below

MADE = ["config.json", "map.png", "overview.png"]
_BAKED = ["scene", "tracks/down", "tracks/side", "preview/sheet", "preview/moment"]
PLANNED = [
    "plan/checksums.json",
    "plan/plan.json",
    *(f"plan/{name}.{kind}" for name in _BAKED for kind in ("json", "bin")),
]


def _run(blender, *options, out="out") -> list[str]:
    return ["render", "config.json", "--out", str(out), "--preview", "--blender", str(blender), *options]


def test_it_makes_pictures_and_no_passes(veldt, blender):
    done = veldt(*_run(blender, "--progress", "none"))
    assert (done.code, done.err) == (0, "")
    assert done.out == "out/preview: 2 pictures; map.png shows the place from above\n"
    assert files_below(veldt.folder / "out") == [
        ".lock",
        *sorted(f"preview/{name}" for name in [*MADE, "blender.log", *PLANNED]),
    ]
    assert veldt.read("out/preview/config.json")["seed"] == 7


def test_quiet_says_nothing(veldt, blender):
    done = veldt(*_run(blender, "--quiet"))
    assert (done.code, done.out, done.err) == (0, "", "")


def test_progress_counts_pictures(veldt, blender):
    done = veldt(*_run(blender, "--progress", "json"))
    lines = [json.loads(line) for line in done.err.splitlines()]
    planned = [line for line in lines if "flights_done" in line]
    rendered = lines[len(planned) :]
    assert [line["flights_done"] for line in planned] == list(range(1, len(planned) + 1))
    assert [(line["clip"], line["frames_done"], line["frames_total"]) for line in rendered] == [
        ("preview", 0, 2),
        ("preview", 1, 2),
        ("preview", 2, 2),
    ]


def test_it_is_made_again_for_another_config(veldt, blender):
    assert veldt(*_run(blender, "--quiet")).code == 0
    veldt.write("config.json", tiny(lambda config: config.update(seed=8)))
    assert veldt(*_run(blender, "--quiet")).code == 0
    assert veldt.read("out/preview/config.json")["seed"] == 8


def test_it_may_lie_beside_a_dataset_of_another_config(veldt, blender):
    usual = [option for option in _run(blender, "--quiet") if option != "--preview"]
    assert veldt(*usual).code == 0
    done = veldt(*_run(blender, "--quiet", "--set", "seed=8"))
    assert (done.code, done.err) == (0, "")


def test_a_dry_run_writes_nothing(veldt, blender):
    done = veldt(*_run(blender, "--dry-run"), env={"PATH": ""})
    assert (done.code, done.err) == (0, "")
    assert not (veldt.folder / "out").exists()


def test_asked_to_stop_it_stops_the_renderer(veldt, blender):
    out = veldt.folder / "out"
    fake_blender.hold_after(veldt.folder, "preview", 0)
    run = veldt.start(*_run(blender, "--progress", "none", out=out))
    assert wait_until((out / "preview" / "overview.png").exists)
    os.kill(run.pid, signal.SIGINT)
    run.communicate(timeout=PATIENCE_S)  # less than the renderer is held
    assert run.returncode == 128 + signal.SIGINT
    assert wait_until(lambda: not running_with(out))


# --- what can go wrong ------------------------------------------------------------------------------------------------


def test_no_blender_on_path(veldt):
    veldt.write("config.json", tiny())
    done = veldt("render", "config.json", "--out", "out", "--preview", env={"PATH": ""})
    assert (done.code, done.out) == (1, "")
    assert done.err == (
        "veldt: no blender on PATH; install it (apt-get install blender) or name one with --blender\n"
    )
    assert not (veldt.folder / "out").exists()


def test_a_config_that_cannot_be_meant_is_refused_before_anything_is_made(veldt, blender):
    veldt.write("config.json", tiny(lambda config: config["scene"]["groups"][0].update(path="lop")))
    done = veldt(*_run(blender))
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        'veldt: config.json: scene.groups[0].path = "lop"; expected a path of scene.paths: loop;'
        ' did you mean "loop"?\n'
    )
    assert not (veldt.folder / "out").exists()


BLENDERS = {
    "ends without a word": ("exit 0", 1, "Blender ended early while building the scene; it printed nothing"),
    "is killed after a picture": (
        """echo '{"event": "clip", "clip": "preview", "first_frame": 0, "frames": 2}' >&3
        echo '{"event": "frame", "clip": "preview", "index": 0}' >&3; kill -9 $$""",
        75,
        "Blender was killed by signal 9 (Killed) while rendering clip preview after frame 0;"
        " unless someone killed it, the machine may have run out of memory",
    ),
    "cannot write": (
        """echo '{"event": "error", "kind": "internal", "message": "OSError: no", "where": "a/preview.py:12"}' >&3
        exit 1""",
        1,
        "Blender failed while building the scene: OSError: no (a/preview.py:12)",
    ),
}


@pytest.mark.parametrize("name", BLENDERS)
def test_a_failing_blender_is_relayed_in_words(veldt, blender, name):
    script, code, message = BLENDERS[name]
    blender.write_text(f"#!/bin/sh\n{script}\n")
    done = veldt(*_run(blender, "--progress", "none"))
    assert (done.code, done.out) == (code, "")
    assert done.err == f"veldt: {message}; log: out/preview/blender.log\n"


def test_only_render_makes_previews(veldt, blender):
    done = veldt("generate", "config.json", "--out", "out", "--preview", "--blender", blender)
    assert (done.code, done.out) == (2, "")
    assert done.err == "veldt: unknown option --preview; see veldt generate --help\n"
