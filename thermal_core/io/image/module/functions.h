#pragma once

#include "io/image/picture_module.h"

namespace thermal::pictures {

/// As as_jpeg() in io/image/pictures.h, with faults of the file without its name.
[[nodiscard]] std::string as_jpeg(const Path& picture, int most_px);

/// As draw_text() in io/image/pictures.h, of printable ASCII that is not all spaces, with a font that exists.
[[nodiscard]] TextPicture draw_text(const Path& font, const std::string& ascii, int size_px);

/// As read_grey_picture() in io/image/pictures.h, with faults of the file without its name.
[[nodiscard]] GreyPicture read_grey(const Path& file);

/// Of read_kelvin_picture() in io/image/pictures.h, with faults of the file without its name.
[[nodiscard]] StoredTemperatures read_temperatures(const Path& file);

/// As read_photo_tags() in io/image/pictures.h, with faults of the file without its name.
[[nodiscard]] PhotoTags read_tags(const Path& file);

/// As encode_tiff() in io/image/pictures.h.
[[nodiscard]] std::string encode_kelvin_tiff(const Plane<float>& picture, const TiffTags& tags);
[[nodiscard]] std::string encode_counts_tiff(const Plane<std::uint16_t>& picture, const TiffTags& tags);

}  // namespace thermal::pictures
