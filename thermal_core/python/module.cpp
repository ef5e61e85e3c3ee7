#include "python/parts.h"

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
