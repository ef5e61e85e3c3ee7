#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "io/pass_buffer.h"
#include "labels/instances.h"
#include "labels/rle.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// Column-major run lengths as a plane of 0 and 1. DataError unless they cover it exactly, and above the limit of
/// pixels in a picture.
Plane<std::uint8_t> mask_of(const RunLengths& runs, int width_px, int height_px) {
  const std::int64_t size = static_cast<std::int64_t>(width_px) * height_px;
  if (width_px < 1 || height_px < 1 || size > ReadLimits{}.pixels)
    throw DataError(fault("size of a mask", fmt::format("{} x {}", width_px, height_px), "px",
                          fmt::format("1 to {} px in all", ReadLimits{}.pixels)));
  if (covered_px(runs) != size)
    throw DataError(fault("run lengths", std::to_string(covered_px(runs)), "px",
                          std::to_string(size) + " px, as the picture has"));
  Plane<std::uint8_t> mask(width_px, height_px);
  for_stretches(runs, height_px, [&](int x, int y, int stretch_px) {
    for (int row = y; row < y + stretch_px; ++row) mask.at(x, row) = 1;
  });
  return mask;
}

/// `actors`: a plane, or None.
std::vector<Instance> instances_of(const py::object& index_plane, const py::object& actors) {
  const Plane<std::uint16_t> plane = index_plane_of(index_plane, "index_plane");
  const IndexSet labelled =
      actors.is_none() ? IndexSet() : IndexSet(index_plane_of(actors, "actors").pixels());
  const py::gil_scoped_release others_run;
  return extract_instances(plane, survey_indices(plane), labelled);
}

}  // namespace

void add_labels(py::module_& module) {
  py::class_<Instance>(module, "Instance")
      .def_readonly("index", &Instance::index)
      .def_readonly("area_px", &Instance::area_px)
      .def_readonly("truncated", &Instance::truncated)
      .def_property_readonly("box_px",
                             [](const Instance& of) {
                               return py::make_tuple(of.box.x_px, of.box.y_px, of.box.width_px,
                                                     of.box.height_px);
                             })
      .def_property_readonly("rle", [](const Instance& of) { return encode_coco_rle(of.mask); });
  module.def("instances", &instances_of, py::arg("index_plane"), py::arg("actors"));
  module.def(
      "mask_of",
      [](const std::string& rle, int width_px, int height_px) {
        return array_of(mask_of(decode_coco_rle(rle), width_px, height_px)).attr("view")("bool");
      },
      py::arg("rle"), py::arg("width_px"), py::arg("height_px"));
}

}  // namespace thermal::python
