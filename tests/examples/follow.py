"""A detector in the loop: fly after a group of people by what the camera sees, and say how well it went.

  pip install '.[gym]' matplotlib pillow
  veldt plan configs/follow.json --out plan
  python tests/examples/follow.py plan night --picture follow.jpg

The detector looks for warm spots of a person's size in the 8-bit frame. The pilot turns them into places on flat
ground, leaves out those that stay where they are, such as warm stones, follows those near the group, and keeps the
camera behind it. Neither knows where anybody is: labels only judge.
"""

from __future__ import annotations

import argparse
import time
from collections import deque
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from veldt import Actor, Capture, Intrinsics
from veldt.gym import FlightEnv

PERSON_M = 0.8  # across: between the width of the shoulders and the height
HEIGHT_M = 61  # above the ground, as a drone's barometer has it from the start
DISTANCE_M = 61  # from the group, over ground: the camera looks 45 degrees down
MOST_SPOTS = 24
STILL_S = 3  # what has been at its place for this long does not walk
STILL_M = 0.7


class Spot(NamedTuple):
    """A warm spot in a frame."""

    column_px: float
    row_px: float
    contrast: float
    """Above its surroundings, in standard deviations of the frame's background."""


def sums_in_boxes(grey: NDArray[np.float32], size_px: int) -> NDArray[np.float32]:
    """Sums over the box of size x size around each pixel; beyond the border, the border's pixels go on."""
    left, right = size_px // 2, size_px - size_px // 2
    padded = np.pad(grey, ((left + 1, right - 1), (left + 1, right - 1)), mode="edge")
    sums = padded.cumsum(axis=0, dtype=np.float32)
    sums = (sums[size_px:] - sums[:-size_px]).cumsum(axis=1, dtype=np.float32)
    return sums[:, size_px:] - sums[:, :-size_px]


def warm_spots(ir8: NDArray[np.uint8], size_px: int, least: float = 6) -> list[Spot]:
    """The spots of about this size that are warmer than what is around them, the clearest first."""
    grey = ir8.astype(np.float32) - np.float32(ir8.mean())
    wide_px = 4 * size_px
    inner, outer = sums_in_boxes(grey, size_px), sums_in_boxes(grey, wide_px)
    inner_mean = inner / size_px**2
    contrast = inner_mean - (outer - inner) / (wide_px**2 - size_px**2)
    deviation = 1.4826 * np.median(np.abs(contrast[::4, ::4]))
    contrast /= max(float(deviation), 0.25)
    spots: list[Spot] = []
    while len(spots) < MOST_SPOTS:
        row, column = np.unravel_index(np.argmax(contrast), contrast.shape)
        if contrast[row, column] < least:
            break
        spots.append(Spot(column + 0.5, row + 0.5, float(contrast[row, column])))
        reach = slice(max(0, row - size_px), row + size_px + 1), slice(
            max(0, column - size_px), column + size_px + 1
        )
        contrast[reach] = 0
    return spots


def place_on_ground(
    spot: Spot, pose: NDArray[np.float64], camera: Intrinsics, ground_m: float
) -> NDArray[np.float64] | None:
    """East and north [m] of a spot, if the ground is flat at that height; None above the horizon."""
    ray = np.array(
        [(spot.column_px - camera.cx_px) / camera.fx_px, (spot.row_px - camera.cy_px) / camera.fy_px, 1]
    )
    direction = pose[:3, :3] @ ray
    if direction[2] > -0.05:
        return None
    return pose[:2, 3] + direction[:2] * (pose[2, 3] - ground_m) / -direction[2]


class Pilot:
    """Where the group is thought to be, and how to fly after it."""

    def __init__(self, pose: NDArray[np.float64], camera: Intrinsics, frame_rate_hz: float) -> None:
        """The group is where the first pose looks."""
        self._camera = camera
        self._frame_s = 1 / frame_rate_hz
        self._ground_m = pose[2, 3] - HEIGHT_M
        middle = Spot(camera.cx_px, camera.cy_px, 0)
        self.place_m = place_on_ground(middle, pose, camera, self._ground_m)
        self.velocity_m_s = np.zeros(2)
        self.seen_s = 0.0  # ago
        self._places_m: deque[NDArray[np.float64]] = deque(maxlen=round(STILL_S * frame_rate_hz))
        self._last: NDArray[np.uint8] | None = None

    def look(self, ir8: NDArray[np.uint8], pose: NDArray[np.float64]) -> list[Spot]:
        """Update the place by a frame: the mean of the spots near to where the group should be by now."""
        self.place_m = self.place_m + self.velocity_m_s * self._frame_s
        self.seen_s += self._frame_s
        frozen = self._last is not None and np.array_equal(ir8, self._last)  # the camera's shutter is closed
        self._last = ir8
        if frozen:
            return []
        distance_m = np.hypot(pose[2, 3] - self._ground_m, np.linalg.norm(pose[:2, 3] - self.place_m))
        size_px = max(3, round(self._camera.fx_px * PERSON_M / distance_m))
        spots, places_m = self._places_of(warm_spots(ir8, size_px), pose)
        walks = ~self._stay(places_m)
        self._places_m.append(places_m)
        near = walks & (np.linalg.norm(places_m - self.place_m, axis=1) < 7 + min(2 * self.seen_s, 15))
        if near.any():
            self._correct(places_m[near].mean(axis=0) - self.place_m)
        return [spot for spot, one in zip(spots, near) if one]

    def _places_of(
        self, spots: list[Spot], pose: NDArray[np.float64]
    ) -> tuple[list[Spot], NDArray[np.float64]]:
        """The spots on the ground, and their places (n, 2)."""
        places_m = [place_on_ground(spot, pose, self._camera, self._ground_m) for spot in spots]
        on_ground = [(spot, place_m) for spot, place_m in zip(spots, places_m) if place_m is not None]
        return [spot for spot, _ in on_ground], np.array([place_m for _, place_m in on_ground]).reshape(-1, 2)

    def _stay(self, places_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether something has been at each place all the time. People in single file take turns at a place."""
        times = np.zeros(len(places_m))
        for before_m in self._places_m:
            off_m = np.linalg.norm(places_m[:, None] - before_m[None], axis=2)
            times += off_m.min(axis=1, initial=np.inf) < STILL_M
        return times > 0.8 * self._places_m.maxlen

    def _correct(self, off_m: NDArray[np.float64]) -> None:
        """An alpha-beta filter."""
        self.place_m = self.place_m + 0.2 * off_m
        velocity_m_s = self.velocity_m_s + 0.02 / self._frame_s * off_m
        self.velocity_m_s = velocity_m_s * min(
            1, 2.5 / max(np.linalg.norm(velocity_m_s), 1e-9)
        )  # people don't run for long
        self.seen_s = 0

    def steer(
        self, pose: NDArray[np.float64], max_speed_m_s: float, max_turn_rad_s: float
    ) -> NDArray[np.float32]:
        """The action that keeps the camera at its distance and height, looking at the group."""
        ahead = np.array([pose[0, 2], pose[1, 2]]) / max(np.hypot(pose[0, 2], pose[1, 2]), 1e-9)
        to_group_m = self.place_m - pose[:2, 3]
        distance_m = np.linalg.norm(to_group_m)
        wanted_m_s = self.velocity_m_s + 0.5 * to_group_m * (1 - DISTANCE_M / max(distance_m, 1e-9))
        climb_m_s = 0.5 * (HEIGHT_M - (pose[2, 3] - self._ground_m))
        right = np.array([ahead[1], -ahead[0]])
        turn_rad = np.arctan2(-to_group_m @ right, to_group_m @ ahead)
        down_rad = np.arctan2(pose[2, 3] - self._ground_m, distance_m) - np.arcsin(
            np.clip(-pose[2, 2], -1, 1)
        )
        speeds = np.array([wanted_m_s @ ahead, wanted_m_s @ right, climb_m_s]) / max_speed_m_s
        turns = np.array([turn_rad, down_rad]) / max_turn_rad_s
        return np.clip(np.concatenate([speeds, turns]), -1, 1).astype(np.float32)


class Step(NamedTuple):
    """What a frame showed, and what was true."""

    time_s: float
    camera_m: NDArray[np.float64]
    thought_m: NDArray[np.float64]
    true_m: NDArray[np.float64]
    seen: int
    """People of the group that the frame's labels have."""
    count: int


def group_of(actors: dict[int, Actor], follow: str) -> dict[int, NDArray[np.float64]]:
    """Where the followed actors are, east and north [m], by track."""
    return {track: np.array(one.position_m[:2]) for track, one in actors.items() if one.category == follow}


def judge(time_s: float, capture: Capture, pose: NDArray[np.float64], pilot: Pilot, follow: str) -> Step:
    """Compare what the pilot thinks with where the group is."""
    group = group_of(capture.actors, follow)
    seen = {label.track_id for label in capture.labels} & set(group)
    true_m = np.mean(list(group.values()), axis=0)
    return Step(time_s, pose[:2, 3].copy(), pilot.place_m.copy(), true_m, len(seen), len(group))


def fly(
    env: FlightEnv, follow: str
) -> tuple[list[Step], float, dict[float, tuple[NDArray[np.uint8], list[Spot]]]]:
    """Follow until the plan's time is over: the steps, the seconds it took, and a frame every minute with its spots."""
    max_speed_m_s, max_turn_rad_s = 15, 1
    ir8, info = env.reset()
    pilot = Pilot(info["camera_to_world"], env.world.camera, env.world.frame_rate_hz)
    steps: list[Step] = []
    shown: dict[float, tuple[NDArray[np.uint8], list[Spot]]] = {}
    over, frame = False, 0
    start_s = time.perf_counter()
    while True:
        pose = info["camera_to_world"]
        spots = pilot.look(ir8, pose)
        time_s = frame / env.world.frame_rate_hz
        steps.append(judge(time_s, info["capture"], pose, pilot, follow))
        if frame % round(60 * env.world.frame_rate_hz) == 0:
            shown[time_s] = ir8.copy(), spots
        if over:
            return steps, time.perf_counter() - start_s, shown
        ir8, _, _, over, info = env.step(pilot.steer(pose, max_speed_m_s, max_turn_rad_s))
        frame += 1


def longest_s(absent: NDArray[np.bool_], frame_s: float) -> float:
    """The longest time without a break."""
    longest = run = 0
    for one in absent:
        run = run + 1 if one else 0
        longest = max(longest, run)
    return longest * frame_s


def print_result(steps: list[Step], took_s: float, frame_rate_hz: float) -> None:
    """How well it went, and how fast."""
    off_m = np.array([np.linalg.norm(step.thought_m - step.true_m) for step in steps])
    seen = np.array([step.seen for step in steps])
    away = longest_s(seen == 0, 1 / frame_rate_hz)
    flown_s, speed_hz = len(steps) / frame_rate_hz, len(steps) / took_s
    print(f"{len(steps)} frames, {flown_s:.0f} s of flight in {took_s:.0f} s: {speed_hz:.1f} frames/s")
    print(
        f"in view: {seen.sum() / sum(step.count for step in steps):.1%} of the group; away for {away:.1f} s at most"
    )
    middle_m, high_m = np.percentile(off_m, [50, 95])
    print(f"thought to be {middle_m:.1f} m off (median), {high_m:.1f} m (95 %), {off_m.max():.1f} m (most)")
    print("lost" if off_m[-1] > 15 or seen[-1] == 0 else "not lost")


def draw(steps: list[Step], shown: dict[float, tuple[NDArray[np.uint8], list[Spot]]], path: Path) -> None:
    """A map of the flight, how far off the pilot was, and what the camera saw every minute."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplot_mosaic("AAAABB;AAAACC;DDEEFF", figsize=(12, 10.5), layout="constrained")
    column = {name: np.array([getattr(step, name) for step in steps]) for name in Step._fields}
    axes["A"].plot(*column["camera_m"].T, color="0.6", label="camera")
    axes["A"].plot(*column["true_m"].T, color="tab:blue", linewidth=5, alpha=0.4, label="group")
    axes["A"].plot(*column["thought_m"].T, color="tab:red", linewidth=1, label="where the pilot thinks it is")
    for time_s in shown:
        step = steps[int(np.searchsorted(column["time_s"], time_s))]
        axes["A"].annotate(f"{time_s:.0f} s", step.true_m, textcoords="offset points", xytext=(6, 6))
        axes["A"].plot(*np.array([step.camera_m, step.true_m]).T, color="0.8", linewidth=1, zorder=0)
    axes["A"].set(xlabel="east [m]", ylabel="north [m]", aspect="equal")
    axes["A"].legend()
    axes["B"].plot(
        column["time_s"], np.linalg.norm(column["thought_m"] - column["true_m"], axis=1), color="tab:red"
    )
    axes["B"].set(xlabel="time [s]", ylabel="error of the place [m]", ylim=(0, None))
    axes["C"].plot(column["time_s"], column["seen"], color="tab:blue")
    axes["C"].set(xlabel="time [s]", ylabel="people in view", ylim=(0, None))
    axes["C"].yaxis.get_major_locator().set_params(integer=True)
    for name, (time_s, (ir8, spots)) in zip("DEF", list(shown.items())[1::2]):
        axes[name].imshow(ir8, cmap="gray", vmin=0, vmax=255)
        axes[name].scatter(
            [spot.column_px for spot in spots],
            [spot.row_px for spot in spots],
            s=80,
            facecolors="none",
            edgecolors="tab:red",
        )
        axes[name].set(title=f"{time_s:.0f} s", xticks=[], yticks=[])
    figure.savefig(path, dpi=100)


def main() -> None:
    """Fly, print and draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("plan", type=Path, help="what `veldt plan` wrote")
    parser.add_argument("clip")
    parser.add_argument("--follow", default="human", metavar="CATEGORY")
    parser.add_argument("--rate", type=float, metavar="HZ", help="frames a second; the clip's by default")
    parser.add_argument("--picture", type=Path, metavar="FILE")
    given = parser.parse_args()
    env = FlightEnv(given.plan, given.clip, follow=given.follow, frame_rate_hz=given.rate)
    steps, took_s, shown = fly(env, given.follow)
    print_result(steps, took_s, env.world.frame_rate_hz)
    if given.picture:
        draw(steps, shown, given.picture)


if __name__ == "__main__":
    main()
