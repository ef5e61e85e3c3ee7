#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "dataset/stream/frame_stream.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

FrameStream* open_stream(const std::string& video_url, const std::optional<std::string>& labels_url,
                         double frame_rate_hz, int width_px, int height_px) {
  StreamTarget target = {.video = parse_video_address(video_url, "video_url"),
                         .frame_rate_hz = frame_rate_hz,
                         .width_px = width_px,
                         .height_px = height_px};
  if (labels_url) target.lines = parse_line_address(*labels_url, "labels_url");
  return new FrameStream(target);  // pybind11 owns it
}

}  // namespace

void add_stream(py::module_& module) {
  py::class_<FrameStream>(module, "FrameStream")
      .def(py::init(&open_stream), py::arg("video_url"), py::arg("labels_url"), py::arg("frame_rate_hz"),
           py::arg("width_px"), py::arg("height_px"), py::call_guard<py::gil_scoped_release>())
      .def(
          "send",
          [](FrameStream& stream, const ArrayOf<std::uint8_t>& ir8, std::int64_t time, std::string line) {
            const Plane<std::uint8_t> frame = plane_of<std::uint8_t>(ir8, "ir8");
            const py::gil_scoped_release others_run;
            return stream.send(frame, time, std::move(line));
          },
          py::arg("ir8"), py::arg("time"), py::arg("line"))
      .def("close", &FrameStream::close, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("counts", [](const FrameStream& stream) {
        const FrameStream::Counts counts = stream.counts();
        return py::make_tuple(counts.sent, counts.dropped, counts.lines_missed, counts.fault);
      });
}

}  // namespace thermal::python
