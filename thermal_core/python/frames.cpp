#include "python/frames.h"

#include "python/arrays.h"

namespace thermal::python {

py::tuple tuple_of(const ClipImager::Frame& frame, const LiveClip& clip) {
  return py::make_tuple(array_of(Plane<std::uint8_t>(frame.pictures.ir8)),
                        array_of(Plane<std::uint16_t>(frame.pictures.ir16)), frame.pictures.shutter_closed,
                        clip.labels().dump());
}

}  // namespace thermal::python
