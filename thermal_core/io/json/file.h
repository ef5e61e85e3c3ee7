#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/system/files.h"

namespace thermal {

/// JSON that keeps the order of its keys.
using Json = nlohmann::ordered_json;

/// ConfigError "NAME:LINE:COLUMN: not JSON: …" for text that is not JSON, repeats a key in one object, or nests lists
/// and objects more than 64 deep.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& name);

/// The same for a file; IoError if it cannot be read.
[[nodiscard]] Json read_json(const Path& file);

/// Called with an element of a long array: the array's key in the document, empty if the document itself is the
/// array, and the element's index.
using TakeElement = std::function<void(const std::string& array, std::size_t place, const Json& element)>;

/// Parses a document dominated by top-level arrays: each element goes to `take` and is discarded, so that memory is
/// that of the text and not of its tree, which takes ten times as much. Returns the rest, with empty arrays. Faults
/// as in parse_json(); exceptions of `take` pass through.
[[nodiscard]] Json parse_json_elements(std::string_view text, const std::string& name,
                                       const TakeElement& take);

/// The same for a file of any length, read in pieces: memory is that of one element. For our own files: repeated keys
/// are not detected.
[[nodiscard]] Json read_json_elements(const Path& file, const TakeElement& take);

/// For messages: one line of JSON, which escapes control characters; past 60 bytes cut, with "…".
[[nodiscard]] std::string brief(const Json& value);

/// Indented by two, newline at the end.
[[nodiscard]] std::string to_text(const Json& json);

/// All differences between two documents: "sensor.netd_mk is 40 here and 50 there".
[[nodiscard]] std::vector<std::string> differences(const Json& here, const Json& there);

/// Takes the next piece of a document's text.
using TakeText = std::function<void(std::string_view text)>;

/// Layout of a document: like to_text(), or all in one line.
enum class JsonLayout { indented, compact };

/// Writes an object whose last members are arrays, element by element, so that it is never completely in memory. The
/// text equals that of the complete document, with a newline at the end.
class JsonStream {
 public:
  /// `head`: the members before the arrays, at least one.
  JsonStream(const Json& head, JsonLayout layout, TakeText take);

  /// Starts the next array, and ends the one before.
  void begin_array(const std::string& key);

  /// Adds an element: its text as element_text() gives it.
  void add(std::string_view element_text);

  /// Ends the document.
  void end();

 private:
  void end_array();

  JsonLayout layout_;
  TakeText take_;
  bool in_array_ = false;
  bool empty_ = true;  ///< whether the current array has no element yet
};

/// The text of an element at its indentation.
[[nodiscard]] std::string element_text(const Json& element, JsonLayout layout);

}  // namespace thermal
