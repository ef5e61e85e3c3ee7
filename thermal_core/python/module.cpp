#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

namespace py = pybind11;

/// Named and pickled as veldt.`name`, where users find it. Messages may quote bytes that are not UTF-8.
template <typename Exception>
py::object add_error(py::module_& module, const char* name, const char* meaning, const py::object& base) {
  static py::object type;
  type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc((std::string("veldt.") + name).c_str(), meaning, base.ptr(), nullptr));
  module.attr(name) = type;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const Exception& error) {
      const std::string_view what = error.what();
      const auto message = py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(what.data(), static_cast<Py_ssize_t>(what.size()), "backslashreplace"));
      PyErr_SetObject(type.ptr(), message.ptr());
    }
  });
  return type;
}

}  // namespace

void add_errors(py::module_& module) {
  const auto exception = py::reinterpret_borrow<py::object>(PyExc_Exception);
  const py::object base =
      add_error<Error>(module, "Error", "Caused by the user, the data or the machine.", exception);
  add_error<ConfigError>(module, "ConfigError", "An invalid config or argument.", base);
  add_error<DataError>(module, "DataError", "Something was read, but its contents are invalid.", base);
  add_error<IoError>(module, "IoError", "A file, folder or program could not be read, written or run.", base);
  add_error<TryAgainError>(module, "TryAgainError", "Temporary: a full disk, another run in the same folder.",
                           base);
  add_error<Cancelled>(module, "Cancelled", "A stop was requested.", base);
}

}  // namespace thermal::python

PYBIND11_MODULE(_core, module) {
  thermal::python::add_errors(module);
  thermal::python::add_band(module);
  thermal::python::add_camera(module);
  thermal::python::add_converter(module);
  thermal::python::add_earth(module);
  thermal::python::add_heat(module);
  thermal::python::add_labels(module);
  thermal::python::add_runs(module);
  thermal::python::add_stream(module);
  thermal::python::add_video_chain(module);
  thermal::python::add_world(module);
  thermal::python::add_files(module);
}
