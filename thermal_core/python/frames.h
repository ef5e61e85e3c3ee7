#pragma once

#include <pybind11/pybind11.h>

#include "dataset/clip/imager.h"
#include "dataset/run/live_clip.h"

namespace thermal::python {

/// A frame for Python: ir8, ir16, whether the shutter was closed, and its labels as JSON, each label_entry() with its
/// category. The pictures are copied: the clip reuses its frame.
[[nodiscard]] pybind11::tuple tuple_of(const ClipImager::Frame& frame, const LiveClip& clip);

}  // namespace thermal::python
