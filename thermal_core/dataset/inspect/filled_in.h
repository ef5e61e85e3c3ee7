#pragma once

#include "io/system/files.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// Placeholder in a starter manifest for values that only the user knows.
inline constexpr const char* kFillIn = "FILL IN";

/// DataError with all placeholders left in `file`, and all unknown materials; entries with the same fault share a line.
void check_filled_in(const Manifest& manifest, const Path& file, const MaterialLibrary& materials);

}  // namespace thermal
