#include "io/image/module/claimed_size.h"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "io/system/read_limits.h"

namespace thermal::pictures {
namespace {

/// Zstandard, the densest compression, stores 128 kB in 4 bytes.
constexpr std::uint64_t kMostPerByte = 1U << 15U;

struct Claim {
  const char* what;
  int width_px;
  int height_px;
};

void check_fits(const Claim& claim, const OIIO::ImageSpec& spec, std::int64_t most_pixels,
                std::uint64_t file_bytes) {
  const std::int64_t pixels = std::int64_t{claim.width_px} * claim.height_px;
  const bool countable =
      claim.width_px >= 0 && claim.height_px >= 0;  // from 2^31 on, OpenImageIO reports negative ones
  const std::uint64_t bytes = static_cast<std::uint64_t>(pixels) * spec.pixel_bytes(true);
  if (countable && pixels <= most_pixels && bytes / kMostPerByte <= file_bytes) return;
  throw DataError(fmt::format("{} = {} x {} px of {} bytes each; expected what a file of {} bytes can hold",
                              claim.what, claim.width_px, claim.height_px, spec.pixel_bytes(true),
                              file_bytes));
}

}  // namespace

void check_claimed_size(const OIIO::ImageSpec& spec, const Path& file) {
  const std::int64_t most_pixels = ReadLimits().pixels;
  const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
  if (pixels < 1 || pixels > most_pixels || spec.depth > 1)
    throw DataError(fmt::format("size = {} x {} x {} px; expected 1 to {} pixels", spec.width, spec.height,
                                spec.depth, most_pixels));
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) return;  // not a regular file
  // OpenImageIO reserves address space for all rows of a strip, of which 65,535 are usual, even if the picture has
  // fewer.
  const int strip_rows = spec.get_int_attribute("tiff:RowsPerStrip");
  check_fits({"size", spec.width, spec.height}, spec, most_pixels, bytes);
  check_fits({"tiles", spec.tile_width, spec.tile_height}, spec, most_pixels, bytes);
  check_fits({"strips", spec.width, strip_rows}, spec, 4 * most_pixels, bytes);
}

}  // namespace thermal::pictures
