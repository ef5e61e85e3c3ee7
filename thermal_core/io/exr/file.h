#pragma once

#include <exception>
#include <map>
#include <new>
#include <string>
#include <vector>

#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/header.h"
#include "io/exr/pixels.h"
#include "io/system/files.h"

namespace thermal {

/// An open EXR file. Messages lack the file's name; with_exr_file() adds it.
class ExrFile {
 public:
  /// IoError if the file does not exist, or its headers are not those of flat pixels within the limits.
  ExrFile(const Path& file, const ExrLimits& limits);

  /// Without strings: most readers do not use them, and a cryptomatte's are long.
  [[nodiscard]] const ExrHeader& header() const noexcept { return header_; }
  /// String attributes of all parts; the first of each name.
  [[nodiscard]] std::map<std::string, std::string> texts() const;

  /// See io/exr/pixels.h.
  void decode(const std::vector<ExrTarget>& targets) { thermal::decode(opened_, name_, targets); }

 private:
  Path name_;
  Imf::MultiPartInputFile opened_;
  ExrHeader header_;
};

/// The result of `work` on an open file; errors, ours and the library's, name the file, except running out of memory.
template <typename Work>
auto with_exr_file(const Path& file, const ExrLimits& limits, const Work& work) {
  try {
    ExrFile opened(file, limits);
    return work(opened);
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}: {}", file.string(), error.what()));
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
