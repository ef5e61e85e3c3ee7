#include "io/image/module/claimed_size.h"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "io/system/read_limits.h"

namespace thermal::pictures {
namespace {

/// Zstandard, which packs best, makes 128 kB of 4 bytes.
constexpr std::uint64_t kMostPerByte = 1U << 15U;

void check_fits(const char* what, int width_px, int height_px, const OIIO::ImageSpec& spec,
                std::uint64_t file_bytes) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px);
  const std::uint64_t claimed_bytes = pixels * spec.pixel_bytes(true);
  if (claimed_bytes / kMostPerByte <= file_bytes) return;
  throw DataError(fmt::format("{} = {} x {} px of {} bytes each; expected what a file of {} bytes can hold",
                              what, width_px, height_px, spec.pixel_bytes(true), file_bytes));
}

}  // namespace

void check_claimed_size(const OIIO::ImageSpec& spec, const Path& file) {
  const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
  if (pixels < 1 || pixels > ReadLimits().pixels || spec.depth > 1)
    throw DataError(fmt::format("size = {} x {} x {} px; expected 1 to {} pixels", spec.width, spec.height,
                                spec.depth, ReadLimits().pixels));
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) return;  // of no regular file
  check_fits("size", spec.width, spec.height, spec, bytes);
  check_fits("tiles", spec.tile_width, spec.tile_height, spec, bytes);
}

}  // namespace thermal::pictures
