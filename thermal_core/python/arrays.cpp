#include "python/arrays.h"

#include <fmt/format.h>

#include "base/error.h"

namespace thermal::python {

void check_is_plane(const py::array& array, const char* what) {
  if (array.ndim() == 2) return;
  throw ConfigError(fault(what, fmt::format("{} axes", array.ndim()), "", "two, of shape (height, width)"));
}

}  // namespace thermal::python
