#pragma once

#include <string>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// Writes checksums.json, with the SHA-256 of all other files in a plan's folder: a plan that was damaged, or mixed with
/// another, would make other frames without any sign of it.
void write_checksums(const Path& folder);

/// Whether all files that checksums.json lists are there, and unchanged. Others may have been added.
[[nodiscard]] bool has_its_checksums(const Path& folder);

/// DataError unless these files, given relative to the folder, are as checksums.json has them.
void check_files(const Path& folder, const std::vector<std::string>& names);

/// The same for all files that making these clips reads.
void check_files_of_clips(const Path& folder, const std::vector<std::string>& clips);

}  // namespace thermal
