#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include <ImfMultiPartInputFile.h>

#include "base/image.h"
#include "io/exr/header.h"

namespace thermal {

/// One channel to decode and its destination: floats, whose bits are kept if the channel is float too, or whole
/// numbers, for a uint channel.
struct ExrTarget {
  const ExrChannel* channel = nullptr;
  std::variant<Plane<float>*, Plane<std::uint32_t>*> plane;
  float outside = 0;  ///< for pixels of the display window outside the data window; whole numbers: 0
};

/// Fills planes of the display window's size, reusing memory of the right size. Each part is decoded once, directly
/// into the planes if its data window does not extend beyond them; only lines and tiles in the display window are
/// decoded. For tiled parts with several levels: the finest.
/// DataError for subsampled channels, IoError for incomplete parts, both without the file's name; exceptions of the
/// library.
void decode(Imf::MultiPartInputFile& file, const Path& name, const std::vector<ExrTarget>& targets);

}  // namespace thermal
