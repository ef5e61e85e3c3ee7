#pragma once

#include "io/json/file.h"
#include "io/system/files.h"

namespace veldt {

/// Reads a JSON document that the user names. ConfigError if it is not there, or is not for this user to read: that is
/// wrong usage. IoError if the machine fails to read a file that is.
[[nodiscard]] thermal::Json read_named_document(const thermal::Path& file);

}  // namespace veldt
