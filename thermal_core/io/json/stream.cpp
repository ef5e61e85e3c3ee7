#include "io/json/stream.h"

#include <utility>

#include <fmt/format.h>

namespace thermal {
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
