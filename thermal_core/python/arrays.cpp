#include "python/arrays.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image.h"
#include "io/pass_buffer.h"

namespace thermal::python {
namespace {

constexpr std::int64_t kMostPixels = ReadLimits{}.pixels;
constexpr std::int64_t kMostNumbers = 3 * kMostPixels;  // of normals

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

std::string shape_of(const py::array& array) { return "shape " + text_of(array.attr("shape")); }

template <typename Number>
Plane<std::uint16_t> to_indices_of(const py::array& given, const char* what) {
  const ArrayOf<Number> array(given);
  Plane<std::uint16_t> plane(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const py::gil_scoped_release others_run;
  to_indices(std::span<const Number>(array.data(), plane.size()), plane.width_px(), what, plane.pixels());
  return plane;
}

}  // namespace

py::array numbers_in(const py::handle& given, const char* what) {
  try {
    py::array array = py::module_::import("numpy").attr("asarray")(given);
    constexpr std::string_view kNumbers = "biuf";
    if (kNumbers.find(array.dtype().kind()) == std::string_view::npos)
      throw ConfigError(fault(what, "an array of " + text_of(array.dtype()), "", "numbers"));
    if (array.size() > kMostNumbers)
      throw ConfigError(fault(what, shape_of(array), "", fmt::format("at most {} numbers", kMostNumbers)));
    return array;
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;  // Ctrl-C
    throw ConfigError(fmt::format("{}: {}; expected an array of numbers", what, text_of(error.value())));
  }
}

ArrayOf<double> finite_numbers_of(const py::handle& given, const char* what) {
  ArrayOf<double> array = numbers_of<double>(given, what);
  const std::span numbers(array.data(), static_cast<std::size_t>(array.size()));
  const auto bad = std::ranges::find_if_not(numbers, [](double one) { return std::isfinite(one); });
  if (bad != numbers.end()) throw ConfigError(fault(what, fmt::format("{}", *bad), "", "finite numbers"));
  return array;
}

double finite_number_of(const py::handle& given, const char* what) {
  const ArrayOf<double> numbers = finite_numbers_of(given, what);
  if (numbers.ndim() > 0) throw ConfigError(fault(what, shape_of(numbers), "", "one number"));
  return *numbers.data();
}

py::array plane_in(const py::handle& given, const char* what) {
  py::array array = numbers_in(given, what);
  if (array.ndim() == 2 && array.size() > 0 && array.size() <= kMostPixels) return array;
  throw ConfigError(fault(what, shape_of(array), "",
                          fmt::format("(height, width), 1 to {} million pixels", kMostPixels / 1'000'000)));
}

Plane<std::uint8_t> levels_of(const py::handle& given, const char* what) {
  const py::array array = plane_in(given, what);
  if (!py::isinstance<py::array_t<std::uint8_t>>(array))
    throw ConfigError(fault(what, "an array of " + text_of(array.dtype()), "", "uint8"));
  return plane_of<std::uint8_t>(array, what);
}

Plane<std::uint16_t> index_plane_of(const py::handle& given, const char* what) {
  const py::array array = plane_in(given, what);
  const char kind = array.dtype().kind();
  // Debian 12's pybind11 reads the element size of NumPy 2 at the wrong offset.
  const auto bytes = array.attr("itemsize").cast<py::ssize_t>();
  if (kind == 'b' || (kind == 'u' && bytes <= 2)) return to_indices_of<std::uint16_t>(array, what);
  if (kind == 'u') return to_indices_of<std::uint64_t>(array, what);
  if (kind == 'i') return to_indices_of<std::int64_t>(array, what);
  return bytes <= 4 ? to_indices_of<float>(array, what) : to_indices_of<double>(array, what);
}

}  // namespace thermal::python
