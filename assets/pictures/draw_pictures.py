"""Draw the pictures of the pages, and record what each was made of: `./run pictures [NAME…]`.

    python3 assets/pictures/draw_pictures.py [NAME…]

NAME is a picture's file name without suffix; without names, all are drawn. pictures.json has for each picture the
commands that made what is on it, checksums by which a test sees whether Veldt still draws that, its own checksum, and
what pages say of it. Where such words have changed, the pages are changed too. build/pictures keeps what was made.
"""

from __future__ import annotations

import functools
import hashlib
import json
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from shown import ROOT, Day, Frames, Map, Shown, veldt

FOLDER = ROOT / "assets" / "pictures"
RECORD = FOLDER / "pictures.json"
BUILD = Path("build/pictures")  # below the repository's root, where all commands run

# Species that fill a frame of the contact sheet from the side; of the others, its middle is enough.
LARGE_SPECIES = ("elephant", "giraffe", "hippopotamus", "lorry", "pickup", "rhinoceros")


FONT = ROOT / "assets" / "fonts" / "B612-Regular.otf"

# Rows of the gallery, presets of sensors, all of one frame.
PUBLISHED_CAMERAS = ("airsim_w_256x144", "airsim_w")
PHYSICAL_CAMERAS = ("flir_vue_pro_640_13mm", "flir_vue_pro_640_19mm", "boson_640_14mm", "boson_640_18mm")
GALLERY_CLIP = "summer_follow_61m"
CLOSE_LANES = "clips[0].flight.lane_spacing_m=20"  # of the other clip, as narrow pictures need them

# What the test draws to save time: less land around the flights, fewer pixels, some of the hours; the cameras in the
# small place of the hours, those of one model and size in one run.
DEMO = Frames("configs/demo.json", ("scene.terrain.size_m=600", CLOSE_LANES))
CAMERAS_SHOWN = (
    *(
        Frames("configs/hours.json", (f"sensor.preset={camera}",), ("winter_1800",))
        for camera in PUBLISHED_CAMERAS
    ),
    Frames(
        "configs/hours.json",
        tuple(f"clips[{k}].sensor.preset={camera}" for k, camera in enumerate(PHYSICAL_CAMERAS)),
        ("winter_1800", "winter_2100", "winter_0000", "winter_0300"),
    ),
)
SHEET = Frames(
    "configs/contact_sheet.json",
    ("camera.width_px=160", "camera.height_px=128", "camera.pixel_pitch_um=68"),
)
HOURS = Frames("configs/hours.json", (), ("winter_0300", "winter_1200", "summer_0300", "summer_1200"))
DAY = Day(
    "configs/demo.json",
    ("soil", "wet_soil", "grass", "litter", "rock", "road", "water", "acacia", "acacia wood", "shrub"),
)
FOLLOWED = Frames("configs/follow.json", ("scene.terrain.size_m=760", "render.posed_actors=seen"))


class Workshop:
    """Runs what a picture needs, and remembers it."""

    def __init__(self) -> None:
        self._datasets: dict[str, str] = {}
        self.commands: list[str] = []
        self.words: dict[str, str] = {}

    def begin(self) -> None:
        """Forget what the last picture needed, but for datasets."""
        self.commands, self.words = [], {}

    def veldt(self, *arguments: object) -> None:
        """Run the program."""
        self.commands.append(shlex.join(["veldt", *map(str, arguments)]))
        veldt(*arguments)

    def dataset(self, name: str, config: str, *options: str) -> Path:
        """A dataset, made once for all pictures."""
        command = ["generate", config, "--out", BUILD / name, *options]
        if name in self._datasets:
            self.commands.append(self._datasets[name])
        else:
            shutil.rmtree(ROOT / BUILD / name, ignore_errors=True)
            self.veldt(*command)
            self._datasets[name] = self.commands[-1]
        return BUILD / name


class Picture(NamedTuple):
    """A picture of the pages: how to draw it into a file, and what it shows."""

    draw: Callable[[Workshop, Path], None]
    shows: tuple[Shown, ...]


@functools.cache
def checksums(shown: Shown) -> dict[str, str | int]:
    """What the test compares, made once for all pictures."""
    name = hashlib.sha256(shlex.join(shown.command()).encode()).hexdigest()[:12]
    folder = ROOT / BUILD / "shown" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    return shown.make(folder)


def run(*command: object) -> str:
    """Run another program in the repository's root, and return what it prints. CalledProcessError if it fails."""
    words = list(map(str, command))
    return subprocess.run(words, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout


def write_jpeg(out: Path, quality: int, *work: object) -> None:
    """Run oiiotool on pictures, and write the result without the tool's name in it."""
    write = ["--compression", f"jpeg:{quality}", "-o", str(out)]
    run("oiiotool", "--nosoftwareattrib", *work, *write)


def mosaic(tiles: list[list[object]], columns: int, gap_px: int) -> list[object]:
    """Pictures, each with what is done to it, in rows."""
    rows = -(-len(tiles) // columns)
    return [*(word for tile in tiles for word in tile), f"--mosaic:pad={gap_px}", f"{columns}x{rows}"]


# --- pictures ---------------------------------------------------------------------------------------------------------


def draw_demo(shop: Workshop, out: Path) -> None:
    """A frame of each clip, as `veldt video` shows them."""
    demo, picture = shop.dataset("demo", "configs/demo.json"), BUILD / "demo.png"
    marks = ("--palette", "ironbow", "--boxes", "--tracks", "--scale", "--frame", "20")
    shop.veldt("video", demo, "--out", picture, *marks)
    write_jpeg(out, 88, picture)


def draw_models(shop: Workshop, out: Path) -> None:
    """The same frame by the physical and by the published model."""
    clip, picture = "summer_follow_61m", BUILD / "models.png"
    demo = shop.dataset("demo", "configs/demo.json")
    published = shop.dataset(
        "demo_published", "configs/demo.json", "--clips", clip, "--set", "sensor.preset=airsim_w"
    )
    marks = ("--palette", "ironbow", "--boxes", "--scale", "--frame", "20", "--width-px", "1600")
    shop.veldt("video", demo / "clips" / clip, "--side-by-side", published, "--out", picture, *marks)
    write_jpeg(out, 88, picture)
    budget = json.loads((ROOT / published / "dataset.json").read_text(encoding="utf-8"))["physics"]
    spread_k = {term["term"]: term["spread_mk"] / 1000 for term in budget["terms"]}
    total, bodies = f"{budget['dropped_mk'] / 1000:.0f} K", f"{spread_k['parts']:.0f} K of that within bodies"
    shop.words["thermal_core/README.md"] = f"puts what it leaves out at {total}, {bodies}"


def draw_gallery(shop: Workshop, out: Path) -> None:
    """The middle of a frame, a row a camera: clean, blurred and noisy, in winter and in summer."""
    tiles = []
    for camera in (*PUBLISHED_CAMERAS, *PHYSICAL_CAMERAS):
        row, preset = BUILD / "gallery" / camera, f"sensor.preset={camera}"
        shutil.rmtree(ROOT / row, ignore_errors=True)
        cut = (
            "--clips",
            GALLERY_CLIP,
            "--set",
            preset,
            "clips[1].frames=1",
            "clips[1].start_s=8",
            CLOSE_LANES,
        )
        shop.veldt("render", "configs/demo.json", "--out", row / "render", *cut)
        variants = ("--out", row / "variants", "--variants", "configs/gallery.json", "--set", preset)
        shop.veldt("convert", row / "render/passes" / GALLERY_CLIP, *variants)
        middle = "160x128+48+8" if camera.endswith("_256x144") else "160x128+240+192"
        frames = sorted((ROOT / row).glob("variants/*/clips/*/ir8/000000.png"))
        tiles += [[frame, "--cut", middle] for frame in frames]
    write_jpeg(out, 90, *mosaic(tiles, 6, 3))


def draw_hours(shop: Workshop, out: Path) -> None:
    """The clips in the order of the config: seven hours of a winter day, then of a summer day."""
    hours = shop.dataset("hours", "configs/hours.json")
    clips = json.loads((ROOT / "configs" / "hours.json").read_text(encoding="utf-8"))["clips"]
    tiles = [[hours / "clips" / clip["id"] / "ir8/000000.png", "--resize", "280x224"] for clip in clips]
    write_jpeg(out, 90, *mosaic(tiles, 7, 2))


def draw_species(view: str, cut: str, cut_of_large: str, shop: Workshop, out: Path) -> None:
    """All species from one side, each named in its corner."""
    clips = ROOT / shop.dataset("contact_sheet", "configs/contact_sheet.json") / "clips"
    tiles = []
    for clip in sorted(clips.glob(f"{view}_*")):
        name = clip.name.removeprefix(f"{view}_")
        part = cut_of_large if name.split("_")[0] in LARGE_SPECIES else cut
        label = f"--text:x=6:y=22:size=20:shadow=1:font={FONT}", name.replace("_", " ")
        tiles.append([clip / "ir8/000000.png", "--cut", part, "--resample", "320x256", *label])
    write_jpeg(out, 80, *mosaic(tiles, 6, 3))


def draw_report(shop: Workshop, out: Path) -> None:
    """Three parts of the page: its top, Distributions, and Flights with what follows."""
    from browser import open_browser  # pylint: disable=import-outside-toplevel # the other pictures need none

    demo, page, whole = shop.dataset("demo", "configs/demo.json"), BUILD / "report.html", BUILD / "report.png"
    shop.veldt("report", demo, "--out", page)
    browser = open_browser(ROOT / BUILD / "browser")
    browser.open(ROOT / page, (1280, 800))
    browser.picture(ROOT / whole)
    tops = [
        browser.run(f"return document.querySelector('{one}').getBoundingClientRect().top + scrollY")
        for one in ("html", "#distributions", "#flights")
    ]
    browser.close()
    tiles = [[whole, "--cut", f"1280x1230+0+{round(top)}", "--resize", "500x480"] for top in tops]
    write_jpeg(out, 90, *mosaic(tiles, 3, 0))


def draw_map(shop: Workshop, out: Path) -> None:
    """What `veldt render --preview` draws."""
    shop.veldt("render", "configs/savanna.json", "--out", BUILD / "look", "--preview")
    write_jpeg(out, 90, BUILD / "look/preview/map.png", "--resize", "1100x0")
    found = checksums(Map("configs/savanna.json"))
    shop.words["cli/README.md"] = f"one square mile, {found['actors']} actors, {found['plants']:,} plants"


def draw_day(shop: Workshop, out: Path) -> None:
    """What `veldt heat` draws."""
    shop.veldt(*DAY.command()[1:], "--plot", out)


def draw_follow(shop: Workshop, out: Path) -> None:
    """What the example draws, by the Python package as users have it."""
    environment = BUILD / "python"
    python = environment / "bin" / "python"
    run(sys.executable, "-m", "venv", "--system-site-packages", environment)
    run(python, "-m", "pip", "install", "--quiet", "gymnasium==1.4.0", "scikit-build-core==0.11.6")
    wheel = ("--no-deps", "--no-build-isolation", "--config-settings", "build-dir=build/release", ".")
    run(python, "-m", "pip", "install", "--quiet", *wheel)
    plan = BUILD / "follow"
    shutil.rmtree(ROOT / plan, ignore_errors=True)
    shop.veldt("plan", "configs/follow.json", "--out", plan)
    command = [python, "tests/examples/follow.py", plan, "night", "--picture", out]
    shop.commands.append(shlex.join(["python", *map(str, command[1:])]))
    printed = run(*command)
    share, middle_m, most_m = re.search(
        r"in view: ([\d.]+)%.*thought to be ([\d.]+) m off \(median\).* ([\d.]+) m \(most\)",
        printed,
        re.DOTALL,
    ).groups()
    off = f"{middle_m} m off their place (median; {most_m} m at most)"
    shop.words[
        "thermal_core/python/README.md"
    ] = f"keep {share} % of four poachers in view, thought to be {off}"


PICTURES = {
    "demo.jpg": Picture(draw_demo, (DEMO,)),
    "report.jpg": Picture(draw_report, (DEMO,)),
    "models.jpg": Picture(draw_models, (DEMO, CAMERAS_SHOWN[PUBLISHED_CAMERAS.index("airsim_w")])),
    "gallery.jpg": Picture(draw_gallery, CAMERAS_SHOWN),
    "hours.jpg": Picture(draw_hours, (HOURS,)),
    "heat.svg": Picture(draw_day, (DAY,)),
    "species_side.jpg": Picture(
        functools.partial(draw_species, "side", "320x256+160+128", "640x512+0+0"), (SHEET,)
    ),
    "species_top.jpg": Picture(
        functools.partial(draw_species, "top", "160x128+240+192", "160x128+240+192"), (SHEET,)
    ),
    "savanna_map.jpg": Picture(draw_map, (Map("configs/savanna.json"),)),
    "follow.jpg": Picture(draw_follow, (FOLLOWED,)),
}


# --- the record -------------------------------------------------------------------------------------------------------


def reworded(page: str, old: str, new: str) -> str:
    """A page with other words in the same places, lines broken as before. ValueError if it lacks the old ones."""
    if old == new:
        return page
    found = re.search(r"\s+".join(map(re.escape, old.split())), page)
    if found is None:
        raise ValueError(f'expected the words "{old}", to make them "{new}"')
    gaps = re.findall(r"\s+", found[0])
    words = "".join(word + gap for word, gap in zip_longest(new.split(), gaps, fillvalue=" ")).rstrip()
    return page[: found.start()] + words + page[found.end() :]


def draw(name: str, shop: Workshop, record: dict) -> None:
    """Draw a picture in place, and bring its record and the words on pages up to date."""
    picture = PICTURES[name]
    made = BUILD / name
    shop.begin()
    picture.draw(shop, made)
    shows = {shlex.join(one.command()): checksums(one) for one in picture.shows}
    for page, words in shop.words.items():
        file = ROOT / page
        old = record.get(name, {}).get("words", {}).get(page, words)
        file.write_text(reworded(file.read_text(encoding="utf-8"), old, words), encoding="utf-8")
    shutil.copyfile(ROOT / made, FOLDER / name)
    record[name] = {
        "commands": shop.commands,
        "shows": shows,
        "words": shop.words,
        "sha256": hashlib.sha256((FOLDER / name).read_bytes()).hexdigest(),
    }
    text = json.dumps(dict(sorted(record.items())), indent=1, ensure_ascii=False)
    RECORD.write_text(text + "\n", encoding="utf-8")


def main(names: list[str]) -> int:
    """Draw the named pictures, or all; the exit code."""
    files = {Path(name).stem: name for name in PICTURES}
    unknown = [name for name in names if name not in files]
    if unknown:
        print(f"pictures: unknown picture {unknown[0]}; expected one of {', '.join(files)}", file=sys.stderr)
        return 2
    (ROOT / BUILD).mkdir(parents=True, exist_ok=True)
    record = json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {}
    shop = Workshop()
    for name in names or files:
        start_s = time.monotonic()
        draw(files[name], shop, record)
        size_kb = (FOLDER / files[name]).stat().st_size / 1000
        print(
            f"assets/pictures/{files[name]}: {size_kb:.0f} kB, {time.monotonic() - start_s:.0f} s", flush=True
        )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
