#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "base/image.h"

namespace thermal::python {

namespace py = pybind11;

/// Numbers of one type in C order.
template <typename T>
using ArrayOf = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// The only conversions from users' objects to numbers. They accept whatever numpy.asarray() converts to an array of
/// booleans, whole or real numbers, in any order and with any strides. ConfigError "WHAT = …; expected …" for anything
/// else: texts, objects, dates, complex numbers, lists of different lengths, and more numbers than the normals of the
/// largest picture.
[[nodiscard]] py::array numbers_in(const py::handle& given, const char* what);

/// As numbers of real type T: copied if they are of another type or not in C order.
template <typename T>
[[nodiscard]] ArrayOf<T> numbers_of(const py::handle& given, const char* what) {
  return ArrayOf<T>(numbers_in(given, what));
}

/// The same, with ConfigError naming the first that is not finite.
[[nodiscard]] ArrayOf<double> finite_numbers_of(const py::handle& given, const char* what);

/// The same for one number.
[[nodiscard]] double finite_number_of(const py::handle& given, const char* what);

/// The same with two axes, of 1 to 256 million elements in all.
[[nodiscard]] py::array plane_in(const py::handle& given, const char* what);

/// A plane of real numbers [row, column]: a copy, because Python may change its arrays.
template <typename T>
[[nodiscard]] Plane<T> plane_of(const py::handle& given, const char* what) {
  const ArrayOf<T> array(plane_in(given, what));
  Plane<T> plane(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::copy_n(array.data(), plane.size(), plane.pixels().begin());
  return plane;
}

/// A plane of grey levels: numpy.uint8 alone, as any other type would have to be scaled.
[[nodiscard]] Plane<std::uint8_t> levels_of(const py::handle& given, const char* what);

/// A plane of indices, by to_indices(): DataError for the first number that is not an index.
[[nodiscard]] Plane<std::uint16_t> index_plane_of(const py::handle& given, const char* what);

/// The pixels of a plane [row, column], without a copy: the array owns the plane.
template <typename T>
[[nodiscard]] py::array_t<T> array_of(Plane<T> plane) {
  auto owned = std::make_unique<Plane<T>>(std::move(plane));
  T* const pixels = owned->pixels().data();
  const py::ssize_t shape[] = {owned->height_px(), owned->width_px()};
  const py::capsule owner(owned.release(), [](void* held) { delete static_cast<Plane<T>*>(held); });
  return py::array_t<T>(shape, pixels, owner);
}

/// An array of another one's shape.
template <typename T>
[[nodiscard]] py::array_t<T> array_like(const py::array& other) {
  return py::array_t<T>(std::vector<py::ssize_t>(other.shape(), other.shape() + other.ndim()));
}

}  // namespace thermal::python
