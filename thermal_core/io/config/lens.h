#pragma once

#include <string>
#include <vector>

#include "io/config/spec.h"
#include "io/json/file.h"
#include "scene/camera_model.h"

namespace thermal {

/// The pinhole of a config's `camera`, whose defaults are filled in. Where it does not give them, fx_px is focal length /
/// pixel pitch, fy_px is fx_px, and the principal point is the picture's middle.
[[nodiscard]] CameraIntrinsics read_intrinsics(const Json& camera);

/// Whether a config's `camera` gives any of fx_px, fy_px, cx_px and cy_px.
[[nodiscard]] bool gives_intrinsics(const Json& camera);

/// Puts focal_length_m in the place of `camera.lens_mm`, and the numbers of the file that `camera.calibration` names in the
/// place of that, so that the document speaks for itself. `schema`: that of configs. Adds faults, with the file's name, if it cannot be read, is of another size of picture, or
/// holds what a config must not; and if the document gives one of the numbers, too.
void apply_lens(Json& document, const Json& schema, std::vector<std::string>& faults);

/// Adds a fault if the principal point is outside the picture, or one focal length more than ten times the other.
void check_intrinsics(const CameraIntrinsics& camera, std::vector<std::string>& faults);

/// Writes what the lenses of a dataset need as the config's render.overscan_px, where that says nothing of it: nothing
/// with the engine embree, whose rays follow the lens. Adds a fault if it says too little, or anything in vain, or if no
/// overscan is enough. Returns how much pinholes' pictures need for the lenses, 0 after a fault of a lens.
int fill_overscan(Json& document, const DatasetSpec& spec, std::vector<std::string>& faults);

}  // namespace thermal
