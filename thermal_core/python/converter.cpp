#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "dataset/run/live_clip.h"
#include "io/manifest_file.h"
#include "python/arrays.h"
#include "python/frames.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// Planes by name, from Python; absent ones are empty.
Passes passes_of(const py::dict& planes) {
  Passes passes;
  const auto take_indices = [&planes](const char* name, Plane<std::uint16_t>& plane) {
    if (planes.contains(name)) plane = index_plane_of(planes[name], name);
  };
  const auto take_numbers = [&planes](const char* name, Plane<float>& plane) {
    if (planes.contains(name)) plane = plane_of<float>(planes[name], name);
  };
  take_indices("object_index", passes.object_index);
  take_indices("material_index", passes.material_index);
  take_indices("actor_index", passes.actor_index);
  take_numbers("depth_m", passes.depth_m);
  take_numbers("normal_x", passes.normal[0]);
  take_numbers("normal_y", passes.normal[1]);
  take_numbers("normal_z", passes.normal[2]);
  return passes;
}

/// A clip that is opened with its first frame, whose planes decide on its terms. Calls from several threads are
/// serialised.
class Converter {
 public:
  Converter(const std::string& manifest, const std::string& name, const std::optional<std::string>& config,
            const std::string& config_name, std::vector<std::string> settings, const std::string& home)
      : options_{.assets = Assets(home), .config_name = config_name, .settings = std::move(settings)},
        manifest_(parse_manifest(parse_json(manifest, name), name, options_.assets)) {
    if (config) options_.config = parse_json(*config, config_name);
  }

  [[nodiscard]] py::tuple convert(int number, const py::dict& planes) {
    const Passes passes = passes_of(planes);
    const py::gil_scoped_release others_run;
    const std::lock_guard turn(mutex_);
    if (!clip_) clip_ = live_clip_of(manifest_, passes, options_);
    const ClipImager::Frame& frame = clip_->make(passes, number);
    const py::gil_scoped_acquire python;
    return tuple_of(frame, *clip_);
  }

  [[nodiscard]] std::size_t frames() const { return manifest_.frames.size(); }

 private:
  ConvertOptions options_;
  Manifest manifest_;
  std::unique_ptr<LiveClip> clip_;
  std::mutex mutex_;
};

}  // namespace

void add_converter(py::module_& module) {
  py::class_<Converter>(module, "Converter")
      .def(py::init<const std::string&, const std::string&, const std::optional<std::string>&,
                    const std::string&, std::vector<std::string>, const std::string&>(),
           py::arg("manifest"), py::arg("name"), py::arg("config"), py::arg("config_name"),
           py::arg("settings"), py::arg("home"))
      .def("convert", &Converter::convert, py::arg("number"), py::arg("planes"))
      .def_property_readonly("frames", &Converter::frames);
}

}  // namespace thermal::python
