#include "cli/class_bounds.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/text.h"

namespace veldt {
namespace {

using thermal::ClassBounds;
using thermal::ConfigError;

constexpr std::int64_t kMostLabels = 1'000'000'000;  // of a class; far more than any data set has

ConfigError fault_of(const std::string& word, const std::string& rule) {
  return ConfigError(thermal::fault("--per-class", "\"" + word + "\"", "", rule));
}

std::optional<std::int64_t> parse_count(std::string_view text) {
  const auto count = thermal::number_in<std::int64_t>(text);
  return count && *count >= 0 && *count <= kMostLabels ? count : std::nullopt;
}

/// "LO:HI"; `word` is the argument that contains it, for messages.
ClassBounds parse_bounds(std::string_view text, const std::string& word) {
  const std::size_t colon = text.find(':');
  const auto low = parse_count(text.substr(0, colon));
  const auto high = parse_count(colon == std::string_view::npos ? "" : text.substr(colon + 1));
  if (!low || !high)
    throw fault_of(word, "LO:HI or CLASS=LO:HI, whole numbers from 0 to " + std::to_string(kMostLabels));
  if (*low > *high) throw fault_of(word, "LO:HI with LO at most HI");
  return {.at_least = *low, .at_most = *high};
}

/// The category of poachers is `human`, so small_human is an alias of small_poacher.
std::string with_poachers(const std::string& name) {
  const std::size_t size = name.rfind("_human");
  return size != std::string::npos && name.ends_with("_human") ? name.substr(0, size) + "_poacher" : name;
}

std::size_t parse_class(const std::string& name, const std::string& word) {
  const auto& names = thermal::balance_class_names();
  const std::string known = with_poachers(name);
  const auto found = std::find(names.begin(), names.end(), known);
  if (found == names.end())
    throw fault_of(word,
                   "one of " + thermal::list_names(names) + " before =" + thermal::did_you_mean(name, names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::array<ClassBounds, thermal::kBalanceClasses> parse_class_bounds(const std::vector<std::string>& words) {
  std::array<std::optional<ClassBounds>, thermal::kBalanceClasses> given;
  std::optional<ClassBounds> others;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const bool for_one = equals != std::string::npos;
    auto& place = for_one ? given[parse_class(word.substr(0, equals), word)] : others;
    if (place) throw fault_of(word, for_one ? "each class once" : "one LO:HI for all classes");
    place = parse_bounds(std::string_view(word).substr(for_one ? equals + 1 : 0), word);
  }
  std::array<ClassBounds, thermal::kBalanceClasses> bounds;
  for (std::size_t k = 0; k < bounds.size(); ++k)
    bounds[k] = given[k].value_or(others.value_or(ClassBounds{.at_least = 0, .at_most = kMostLabels}));
  return bounds;
}

}  // namespace veldt
