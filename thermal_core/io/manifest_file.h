#pragma once

#include "io/files.h"
#include "scene/manifest.h"

namespace thermal {

/// Reads and checks a manifest.json (configs/schema/manifest.schema.json). DataError with one line per fault, each
/// starting with the file's name; IoError if it cannot be read.
[[nodiscard]] Manifest read_manifest(const Path& file, const Path& home);

}  // namespace thermal
