"""Check flight plans that pass the schema for being flyable."""

from __future__ import annotations

from collections.abc import Mapping

from ..faults import ConfigError, did_you_mean
from .aircraft import aircraft_of
from .poses import Flight

_PATTERNS = "zigzag, transect, waypoints, orbit or follow"
_NEEDED = {  # by pattern: a required key, and its meaning
    "zigzag": ("area_m", "[x_min, y_min, x_max, y_max]"),
    "transect": ("points_m", "two points [x, y]"),
    "orbit": ("radius_m", "the distance from the middle"),
    "follow": ("target", "an actor or a group"),
}


def check_entry(where: str, entry: dict, targets: Mapping[str, object]) -> None:
    """Check the plan of a clip or flight by itself. targets: names that it can look at."""
    if "flight" not in entry:
        raise ConfigError(f"{where}.flight is missing; expected a flight plan with a pattern: {_PATTERNS}")
    if "clip_length_s" in entry and entry["clip_length_s"] > entry["duration_s"]:
        raise ConfigError(
            f'{where}.clip_length_s = {entry["clip_length_s"]:g} s; expected at most duration_s ='
            f' {entry["duration_s"]:g} s, the length of the flight'
        )
    if "duration_s" in entry and entry["duration_s"] * entry["frame_rate_hz"] < 1.0:
        raise ConfigError(
            f'{where}.duration_s = {entry["duration_s"]:g} s; expected at least one frame,'
            f' {1.0 / entry["frame_rate_hz"]:g} s at {entry["frame_rate_hz"]:g} Hz'
        )
    _check_plan(f"{where}.flight", entry["flight"], targets)


def check_height(where: str, flight: Flight) -> None:
    """Check that the camera stays above ground and water."""
    lowest = int(flight.agl_m.argmin())
    if flight.agl_m[lowest] <= 0:
        raise ConfigError(
            f"{where}.flight: the camera is {-flight.agl_m[lowest]:.1f} m under the terrain"
            f" at time_s = {flight.time_s[lowest]:.1f}; expected it above ground all along"
        )


def _check_plan(where: str, plan: dict, targets: Mapping[str, object]) -> None:
    pattern = plan["pattern"]
    if plan["altitude_reference"] == "ground" and plan["altitude_m"] <= 0:
        raise ConfigError(
            f'{where}.altitude_m = {plan["altitude_m"]:g} m; expected more than 0 m above ground'
        )
    if pattern in _NEEDED and _NEEDED[pattern][0] not in plan:
        key, what = _NEEDED[pattern]
        raise ConfigError(f'{where}.{key} is missing; expected {what}, since pattern is "{pattern}"')
    if pattern == "zigzag":
        _check_area(where, plan)
    elif pattern == "transect":
        _check_transect(where, plan)
    elif pattern == "waypoints":
        _check_either(where, plan, "points_m", "waypoints")
    elif pattern == "orbit":
        _check_either(where, plan, "target", "centre_m")
        _check_circle(where, plan)
    elif plan["aircraft"] == "fixed_wing":
        raise ConfigError(
            f'{where}.aircraft = "fixed_wing"; expected "multirotor", since pattern is "follow": a fixed wing cannot'
            " fly as slowly as its target walks"
        )
    if "target" in plan and plan["target"] not in targets:
        near = did_you_mean(plan["target"], targets)
        raise ConfigError(f'{where}.target = "{plan["target"]}"; expected an actor or a group{near}')


def _check_either(where: str, plan: dict, one: str, other: str) -> None:
    if (one in plan) == (other in plan):
        found = "both are given" if one in plan else "neither is given"
        raise ConfigError(
            f'{where}: {found}; expected {one} or {other}, since pattern is "{plan["pattern"]}"'
        )


def _check_area(where: str, plan: dict) -> None:
    x0, y0, x1, y1 = plan["area_m"]
    if not (x0 < x1 and y0 < y1):
        raise ConfigError(f'{where}.area_m = {plan["area_m"]} m; expected x_min < x_max and y_min < y_max')


def _check_transect(where: str, plan: dict) -> None:
    points = plan["points_m"]
    if len(points) != 2 or points[0][:2] == points[1][:2]:
        raise ConfigError(f"{where}.points_m = {points} m; expected two different points [x, y]")


def _check_circle(where: str, plan: dict) -> None:
    least_m = aircraft_of(plan).turn_radius_m
    if plan["radius_m"] < least_m:
        raise ConfigError(
            f'{where}.radius_m = {plan["radius_m"]:g} m; expected at least {least_m:.1f} m, the tightest turn at'
            f' {plan["speed_m_s"]:g} m/s and {plan["bank_deg"]:g} deg of bank'
        )
