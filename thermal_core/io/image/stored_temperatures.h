#pragma once

#include <optional>

#include "base/image.h"

namespace thermal {

/// A TIFF of one channel as stored.
struct StoredTemperatures {
  Plane<float> values;            ///< exact: floats, or counts of 16 bits
  bool counts = false;            ///< of 16 bits
  std::optional<double> scale{};  ///< of GDAL's metadata: value x scale + offset
  double offset = 0;
};

}  // namespace thermal
