#pragma once

#include "io/exr_scan.h"
#include "io/files.h"

namespace thermal {

/// A rectangle of pixels, its corner counted from the picture's top left one; it may lie outside.
struct ExrWindow {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] bool operator==(const ExrWindow&) const = default;
};

/// The data window of a file's first part in its display window, which is the picture: pixels outside are not in the file, or
/// not in the picture. IoError naming the file and the reason if its headers cannot be read.
[[nodiscard]] ExrWindow read_data_window(const Path& file, const ExrLimits& limits = {});

}  // namespace thermal
