#include "io/json/entry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

#include <fmt/format.h>

namespace thermal {
namespace {

constexpr double kMostExact = 9007199254740992;  // 2^53: floats past it skip whole numbers

/// Empty for other values, and beyond 64 bits.
std::optional<std::int64_t> whole_number_in(const Json& value) {
  if (value.is_number_float()) {
    const double number = value.get<double>();
    const bool is_whole = std::abs(number) <= kMostExact && number == std::floor(number);
    return is_whole ? std::optional(static_cast<std::int64_t>(number)) : std::nullopt;
  }
  if (!value.is_number_integer()) return {};
  // JSON integers above this are unsigned, and would become negative.
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
    return {};
  return value.get<std::int64_t>();
}

}  // namespace

LabelId label_id_in(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (const auto number = whole_number_in(value)) return *number;
  throw DataError(fault("an id", brief(value), "", "a whole number or text"));
}

Json json_of(const LabelId& id) {
  return std::visit([](const auto& value) { return Json(value); }, id);
}

void check_version(const Json& document, const std::string& file, int version) {
  const auto found = document.find("version");
  if (found == document.end() || *found == version) return;
  throw DataError(fault(file + ": version", brief(*found), "",
                        fmt::format("{}, the version that this program reads", version)));
}

JsonEntry::JsonEntry(const Json& json, const std::string& file, const std::string& list, std::size_t index)
    : json_(json), file_(file), list_(&list), place_(index) {
  if (!json.is_object())
    throw DataError(fault(fmt::format("{}: {}[{}]", file, list, index), brief(json), "", "an object"));
}

JsonEntry::JsonEntry(const Json& json, const std::string& file) : json_(json), file_(file) {
  if (!json.is_object()) throw DataError(fault(file, brief(json), "", "an object"));
}

std::int64_t JsonEntry::integer(const char* key) const {
  const Json& value = at(key);
  if (const auto number = whole_number_in(value)) return *number;
  if (value.is_number_integer()) throw fault_of(key, "a whole number up to 9223372036854775807");
  const double number = value.is_number() ? value.get<double>() : 0;
  const bool is_rounded = std::abs(number) > kMostExact && std::abs(number) < kMostExact * 1024;
  throw fault_of(key, is_rounded ? "a whole number; past 2^53 without \".\" and \"e\", which round it"
                                 : "a whole number");
}

LabelId JsonEntry::id(const char* key) const {
  const Json& value = at(key);
  if (value.is_string()) return text(key);
  if (!value.is_number()) throw fault_of(key, "a whole number or text");
  return integer(key);
}

int JsonEntry::count(const char* key) const {
  constexpr std::int64_t kMost = 1'000'000'000;
  return static_cast<int>(whole_number(key, kMost));
}

std::int64_t JsonEntry::whole_number(const char* key, std::int64_t most) const {
  const std::int64_t value = integer(key);
  if (value < 0 || value > most) throw fault_of(key, fmt::format("a whole number from 0 to {}", most));
  return value;
}

std::string JsonEntry::text(const char* key) const {
  const Json& value = at(key);
  if (!value.is_string() || value.get_ref<const std::string&>().empty()) throw fault_of(key, "a string");
  return value.get<std::string>();
}

double JsonEntry::number(const char* key) const {
  const Json& value = at(key);
  if (!value.is_number() || !std::isfinite(value.get<double>())) throw fault_of(key, "a finite number");
  return value.get<double>();
}

std::optional<double> JsonEntry::optional_number(const char* key) const {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}

bool JsonEntry::flag(const char* key) const {
  if (!has(key)) return false;
  const Json& value = json_[key];
  if (value.is_boolean()) return value.get<bool>();
  const std::int64_t number = whole_number_in(value).value_or(-1);
  if (number == 0 || number == 1) return number == 1;
  throw fault_of(key, "0, 1, false or true");
}

LabelBox JsonEntry::box(const char* key) const {
  const Json& value = at(key);
  const auto is_length = [](const Json& v) { return v.is_number() && std::isfinite(v.get<double>()); };
  const bool is_box =
      value.is_array() && value.size() == 4 && std::all_of(value.begin(), value.end(), is_length);
  const auto side = [&value](std::size_t i) { return value[i].get<double>(); };
  if (!is_box || side(2) < 0 || side(3) < 0)
    throw fault_of(key, "x, y, width and height in px, the last two not negative");
  constexpr double kMostPx = 1e9;
  for (std::size_t i = 0; i < 4; ++i)
    if (std::abs(side(i)) > kMostPx) throw fault_of(key, "numbers of at most 1e9 px");
  return {side(0), side(1), side(2), side(3)};
}

DataError JsonEntry::fault_of(const char* key, const std::string& rule) const {
  return DataError(fault(location_of(key), json_.contains(key) ? brief(json_[key]) : "nothing", "", rule));
}

std::string JsonEntry::location_of(const char* key) const {
  return list_ == nullptr ? fmt::format("{}: {}", file_, key)
                          : fmt::format("{}: {}[{}].{}", file_, *list_, place_, key);
}

const Json& JsonEntry::at(const char* key) const {
  if (!json_.contains(key)) throw fault_of(key, "one");
  return json_[key];
}

}  // namespace thermal
