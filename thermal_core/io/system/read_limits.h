#pragma once

#include <cstdint>

namespace thermal {

/// Limits on what a file of passes may claim, checked before memory is allocated for it.
struct ReadLimits {
  std::int64_t pixels = 256'000'000;  ///< of a plane
};

}  // namespace thermal
