#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/image.h"
#include "io/system/files.h"

namespace cv {
class Mat;
}

namespace thermal {

/// Size of a picture file.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

/// Size of a PNG, JPEG or TIFF, from its header. DataError with the file if it is none; IoError if it cannot be read.
[[nodiscard]] PictureSize read_picture_size(const Path& file);

/// A picture of one channel as stored.
struct GreyPicture {
  Plane<std::uint16_t> levels;
  int bits = 8;  ///< of a level: 8 or 16
};

/// Levels of 8 bits by which the channels of a grey picture may differ, as after a conversion to luminance and back.
inline constexpr int kMostGreyTint = 2;

/// Whether a file is read as a picture of grey levels: .png, .jpg, .jpeg, .tif or .tiff, in any case.
[[nodiscard]] bool is_grey_picture(const Path& file);

/// Reads a picture of grey levels of 8 or 16 bits. Colours of which all channels differ by at most kMostGreyTint, as in
/// a grey JPEG stored in colour, count as grey: their first channel is used. Alpha is dropped. DataError with the file
/// for other colours, other depths, damaged pictures and more than 256 million pixels; IoError if it cannot be read.
[[nodiscard]] GreyPicture read_grey_picture(const Path& file);

/// Stored values of a picture of temperatures, and their scale.
struct StoredTemperatures {
  Plane<float> values;            ///< exact: floats, or counts of 16 bits
  bool counts = false;            ///< of 16 bits
  std::optional<double> scale{};  ///< of GDAL's metadata: value x scale + offset
  double offset = 0;
  std::string unit{};               ///< of GDAL's metadata; empty: none
  std::optional<double> no_data{};  ///< GDAL_NODATA: the stored value of pixels without one; may be NaN
};

/// EXIF and XMP tags of a photo.
struct PhotoTags {
  PictureSize size;
  /// By OpenImageIO's names, such as "Exif:FocalLength" or "drone-dji:RelativeAltitude": texts unchanged, numbers in
  /// their shortest form, several separated by blanks.
  std::map<std::string, std::string, std::less<>> texts;
};

/// Tags of a PNG, JPEG or TIFF of at most 256 MiB, without those that are longer than 256 bytes; no pixel is decoded.
/// DataError with the file if it is another kind, larger or damaged; IoError if it cannot be read. OpenImageIO finds
/// nothing in XMP whose rdf:Description has no end tag, which is legal; DJI and FLIR write end tags.
[[nodiscard]] PhotoTags read_photo_tags(const Path& file);

/// Encodes a picture of any format as a JPEG for viewing; wider than `most_px` it is scaled down. One channel of more
/// than 8 bits, such as temperatures, is stretched from its 0.5 % point (black) to its 99.5 % point (white). IoError if
/// it cannot be read, DataError if it is damaged.
[[nodiscard]] std::string as_jpeg(const Path& picture, int most_px);

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

/// File formats of stills, and of pictures in reports.
enum class PictureFormat : std::uint8_t { png, jpeg };

/// The bytes of a picture file: PNG at its highest compression, or JPEG at quality 92.
/// @param bgr  8 bits, three channels, OpenCV's order
[[nodiscard]] std::string encode_picture(const cv::Mat& bgr, PictureFormat format);

/// A rendered line of text: coverage of each pixel, 0 to 255.
struct TextPicture {
  Plane<std::uint8_t> coverage;  ///< from the first letter's left edge; empty for invisible text
  int baseline_px = 0;           ///< the row of `coverage` with the baseline
};

/// Draws a line of text with FreeType, anti-aliased. The bits depend on FreeType's version. A character that is not
/// ASCII shows as "?": OpenImageIO 2.4 would draw "·" as "7".
/// @param line  its text, UTF-8
/// @param font  a TrueType or OpenType file
/// @param size_px  of the letter em, 4 to 400
/// IoError naming the font if it cannot be used.
[[nodiscard]] TextPicture draw_text(const Path& font, const std::string& line, int size_px);

}  // namespace thermal
