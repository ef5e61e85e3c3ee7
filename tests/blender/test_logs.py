"""Logs of real flights are flown as recorded, or rejected with exact messages."""

import random
from pathlib import Path

import numpy as np
import pytest

from planner.camera import look
from planner.faults import ConfigError
from planner.flight.waypoint_files import read_waypoints
from planner.geometry.rotations import by_vector

FLIGHTS = Path(__file__).resolve().parents[1] / "data" / "flights"
TEXT = (FLIGHTS / "log.csv").read_text(encoding="utf-8")
HOME_M = (10.0, -5.0)
WHERE = "clips[0].flight.waypoints"
COLUMNS = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg"


def _ground_m(x_m, y_m):
    """8 m high at home, rising to the east."""
    return 8.0 + 0.1 * (np.asarray(x_m, float) - HOME_M[0]) + 0.0 * np.asarray(y_m, float)


def _read(folder, text, name="log.csv"):
    (folder / name).write_bytes(text.encode("utf-8"))
    return read_waypoints(str(folder / name), HOME_M, _ground_m, WHERE)


def test_a_log_is_flown_as_it_was():
    log = read_waypoints(str(FLIGHTS / "log.csv"), HOME_M, _ground_m, WHERE)
    assert log.duration_s == 4.0
    time_s = np.array([4.0, 0.0, 0.25, 1.0])
    position_m, bearing_rad, depression_rad, roll_rad = log.at(time_s, _ground_m)
    flown_m = np.outer(time_s, [6.0, 8.0]) + HOME_M
    assert np.abs(position_m[:, :2] - flown_m).max() < 0.02
    assert position_m[:, 2] == pytest.approx(8 + 40 + 0.5 * time_s, abs=1e-9)
    assert np.degrees(bearing_rad) == pytest.approx(90 - 352 - 8 * time_s)
    assert np.degrees(depression_rad) == pytest.approx(90 - 10 * time_s)
    assert np.degrees(roll_rad) == pytest.approx([0, 0, 0.2, 0.8])


def test_moments_are_independent_and_ends_are_extended():
    log = read_waypoints(str(FLIGHTS / "log.csv"), HOME_M, _ground_m, WHERE)
    time_s = np.array([0.0, 3.3, 4.0])
    together = log.at(time_s, _ground_m)
    for k in range(3):
        alone = log.at(time_s[k : k + 1], _ground_m)
        assert all(np.array_equal(one[0], all_[k]) for one, all_ in zip(alone, together))
    beyond = log.at(np.array([-1.0, 3.3, 9.0]), _ground_m)
    assert all(np.array_equal(*both) for both in zip(beyond, together))


@pytest.mark.parametrize(
    "reference, height_m", [("z_m", [50, 52]), ("agl_m", [58, 62]), ("altitude_m", [58, 60])]
)
def test_heights_are_above_what_their_column_says(tmp_path, reference, height_m):
    text = COLUMNS.replace("z_m", reference) + "\n0,10,20,50,0,-90,0\n1,30,20,52,0,-90,0\n"
    position_m, *_ = _read(tmp_path, text).at(np.array([0.0, 1.0]), _ground_m)
    assert position_m == pytest.approx(np.array([[10, 20, height_m[0]], [30, 20, height_m[1]]]))


def test_the_camera_turns_by_aviation_angles(tmp_path):
    """Yaw 90 looks east, pitch -30 down, and roll 10 puts the right side down."""
    log = _read(tmp_path, COLUMNS + "\n0,0,0,50,90,-30,10\n1,0,0,50,90,-30,10\n")
    position_m, bearing_rad, depression_rad, roll_rad = log.at(np.zeros(1), _ground_m)
    bearing = np.stack([np.cos(bearing_rad), np.sin(bearing_rad)], axis=-1)
    pose = look(position_m, bearing, depression_rad)
    forward = pose[:, :3, 2]
    assert forward[0] == pytest.approx([np.cos(np.radians(30)), 0, -0.5])
    right = (by_vector(roll_rad[:, None] * forward) @ pose[:, :3, :3])[0, :, 0]
    assert right[2] == pytest.approx(-np.sin(np.radians(10)) * np.cos(np.radians(30)))


def test_how_a_table_is_laid_out_does_not_matter(tmp_path):
    lines = [line.split(",") for line in TEXT.splitlines()]
    turned = "\n".join(",".join(reversed(line)) for line in lines)
    spaced = TEXT.replace(",", " , ").replace("\n", "\r\n\r\n")
    quoted = TEXT.replace("time_s", '"time_s"')
    time_s = np.linspace(0, 4, 9)
    same = _read(tmp_path, TEXT).at(time_s, _ground_m)
    for text in (turned, spaced, quoted, "\ufeff" + TEXT, TEXT.replace("\n", "\r")):
        log = _read(tmp_path, text, "LOG.CSV").at(time_s, _ground_m)
        assert all(np.array_equal(*both) for both in zip(log, same))


ROW = "\n0,1,2,50,0,-90,0"
FAULTS = {
    "no bytes": ("", "{where} = {file}; expected a header and lines of numbers, and the file is empty"),
    "no lines": (COLUMNS, "log.csv = 0 lines of numbers; expected at least 2"),
    "one line": (COLUMNS + ROW, "log.csv = 1 lines of numbers; expected at least 2"),
    "no header": (
        "0,1,2,50,0,-90,0" + ROW,
        'log.csv: line 1 = "0,1,2,50,0,-90,0"; expected the names of the columns',
    ),
    "unknown column": (
        COLUMNS.replace("yaw_deg", "yaw"),
        'log.csv: column 5 = "yaw"; expected a column: agl_m, altitude_m, latitude_deg, longitude_deg, pitch_deg,'
        ' roll_deg, time_s, x_m, y_m, yaw_deg, z_m; did you mean "yaw_deg"?',
    ),
    "a column twice": (COLUMNS + ",z_m", 'log.csv: column 8 = "z_m"; expected each column once'),
    "no roll": (
        COLUMNS.replace(",roll_deg", ""),
        "log.csv: column roll_deg is missing; expected time_s, yaw_deg, pitch_deg, roll_deg",
    ),
    "no place": (
        COLUMNS.replace("x_m,y_m,", ""),
        "log.csv: columns are missing; expected either x_m and y_m, or latitude_deg and longitude_deg",
    ),
    "half a place": (
        COLUMNS.replace("y_m", "latitude_deg"),
        "log.csv: columns = x_m, latitude_deg; expected either x_m and y_m, or latitude_deg and longitude_deg",
    ),
    "no height": (
        COLUMNS.replace("z_m,", ""),
        "log.csv: columns are missing; expected either z_m, or agl_m, or altitude_m",
    ),
    "two heights": (
        COLUMNS + ",agl_m",
        "log.csv: columns = z_m, agl_m; expected either z_m, or agl_m, or altitude_m",
    ),
    "a value too few": (
        COLUMNS + ROW + "\n1,1,2,50,0,-90",
        "log.csv: line 3 = 6 values; expected 7, as many as columns",
    ),
    "a value too many": (
        COLUMNS + "\n" + ROW + ",",
        "log.csv: line 3 = 8 values; expected 7, as many as columns",
    ),
    "no number": (
        COLUMNS + ROW + "\n1,1,2,50,0,down,0",
        'log.csv: line 3, pitch_deg = "down"; expected a number from -90 to 90',
    ),
    "nothing": (
        COLUMNS + "\n0,1,2,50,,-90,0",
        'log.csv: line 2, yaw_deg = ""; expected a number from -360 to 360',
    ),
    "a number of Python's": (
        COLUMNS + "\n1_0,1,2,50,0,-90,0",
        'log.csv: line 2, time_s = "1_0"; expected a number from -1e+11 to 1e+11',
    ),
    "not finite": (
        COLUMNS + "\n0,nan,2,50,0,-90,0",
        'log.csv: line 2, x_m = "nan"; expected a number from -100000 to 100000',
    ),
    "off the Earth": (
        TEXT.replace("-2.3311277", "-92.3311277"),
        'log.csv: line 4, latitude_deg = "-92.3311277"; expected a number from -89 to 89',
    ),
    "far away": (
        TEXT.replace("-2.3311277", "-3.3311277"),
        "log.csv: line 4 = 110.6 km from the first position; expected at most 20 km",
    ),
    "time stands still": (
        TEXT.replace("1001.5", "1001.0"),
        "log.csv: line 5, time_s = 1001 s; expected more than 1001 s, the time before",
    ),
}


@pytest.mark.parametrize("text, message", FAULTS.values(), ids=FAULTS)
def test_faults_are_named(tmp_path, text, message):
    with pytest.raises(ConfigError) as fault:
        _read(tmp_path, text)
    assert str(fault.value) == message.format(where=f"{WHERE}.file", file=tmp_path / "log.csv")


def test_malformed_logs_are_refused_and_never_crash(tmp_path):
    dice = random.Random(1)  # of this test alone
    odd = [
        "",
        ",",
        "\n",
        '"',
        "\x00",
        "\r",
        "nan",
        "1e999",
        "-",
        "_",
        "é",
        "9" * 400,
        ";",
        "x_m",
        "a" * 200_000,
    ]
    refused = 0
    for _ in range(2000):
        text = TEXT
        for _ in range(dice.randint(1, 2)):
            place = dice.randrange(len(text))
            text = text[:place] + dice.choice(odd) + text[place + dice.randint(0, 2) :]
        try:
            position_m, *angles_rad = _read(tmp_path, text).at(np.linspace(0, 4, 5), _ground_m)
            assert np.isfinite(position_m).all() and np.isfinite(angles_rad).all()
        except ConfigError:
            refused += 1
    assert 300 < refused < 2000
