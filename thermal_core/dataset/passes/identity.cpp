#include "dataset/passes/identity.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/cryptomatte.h"
#include "io/image/index_picture.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

/// "-" if there is no such file: a skipped frame.
std::string bytes_text(const Path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? "-" : std::to_string(bytes);
}

/// Other files that a frame is made from; none for an unreadable frame.
std::vector<Path> files_beside(const ClipPasses& passes, const Path& frame) {
  if (passes.manifest.cryptomatte.empty() || is_index_picture(frame)) return {};
  try {
    return sidecars_of(read_exr_header(frame));
  } catch (const Error&) {
    return {};
  }
}

bool is_newer(const Path& file, std::filesystem::file_time_type than) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && written > than;
}

}  // namespace

std::string identity_of(const ClipPasses& passes) {
  Sha256 sum;
  sum.add(passes.manifest.document_sha256 + "\n");
  for (const ManifestFrame& frame : passes.manifest.frames) {
    const Path file = passes.folder / frame.file;
    sum.add(fmt::format("{}\n{}\n", frame.file, bytes_text(file)));
    for (const Path& beside : files_beside(passes, file))
      sum.add(fmt::format("{}\n{}\n", beside.lexically_relative(passes.folder).string(), bytes_text(beside)));
  }
  return sum.hex();
}

bool has_changed(const ClipPasses& passes, const std::string& made_from_sha256, const Path& record_file) {
  if (made_from_sha256 != passes.identity_sha256) return true;
  std::error_code error;
  const auto recorded = std::filesystem::last_write_time(record_file, error);
  return error || std::ranges::any_of(passes.manifest.frames, [&](const ManifestFrame& frame) {
           const Path file = passes.folder / frame.file;
           return is_newer(file, recorded) ||
                  std::ranges::any_of(files_beside(passes, file),
                                      [&](const Path& beside) { return is_newer(beside, recorded); });
         });
}

}  // namespace thermal
