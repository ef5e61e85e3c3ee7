#pragma once

#include <exception>
#include <map>
#include <string>
#include <vector>

#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/exr_header.h"
#include "io/exr_pixels.h"
#include "io/files.h"

namespace thermal {

/// An EXR file that is open. Faults lack the file's name: with_exr_file() adds it.
class ExrFile {
 public:
  /// IoError if there is no such file, or its headers are not those of flat pixels within the limits.
  ExrFile(const Path& file, const ExrLimits& limits);

  /// Without texts: most readers have no use for them, and a cryptomatte's are long.
  [[nodiscard]] const ExrHeader& header() const noexcept { return header_; }
  /// Attributes of type string, of all parts; the first of a name.
  [[nodiscard]] std::map<std::string, std::string> texts() const;

  /// As io/exr_pixels.h says.
  void decode(const std::vector<ExrTarget>& targets) { thermal::decode(opened_, name_, targets); }

 private:
  Path name_;
  Imf::MultiPartInputFile opened_;
  ExrHeader header_;
};

/// What `work` makes of an open file: faults of ours and of the library name the file.
template <typename Work>
auto with_exr_file(const Path& file, const ExrLimits& limits, const Work& work) {
  try {
    ExrFile opened(file, limits);
    return work(opened);
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}: {}", file.string(), error.what()));
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
