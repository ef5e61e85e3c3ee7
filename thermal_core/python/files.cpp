#include <string>

#include "dataset/dataset_file.h"
#include "io/image/png.h"
#include "io/json/file.h"
#include "io/system/text_file.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

template <typename T>
py::array_t<T> array_of_png(const std::string& file, Plane<T> (*read)(const Path&)) {
  Plane<T> plane;
  {
    const py::gil_scoped_release others_run;
    plane = read(file);
  }
  return array_of(std::move(plane));
}

}  // namespace

void add_files(py::module_& module) {
  module.def("read_png8", [](const std::string& file) { return array_of_png(file, &read_png8); });
  module.def("read_png16", [](const std::string& file) { return array_of_png(file, &read_png16); });
  module.def("read_text", [](const std::string& file) { return read_text_file(file); });
  module.def("read_json", [](const std::string& file) { return read_json(file).dump(); });
  module.def("read_dataset_file", [](const std::string& folder) { return read_dataset_file(folder).dump(); });
}

}  // namespace thermal::python
