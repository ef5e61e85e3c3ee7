#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dataset/exports/export_options.h"
#include "dataset/exports/segments.h"
#include "dataset/run/progress.h"
#include "io/image/tiff.h"

namespace thermal {

/// What a split of an export holds.
struct ExportedSplit {
  std::string name;
  int clips = 0;
  int pictures = 0;
  std::vector<int> labels;  ///< per category
};

/// What an export wrote, and what it could not represent.
struct ExportOutcome {
  bool already_there = false;  ///< this very export existed already: nothing was written
  std::vector<std::string> categories;
  std::vector<ExportedSplit> splits;
  std::map<std::string, int> left_out;  ///< labels left out, by why the format cannot represent them
  int copied = 0;                       ///< pictures that could not be linked
  OutlineFigures outlines;              ///< how well they reproduce masks, where they replace these
  std::optional<GeoPosition> origin;    ///< of TIFFs: where the scene was put on Earth
  bool origin_given = false;            ///< by the request
  int without_pose = 0;  ///< TIFFs without position and attitude, because their frames have no pose
};

/// Writes labels and pictures in another program's layout, with an export.json that describes the source. Everything
/// is made in OUT.part, which becomes OUT when it is complete, and is removed on failure.
/// ConfigError if `out` holds anything but this very export, or the request is impossible; DataError for labels or
/// file names that the format cannot represent, and missing pictures; IoError, TryAgainError or Cancelled.
ExportOutcome export_dataset(const ExportOptions& options, const RunHooks& hooks);

/// As flags spell it.
[[nodiscard]] std::string format_name(ExportFormat format) noexcept;

}  // namespace thermal
