#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "base/error.h"
#include "labels/instances.h"
#include "labels/rle.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "scene/manifest.h"

namespace thermal::python {
namespace {

/// Column-major run lengths as a plane of 0 and 1. DataError unless they cover it exactly.
Plane<std::uint8_t> mask_of(const RunLengths& runs, int width_px, int height_px) {
  Plane<std::uint8_t> mask(width_px, height_px);
  const auto size = static_cast<std::int64_t>(mask.size());
  if (covered_px(runs) != size)
    throw DataError(fault("run lengths", std::to_string(covered_px(runs)), "px",
                          std::to_string(size) + " px, as the picture has"));
  for_stretches(runs, height_px, [&](int x, int y, int stretch_px) {
    for (int row = y; row < y + stretch_px; ++row) mask.at(x, row) = 1;
  });
  return mask;
}

std::vector<Instance> instances_of(const ArrayOf<std::uint16_t>& index_plane,
                                   const std::vector<std::uint16_t>& actors) {
  const Plane<std::uint16_t> plane = plane_of<std::uint16_t>(index_plane, "index_plane");
  const py::gil_scoped_release others_run;
  for (const std::uint16_t index : plane.pixels()) {
    if (index > kLargestIndex)
      throw DataError(
          fault("index_plane", std::to_string(index), "", "indices up to " + std::to_string(kLargestIndex)));
  }
  return extract_instances(plane, survey_indices(plane), IndexSet(actors));
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
