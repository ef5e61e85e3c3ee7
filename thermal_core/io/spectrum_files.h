#pragma once

#include "io/files.h"
#include "radiometry/emissivity.h"
#include "radiometry/spectral_response.h"

namespace thermal {

/// Reads a CSV with the header "wavelength_um,response"; lines starting with # are skipped.
/// ConfigError naming file, line and what was expected; IoError if it cannot be read.
[[nodiscard]] SpectralResponse read_response(const Path& file);

/// The same for "wavelength_um,emissivity".
[[nodiscard]] EmissivitySpectrum read_emissivity(const Path& file);

}  // namespace thermal
