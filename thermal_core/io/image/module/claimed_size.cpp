#include "io/image/module/claimed_size.h"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "io/system/read_limits.h"

namespace thermal::pictures {

void check_claimed_size(const OIIO::ImageSpec& spec, const Path& file) {
  const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
  if (pixels < 1 || pixels > ReadLimits().pixels || spec.depth > 1)
    throw DataError(fmt::format("size = {} x {} x {} px; expected 1 to {} pixels", spec.width, spec.height,
                                spec.depth, ReadLimits().pixels));
  // Zstandard, which packs best, makes 128 kB from 4 bytes. Pictures that are so even are not real ones.
  constexpr std::int64_t kMostPerByte = 20'000;
  std::error_code error;
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
  if (error || pixels / kMostPerByte <= bytes) return;
  throw DataError(fmt::format("size = {} x {} px; expected what a file of {} bytes can hold", spec.width,
                              spec.height, bytes));
}

}  // namespace thermal::pictures
