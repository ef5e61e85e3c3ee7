#pragma once

#include <string>

#include "dataset/exports/export.h"
#include "dataset/exports/plan.h"

namespace thermal {

/// What is read for an export, before anything is written.
struct ExportSource {
  ExportInput input;
  std::string coco;       ///< the COCO file the labels come from, whole; empty if they come from none
  std::string coco_name;  ///< for faults
  bool all = true;        ///< nothing is left away, renamed or split
  std::string labels_sha256;
  std::uint32_t seed = 1;  ///< of the splits
};

/// Reads labels, takes the selected frames, and shares clips out to splits. Each picture is there,
/// and has a size where the format needs one.
[[nodiscard]] ExportSource read_export_source(const ExportOptions& options);

}  // namespace thermal
