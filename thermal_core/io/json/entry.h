#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// An id of a file of labels. DataError unless it is text or a whole number, as JsonEntry::integer() reads it.
[[nodiscard]] LabelId label_id_in(const Json& value);

/// A number or text.
[[nodiscard]] Json json_of(const LabelId& id);

/// Checks the version of one of our own files. DataError with the file if it states another; without a version, it is
/// the first.
void check_version(const Json& document, const std::string& file, int version);

/// One object of a list in an external JSON file, or the file's only one, read key by key. A wrong value, or a missing
/// required key, is a DataError "FILE: LIST[PLACE].KEY = VALUE; expected RULE". A null value counts as missing.
class JsonEntry {
 public:
  /// `list` is empty if the file itself is the list. All arguments must outlive the entry. DataError if it is not an
  /// object.
  JsonEntry(const Json& json, const std::string& file, const std::string& list, std::size_t index);
  /// The file's only object: faults are "FILE: KEY = VALUE; expected RULE".
  JsonEntry(const Json& json, const std::string& file);

  [[nodiscard]] bool has(const char* key) const { return json_.contains(key) && !json_[key].is_null(); }
  /// Up to 2^63 - 1. 1.0 is 1, up to 2^53: pandas writes whole numbers so in columns with missing values.
  [[nodiscard]] std::int64_t integer(const char* key) const;
  /// The same, or text that is not empty.
  [[nodiscard]] LabelId id(const char* key) const;
  /// 0 to `most`.
  [[nodiscard]] std::int64_t whole_number(const char* key, std::int64_t most) const;
  /// A size or a number of frames: 0 to 1e9.
  [[nodiscard]] int count(const char* key) const;
  /// Not empty.
  [[nodiscard]] std::string text(const char* key) const;
  /// Always finite: JSON has no NaN or infinity.
  [[nodiscard]] double number(const char* key) const;
  [[nodiscard]] std::optional<double> optional_number(const char* key) const;
  /// COCO writes 0 and 1, others false and true; missing is false.
  [[nodiscard]] bool flag(const char* key) const;
  /// [x, y, width, height] in px, at most 1e9 in size, width and height not negative.
  [[nodiscard]] LabelBox box(const char* key) const;

  [[nodiscard]] DataError fault_of(const char* key, const std::string& rule) const;
  /// "FILE: LIST[PLACE].KEY", for messages.
  [[nodiscard]] std::string location_of(const char* key) const;

 private:
  [[nodiscard]] const Json& at(const char* key) const;

  const Json& json_;
  const std::string& file_;
  const std::string* list_ = nullptr;
  std::size_t place_ = 0;
};

}  // namespace thermal
