#pragma once

#include <cstdint>

#include "io/system/files.h"

namespace thermal {

/// Limits on what a file may claim.
struct ExrLimits {
  std::int64_t pixels = 256'000'000;  ///< of a plane
  int channels = 4096;                ///< of all parts
  int parts = 256;
};

/// Checks an EXR file's headers without trusting them, before a library allocates memory for what they claim: every
/// length is within the file, the data and display windows are neither empty nor inverted nor larger than the limits,
/// and the file is long enough for the table of chunks it claims. Reads only the headers.
/// DataError (without the file's name) with the part, the attribute, its value and what was expected.
/// Source: Technical Introduction to OpenEXR, "OpenEXR File Layout".
void check_exr_headers(const Path& file, const ExrLimits& limits = {});

}  // namespace thermal
