#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// Flat little-endian arrays in NAME.bin, described by NAME.json beside it.
class ArrayFile {
 public:
  /// Reads both. `schema` is that of the JSON. DataError with the file's name if it does not conform to the schema, or
  /// if an array lies outside the binary file; IoError if one cannot be read.
  ArrayFile(const Path& json, const Json& schema);

  [[nodiscard]] const Json& header() const { return header_; }

  /// An array of `count` elements of a type that the description gives as `type` and `shape`, such as "<f4" and [n, 3].
  /// DataError if it is described otherwise. In the shape, kAny stands for any length.
  template <typename Element>
  [[nodiscard]] std::span<const Element> array(const std::string& name, std::string_view type,
                                               const std::vector<std::size_t>& shape) const {
    const std::span<const std::byte> bytes = bytes_of(name, type, shape, sizeof(Element));
    return {reinterpret_cast<const Element*>(bytes.data()), bytes.size() / sizeof(Element)};
  }
  static constexpr std::size_t kAny = ~std::size_t{0};

  /// Arrays begin at multiples of this.
  static constexpr std::size_t kAlignmentBytes = 64;

  /// DataError if a value of an array is NaN or infinite.
  void check_finite(const std::string& name, std::span<const float> values) const;
  void check_finite(const std::string& name, std::span<const double> values) const;
  /// DataError if a number of an array is `count` or more.
  void check_below(const std::string& name, std::span<const std::uint8_t> numbers, std::size_t count) const;

  /// A fault of the file, to be thrown: "FILE: <fault>".
  [[nodiscard]] DataError fault_at(const std::string& where, const std::string& value,
                                   const std::string& rule) const;

  /// The same for a fault in words.
  [[nodiscard]] DataError fault_of(const std::string& words) const;

  /// The bytes that all arrays refer to; the caller becomes their owner.
  [[nodiscard]] std::vector<std::byte> take_data() { return std::move(data_); }

 private:
  [[nodiscard]] std::span<const std::byte> bytes_of(const std::string& name, std::string_view type,
                                                    const std::vector<std::size_t>& shape,
                                                    std::size_t element_bytes) const;

  Path file_;
  Json header_;
  std::vector<std::byte> data_;
};

/// Writes flat little-endian arrays into NAME.bin, described by NAME.json beside it, as ArrayFile reads them.
class ArrayWriter {
 public:
  /// @param scratch  a folder for the binary file while it is not complete
  ArrayWriter(const Path& json, const Path& scratch);

  /// The next array; `type` is NumPy's name, such as "<f4".
  template <typename Element>
  void add(const std::string& name, const std::string& type, const std::vector<std::size_t>& shape,
           std::span<const Element> values) {
    add_bytes(name, type, shape, std::as_bytes(values));
  }

  /// Ends NAME.bin and then writes NAME.json: `header` with the description of all arrays.
  void close(Json header);

 private:
  void add_bytes(const std::string& name, const std::string& type, const std::vector<std::size_t>& shape,
                 std::span<const std::byte> bytes);

  Path json_;
  OutputFile binary_;
  Json arrays_ = Json::object();
  std::size_t written_bytes_ = 0;
};

}  // namespace thermal
