#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "dataset/stream/frame_stream.h"
#include "dataset/stream/lateness.h"
#include "io/video/h264_file.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

FrameStream* open_stream(const std::string& video_url, const std::optional<std::string>& labels_url,
                         double frame_rate_hz, int width_px, int height_px, bool allow_remote) {
  StreamTarget target = {.video = parse_video_address(video_url, "video_url"),
                         .frame_rate_hz = frame_rate_hz,
                         .width_px = width_px,
                         .height_px = height_px};
  if (labels_url) target.lines = parse_line_address(*labels_url, "labels_url");
  if (!allow_remote) {
    constexpr const char* kPermit = "allow_remote=True";
    check_is_loopback(target.video, "video_url", kPermit);
    if (target.lines) check_is_loopback(*target.lines, "labels_url", kPermit);
  }
  silence_ffmpeg();                // counts report a missing receiver
  return new FrameStream(target);  // pybind11 owns it
}

}  // namespace

void add_stream(py::module_& module) {
  py::class_<FrameStream>(module, "FrameStream")
      .def(py::init(&open_stream), py::arg("video_url"), py::arg("labels_url"), py::arg("frame_rate_hz"),
           py::arg("width_px"), py::arg("height_px"), py::arg("allow_remote"),
           py::call_guard<py::gil_scoped_release>())
      .def(
          "send",
          [](FrameStream& stream, const py::object& ir8, std::int64_t time, const std::string& line) {
            const Plane<std::uint8_t> frame = levels_of(ir8, "ir8");
            const py::gil_scoped_release others_run;
            return stream.send(frame, time, line);
          },
          py::arg("ir8"), py::arg("time"), py::arg("line"))
      .def("close", &FrameStream::close, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("clients_refused",
                             [](const FrameStream& stream) { return stream.counts().clients_refused; })
      .def_property_readonly("counts", [](const FrameStream& stream) {
        const FrameStream::Counts counts = stream.counts();
        return py::make_tuple(counts.sent, counts.dropped, counts.waiting, counts.lines_missed, counts.fault);
      });
  module.def(
      "check_is_loopback",
      [](const std::string& url, const std::string& where, const std::string& permit) {
        check_is_loopback(parse_address(url, {"udp", "tcp", "rtsp"}, where), where, permit);
      },
      py::arg("url"), py::arg("where"), py::arg("permit"));
  module.def("frames_to_leave_out", &frames_to_leave_out, py::arg("late_s"), py::arg("frame_rate_hz"));
}

}  // namespace thermal::python
