#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include <ImfMultiPartInputFile.h>

#include "base/image.h"
#include "io/exr/header.h"
#include "io/pass_buffer.h"

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

/// Reads a plane of indices exactly: from uint channels as they are, from floats if they are whole. An index must not
/// exceed kLargestIndex, nor 2048 in half floats, which are exact up to there.
class ExrIndexPlane {
 public:
  /// DataError for a lossy compression. Pixels are decoded into `pixels`, which must outlive this object.
  ExrIndexPlane(const ExrChannel& channel, IndexPixels& pixels);

  /// To be decoded; this object must not move before that.
  [[nodiscard]] ExrTarget target();

  /// The decoded indices, in a plane whose memory is reused if it has the right size. DataError with the channel,
  /// pixel and value of the first number that is not an index.
  void indices(Plane<std::uint16_t>& out) const;

 private:
  ExrChannel channel_;
  IndexPixels& pixels_;
};

}  // namespace thermal
