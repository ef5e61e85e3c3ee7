"""Bad inputs give the exit code and the message that bad_inputs.py states, and README.md lists them all.

VELDT_WRITE_README=1 rewrites that list. VELDT_UNDER names a program to run `veldt` under, such as "valgrind -q".
"""

from __future__ import annotations

import itertools
import os
import re
import shlex
from pathlib import Path

import pytest

import passes
from bad_input import ALL, NO_CLIP, NOTHING, OTHERS, RUN, BadInput
from bad_inputs import BAD_INPUTS
from program import files_below, used_s
from raw_exr import exr_bytes

README = Path(__file__).parent / "README.md"
BEGIN, END = "<!-- bad inputs: begin -->\n", "<!-- bad inputs: end -->\n"
UNDER = shlex.split(os.environ.get("VELDT_UNDER", ""))
LONGEST_S = 300 if UNDER else 20  # of processor time; the sanitizers' build takes seconds to begin


def _made(out: Path) -> str:
    """The part of the clip that exists, which must be complete."""
    if not out.exists():
        return NOTHING
    assert not [name for name in files_below(out) if ".part/" in name or name.endswith(".tmp")]
    if not list((out / "clips").glob("*")):
        return NO_CLIP
    pictures = [len(list((out / "clips" / "one" / kind).iterdir())) for kind in ("ir8", "ir16")]
    whole = pictures[0] == pictures[1]
    return {3: ALL, 2: OTHERS}.get(pictures[0], f"{pictures[0]} frames") if whole else "halves"


@pytest.mark.parametrize("bad", BAD_INPUTS, ids=lambda bad: f"{bad.group}: {bad.name}")
def test_a_bad_input_gets_what_the_table_says(veldt, bad: BadInput):
    bad.spoil(passes.write_clip(veldt.folder / "one"))
    begun_s = used_s()
    done = veldt(*RUN, *bad.more, under=UNDER)
    assert used_s() - begun_s < LONGEST_S
    expected = "".join(f"veldt: {line}\n" for line in bad.message.splitlines())
    assert (done.code, done.out, done.err) == (bad.code, "", expected)
    assert _made(veldt.folder / "out") == bad.made


def test_readme_lists_them_all():
    text = README.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    expected = before + BEGIN + "".join(_table()) + END + after
    if os.environ.get("VELDT_WRITE_README"):
        README.write_text(expected, encoding="utf-8")
    assert README.read_text(encoding="utf-8") == expected


def _table():
    yield "| input | exit code | message | what is made |\n|---|---|---|---|\n"
    for group, inputs in itertools.groupby(BAD_INPUTS, key=lambda bad: bad.group):
        yield f"| **{group}** | | | |\n"
        for bad in inputs:
            message = "<br>".join(_code(line) for line in bad.message.splitlines())
            yield f"| {bad.name.replace('|', chr(92) + '|')} | {bad.code} | {message} | {bad.made} |\n"


def _code(line: str) -> str:
    short = re.sub("x{20,}", "x...x", line)
    return "`" + short.replace("|", "\\|").replace("`", "'") + "`"


# --- all cuts and flips of one file -----------------------------------------------------------------------------------

REASON = re.compile(r"[^\n]+")


def _spoilt_clip(folder: Path, frames: list[bytes]) -> None:
    """A clip whose frames are these files."""
    folder.mkdir()
    for number, content in enumerate(frames):
        (folder / f"{number:06d}.exr").write_bytes(content)
    passes.write_manifest(folder, passes.manifest(frames=len(frames)))


def _skipped(veldt, frames: list[bytes]) -> set[int]:
    """Check that skipped frames have a reason of one line and all others are made; return the skipped ones."""
    _spoilt_clip(veldt.folder / "one", frames)
    done = veldt(*RUN, under=UNDER)
    assert (done.code, done.out) == (3, "")
    record = veldt.read("out/clips/one/clip.json")
    assert all(REASON.fullmatch(frame["reason"]) for frame in record["skipped"])
    assert record["frames"] + len(record["skipped"]) == len(frames)
    return {frame["frame_index"] for frame in record["skipped"]}


def _whole() -> bytes:
    return exr_bytes({passes.OBJECTS: passes.object_index(1)})


def test_a_file_cut_anywhere_is_skipped(veldt):
    whole = _whole()
    cut = [whole[:count] for count in range(0, len(whole), 3 if not UNDER else 50)]
    assert _skipped(veldt, [*cut, whole]) == set(range(len(cut)))


def test_a_compressed_file_cut_anywhere_is_skipped(veldt):
    passes.write_clip(veldt.folder / "good", frames=1)
    whole = (veldt.folder / "good" / "000000.exr").read_bytes()
    cut = [whole[:count] for count in range(0, len(whole), 2 if not UNDER else 20)]
    assert _skipped(veldt, [*cut, whole]) == set(range(len(cut)))


@pytest.mark.parametrize("which", ["plain", "compressed"])
def test_a_file_with_any_bit_flipped_is_skipped_or_read(veldt, which):
    """A flip may turn a value into another valid one, which cannot be detected. There is no other outcome."""
    passes.write_clip(veldt.folder / "good", frames=1)
    whole = _whole() if which == "plain" else (veldt.folder / "good" / "000000.exr").read_bytes()
    flipped = []
    for bit in range(0, 8 * len(whole), 7 if not UNDER else 97):
        content = bytearray(whole)
        content[bit // 8] ^= 1 << bit % 8
        flipped.append(bytes(content))
    skipped = _skipped(veldt, [*flipped, whole])
    assert len(flipped) not in skipped
    assert {bit for bit in range(4)} <= skipped  # of the number that says it is an EXR file
