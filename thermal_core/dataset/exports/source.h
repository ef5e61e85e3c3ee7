#pragma once

#include <string>

#include "dataset/exports/plan.h"
#include "dataset/selection_file.h"
#include "labels/label_set.h"

namespace thermal {

/// The pictures of a selection, with their labels; all videos and categories are kept. `file` is the selection's file.
/// DataError with it if it selects from an unknown video or frame, or selects nothing.
[[nodiscard]] LabelSet take_selected(const LabelSet& set, const SelectedDataset& selected, const Path& file);

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
