"""Daylight colours of surfaces, used in previews only; they do not affect datasets."""

from __future__ import annotations

from .. import assets

UNKNOWN = "#8a8078"  # default of a material: a stony grey
SKY = "#a9c8e8"
INK = "#101010"  # of letters and lines
_PALETTE = (
    "#e6194b",
    "#1f5fd0",
    "#f58231",
    "#911eb4",
    "#00a3a3",
    "#e43fd0",
    "#7a4a12",
    "#101010",
    "#0a8f3c",
    "#800000",
    "#f2d13a",
    "#000080",
)


def surface_colour(material: str, part: str = "") -> str:
    """The sRGB colour, #rrggbb, of a part of a material, or else of the material."""
    data = assets.load("materials", material)
    return data.get("parts", {}).get(part, {}).get("colour", data.get("colour", UNKNOWN))


def signal_colours(names: list[str]) -> dict[str, str]:
    """Colours, #rrggbb, that distinguish names on a map; they repeat after the twelfth."""
    return {name: _PALETTE[k % len(_PALETTE)] for k, name in enumerate(dict.fromkeys(names))}


def linear(colour: str) -> tuple[float, float, float]:
    """Linear red, green and blue, 0 to 1, of #rrggbb (IEC 61966-2-1)."""
    red, green, blue = _bytes(colour)
    return _linear(red / 255.0), _linear(green / 255.0), _linear(blue / 255.0)


def mixed(below: str, above: str, opacity: float) -> str:
    """The approximate result of one colour seen through another."""
    pairs = zip(_bytes(below), _bytes(above))
    return "#" + "".join(f"{round((1.0 - opacity) * a + opacity * b):02x}" for a, b in pairs)


def _bytes(colour: str) -> list[int]:
    return [int(colour[k : k + 2], 16) for k in (1, 3, 5)]


def _linear(value: float) -> float:
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
