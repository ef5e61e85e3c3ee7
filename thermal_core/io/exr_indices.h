#pragma once

#include <cstdint>

#include "base/image.h"
#include "io/exr_header.h"
#include "io/exr_pixels.h"
#include "io/pass_buffer.h"

namespace thermal {

/// Reads a plane of indices exactly: of whole numbers as they are, of floats if they are whole. An index must
/// be no larger than kLargestIndex, and in half floats no larger than 2048: they are exact up to there.
class ExrIndexPlane {
 public:
  /// DataError for a compression that changes pixels. Pixels are decoded into `pixels`, which must outlive this.
  ExrIndexPlane(const ExrChannel& channel, IndexPixels& pixels);

  /// To be decoded; this must stay where it is until then.
  [[nodiscard]] ExrTarget target();

  /// What was decoded, into a plane whose memory is used again if it has the right size. DataError that names channel and
  /// pixel of the first number that is no index, and the number.
  void indices(Plane<std::uint16_t>& out) const;

 private:
  ExrChannel channel_;
  IndexPixels& pixels_;
};

}  // namespace thermal
