#include "analysis/fit/fitted_keys.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"

namespace thermal {
namespace {

using Keys = std::vector<std::string>;

Keys keys_in(const char* path) {
  Keys keys;
  for (const std::string_view key : split(std::string_view(path).substr(1), '/')) keys.emplace_back(key);
  return keys;
}

bool is_choice(const Json& value) {
  return value.is_object() && value.contains("choice") && value["choice"].is_array();
}

/// The value of a key below `value`, in a choice that of the first entry that has it; null: absent.
const Json* found_in(const Json& value, const Keys& keys, std::size_t depth = 0) {
  if (is_choice(value)) {
    for (const Json& entry : value["choice"])
      if (const Json* found = found_in(entry, keys, depth)) return found;
    return nullptr;
  }
  if (depth == keys.size()) return &value;
  if (!value.is_object() || !value.contains(keys[depth])) return nullptr;
  return found_in(value[keys[depth]], keys, depth + 1);
}

void set_in(Json& value, const Keys& keys, const Json& what, std::size_t depth = 0) {
  if (is_choice(value) && depth < keys.size()) {
    for (Json& entry : value["choice"])
      if (entry.is_object()) set_in(entry, keys, what, depth);
    return;
  }
  if (depth == keys.size())
    value = what;
  else
    set_in(value[keys[depth]], keys, what, depth + 1);
}

/// Minimum and maximum of a number or a distribution; for a normal one, of a uniform one with the same deviation.
std::optional<std::pair<double, double>> ends_of(const Json& value) {
  if (value.is_number()) return std::pair(value.get<double>(), value.get<double>());
  if (!value.is_object()) return {};
  const auto pair_of = [&value](const char* kind) -> std::optional<std::pair<double, double>> {
    if (!value.contains(kind)) return {};
    const Json& pair = value[kind];
    if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) return {};
    return std::pair(pair[0].get<double>(), pair[1].get<double>());
  };
  if (const auto uniform = pair_of("uniform")) return uniform;
  if (const auto normal = pair_of("normal")) {
    const double reach = std::sqrt(3.0) * normal->second;
    return std::pair(normal->first - reach, normal->first + reach);
  }
  return {};
}

/// Ends of a key in a document or, if the document leaves it out, in the resolved one.
std::optional<std::pair<double, double>> known_ends(const FittedKey& key, const Json& document,
                                                    const Json& resolved) {
  for (const Json* one : {&document, &resolved}) {
    const Json* found = found_in(*one, keys_in(key.path));
    if (found == nullptr) continue;
    if (const auto ends = ends_of(*found)) return ends;
  }
  return {};
}

// --- optional stages

/// The section of a stage as a choice: its non-null entries, and their weights.
struct Entries {
  std::vector<Json> entries = {};
  std::vector<double> weights = {};
  double nothing = 0;  ///< weight of null

  [[nodiscard]] double sum() const {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    return sum;
  }
};

Entries entries_of(const Json* section) {
  Entries found;
  if (section == nullptr || section->is_null()) {
    found.nothing = 1;
    return found;
  }
  if (!is_choice(*section)) {
    found.entries.push_back(*section);
    found.weights.push_back(1);
    return found;
  }
  const Json& choice = (*section)["choice"];
  const Json weights = section->value("weights", Json::array());
  for (std::size_t k = 0; k < choice.size(); ++k) {
    const double weight = k < weights.size() && weights[k].is_number() ? weights[k].get<double>() : 1;
    if (choice[k].is_null()) {
      found.nothing += weight;
    } else {
      found.entries.push_back(choice[k]);
      found.weights.push_back(weight);
    }
  }
  return found;
}

const Json* member(const Json& document, const std::string& path) {
  const Json::json_pointer point(path);
  return document.contains(point) ? &document[point] : nullptr;
}

double share_of(const Json* section) {
  const Entries found = entries_of(section);
  const double sum = found.sum();
  return sum > 0 ? sum / (sum + found.nothing) : 0;
}

/// Defaults of a stage that a config lacks; null: there are none.
Json stage_of(std::string_view path) {
  if (path == "/output/link") return {{"standard", "pal"}};
  return {{"name", "h264"}, {"bitrate_kbit_s", 500}};
}

/// Below this share of the clips a stage is left out; above 1 minus this, all clips have it.
constexpr double kLeastShare = 0.02;

Json section_with(const Json* section, const std::string& path, double share) {
  Entries found = entries_of(section);
  if (share < kLeastShare) return {};
  if (found.entries.empty()) {
    found.entries.push_back(stage_of(path));
    found.weights.push_back(1);
  }
  const double sum = found.sum();
  Json choice = Json::array();
  Json weights = Json::array();
  if (share <= 1 - kLeastShare) {
    choice.push_back(nullptr);
    weights.push_back(rounded_to_three(1 - share));
  }
  for (std::size_t k = 0; k < found.entries.size(); ++k) {
    choice.push_back(found.entries[k]);
    weights.push_back(rounded_to_three(std::min(share, 1.0) * found.weights[k] / sum));
  }
  if (choice.size() == 1) return found.entries.front();
  return {{"choice", std::move(choice)}, {"weights", std::move(weights)}};
}

void set_section(Json& document, const std::string& path, double share) {
  const Json::json_pointer point(path);
  Json section = section_with(member(document, path), path, share);
  if (!section.is_null())
    document[point] = std::move(section);
  else if (document.contains(point))
    document[point.parent_pointer()].erase(point.back());
}

/// Whether a document has the stage of a key; those of the sensor always exist.
bool has_stage(const Json& document, const std::string& path) {
  return !path.starts_with("/output/") || share_of(member(document, path.substr(0, path.rfind('/')))) > 0;
}

}  // namespace

double rounded_to_three(double value) {
  const double three = number_in<double>(fmt::format("{:.3g}", value)).value_or(value);
  return three == 0 ? 0 : three;  // no negative zero
}

const std::vector<FittedKey>& fitted_keys() {
  // Ranges: between no effect and a useless picture, for uncooled cameras and links; estimates.
  static const std::vector<FittedKey> kKeys = {
      {.stage = "gain", .path = "/sensor/agc/max_gain_dn_per_netd", .low = 0.2, .high = 12, .by_ratio = true},
      {.stage = "gain",
       .path = "/sensor/agc/tail_percent",
       .low = 0.01,
       .high = 3,
       .by_ratio = true,
       .varies = false},
      {.stage = "gain",
       .path = "/sensor/agc/black_level",
       .low = 0,
       .high = 60,
       .varies = false,
       .is_whole = true},
      {.stage = "gain",
       .path = "/sensor/agc/white_level",
       .low = 195,
       .high = 255,
       .varies = false,
       .is_whole = true},
      {.stage = "noise", .path = "/sensor/noise/amount", .low = 0.01, .high = 4, .by_ratio = true},
      {.stage = "noise", .path = "/sensor/processing/noise_filter_sigma_px", .low = 0, .high = 1.6},
      {.stage = "sharpening", .path = "/sensor/processing/unsharp_amount", .low = 0, .high = 2.5},
      {.stage = "sharpening",
       .path = "/sensor/processing/unsharp_sigma_px",
       .low = 1,
       .high = 4,
       .varies = false},
      {.stage = "optics", .path = "/sensor/optics/aberration_sigma_px", .low = 0.1, .high = 2.5},
      {.stage = "link", .path = "/output/link", .varies = false, .is_share = true},
      {.stage = "link", .path = "/output/link/bandwidth_mhz", .low = 1, .high = 6, .varies = false},
      {.stage = "link", .path = "/output/link/noise_levels", .low = 0, .high = 8, .varies = false},
      {.stage = "link", .path = "/output/link/streak_levels", .low = 0, .high = 6, .varies = false},
      {.stage = "link", .path = "/output/link/row_levels", .low = 0, .high = 4, .varies = false},
      {.stage = "codec", .path = "/output/codec", .varies = false, .is_share = true},
      {.stage = "codec", .path = "/output/codec/bitrate_kbit_s", .low = 30, .high = 5000, .by_ratio = true},
  };
  return kKeys;
}

FittedSpace::FittedSpace(Json document, const Json& resolved) : document_(std::move(document)) {
  const char* stage = "";
  for (const FittedKey& key : fitted_keys()) {
    if (std::string_view(stage) != key.stage) stages_.emplace_back();
    stage = key.stage;
    first_.push_back(start_.size());
    known_.push_back(true);
    const auto add = [&](double coordinate) {
      stages_.back().push_back(start_.size());
      start_.push_back(std::clamp(coordinate, 0.0, 1.0));
    };
    if (key.is_share) {
      shares_.push_back(start_.size());
      add(share_of(member(document_, key.path)));
      continue;
    }
    const auto known = known_ends(key, document_, resolved);
    known_.back() = known.has_value();
    const double middle = number_at(key, 0.5);  // of a stage that the config lacks
    const auto [low, high] = known.value_or(std::pair(middle, middle));
    const auto point = [&key](double value) {
      if (!key.by_ratio) return (value - key.low) / (key.high - key.low);
      return std::log(std::max(value, key.low) / key.low) / std::log(key.high / key.low);
    };
    if (key.varies) {
      add(point(low));
      add(point(high));
    } else {
      add(0.5 * (point(low) + point(high)));
    }
  }
}

double FittedSpace::number_at(const FittedKey& key, double coordinate) const {
  const double share = std::clamp(coordinate, 0.0, 1.0);
  const double value =
      key.by_ratio ? key.low * std::pow(key.high / key.low, share) : key.low + share * (key.high - key.low);
  return key.is_whole ? std::round(value) : rounded_to_three(value);
}

Json FittedSpace::value_at(std::size_t number, const std::vector<double>& point) const {
  const FittedKey& key = fitted_keys()[number];
  const std::size_t at = first_[number];
  if (key.is_share) return rounded_to_three(std::clamp(point[at], 0.0, 1.0));
  const double one = number_at(key, point[at]);
  if (key.is_whole) return static_cast<int>(one);
  const double other = key.varies ? number_at(key, point[at + 1]) : one;
  if (one == other) return one;
  return {{"uniform", {std::min(one, other), std::max(one, other)}}};
}

Json FittedSpace::document_at(const std::vector<double>& point) const {
  Json document = document_;
  for (std::size_t number = 0; number < fitted_keys().size(); ++number) {
    const FittedKey& key = fitted_keys()[number];
    const bool is_start = is_at_start(number, point);
    if (key.is_share) {
      if (!is_start) set_section(document, key.path, point[first_[number]]);
    } else if (!(is_start && known_[number]) && has_stage(document, key.path)) {
      set_in(document, keys_in(key.path), value_at(number, point));
    }
  }
  return document;
}

bool FittedSpace::is_at_start(std::size_t number, const std::vector<double>& point) const {
  const std::size_t end = number + 1 < first_.size() ? first_[number + 1] : start_.size();
  for (std::size_t k = first_[number]; k < end; ++k)
    if (point[k] != start_[k]) return false;
  return true;
}

}  // namespace thermal
