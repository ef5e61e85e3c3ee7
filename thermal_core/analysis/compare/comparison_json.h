#pragma once

#include "analysis/compare/comparison.h"
#include "io/json/file.h"

namespace thermal {

/// How noise was measured in a set, as a sentence without a full stop.
[[nodiscard]] std::string noise_method(const SetFigures& set);

/// A comparison as JSON, with all that is printed; unknown values are null. With `each`, also the figures of each frame
/// and target.
[[nodiscard]] Json to_json(const Comparison& comparison, bool each);

}  // namespace thermal
