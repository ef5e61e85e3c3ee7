#pragma once

#include "io/json/file.h"
#include "io/system/files.h"

namespace veldt {

/// Reads a JSON document that the user names. ConfigError if it is missing or not readable for this user; IoError for a
/// failure of the machine.
[[nodiscard]] thermal::Json read_named_document(const thermal::Path& file);

}  // namespace veldt
