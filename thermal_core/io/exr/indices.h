#pragma once

#include <cstdint>

#include "base/image.h"
#include "io/exr/header.h"
#include "io/exr/pixels.h"
#include "io/pass_buffer.h"

namespace thermal {

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
