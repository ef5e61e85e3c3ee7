#pragma once

#include <string>

namespace thermal {

/// Version of Embree, and the width of this processor's vectors: "3.13.5, 16 rays at once".
[[nodiscard]] std::string engine_version();

}  // namespace thermal
