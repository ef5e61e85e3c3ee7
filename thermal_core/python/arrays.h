#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "base/image.h"

namespace thermal::python {

namespace py = pybind11;

/// An argument of numbers: converted where it has another type, copied where its elements are not in C's order.
template <typename T>
using ArrayOf = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// The pixels of a plane [row, column], without a copy: the array owns the plane.
template <typename T>
[[nodiscard]] py::array_t<T> array_of(Plane<T> plane) {
  auto owned = std::make_unique<Plane<T>>(std::move(plane));
  T* const pixels = owned->pixels().data();
  const py::ssize_t shape[] = {owned->height_px(), owned->width_px()};
  const py::capsule owner(owned.release(), [](void* held) { delete static_cast<Plane<T>*>(held); });
  return py::array_t<T>(shape, pixels, owner);
}

/// Throws TypeError unless an array has two axes. `what` starts the message.
void check_is_plane(const py::array& array, const char* what);

/// The opposite, which copies: arrays belong to Python, which may change them.
template <typename T>
[[nodiscard]] Plane<T> plane_of(const ArrayOf<T>& array, const char* what) {
  check_is_plane(array, what);
  Plane<T> plane(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::copy_n(array.data(), plane.size(), plane.pixels().begin());
  return plane;
}

/// An array of another one's shape.
template <typename T>
[[nodiscard]] py::array_t<T> array_like(const py::array& other) {
  return py::array_t<T>(std::vector<py::ssize_t>(other.shape(), other.shape() + other.ndim()));
}

}  // namespace thermal::python
