#include "io/json/schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <map>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// Longest suffixes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kUnits = {
    {{"_w_m2_sr", "W m^-2 sr^-1"},
     {"_m_s", "m/s"},
     {"per_ha", "per hectare"},
     {"_kelvin", "K"},
     {"_um", "um"},
     {"_mm", "mm"},
     {"_hz", "Hz"},
     {"_mk", "mK"},
     {"_deg", "deg"},
     {"_rad", "rad"},
     {"_px", "px"},
     {"_dn", "counts"},
     {"_k", "K"},
     {"_m", "m"},
     {"_s", "s"}}};

const Json kNone = Json::object();
const Json kAnything = true;

const Json& member_or(const Json& object, const char* key, const Json& otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : *found;
}

std::string key_of(std::string_view where) {
  const std::size_t dot = where.rfind('.');
  std::string key(dot == std::string_view::npos ? where : where.substr(dot + 1));
  key.erase(std::min(key.find('['), key.size()));
  return key;
}

/// Compiles a pattern on any thread. libstdc++ caches each character narrowed for a pattern in a global table, without
/// a lock (GCC's bug 77704). Narrowing a range fills the whole table, which is then only read.
std::regex compiled(const std::string& pattern) {
  [[maybe_unused]] static const char kNarrowed = [] {
    const char letter = 'a';
    char narrow = 0;
    std::use_facet<std::ctype<char>>(std::locale()).narrow(&letter, &letter + 1, 0, &narrow);
    return narrow;
  }();
  return std::regex(pattern);
}

/// Of names that become names of files and folders, or parts of them.
constexpr std::string_view kNamePattern = "^[A-Za-z0-9_][A-Za-z0-9_-]{0,199}$";
constexpr std::string_view kNameOrNothingPattern = "^([A-Za-z0-9_][A-Za-z0-9_-]{0,199})?$";

std::string in_words(const std::string& pattern) {
  if (pattern == kNamePattern) return "1 to 200 letters, digits, _ or -, not beginning with -";
  if (pattern == kNameOrNothingPattern) return "at most 200 letters, digits, _ or -, not beginning with -";
  return "text that matches " + pattern;
}

constexpr std::size_t kMostPatternBytes = 4096;

/// Checks one document against one schema.
class Checker {
 public:
  Checker(const Json& root, const EntryNames& names) : root_(root), names_(names) {}

  void check(Json& value, const Json& given, const std::string& where) {
    const Json& schema = meant_by(given);
    if (!has_type(value, schema)) return;
    if (!check_enum(value, schema)) return;
    if (value.is_number()) check_range(value, schema);
    if (value.is_string()) check_pattern(value, schema);
    if (value.is_object()) check_object(value, schema, where);
    if (value.is_array()) check_array(value, schema, where);
  }
  void check_at(Json& value, const Json& schema, const std::string& where) {
    const std::string outer = std::exchange(where_, where);
    check(value, schema, where);
    where_ = outer;
  }
  [[nodiscard]] std::vector<std::string> faults() && { return std::move(faults_); }

 private:
  /// Resolves a "$ref" within the same schema.
  [[nodiscard]] const Json& meant_by(const Json& schema) const {
    const auto reference = schema.find("$ref");
    if (reference == schema.end()) return schema;
    return root_.at(Json::json_pointer(reference->get<std::string>().substr(1)));
  }

  void add(const Json& value, const std::string& rule) {
    const std::string unit = value.is_number() ? unit_of_key(key_of(where_)) : "";
    const std::string where = where_.empty() ? "document" : where_;
    add_at(where, fault("", shortened(value), unit, rule));
  }

  void add_at(const std::string& where, const std::string& fault) {
    if (at_fault_.insert(where).second) faults_.push_back(where + fault);
  }

  static std::string shortened(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("a list of {}", value.size());
    return brief(value);
  }

  bool has_type(const Json& value, const Json& schema) {
    static const std::map<std::string_view, std::string_view> kWords = {
        {"object", "an object"},       {"array", "a list"},    {"string", "a string"},
        {"integer", "a whole number"}, {"number", "a number"}, {"boolean", "true or false"}};
    if (!schema.contains("type")) return true;
    std::vector<std::string_view> words;
    const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
    for (const auto& type : types.get<std::vector<std::string>>()) {
      if (is_of_type(value, type)) return true;
      words.push_back(kWords.at(type));
    }
    add(value, fmt::format("{}", fmt::join(words, " or ")));
    return false;
  }

  static bool is_of_type(const Json& value, std::string_view type) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "integer" && is_whole(value)) ||
           (type == "number" && value.is_number()) || (type == "boolean" && value.is_boolean());
  }

  static bool is_whole(const Json& value) {
    if (value.is_number_integer()) return true;
    if (!value.is_number_float()) return false;
    const auto number = value.get<double>();
    constexpr double kLargestExact = 9007199254740992.0;
    return std::abs(number) <= kLargestExact && number == std::floor(number);
  }

  bool check_enum(const Json& value, const Json& schema) {
    if (!schema.contains("enum")) return true;
    std::vector<std::string> choices;
    for (const Json& choice : schema["enum"]) {
      if (choice == value) return true;
      choices.push_back(choice.is_string() ? choice.get<std::string>() : choice.dump());
    }
    const std::string miss = value.is_string() ? did_you_mean(value.get<std::string>(), choices) : "";
    add(value, (choices.size() == 1 ? "" : "one of ") + list_names(choices) + miss);
    return false;
  }

  void check_range(const Json& value, const Json& schema) {
    const auto number = value.get<double>();
    const bool above = schema.contains("exclusiveMinimum");
    const bool low = above ? !(number > schema["exclusiveMinimum"].get<double>())
                           : schema.contains("minimum") && !(number >= schema["minimum"].get<double>());
    const bool high = schema.contains("maximum") && !(number <= schema["maximum"].get<double>());
    if (!low && !high) return;
    const std::string unit = unit_of_key(key_of(where_));
    std::vector<std::string> rules;
    if (above) rules.push_back("more than " + schema["exclusiveMinimum"].dump());
    if (schema.contains("minimum")) rules.push_back("at least " + schema["minimum"].dump());
    if (schema.contains("maximum")) rules.push_back("at most " + schema["maximum"].dump());
    add(value, fmt::format("{}{}{}", fmt::join(rules, " and "), unit.empty() ? "" : " ", unit));
  }

  void check_pattern(const Json& value, const Json& schema) {
    if (!schema.contains("pattern")) return;
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() > kMostPatternBytes) {  // std::regex takes stack space for each byte
      add(value, fmt::format("at most {} bytes", kMostPatternBytes));
      return;
    }
    const auto pattern = schema["pattern"].get<std::string>();
    auto found = patterns_.find(pattern);
    if (found == patterns_.end()) found = patterns_.emplace(pattern, compiled(pattern)).first;
    if (std::regex_search(text, found->second)) return;
    add(value, in_words(pattern));
  }

  void check_object(Json& value, const Json& schema, const std::string& where) {
    const std::string prefix = where.empty() ? "" : where + ".";
    if (value.size() < schema.value("minProperties", std::size_t{0})) add(value, "at least one entry");
    const Json& properties = member_or(schema, "properties", kNone);
    const Json& others = member_or(schema, "additionalProperties", kAnything);
    for (const auto& [key, member] : value.items()) {
      if (properties.contains(key)) {
        check_at(member, properties[key], prefix + key);
      } else if (others.is_object()) {
        check_at(member, others, prefix + key);
      } else if (!others.get<bool>()) {
        add_unknown_key(prefix + key, key, properties);
      }
    }
    for (const Json& key : member_or(schema, "required", kNone)) {
      const auto name = key.get<std::string>();
      if (!value.contains(name)) add_at(prefix + name, " is missing; expected a value");
    }
    for (const auto& [key, property] : properties.items()) fill_preset(value, key, property);
    for (const auto& [key, property] : properties.items()) {
      if (value.contains(key) || !property.contains("default")) continue;
      value[key] = property["default"];
      check_at(value[key], property, prefix + key);  // fills in nested defaults
    }
  }

  /// Some keys are shorthand for several others: "presets" lists the others' defaults for each value.
  static void fill_preset(Json& value, const std::string& key, const Json& property) {
    const auto presets = property.find("presets");
    if (presets == property.end() || !value.contains(key) || !value[key].is_string()) return;
    const Json& preset = member_or(*presets, value[key].get<std::string>().c_str(), kNone);
    for (const auto& [name, chosen] : preset.items()) {
      if (!value.contains(name)) value[name] = chosen;
    }
  }

  void add_unknown_key(const std::string& where, const std::string& key, const Json& properties) {
    std::vector<std::string> known;
    for (const auto& [name, property] : properties.items()) known.push_back(name);
    add_at(where, " is not a known key; expected " +
                      (known.empty() ? "none" : "one of " + list_names(known, 40)) +
                      did_you_mean(key, known));
  }

  void check_array(Json& value, const Json& schema, const std::string& where) {
    const auto fewest = schema.value("minItems", std::size_t{0});
    const auto most = schema.value("maxItems", value.size());
    if (value.size() < fewest || value.size() > most) {
      const bool exact = schema.contains("maxItems") && fewest == most;
      add(value, exact ? fmt::format("{} entries", fewest)
                       : (value.size() < fewest ? fmt::format("at least {} entries", fewest)
                                                : fmt::format("at most {} entries", most)));
    }
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i) {
      check_at(value[i], schema["items"], entry_name(where, i));
    }
  }

  [[nodiscard]] std::string entry_name(const std::string& list, std::size_t entry) const {
    const auto named = names_.find(list);
    return named == names_.end() ? fmt::format("{}[{}]", list, entry) : named->second.at(entry);
  }

  const Json& root_;
  const EntryNames& names_;
  std::string where_;
  std::vector<std::string> faults_;
  std::set<std::string> at_fault_;  ///< places that have one
  std::map<std::string, std::regex> patterns_;
};

}  // namespace

std::vector<std::string> check_and_fill(Json& document, const Json& schema, const std::string& where,
                                        const EntryNames& names) {
  Checker checker(schema, names);
  checker.check_at(document, schema, where);
  return std::move(checker).faults();
}

std::string unit_of_key(std::string_view key) {
  for (const auto& [suffix, unit] : kUnits) {
    if (key.ends_with(suffix)) return std::string(unit);
  }
  return "";
}

}  // namespace thermal
