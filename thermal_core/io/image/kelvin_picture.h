#pragma once

#include <optional>
#include <string>

#include "base/image.h"
#include "io/system/files.h"

namespace thermal {

/// Unit of stored temperatures.
enum class TemperatureUnit { kelvin, celsius };

/// The user's statements about stored temperatures.
struct StoredScale {
  std::optional<double> kelvin_per_count = {};  ///< for pictures of counts; empty: from a TIFF's tags
  std::optional<TemperatureUnit> unit = {};     ///< of stored values; empty: from a TIFF's tags, or kelvin
  std::string prefix = "--";                    ///< of the options kelvin-per-count and unit, for messages
};

/// Reads a picture of temperatures [K]: a TIFF of floats (32 or 64 bits), or a TIFF (signed or not) or PNG of 16-bit
/// counts, in kelvin or degrees Celsius. The scale of counts is `kelvin_per_count`, or that of a TIFF's tags, as GDAL
/// and `veldt export --format tiff` write it; kelvin are rounded once, which restores exported values exactly. Of
/// GDAL's metadata, SCALE, OFFSET, UNITTYPE and GDAL_NODATA are used, the first of each; other tags do not concern the
/// values and are ignored.
/// DataError with the file for other pixels, further pages or a mask; counts without a scale; another unit; pixels that
/// are GDAL_NODATA, because every pixel is measured; a median outside of kSceneMedianK, which indicates another unit or
/// scale; pixels outside of kTemperatureK, such as NaN or fill values, with their number; and as read_grey_picture().
[[nodiscard]] Plane<float> read_kelvin_picture(const Path& file, const StoredScale& scale = {});

}  // namespace thermal
