#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

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
