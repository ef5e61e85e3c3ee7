#include <string>

#include <pybind11/stl.h>

#include "dataset/clip/record.h"
#include "dataset/clip_files.h"
#include "dataset/dataset_file.h"
#include "io/image/png.h"
#include "io/json/file.h"
#include "io/label_files/coco.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// Reads from a dataset without following links.
template <typename T>
py::array_t<T> array_of_png(const std::string& file, Plane<T> (*read)(const Path&)) {
  Plane<T> plane;
  {
    const py::gil_scoped_release others_run;
    check_is_own_file(file);
    plane = read(file);
  }
  return array_of(std::move(plane));
}

/// (frame_index, JSON) of each line.
py::list frames_of(const std::string& folder) {
  py::list frames;
  for_clip_frames(folder, [&frames](int frame_index, const Json& values) {
    frames.append(py::make_tuple(frame_index, values.dump()));
  });
  return frames;
}

/// (frame_index, category, JSON) of each annotation.
py::list labels_of(const std::string& folder) {
  py::list labels;
  for_clip_labels(folder,
                  [&labels](int frame_index, const std::string& category, const std::string& annotation) {
                    labels.append(py::make_tuple(frame_index, category, annotation));
                  });
  return labels;
}

/// Gives a file of a dataset a second name, or copies it where that is impossible.
void link_to(const std::string& file, const std::string& as) {
  check_is_own_file(file);
  (void)link_file(file, as, Linking::hard);
}

}  // namespace

void add_files(py::module_& module) {
  module.def("read_png8", [](const std::string& file) { return array_of_png(file, &read_png8); });
  module.def("read_png16", [](const std::string& file) { return array_of_png(file, &read_png16); });
  module.def("read_json", [](const std::string& file) { return read_json(file).dump(); });
  module.def("read_dataset_file", [](const std::string& folder) { return read_dataset_file(folder).dump(); });
  module.def("read_clip_record",
             [](const std::string& file) { return to_json(read_clip_record(file)).dump(); });
  module.def("read_clip_frames", &frames_of);
  module.def("read_clip_labels", &labels_of);
  module.def("read_coco_head", [](const std::string& file) {
    const CocoHead head = read_coco_head(file);
    return py::make_tuple(head.categories, head.videos);
  });
  module.def("link_file", &link_to);
  module.def("numbers", &numbers_of<double>, py::arg("given"), py::arg("what"));
  module.def("finite_number", &finite_number_of, py::arg("given"), py::arg("what"));
  module.def("finite_numbers", &finite_numbers_of, py::arg("given"), py::arg("what"));
}

}  // namespace thermal::python
