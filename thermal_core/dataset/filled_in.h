#pragma once

#include "io/files.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// What stands in a starter manifest where only its reader knows what belongs there.
inline constexpr const char* kFillIn = "FILL IN";

/// DataError that names every entry of `file` that is left to fill in, and every material that is not there; entries
/// with the same fault in one line.
void check_filled_in(const Manifest& manifest, const Path& file, const MaterialLibrary& materials);

}  // namespace thermal
