"""Veldt in Python: radiance, cameras, temperatures by the weather, labels and datasets, equal to the results of the
command `veldt`, bit for bit. NumPy arrays in, NumPy arrays out; computations release the interpreter's lock.

Errors are those of the command, with the same messages: `ConfigError`, `DataError`, `IoError`, `TryAgainError` and
`Cancelled`, all of them `Error`.
"""

from __future__ import annotations

from veldt._core import Cancelled, ConfigError, DataError, Error, IoError, TryAgainError
from .band import Band
from .camera import Camera, Exposure
from .converter import Converter, MadeFrame
from .datasets import Clip, Dataset, Frame, Label, open_dataset, splits_of
from .heat import HeatOfDay
from .labels import Instance, instances
from .runs import Outcome, Progress, generate, plan
from .stream import Stream, StreamCounts
from .video import VideoChain
from .world import Actor, Capture, Intrinsics, World

__all__ = [
    "Actor",
    "Band",
    "Camera",
    "Cancelled",
    "Capture",
    "Clip",
    "ConfigError",
    "Converter",
    "DataError",
    "Dataset",
    "Error",
    "Exposure",
    "Frame",
    "HeatOfDay",
    "Instance",
    "Intrinsics",
    "IoError",
    "Label",
    "MadeFrame",
    "Outcome",
    "Progress",
    "Stream",
    "StreamCounts",
    "TryAgainError",
    "VideoChain",
    "World",
    "generate",
    "instances",
    "open_dataset",
    "plan",
    "splits_of",
]
