#pragma once

#include <cstdint>

#include "base/image.h"

namespace thermal {

/// The planes of one rendered frame, all of one size.
struct Passes {
  Plane<std::uint16_t> object_index;
  Plane<std::uint16_t> material_index;  ///< empty if the file has none
};

}  // namespace thermal
