#pragma once

#include "dataset/selection_file.h"
#include "labels/label_set.h"

namespace thermal {

/// The pictures of a selection, with their labels; all videos and categories are kept. `file` is the selection's file.
/// DataError with it if it selects from an unknown video or frame, or selects nothing.
[[nodiscard]] LabelSet take_selected(const LabelSet& set, const SelectedDataset& selected, const Path& file);

}  // namespace thermal
