#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/json/file.h"

namespace thermal {

/// What a draw's random numbers are a function of: adding keys, clips or shards changes no other draw.
struct DrawKey {
  std::uint32_t seed = 1;  ///< of the dataset
  std::string owner = {};  ///< id of the clip or flight; empty: the dataset
  std::string path = {};   ///< of the key, such as "weather.wind_m_s"
};

/// Uniform in [0, 1), with 53 bits.
[[nodiscard]] double uniform_draw(const DrawKey& key);

/// Number `k` of the standard normal distribution, |value| <= 6.7; see fill_normal().
[[nodiscard]] double normal_draw(const DrawKey& key, std::size_t k);

/// The place at a share of the sum of all weights, in [0, 1); none whose weight is 0. One at least is above 0.
[[nodiscard]] std::size_t weighted_place(std::span<const double> weights, double share);

/// Whether a value stands for a distribution where the schema's `rules` of its key expect something else: an object
/// with uniform, normal or choice, or any object in place of a number, a text or a list. Unknown keys, which have no
/// rules, are left to the schema.
[[nodiscard]] bool is_distribution(const Json& value, const Json& rules);

/// A value of a distribution: {"uniform": [lo, hi]} of numbers, times (also past midnight) or dates; {"normal": [mean,
/// sd]}, drawn again until the key's range in the schema has it; or {"choice": […], "weights": […]}, whose entry may hold
/// distributions again. Adds faults, each starting with `where`, also for entries that are not chosen; what is returned
/// then is of no use.
[[nodiscard]] Json drawn_value(const Json& distribution, const Json& rules, const DrawKey& key,
                               const std::string& where, std::vector<std::string>& faults);

/// Draws the distributions in a value, at every depth; `rules` are those of the schema for it. Returns the paths of what
/// was drawn, below `key.path`. `where` starts the messages of faults, and stands for `key.path`.
std::vector<std::string> draw_within(Json& value, const Json& rules, const DrawKey& key,
                                     const std::string& where, std::vector<std::string>& faults);

/// The schema's rules for a member of an object, and for the entries of a list; an empty object where it has none.
[[nodiscard]] const Json& rules_for(const Json& rules, const std::string& key);
/// The same for the entries of a list.
[[nodiscard]] const Json& rules_for_items(const Json& rules);

}  // namespace thermal
