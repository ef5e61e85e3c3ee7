#pragma once

#include <string>

#include "analysis/compare/comparison.h"
#include "io/assets.h"

namespace thermal {

/// A self-contained HTML page about a comparison: the tables, charts of spectra and grey levels, six frames and up to 24
/// crops of targets of each set. The same comparison gives the same bytes. DataError or IoError if a picture that was
/// measured cannot be read again.
[[nodiscard]] std::string comparison_page(const Comparison& comparison, const Assets& assets);

}  // namespace thermal
