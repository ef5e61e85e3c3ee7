"""Fuzz targets for missions of QGroundControl and logs, as targets.h has for the files that C++ reads.

flight_files.py plan|log [ARGS of libFuzzer…] fuzzes, in an environment that has atheris (requirements.txt);
flight_files.py replay plan|log FILE|FOLDER… runs over inputs that are there, without it: 0 when all went well, 1 with
the file's name where one took over 5 s or none was there.
"""

from __future__ import annotations

import copy
import importlib
import json
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LONGEST_S = 5.0
MODULES = (
    "faults",
    "flight.texts",
    "flight.geodesy",
    "flight.qgc_items",
    "flight.qgc_commands",
    "flight.qgc_plans",
)
MODULES += ("flight.logs",)
ODD = (
    None,
    True,
    0,
    1,
    -1,
    0.5,
    1e308,
    -1e308,
    16,
    19,
    20,
    21,
    22,
    82,
    178,
    10**400,
    float("nan"),
    "",
    "x",
    [],
    {},
)


def target_of(suffix: str, folder: Path) -> Callable[[bytes], None]:
    """A function that reads bytes as a flight file with this suffix; ConfigError is the only accepted exception."""
    files, faults = (
        importlib.import_module(f"planner.{name}") for name in ("flight.waypoint_files", "faults")
    )
    file = folder / f"flight.{suffix}"

    def ground_m(x_m, _y_m):
        return np.full(np.shape(x_m), 8.0)

    def read(content: bytes) -> None:
        file.write_bytes(content)
        try:
            demand_usable(files.read_waypoints(str(file), (10.0, -5.0), ground_m, "flight"))
        except faults.ConfigError as fault:
            str(fault).encode("utf-8", "backslashreplace")

    return read


def demand_usable(flight) -> None:
    """Check the assumptions of the autopilot: positions and times are numbers, and there is at least one."""
    if isinstance(flight, list):
        assert flight, "a plan has waypoints"
        assert np.isfinite([(*point.point_m, point.height_m, point.hold_s) for point in flight]).all()
        assert all(point.speed_m_s is None or 0 < point.speed_m_s < 1000 for point in flight)
        return
    assert len(flight.time_s) >= 2 and (np.diff(flight.time_s) > 0).all(), "a log's times increase"
    angles = (flight.bearing_rad, flight.depression_rad, flight.roll_rad)
    assert all(np.isfinite(column).all() for column in (flight.point_m, flight.height_m, *angles))


def replay(read: Callable[[bytes], None], paths: list[Path]) -> int:
    """Read files and the files in folders, which need not exist."""
    files = sorted(
        file for path in paths for file in (path.iterdir() if path.is_dir() else [path]) if file.is_file()
    )
    slow = 0
    for file in files:
        print(file, flush=True)  # the last one named is the one that ended it
        start_s = time.process_time()
        read(file.read_bytes())
        if time.process_time() - start_s > LONGEST_S:
            print(f"{file} took more than {LONGEST_S:g} s")
            slow += 1
    print(f"{len(files) - slow} of {len(files)} inputs are sound")
    return 1 if slow or not files else 0


def places_in(value) -> list[tuple[list | dict, int | str]]:
    """Every value inside a JSON value, as a list or an object and a place in it."""
    if not isinstance(value, (list, dict)):
        return []
    here = [(value, place) for place in (value if isinstance(value, dict) else range(len(value)))]
    return here + [inner for holder, place in here for inner in places_in(holder[place])]


def changed_json(content: bytes, most: int, seed: int) -> bytes:
    """JSON changed as a tree, as json_mutator.cpp does; bytes where it is none, and one time in four."""
    import atheris

    rng = np.random.default_rng(seed)
    try:
        document = json.loads(content)
        places = places_in(document)
    except (ValueError, RecursionError):
        places = []
    if not places or rng.integers(4) == 0:
        return atheris.Mutate(content, most)
    for _ in range(rng.integers(1, 4)):
        (holder, place), (other, there) = (places[rng.integers(len(places))] for _ in range(2))
        try:
            odd = ODD[rng.integers(len(ODD))] if rng.integers(2) else copy.deepcopy(other[there])
            if rng.integers(4):
                holder[place] = odd
            else:
                del holder[place]
        except (KeyError, IndexError):  # removed by an earlier change
            continue
    return json.dumps(document).encode("utf-8")[:most]


def fuzz(suffix: str, folder: Path, arguments: list[str]) -> None:
    """Does not return: libFuzzer ends the process."""
    import atheris

    with atheris.instrument_imports():
        for name in MODULES:
            importlib.import_module(f"planner.{name}")
    mutator = {"custom_mutator": changed_json} if suffix == "plan" else {}
    atheris.Setup([sys.argv[0], *arguments], target_of(suffix, folder), **mutator)
    atheris.Fuzz()


def main(arguments: list[str]) -> int:
    """Replay or fuzz."""
    sys.path.insert(0, str(ROOT / "blender_scripts"))
    suffixes = {"plan": "plan", "log": "csv"}
    with tempfile.TemporaryDirectory() as name:
        if arguments[0] != "replay":
            fuzz(suffixes[arguments[0]], Path(name), arguments[1:])
        return replay(target_of(suffixes[arguments[1]], Path(name)), [Path(path) for path in arguments[2:]])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
