#include <cstring>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/png.h"
#include "io/image/png_file.h"
#include "io/system/naming.h"
#include "io/system/read_limits.h"

namespace thermal {
namespace {

std::string kind_told(const PngHeader& header) {
  const std::string_view colours = header.palette ? "palette" : header.colour ? "colour" : "grey";
  return fmt::format("{}{} of {}", colours, header.alpha ? " and alpha" : "", header.bit_depth);
}

template <typename T>
Plane<T> read(PngFile& file) {
  const PngHeader& header = file.header();
  constexpr int kBits = 8 * sizeof(T);
  if (header.colour || header.alpha || header.bit_depth != kBits)
    throw DataError(fault("pixels", kind_told(header), "bits", fmt::format("grey of {} bits", kBits)));
  check_plausible(header, ReadLimits().pixels);
  Plane<T> picture(static_cast<int>(header.width_px), static_cast<int>(header.height_px));
  file.read([&picture](int y, std::span<const std::uint8_t> row) {
    std::memcpy(picture.row(y).data(), row.data(), row.size());
  });
  return picture;
}

template <typename T>
Plane<T> read_named(const Path& path) {
  return naming(path, [&path] {
    PngFile file(path);
    return read<T>(file);
  });
}

}  // namespace

Plane<std::uint8_t> read_png8(const Path& file) { return read_named<std::uint8_t>(file); }
Plane<std::uint16_t> read_png16(const Path& file) { return read_named<std::uint16_t>(file); }

}  // namespace thermal
