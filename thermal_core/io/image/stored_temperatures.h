#pragma once

#include <optional>
#include <string>

#include "base/image.h"

namespace thermal {

/// Stored values of a picture of temperatures, and their scale.
struct StoredTemperatures {
  Plane<float> values;            ///< exact: floats, or counts of 16 bits
  bool counts = false;            ///< of 16 bits
  std::optional<double> scale{};  ///< of GDAL's metadata: value x scale + offset
  double offset = 0;
  std::string unit{};               ///< of GDAL's metadata; empty: none
  std::optional<double> no_data{};  ///< GDAL_NODATA: the stored value of pixels without one; may be NaN
};

}  // namespace thermal
