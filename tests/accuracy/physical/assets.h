#pragma once

#include <string>
#include <string_view>

#include "io/config/materials.h"
#include "io/config/spectra.h"
#include "radiometry/emissivity.h"
#include "radiometry/spectral_response.h"
#include "support/assets.h"

/// The materials in assets.
inline const thermal::MaterialLibrary& materials() {
  static const thermal::MaterialLibrary kLibrary = thermal::read_materials(kAssets);
  return kLibrary;
}

inline const thermal::Material& material(std::string_view name) {
  return materials().find(std::string(name), "test");
}

/// A response curve in assets.
inline thermal::SpectralResponse response(const std::string& name) {
  return thermal::read_response(std::string(VELDT_SOURCE_DIR) + "/assets/responses/" + name + ".csv");
}

/// Dark below 9.4 um and bright above, like quartz sand: a step a tenth of a micrometre wide.
inline thermal::EmissivitySpectrum quartz() {
  return thermal::EmissivitySpectrum({{7, 0.75}, {9.35, 0.75}, {9.45, 0.97}, {16, 0.97}});
}
