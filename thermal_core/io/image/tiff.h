#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/image.h"

namespace thermal {

/// A position on the WGS 84 ellipsoid.
struct GeoPosition {
  double latitude_deg = 0;   ///< -90 to 90, south is negative
  double longitude_deg = 0;  ///< -180 to 180, west is negative
  double height_m = 0;       ///< above the ellipsoid
};

/// Tags of a TIFF. Empty texts and members are not written.
struct TiffTags {
  std::string description = {};
  std::string make = {};
  std::string model = {};
  std::string software = {};
  std::string taken_at = {};       ///< "2026:07:09 03:00:01"; EXIF's DateTimeOriginal
  std::string subsecond = {};      ///< digits after the second; EXIF's SubSecTimeOriginal
  std::string xmp = {};            ///< an XMP packet
  std::string gdal_metadata = {};  ///< XML of GDAL's tag 42112
  std::optional<double> focal_length_mm = {};
  std::optional<double> f_number = {};
  std::optional<double> pixels_per_cm = {};  ///< of the sensor
  std::optional<GeoPosition> position = {};  ///< EXIF's GPS tags, whose step is 1e-6 arc seconds and 1 mm
};

/// A grey TIFF in memory, compressed without loss (deflate; integers with the horizontal predictor). The picture must
/// not be empty. It contains no time stamp: the bytes depend on picture, tags, and the versions of libtiff and its
/// compression library. IoError with libtiff's reason.
[[nodiscard]] std::string encode_tiff(const Plane<float>& picture, const TiffTags& tags);
/// The same with 16 bits.
[[nodiscard]] std::string encode_tiff(const Plane<std::uint16_t>& picture, const TiffTags& tags);

}  // namespace thermal
