#pragma once

#include <cstdint>

#include "io/files.h"

namespace thermal {

/// Limits on what a file may claim.
struct ExrLimits {
  std::int64_t pixels = 256'000'000;  ///< of a plane
  int channels = 4096;                ///< of all parts
  int parts = 256;
};

/// Walks an EXR file's headers without trust, before a library takes memory for what they claim: every length
/// lies within the file, windows of data and display are neither empty nor inside out nor larger than the
/// limits, and a file that promises so many chunks is long enough for their table. Reads the headers alone.
/// DataError (without the file's name) with the part, the attribute, what it says and what was expected.
/// Source: Technical Introduction to OpenEXR, "OpenEXR File Layout".
void check_exr_headers(const Path& file, const ExrLimits& limits = {});

}  // namespace thermal
