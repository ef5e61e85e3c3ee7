#include "io/json/file.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

/// "NAME:LINE:COLUMN" of a byte, both from 1.
std::string position(std::string_view text, std::size_t byte, const std::string& name) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  return fmt::format("{}:{}:{}", name, line, before.size() - line_begin + 1);
}

/// The library's message without its own numbering and position: the text after "syntax error", or otherwise after the
/// number. Python writes NaN and Infinity unquoted; the library stops at their first letter.
std::string reason(const std::string& what) {
  const std::size_t begin = what.find("syntax error");
  std::string words = what.substr(begin == std::string::npos ? what.find(']') + 2 : begin);
  if (!words.ends_with("N'") && !words.ends_with("I'")) return words;
  return words + "; expected a finite number: JSON has no NaN and no Infinity, though Python writes them";
}

/// Detects keys that are repeated in one object, which JSON readers otherwise drop silently.
class DuplicateKeys {
 public:
  void see(Json::parse_event_t event, const Json& value) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event != Json::parse_event_t::key) return;
    const auto key = value.get<std::string>();
    if (!open_.back().insert(key).second && first_.empty()) first_ = key;
  }
  [[nodiscard]] const std::string& first() const noexcept { return first_; }

 private:
  std::vector<std::set<std::string>> open_;
  std::string first_;
};

/// Passes on the elements of top-level arrays as the parser completes them.
class Elements {
 public:
  explicit Elements(const TakeElement& take) : take_(take) {}

  /// Whether the parser should keep the value that it has just parsed.
  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    using Event = Json::parse_event_t;
    if (event == Event::key && depth == 1) key_ = value.get<std::string>();
    if (event == Event::array_start && depth == 0) inside_ = 1;
    if (event == Event::array_start && depth == 1 && inside_ == 0) begin(2);
    if (event == Event::array_end && depth + 1 == inside_) inside_ = 0;
    const bool ends = event == Event::object_end || event == Event::array_end || event == Event::value;
    if (!ends || inside_ == 0 || depth != inside_) return true;
    take_(key_, place_++, value);
    return false;
  }

 private:
  void begin(int depth) {
    inside_ = depth;
    place_ = 0;
  }

  const TakeElement& take_;
  std::string key_;
  std::size_t place_ = 0;
  int inside_ = 0;  ///< depth of the elements of the open array; 0: none is open
};

/// Limits depth: trees are copied, compared and written recursively, and the stack is small. Our own documents are 8
/// deep.
void check_depth(int depth, Json::parse_event_t event, const std::string& name) {
  constexpr int kDeepest = 64;
  const bool begins = event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
  if (!begins || depth < kDeepest) return;
  throw ConfigError(
      fmt::format("{}: lists and objects are nested more than {} deep; expected fewer", name, kDeepest));
}

/// Parses a text or a stream with the filter `keep`; errors report the position, for which `whole_text` is called.
template <typename Input, typename WholeText, typename Keep>
Json parse_watched(Input&& input, const std::string& name, const WholeText& whole_text, Keep keep) {
  DuplicateKeys duplicates;
  const auto watch = [&](int depth, Json::parse_event_t event, const Json& value) {
    check_depth(depth, event, name);
    duplicates.see(event, value);
    return keep(depth, event, value);
  };
  try {
    Json json = Json::parse(std::forward<Input>(input), watch);
    if (duplicates.first().empty()) return json;
  } catch (const Json::parse_error& error) {
    // The library counts the offending byte from 1.
    const auto& text = whole_text();
    throw ConfigError(fmt::format("{}: not JSON: {}",
                                  position(text, error.byte == 0 ? 0 : error.byte - 1, name),
                                  text.empty() ? "it is empty" : reason(error.what())));
  } catch (const Json::out_of_range& error) {  // "[json.exception.out_of_range.406] number overflow …"
    throw ConfigError(fmt::format("{}: not JSON: {}", name, reason(error.what())));
  }
  throw ConfigError(
      fmt::format("{}: key \"{}\" appears twice in one object; expected once", name, duplicates.first()));
}

void collect_differences(const Json& here, const Json& there, const std::string& where,
                         std::vector<std::string>& found) {
  if (here == there) return;
  if (here.is_object() && there.is_object()) {
    const std::string prefix = where.empty() ? "" : where + ".";
    for (const auto& [key, value] : here.items()) {
      if (there.contains(key)) {
        collect_differences(value, there[key], prefix + key, found);
      } else {
        found.push_back(fmt::format("{}{} is only here", prefix, key));
      }
    }
    for (const auto& [key, value] : there.items()) {
      if (!here.contains(key)) found.push_back(fmt::format("{}{} is only there", prefix, key));
    }
    return;
  }
  if (here.is_array() && there.is_array() && here.size() == there.size()) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      collect_differences(here[i], there[i], fmt::format("{}[{}]", where, i), found);
    }
    return;
  }
  if (here.is_array() && there.is_array()) {
    found.push_back(fmt::format("{} has {} entries here and {} there", where, here.size(), there.size()));
    return;
  }
  found.push_back(fmt::format("{} is {} here and {} there", where, here.dump(), there.dump()));
}

}  // namespace

Json parse_json(std::string_view text, const std::string& name) {
  return parse_watched(
      text, name, [&] { return text; }, [](int, Json::parse_event_t, const Json&) { return true; });
}

Json parse_json_elements(std::string_view text, const std::string& name, const TakeElement& take) {
  return parse_watched(
      text, name, [&] { return text; }, Elements(take));
}

Json read_json_elements(const Path& file, const TakeElement& take) {
  std::ifstream in(file, std::ios::binary);
  return parse_watched(
      in, file.string(), [&] { return read_file(file); }, Elements(take));
}

Json read_json(const Path& file) { return parse_json(read_file(file), file.string()); }

std::string brief(const Json& value) {
  constexpr std::size_t kMost = 60;
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= kMost) return text;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // inside a character
  return text.substr(0, end) + "…";
}

std::string to_text(const Json& json) { return json.dump(2) + "\n"; }

std::vector<std::string> differences(const Json& here, const Json& there) {
  std::vector<std::string> found;
  collect_differences(here, there, "", found);
  return found;
}

namespace {

constexpr int kStep = 2;  // like to_text()

}  // namespace

JsonStream::JsonStream(const Json& head, JsonLayout layout, TakeText take)
    : layout_(layout), take_(std::move(take)) {
  const std::string text = head.dump(layout == JsonLayout::indented ? kStep : -1);
  std::string_view open = text;
  open.remove_suffix(layout == JsonLayout::indented ? 2 : 1);  // the brace, and its line
  take_(open);
}

void JsonStream::begin_array(const std::string& key) {
  end_array();
  const std::string name = Json(key).dump();
  take_(layout_ == JsonLayout::indented ? fmt::format(",\n  {}: [", name) : fmt::format(",{}:[", name));
  in_array_ = true;
  empty_ = true;
}

void JsonStream::add(std::string_view element_text) {
  if (!empty_) take_(",");
  if (layout_ == JsonLayout::indented) take_("\n    ");
  take_(element_text);
  empty_ = false;
}

void JsonStream::end() {
  end_array();
  take_(layout_ == JsonLayout::indented ? "\n}\n" : "}\n");
}

void JsonStream::end_array() {
  if (in_array_) take_(layout_ == JsonLayout::indented && !empty_ ? "\n  ]" : "]");
  in_array_ = false;
}

/// All line breaks of a JSON text are layout: those in strings are escaped.
std::string element_text(const Json& element, JsonLayout layout) {
  if (layout == JsonLayout::compact) return element.dump();
  std::string text;
  for (const char letter : element.dump(kStep)) {
    text += letter;
    if (letter == '\n') text += "    ";
  }
  return text;
}

}  // namespace thermal
