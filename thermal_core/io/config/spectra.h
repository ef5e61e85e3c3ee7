#pragma once

#include "io/system/files.h"
#include "radiometry/emissivity.h"
#include "radiometry/spectral_response.h"

namespace thermal {

/// Reads a CSV with the header "wavelength_um,response"; lines starting with # are skipped.
/// A UTF-8 byte-order mark and either kind of line end are read. ConfigError naming file, line and what was expected;
/// IoError as read_text_file(), for more than kMostTableBytes, too.
[[nodiscard]] SpectralResponse read_response(const Path& file);

/// The same for "wavelength_um,emissivity".
[[nodiscard]] EmissivitySpectrum read_emissivity(const Path& file);

}  // namespace thermal
