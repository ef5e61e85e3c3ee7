#pragma once

#include <optional>
#include <string>

#include "base/image.h"
#include "io/system/files.h"

namespace thermal {

/// Of temperatures as they are stored.
enum class TemperatureUnit { kelvin, celsius };

/// What a user says about temperatures as they are stored.
struct StoredScale {
  std::optional<double> kelvin_per_count = {};  ///< of pictures of counts; empty: a TIFF's tags say it
  std::optional<TemperatureUnit> unit =
      {};                     ///< of what is stored; empty: a TIFF's tags say it, or it is kelvin
  std::string prefix = "--";  ///< of the options kelvin-per-count and unit, for messages
};

/// Reads a picture of temperatures [K]: a TIFF of floats (32 or 64 bits), or a TIFF (signed or not) or PNG of 16-bit
/// counts, in kelvin or degrees Celsius. The scale of counts is `kelvin_per_count`, or that of a TIFF's tags, as GDAL and
/// `veldt export --format tiff` write it; kelvin are rounded once, so that these are the ones that were exported, bit for
/// bit.
/// Of GDAL's metadata, SCALE, OFFSET, UNITTYPE and GDAL_NODATA are used, the first of each; other tags that
/// say nothing of the values are ignored.
/// DataError with the file for other pixels, further pages or a mask; counts without a scale; a unit that is neither; pixels
/// that are GDAL_NODATA, because every pixel is measured; a median outside of kSceneMedianK, as of another unit or scale;
/// pixels outside of kTemperatureK, as of NaN or another fill value, with their number; those of read_grey_picture() too.
[[nodiscard]] Plane<float> read_kelvin_picture(const Path& file, const StoredScale& scale = {});

}  // namespace thermal
