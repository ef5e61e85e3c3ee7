"""Read passes for the tests."""

from pathlib import Path

import numpy as np
import OpenImageIO

from pictures import channel_name


def read_planes(path: Path) -> dict[str, np.ndarray]:
    """All channels of an EXR file by name as Blender before 5.0 spells it, each (height, width) of float32."""
    file = OpenImageIO.ImageInput.open(str(path))
    assert file is not None, OpenImageIO.geterror()
    names = file.spec().channelnames
    pixels = file.read_image("float")
    file.close()
    return {channel_name(name): pixels[..., k] for k, name in enumerate(names)}
