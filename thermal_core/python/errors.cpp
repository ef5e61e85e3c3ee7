#include "base/error.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// Named and pickled as veldt.`name`, where users find it.
template <typename Exception>
pybind11::object add_error(pybind11::module_& module, const char* name, const char* meaning,
                           const pybind11::object& base) {
  pybind11::object type = pybind11::register_exception<Exception>(module, name, base);
  type.attr("__module__") = "veldt";
  type.attr("__doc__") = meaning;
  return type;
}

}  // namespace

void add_errors(pybind11::module_& module) {
  const auto exception = pybind11::reinterpret_borrow<pybind11::object>(PyExc_Exception);
  const pybind11::object base =
      add_error<Error>(module, "Error", "Caused by the user, the data or the machine.", exception);
  add_error<ConfigError>(module, "ConfigError", "An invalid config or argument.", base);
  add_error<DataError>(module, "DataError", "Something was read, but its contents are invalid.", base);
  add_error<IoError>(module, "IoError", "A file, folder or program could not be read, written or run.", base);
  add_error<TryAgainError>(module, "TryAgainError", "Temporary: a full disk, another run in the same folder.",
                           base);
  add_error<Cancelled>(module, "Cancelled", "A stop was requested.", base);
}

}  // namespace thermal::python
