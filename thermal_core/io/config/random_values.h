#pragma once

#include "io/json/file.h"

namespace thermal {

/// Takes the distributions out of a value, at every depth: an object with them alone, or empty.
[[nodiscard]] Json take_distributions(Json& value, const Json& rules);

/// Merges members of objects at every depth; anything else is replaced, by null too.
void overlay(Json& into, const Json& changes);

}  // namespace thermal
