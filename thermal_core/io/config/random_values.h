#pragma once

#include <string>
#include <vector>

#include "io/config/distribution.h"
#include "io/json/file.h"

namespace thermal {

/// Draws the distributions in a value, at every depth; `rules` are those of the schema for it. Returns the paths of what
/// was drawn, below `key.path`. `where` starts the messages of faults, and stands for `key.path`.
std::vector<std::string> draw_within(Json& value, const Json& rules, const DrawKey& key,
                                     const std::string& where, std::vector<std::string>& faults);

/// Takes the distributions out of a value, at every depth: an object with them alone, or empty.
[[nodiscard]] Json take_distributions(Json& value, const Json& rules);

/// Merges members of objects at every depth; anything else is replaced, by null too.
void overlay(Json& into, const Json& changes);

}  // namespace thermal
