#pragma once

#include "io/system/files.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// Stands in a starter manifest for each value that only the user knows.
inline constexpr const char* kFillIn = "FILL IN";

/// DataError that lists every such value that is still missing in `file`, and every unknown material; entries with the same fault
/// share a line.
void check_filled_in(const Manifest& manifest, const Path& file, const MaterialLibrary& materials);

}  // namespace thermal
