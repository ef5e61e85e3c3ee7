#include "io/json/file.h"
#include "support/catch.h"

namespace json_stream_test {

using namespace thermal;

namespace {

/// The document written element by element; its last members from `arrays` on are arrays.
std::string streamed(const Json& document, std::size_t arrays, JsonLayout layout) {
  Json head = Json::object();
  for (const auto& [key, value] : document.items()) {
    if (head.size() < document.size() - arrays) head[key] = value;
  }
  std::string text;
  JsonStream stream(head, layout, [&text](std::string_view piece) { text += piece; });
  for (const auto& [key, value] : document.items()) {
    if (head.contains(key)) continue;
    stream.begin_array(key);
    for (const Json& element : value) stream.add(element_text(element, layout));
  }
  stream.end();
  return text;
}

const Json kDocument = {
    {"info", {{"a", 1}, {"b", Json::array({1.5, 2})}}},
    {"none", Json::array()},
    {"some",
     Json::array({{{"text", "line\nand \"quotes\""}, {"deep", {{"deeper", Json::array({1, Json::array()})}}}},
                  7,
                  Json::object()})},
    {"one", Json::array({nullptr})}};

}  // namespace

TEST_CASE("A document written element by element equals one written at once") {
  for (const std::size_t arrays : {1U, 2U, 3U}) {
    CAPTURE(arrays);
    CHECK(streamed(kDocument, arrays, JsonLayout::indented) == to_text(kDocument));
    CHECK(streamed(kDocument, arrays, JsonLayout::compact) == kDocument.dump() + "\n");
  }
}

}  // namespace json_stream_test
