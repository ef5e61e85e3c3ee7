#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include <ImfMultiPartInputFile.h>

#include "base/image.h"
#include "io/exr_header.h"

namespace thermal {

/// One channel to decode, and the plane that gets it: floats, whose bits are kept where the channel has
/// floats too; or whole numbers, for a channel of those.
struct ExrTarget {
  const ExrChannel* channel = nullptr;
  std::variant<Plane<float>*, Plane<std::uint32_t>*> plane;
  float outside = 0;  ///< of pixels of the display window that the data window leaves out; whole numbers: 0
};

/// Fills planes of the display window's size; memory of those that have it already is used again. Each part is decoded once, straight into them where its data
/// window does not reach beyond; of lines and tiles those that show. Of tiled parts with several levels: the
/// finest.
/// DataError for subsampled channels, IoError for parts that are not whole, both without the file's name;
/// exceptions of the library.
void decode(Imf::MultiPartInputFile& file, const Path& name, const std::vector<ExrTarget>& targets);

}  // namespace thermal
