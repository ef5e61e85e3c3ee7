"""The page of `veldt view` in a browser, and a dataset to see on it."""

from __future__ import annotations

import base64
import struct
import zlib
from pathlib import Path

import numpy as np

import passes
from browser import Browser
from pictures import read_grey
from program import Veldt
from reports import change, make_dataset

NOTHING_OVER = {"boxes": False, "names": False, "tracks": False, "masks": False}


def filtered_png(counts: np.ndarray) -> bytes:
    """A grey PNG of 16 bits whose rows have all five filters in turn, in pieces of 100 bytes.

    Source: PNG specification (ISO/IEC 15948), sections 9 and 10."""
    step = 2
    rows = counts.astype(">u2").view(np.uint8).astype(int).reshape(len(counts), -1)
    out = bytearray()
    for y, row in enumerate(rows):
        left = np.concatenate([np.zeros(step, int), row[:-step]])
        above = rows[y - 1] if y > 0 else np.zeros_like(row)
        corner = np.concatenate([np.zeros(step, int), above[:-step]])
        guess = left + above - corner
        paeth = np.where(np.abs(guess - above) <= np.abs(guess - corner), above, corner)
        nearest_left = np.minimum(np.abs(guess - above), np.abs(guess - corner)) >= np.abs(guess - left)
        paeth = np.where(nearest_left, left, paeth)
        expected = [0 * row, left, above, (left + above) // 2, paeth][y % 5]
        out += bytes([y % 5]) + ((row - expected) % 256).astype(np.uint8).tobytes()
    data = zlib.compress(bytes(out))
    head = struct.pack(">IIBBBBB", counts.shape[1], counts.shape[0], 16, 0, 0, 0, 0)
    parts = [
        (b"IHDR", head),
        *((b"IDAT", data[k : k + 100]) for k in range(0, len(data), 100)),
        (b"IEND", b""),
    ]
    chunks = (
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def make_view(folder: Path) -> Path:
    """Two clips, viewed in page/index.html beside the dataset `out`, which is returned. Frame 1 of `down` has counts of
    counts[:, 12:] = rng.integers(0, 4, (passes.HEIGHT, 12)) * 257  # neighbours often predict the same
    """
    veldt = Veldt(folder)
    dataset = make_dataset(veldt)
    rng = np.random.Generator(np.random.PCG64(8))
    counts = rng.integers(0, 65536, (passes.HEIGHT, passes.WIDTH))
    counts[0, :3] = [0, 65535, 256]
    counts[:, 12:] = (
        rng.integers(0, 4, (passes.HEIGHT, 12)) * 257
    )  # predictions from neighbours are often equal
    (dataset / "clips" / "down" / "ir16" / "000001.png").write_bytes(filtered_png(counts))
    frames = dataset / "clips" / "down" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    lines[1] = lines[1].replace('"ffc":false', '"ffc":true')
    frames.write_text("\n".join(lines), encoding="utf-8")
    frames = dataset / "clips" / "side" / "frames.jsonl"
    text = frames.read_text(encoding="utf-8")
    assert '"white_hot"' in text
    frames.write_text(text.replace('"white_hot"', '"black_hot"'), encoding="utf-8")
    change(
        dataset / "clips" / "down" / "labels.json",
        lambda document: document["annotations"][0].update(range_m=78.26),
    )
    done = veldt("view", "out", "--out", "page", "--quiet")
    assert (done.code, done.err) == (0, "")
    return dataset


def counts_of(dataset: Path, kind: str, clip: str, frame: int) -> np.ndarray:
    """The counts of a frame, read by OpenImageIO; `kind`: ir8 or ir16."""
    return read_grey(dataset / "clips" / clip / kind / f"{frame:06d}.png").astype(int)


def open_frame(browser: Browser, page: Path, clip="down", frame=0, **options) -> None:
    """Open the page at a frame, and wait for it."""
    browser.open(page, fragment=f"#clip={clip}&frame={frame}", **options)
    wait_for_frame(browser, clip, frame)


def wait_for_frame(browser: Browser, clip: str, frame: int) -> None:
    """Wait until the page shows a frame."""
    browser.wait_for(f'document.getElementById("caption").textContent.includes("{clip} · ")')
    browser.wait_for(f'document.getElementById("caption").textContent.includes(" · frame {frame} · ")')


def screen_of(browser: Browser) -> np.ndarray:
    """The canvas as pixels (height, width, 3)."""
    width, height, data = browser.run(
        """const canvas = document.getElementById("screen");
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        return [canvas.width, canvas.height, new Uint8Array(data.buffer).toBase64()];"""
    )
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(height, width, 4)[..., :3].astype(int)


def switch(browser: Browser, **switches: bool) -> None:
    """Switch what is drawn over the frame on or off."""
    for name, on in switches.items():
        if browser.run(f"return document.getElementById('{name}').checked") != on:
            browser.run(f"document.getElementById('{name}').click()")


def choose(browser: Browser, name: str, value: str) -> None:
    """Choose from a list, as its keyboard would."""
    browser.run(
        f"""const list = document.getElementById("{name}");
        list.value = "{value}";
        list.dispatchEvent(new Event("change", {{ bubbles: true }}));"""
    )


def middles(screen: np.ndarray) -> np.ndarray:
    """The colours in the middle of each of the frame's pixels, (height, width, 3)."""
    scale = screen.shape[1] / passes.WIDTH
    rows, columns = (((np.arange(n) + 0.5) * scale).astype(int) for n in (passes.HEIGHT, passes.WIDTH))
    return screen[np.ix_(rows, columns)]
