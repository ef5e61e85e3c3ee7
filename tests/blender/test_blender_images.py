"""Adding a layer to a frame's file keeps its other layers."""

import numpy as np
import OpenImageIO

from pictures import read_planes
from planner.blender_images import add_layer, is_whole_exr


def _write(path, names: list[str], pixels: np.ndarray) -> None:
    spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], len(names), "float")
    spec.channelnames = names
    spec.attribute("compression", "none")
    file = OpenImageIO.ImageOutput.create(str(path))
    assert file.open(str(path), spec) and file.write_image(pixels)
    file.close()


def _frame(path) -> np.ndarray:
    pixels = np.arange(5 * 7 * 3, dtype=np.float32).reshape(5, 7, 3)
    _write(path, ["Scene.Combined.R", "Scene.Depth.Z", "Scene.IndexOB.X"], pixels)
    return pixels


def test_the_other_frames_channel_is_added_and_the_picture_left_out(tmp_path):
    pixels, other = _frame(tmp_path / "a.exr"), 0.5 * np.ones((5, 7, 1), np.float32)
    other[2, 3] = 32767
    _write(tmp_path / "b.exr", ["Scene.IndexOB.X"], other)
    add_layer(
        tmp_path / "a.exr", "Actors.IndexOB.X", tmp_path / "b.exr", "Scene.IndexOB.X", tmp_path / "c.exr"
    )
    assert is_whole_exr(tmp_path / "c.exr")
    planes = read_planes(tmp_path / "c.exr")
    assert list(planes) == ["Actors.IndexOB.X", "Scene.Depth.Z", "Scene.IndexOB.X"]
    assert np.array_equal(planes["Actors.IndexOB.X"], other[..., 0])
    assert np.array_equal(planes["Scene.Depth.Z"], pixels[..., 1])
    assert np.array_equal(planes["Scene.IndexOB.X"], pixels[..., 2])


def test_without_another_frame_the_layer_is_empty(tmp_path):
    _frame(tmp_path / "a.exr")
    add_layer(tmp_path / "a.exr", "Actors.IndexOB.X", None, "Scene.IndexOB.X", tmp_path / "c.exr")
    assert not read_planes(tmp_path / "c.exr")["Actors.IndexOB.X"].any()
