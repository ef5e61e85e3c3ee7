#include "io/config/distribution.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/rng.h"
#include "base/text.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

constexpr std::uint32_t kDrawStream = 0x64726177;  // "draw"; other streams have small numbers
constexpr std::array<const char*, 3> kKinds = {"uniform", "normal", "choice"};
constexpr double kLeastShare = 0.01;       // of a normal distribution within a key's range
constexpr std::size_t kMostTries = 65536;  // all of them fail with a probability of 0.99^65536 = 1e-286
constexpr std::string_view kTimePattern = "^([01][0-9]|2[0-3]):[0-5][0-9]$";
constexpr std::string_view kDatePattern = "^[0-9]{4}-[0-9]{2}-[0-9]{2}$";
constexpr int kMinutesADay = 24 * 60;

const Json kAnyValue = Json::object();

RandomField field_of(const DrawKey& key) {
  const std::string name = key.owner + '\n' + key.path;
  return {.seed = key.seed, .stream = kDrawStream, .clip = hash_name(name), .frame = 0};
}

bool may_be(const Json& rules, std::string_view type) {
  const auto types = rules.find("type");
  if (types == rules.end()) return type == "object";
  if (types->is_string()) return *types == type;
  return std::ranges::any_of(*types, [type](const Json& one) { return one == type; });
}

bool has_named_members(const Json& rules) {
  const auto others = rules.find("additionalProperties");
  return others != rules.end() && others->is_object();
}

std::string member_of(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

bool is_kind(const std::string& key) { return std::ranges::find(kKinds, key) != kKinds.end(); }

/// The range of a key in the schema.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;
  std::string unit;

  [[nodiscard]] bool has(double value) const {
    return value <= high && (above_low ? value > low : value >= low);
  }
  [[nodiscard]] std::string in_words() const {
    return fmt::format("{} {:g} and at most {:g}{}{}", above_low ? "more than" : "at least", low, high,
                       unit.empty() ? "" : " ", unit);
  }
};

Range range_of(const Json& rules, std::string_view path) {
  Range range;
  range.low = rules.value("minimum", range.low);
  range.high = rules.value("maximum", range.high);
  range.above_low = rules.contains("exclusiveMinimum");
  if (range.above_low) range.low = rules["exclusiveMinimum"];
  range.unit = unit_of_key(path.substr(path.rfind('.') + 1));
  return range;
}

/// Share of a normal distribution within a range.
double share_within(const Range& range, double mean, double deviation) {
  if (deviation == 0) return range.has(mean) ? 1 : 0;
  const auto below = [&](double value) {
    return 0.5 * std::erfc((mean - value) / (deviation * std::numbers::sqrt2));
  };
  return below(range.high) - below(range.low);
}

/// One draw: checks the distribution, and takes a value from it.
class Draw {
 public:
  Draw(const Json& distribution, const Json& rules, const DrawKey& key, std::string where,
       std::vector<std::string>& faults)
      : distribution_(distribution), rules_(rules), key_(key), where_(std::move(where)), faults_(faults) {}

  Json value() {
    std::vector<std::string> kinds;
    for (const auto& [name, content] : distribution_.items()) {
      if (is_kind(name)) {
        kinds.push_back(name);
      } else if (name != "weights") {
        add_unknown(name);
        return {};
      }
    }
    if (kinds.size() != 1) return add("", list_names(kinds), "one of uniform, normal or choice"), Json();
    if (distribution_.contains("weights") && kinds.front() != "choice")
      return add(".weights", "given", "none beside " + kinds.front()), Json();
    if (kinds.front() == "choice") return chosen();
    return kinds.front() == "normal" ? normal() : uniform();
  }

 private:
  void add(const std::string& part, const std::string& value, const std::string& rule) {
    faults_.push_back(fault(where_ + part, value.empty() ? "none" : value, "", rule));
  }

  void add_unknown(const std::string& name) {
    const std::vector<std::string> known(kKinds.begin(), kKinds.end());
    faults_.push_back(fmt::format("{}.{} is not a known distribution; expected one of {}{}", where_, name,
                                  list_names(known), did_you_mean(name, known)));
  }

  /// Adds what the schema has against a value at some part of the distribution.
  bool is_allowed(const Json& value, const std::string& part) {
    Json filled = value;
    const std::vector<std::string> found = check_and_fill(filled, rules_, where_);
    for (const std::string& one : found) faults_.push_back(where_ + part + one.substr(where_.size()));
    return found.empty();
  }

  /// Both entries of a pair of numbers.
  std::optional<std::pair<double, double>> numbers(const char* kind, const char* rule) {
    const Json& pair = distribution_[kind];
    const bool is_pair = pair.is_array() && pair.size() == 2 && pair[0].is_number() && pair[1].is_number();
    if (is_pair) return std::pair(pair[0].get<double>(), pair[1].get<double>());
    add(fmt::format(".{}", kind), brief(pair), rule);
    return std::nullopt;
  }

  Json uniform() {
    if (may_be(rules_, "string")) return uniform_text();
    if (!may_be(rules_, "number") && !may_be(rules_, "integer"))
      return add(".uniform", brief(distribution_["uniform"]), "choice, for what is not a number"), Json();
    const auto ends = numbers("uniform", "[lowest, highest], two numbers");
    if (!ends) return {};
    const auto [low, high] = *ends;
    const bool low_fits = is_allowed(distribution_["uniform"][0], ".uniform[0]");
    const bool high_fits = is_allowed(distribution_["uniform"][1], ".uniform[1]");
    if (!low_fits || !high_fits) return {};
    if (low > high) return add(".uniform", brief(distribution_["uniform"]), "the lowest first"), Json();
    const double share = uniform_draw(key_);
    if (is_integer())
      return static_cast<std::int64_t>(std::min(high, low + std::floor(share * (high - low + 1))));
    return std::min(high, low + share * (high - low));
  }

  [[nodiscard]] bool is_integer() const { return may_be(rules_, "integer") && !may_be(rules_, "number"); }

  /// Between two times or dates; times may cross midnight.
  Json uniform_text() {
    const Json& pair = distribution_["uniform"];
    const std::string pattern = rules_.value("pattern", "");
    if (pattern != kTimePattern && pattern != kDatePattern)
      return add(".uniform", brief(pair), "choice, for what is not a number, a time or a date"), Json();
    if (!pair.is_array() || pair.size() != 2)
      return add(".uniform", brief(pair), "[first, last], two texts"), Json();
    if (!is_allowed(pair[0], ".uniform[0]") || !is_allowed(pair[1], ".uniform[1]")) return {};
    return pattern == kTimePattern ? uniform_time(pair[0], pair[1]) : uniform_date(pair[0], pair[1]);
  }

  [[nodiscard]] Json uniform_time(const std::string& first, const std::string& last) const {
    const auto minutes_of = [](const std::string& time) {
      return 60 * std::stoi(time.substr(0, 2)) + std::stoi(time.substr(3));
    };
    const int from = minutes_of(first);
    const int span = (minutes_of(last) - from + kMinutesADay) % kMinutesADay;
    const int minute = (from + static_cast<int>(uniform_draw(key_) * (span + 1))) % kMinutesADay;
    return fmt::format("{:02}:{:02}", minute / 60, minute % 60);
  }

  Json uniform_date(const std::string& first, const std::string& last) {
    using namespace std::chrono;
    const auto day_of = [&](const std::string& text, const char* part) -> std::optional<sys_days> {
      const year_month_day date(year(std::stoi(text.substr(0, 4))),
                                month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
                                day(static_cast<unsigned>(std::stoi(text.substr(8)))));
      if (date.ok()) return sys_days(date);
      add(part, brief(text), "a day of the calendar");
      return std::nullopt;
    };
    const auto from = day_of(first, ".uniform[0]");
    const auto to = day_of(last, ".uniform[1]");
    if (!from || !to) return {};
    const int span = static_cast<int>((*to - *from).count());
    if (span < 0) return add(".uniform", brief(distribution_["uniform"]), "the first day first"), Json();
    const year_month_day date(*from + days(static_cast<int>(uniform_draw(key_) * (span + 1))));
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  }

  Json normal() {
    if (!may_be(rules_, "number") && !may_be(rules_, "integer"))
      return add(".normal", brief(distribution_["normal"]), "choice, for what is not a number"), Json();
    const auto given = numbers("normal", "[mean, standard deviation], two numbers");
    if (!given) return {};
    const auto [mean, deviation] = *given;
    const Range range = range_of(rules_, key_.path);
    if (deviation < 0)
      return add(".normal[1]", fmt::format("{:g}", deviation), "a standard deviation of at least 0"), Json();
    if (share_within(range, mean, deviation) < kLeastShare)
      return add(".normal", brief(distribution_["normal"]),
                 fmt::format("one of a hundred draws to be {}", range.in_words())),
             Json();
    for (std::size_t k = 0; k < kMostTries; ++k) {
      const double drawn = mean + deviation * normal_draw(key_, k);
      const double value = is_integer() ? std::nearbyint(drawn) : drawn;
      if (range.has(value)) return is_integer() ? Json(static_cast<std::int64_t>(value)) : Json(value);
    }
    return add(".normal", brief(distribution_["normal"]), range.in_words()), Json();
  }

  Json chosen() {
    const Json& entries = distribution_["choice"];
    if (!entries.is_array() || entries.empty())
      return add(".choice", entries.is_array() ? "[]" : brief(entries), "a list of at least one entry"),
             Json();
    const std::optional<std::vector<double>> weights = weights_for(entries.size());
    if (!weights) return {};
    const std::size_t place = weighted_place(*weights, uniform_draw(key_));
    Json found;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      Json entry = drawn_entry(entries[k], fmt::format(".choice[{}]", k));
      if (k == place) found = std::move(entry);
    }
    return found;
  }

  /// Entries may hold distributions themselves, with numbers of their own. Null removes the key.
  Json drawn_entry(const Json& given, const std::string& part) {
    if (given.is_null()) return given;
    const std::size_t before = faults_.size();
    Json entry = given;
    draw_within(entry, rules_, {.seed = key_.seed, .owner = key_.owner, .path = key_.path + ".choice"},
                where_ + part, faults_);
    if (faults_.size() == before) (void)is_allowed(entry, part);
    return entry;
  }

  std::optional<std::vector<double>> weights_for(std::size_t count) {
    if (!distribution_.contains("weights")) return std::vector<double>(count, 1.0);
    const Json& given = distribution_["weights"];
    std::vector<double> weights;
    double sum = 0;
    if (given.is_array() && given.size() == count) {
      for (const Json& weight : given) {
        if (!weight.is_number() || weight.get<double>() < 0) break;
        weights.push_back(weight);
        sum += weights.back();
      }
    }
    if (weights.size() == count && sum > 0) return weights;
    add(".weights", brief(given), fmt::format("{} numbers of at least 0, one above 0", count));
    return std::nullopt;
  }

  const Json& distribution_;
  const Json& rules_;
  const DrawKey& key_;
  std::string where_;
  std::vector<std::string>& faults_;
};

}  // namespace

double uniform_draw(const DrawKey& key) {
  const RandomField field = field_of(key);
  const Philox4x32::Counter words = Philox4x32::generate(
      {0, field.frame, static_cast<std::uint32_t>(field.clip), static_cast<std::uint32_t>(field.clip >> 32)},
      {field.seed, field.stream});
  return (static_cast<double>(words[0] >> 5) * 0x1p26 + static_cast<double>(words[1] >> 6)) * 0x1p-53;
}

double normal_draw(const DrawKey& key, std::size_t k) {
  std::array<float, kRandomBatch> batch{};
  fill_normal(field_of(key), k / kRandomBatch * kRandomBatch, batch);
  return static_cast<double>(batch[k % kRandomBatch]);
}

std::size_t weighted_place(std::span<const double> weights, double share) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  double left = share * sum;
  std::size_t last = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (!(weights[k] > 0)) continue;
    last = k;
    if (left < weights[k]) return k;
    left -= weights[k];
  }
  return last;  // rounding
}

bool is_distribution(const Json& value, const Json& rules) {
  if (!value.is_object() || value.empty() || rules.empty() || has_named_members(rules)) return false;
  if (!may_be(rules, "object")) return true;
  const Json& properties = rules.contains("properties") ? rules["properties"] : Json::object();
  for (const auto& [key, content] : value.items())
    if (is_kind(key) && !properties.contains(key)) return true;
  return false;
}

Json drawn_value(const Json& distribution, const Json& rules, const DrawKey& key, const std::string& where,
                 std::vector<std::string>& faults) {
  return Draw(distribution, rules, key, where, faults).value();
}

std::vector<std::string> draw_within(Json& value, const Json& rules, const DrawKey& key,
                                     const std::string& where, std::vector<std::string>& faults) {
  if (is_distribution(value, rules)) {
    value = drawn_value(value, rules, key, where, faults);
    return {key.path};
  }
  std::vector<std::string> drawn;
  const auto add = [&](Json& member, const Json& its_rules, const std::string& path,
                       const std::string& place) {
    const DrawKey its_key = {.seed = key.seed, .owner = key.owner, .path = path};
    const std::vector<std::string> inner = draw_within(member, its_rules, its_key, place, faults);
    drawn.insert(drawn.end(), inner.begin(), inner.end());
  };
  if (value.is_object()) {
    for (const auto& [name, member] : value.items())
      add(member, rules_for(rules, name), member_of(key.path, name), member_of(where, name));
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k)
      add(value[k], rules_for_items(rules), fmt::format("{}[{}]", key.path, k),
          fmt::format("{}[{}]", where, k));
  }
  return drawn;
}

const Json& rules_for(const Json& rules, const std::string& key) {
  if (const auto properties = rules.find("properties"); properties != rules.end())
    if (const auto found = properties->find(key); found != properties->end()) return *found;
  const auto others = rules.find("additionalProperties");
  return others != rules.end() && others->is_object() ? *others : kAnyValue;
}

const Json& rules_for_items(const Json& rules) {
  const auto items = rules.find("items");
  return items == rules.end() ? kAnyValue : *items;
}

}  // namespace thermal
