#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "io/json/file.h"

namespace thermal {

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
