#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dataset/exports/plan.h"
#include "dataset/exports/segments.h"
#include "dataset/progress.h"
#include "io/image/pictures.h"

namespace thermal {

/// Contents of a split of an export.
struct ExportedSplit {
  std::string name;
  int clips = 0;
  int pictures = 0;
  std::vector<int> labels;  ///< per category
};

/// What an export wrote, and what it could not represent.
struct ExportOutcome {
  bool already_there = false;  ///< an export of the same request existed: nothing was written
  std::vector<std::string> categories;
  std::vector<ExportedSplit> splits;
  std::map<std::string, int> left_out;  ///< number of labels left out, by reason
  int copied = 0;                       ///< pictures that could not be linked
  OutlineFigures outlines;              ///< accuracy of outlines that replace masks
  std::optional<GeoPosition> origin;    ///< of TIFFs: the scene's position on Earth
  bool origin_given = false;            ///< by the request
  int without_pose = 0;  ///< TIFFs without position and attitude, because their frames have no pose
};

/// Writes labels and pictures in another program's layout, with an export.json that describes the source. Everything is
/// written to OUT.part, which is renamed to OUT when it is complete, or removed on failure.
/// ConfigError if `out` holds anything but the same export, or the request is impossible; DataError for labels or file
/// names that the format cannot represent, and missing pictures; IoError, TryAgainError or Cancelled.
ExportOutcome export_dataset(const ExportOptions& options, const RunHooks& hooks);

/// Name of a format on the command line.
[[nodiscard]] std::string format_name(ExportFormat format) noexcept;

}  // namespace thermal
