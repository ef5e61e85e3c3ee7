#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "io/system/files.h"

namespace thermal {

/// Lines written one after another and read back once; kept in a file, so that memory does not grow with them.
class Spool {
 public:
  using TakeLine = std::function<void(std::string_view line)>;

  /// Writes to `file`, which is removed with this object. Empty: in memory, for few lines.
  explicit Spool(Path file = {});
  ~Spool();
  Spool(Spool&&) noexcept = default;
  Spool& operator=(Spool&&) noexcept = delete;

  /// Errors as OutputFile.
  void add(std::string_view line);

  /// Returns every line in order, without its end; then the file is removed. Call once. IoError if the file cannot be
  /// read.
  void read(const TakeLine& take);

 private:
  Path file_;
  std::optional<OutputFile> out_;
  std::string text_;  ///< in memory
};

}  // namespace thermal
