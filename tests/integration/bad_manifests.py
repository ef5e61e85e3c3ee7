"""Invalid manifests, and manifests whose frames are missing."""

# Messages are whole, however long.
# pylint: disable=line-too-long

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import passes
from bad_input import NOTHING, OTHERS, BadInput


def _text(name: str, content: bytes, message: str, code: int = 1) -> BadInput:
    return BadInput(
        "manifest",
        name,
        lambda folder: (folder / "manifest.json").write_bytes(content),
        code,
        message,
        NOTHING,
    )


def _manifest(
    name: str, change: Callable[[dict], object], message: str, code: int = 1, made: str = NOTHING
) -> BadInput:
    def spoil(folder: Path) -> None:
        document = passes.manifest()
        change(document)
        passes.write_manifest(folder, document)

    return BadInput("manifest", name, spoil, code, message, made)


def _instead(name: str, make: Callable[[Path], object], message: str, code: int = 1) -> BadInput:
    def spoil(folder: Path) -> None:
        (folder / "manifest.json").unlink()
        make(folder / "manifest.json")

    return BadInput("manifest", name, spoil, code, message, NOTHING)


_GOOD = json.dumps(passes.manifest())

MANIFESTS = [
    _instead(
        "missing",
        lambda file: None,
        'cannot read one/manifest.json: no such file; expected one that says what the passes mean, such as "veldt inspect one --starter-manifest one/manifest.json" writes',
    ),
    _instead(
        "a folder",
        lambda file: file.mkdir(),
        "cannot read one/manifest.json: it is a folder; expected a file",
    ),
    _instead(
        "a named pipe without a writer",
        os.mkfifo,
        "cannot read one/manifest.json: it is a pipe or a device; expected a file",
    ),
    _instead(
        "a link to itself",
        lambda file: file.symlink_to(file.name),
        "cannot read one/manifest.json: Too many levels of symbolic links",
    ),
    _instead(
        "a link to a device",
        lambda file: file.symlink_to("/dev/zero"),
        "cannot read one/manifest.json: it is a pipe or a device; expected a file",
    ),
    _text(
        "not UTF-8",
        _GOOD.replace("made_up", "\xff").encode("latin-1"),
        "one/manifest.json:1:67: not JSON: syntax error while parsing value - invalid string: ill-formed UTF-8 byte; last read: '\"\\xff'",
    ),
    _text(
        "empty",
        b"",
        "one/manifest.json:1:1: not JSON: it is empty",
    ),
    _text(
        "not JSON",
        b"clip: one",
        "one/manifest.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 'c'",
    ),
    _text(
        "cut short",
        _GOOD[:100].encode(),
        "one/manifest.json:1:101: not JSON: syntax error while parsing object key - invalid string: missing closing quote; last read: '\"w'; expected string literal",
    ),
    _text("a list", b"[]", "one/manifest.json: document = a list of 0; expected an object"),
    _text(
        "100,000 brackets",
        b"[" * 100_000,
        "one/manifest.json: lists and objects are nested more than 64 deep; expected fewer",
    ),
    _text(
        "100,000 brackets, closed again",
        b"[" * 100_000 + b"]" * 100_000,
        "one/manifest.json: lists and objects are nested more than 64 deep; expected fewer",
    ),
    _text(
        "100,000 objects, one in the other",
        b'{"a":' * 100_000,
        "one/manifest.json: lists and objects are nested more than 64 deep; expected fewer",
    ),
    _text(
        "a key twice",
        _GOOD.replace('"seed"', '"clip": "two", "seed"').encode(),
        'one/manifest.json: key "clip" appears twice in one object; expected once',
    ),
    _text(
        "a number over all bounds",
        _GOOD.replace('"fx_px": 30', '"fx_px": 1e999').encode(),
        "one/manifest.json: not JSON: number overflow parsing '1e999'",
    ),
    _text(
        "NaN",
        _GOOD.replace('"fx_px": 30', '"fx_px": NaN').encode(),
        "one/manifest.json:1:141: not JSON: syntax error while parsing value - invalid literal; last read: '\"fx_px\": N'; expected a finite number: JSON has no NaN and no Infinity, though Python writes them",
    ),
    _manifest(
        "unknown key",
        lambda m: m.update(clips="one"),
        'one/manifest.json: clips is not a known key; expected one of format, version, clip, of_flight, scene, seed, frame_rate_hz, layer, actor_layer, mirror_layer, channels, cryptomatte, sky_colour, sequence, supersample, overscan_px, camera, objects, materials, beds, frames; did you mean "clip"?',
    ),
    _manifest(
        "a text for a number",
        lambda m: m.update(seed="5"),
        'one/manifest.json: seed = "5"; expected a whole number',
    ),
    _manifest(
        "a number for a list",
        lambda m: m.update(objects=3),
        "one/manifest.json: objects = 3; expected a list",
    ),
    _manifest(
        "a seed over 2^32",
        lambda m: m.update(seed=2**40),
        "one/manifest.json: seed = 1099511627776; expected at least 0 and at most 4294967295",
    ),
    _manifest(
        "a camera of 10^10 pixels",
        lambda m: m["camera"].update(width_px=100000, height_px=100000),
        "clip one rejected: one: size of the passes = 100000 x 100000 px; expected at most 256000000 pixels (--max-megapixels)",
    ),
    _manifest(
        "a camera without pixels",
        lambda m: m["camera"].update(width_px=0),
        "one/manifest.json: camera.width_px = 0 px; expected at least 1 and at most 100000 px",
    ),
    _manifest(
        "a clip named ../x",
        lambda m: m.update(clip="../x"),
        'one/manifest.json: clip = "../x"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
    ),
    _manifest(
        "a clip named /tmp/x",
        lambda m: m.update(clip="/tmp/x"),
        'one/manifest.json: clip = "/tmp/x"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
    ),
    _manifest(
        "a frame in another folder",
        lambda m: m["frames"][1].update(file="../x.exr"),
        'one/manifest.json: frames[1].file = "../x.exr"; expected text that matches ^[^/\\\\]+$',
    ),
    _manifest(
        "a frame at a place of its own",
        lambda m: m["frames"][1].update(file="/etc/passwd"),
        'one/manifest.json: frames[1].file = "/etc/passwd"; expected text that matches ^[^/\\\\]+$',
    ),
    _manifest(
        "a frame named ..",
        lambda m: m["frames"][1].update(file=".."),
        "clip one: frame 1 skipped: one/..: it is a folder; expected a file",
        3,
        OTHERS,
    ),
    _manifest(
        "a frame with a name of 300 letters",
        lambda m: m["frames"][1].update(file="x" * 300),
        f"clip one: frame 1 skipped: one/{'x' * 300}: File name too long",
        3,
        OTHERS,
    ),
    _manifest(
        "no frames",
        lambda m: m.update(frames=[]),
        'one/manifest.json: frames and sequence are missing; expected one of them: a list of files, or a pattern of their names such as "f_####.exr"',
    ),
    _manifest(
        "frames and a sequence",
        lambda m: m.update(sequence="####.exr"),
        'one/manifest.json: sequence = "####.exr"; expected none, because frames lists the files',
    ),
    _manifest(
        "an index twice",
        lambda m: m["objects"][2].update(index=102),
        "one/manifest.json: objects[3].index = 102; expected each value once",
    ),
    _manifest(
        "an index past the last",
        lambda m: m["objects"][2].update(index=40000),
        "one/manifest.json: objects[2].index = 40000; expected at least 1 and at most 32767",
    ),
    _manifest(
        "an unknown material",
        lambda m: m["objects"][2].update(material="lava"),
        'one/manifest.json: objects[2].material = "lava"; expected one of acacia, ash, baboon, baobab, bicycle, block_wall, buffalo, canvas, cattle, concrete, concrete_post, cooking, crocodile, dog, drum, dung, elephant, elephant_grass, field, fire, generator, giraffe, glass_panel, goat, grass, hippopotamus, hookthorn, human, impala, lamp, lion, litter, log, motorbike, mud_wall, ostrich, painted_metal, pole, rhinoceros, road, … (63 in all)',
    ),
    _manifest(
        "an actor without category",
        lambda m: m["objects"][2].pop("category"),
        "one/manifest.json: objects[2].category is missing; expected one for every actor",
    ),
]


def _gap(folder: Path) -> None:
    document = passes.manifest() | {"sequence": "######.exr"}
    del document["frames"]
    (folder / "000002.exr").rename(folder / "1000000000.exr")
    passes.write_manifest(folder, document)


SEQUENCES = [
    BadInput(
        "sequence",
        "a gap of 10^9 frames",
        _gap,
        1,
        "one: 3 files have numbers from 0 to 1000000000 in steps of 1, so 999999998 are missing; expected at most 30 missing, or a manifest that lists the files in frames",
        NOTHING,
    ),
]
