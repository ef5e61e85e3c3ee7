#pragma once

#include <optional>

#include "base/image.h"
#include "io/system/files.h"

namespace thermal {

/// Reads a picture of temperatures [K]: a TIFF of 32-bit floats in kelvin, or a TIFF or PNG of 16-bit counts. The scale of
/// counts is `kelvin_per_count`, or that of a TIFF's tags, as GDAL and `veldt export --format tiff` write it; kelvin are
/// rounded once, so that these are the ones that were exported, bit for bit.
/// DataError with the file for other pixels, counts without a scale, values that are not finite, and a median that is no
/// temperature in kelvin (100 to 3000), as of degrees Celsius; those of read_grey_picture() too.
[[nodiscard]] Plane<float> read_kelvin_picture(const Path& file, std::optional<double> kelvin_per_count);

}  // namespace thermal
