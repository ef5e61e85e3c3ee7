#pragma once

#include <string>

#include "dataset/exports/export_options.h"
#include "dataset/exports/plan.h"

namespace thermal {

/// Everything read for an export, before anything is written.
struct ExportSource {
  ExportInput input;
  std::string coco;                ///< the COCO file of the labels, complete, if the format has one
  std::string coco_name;           ///< for messages
  bool all = true;                 ///< nothing is removed, renamed or split
  bool has_foreign_masks = false;  ///< may be polygons: the file is not of a Veldt dataset
  std::string labels_sha256;
  std::uint32_t seed = 1;  ///< of the splits
};

/// Reads labels, takes the selected frames, and assigns clips to splits. Checks that each picture exists, and has a
/// size if the format needs one.
[[nodiscard]] ExportSource read_export_source(const ExportOptions& options);

}  // namespace thermal
