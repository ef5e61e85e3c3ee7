#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "io/assets.h"
#include "io/config/spec.h"

namespace thermal::python {

/// Each adds a part of the library to the module `veldt._core`. Docstrings for users are in the Python package, the
/// only caller of this module.
void add_errors(pybind11::module_& module);
void add_band(pybind11::module_& module);
void add_camera(pybind11::module_& module);
void add_converter(pybind11::module_& module);
void add_earth(pybind11::module_& module);
void add_heat(pybind11::module_& module);
void add_labels(pybind11::module_& module);
void add_runs(pybind11::module_& module);
void add_stream(pybind11::module_& module);
void add_video_chain(pybind11::module_& module);
void add_world(pybind11::module_& module);
void add_files(pybind11::module_& module);

/// What some sections of a config mean, checked and with defaults. `sections`: a JSON object with any of camera, sensor,
/// weather, terms and labels. ConfigError, starting with `name`.
[[nodiscard]] SharedSettings settings_of_sections(const std::string& sections, const std::string& name,
                                                  const Assets& assets);

}  // namespace thermal::python
