#pragma once

#include "dataset/selection_file.h"
#include "labels/label_set.h"

namespace thermal {

/// The pictures that a selection takes, with their labels; all videos and categories stay. `file` is where the
/// selection comes from. DataError naming it if it takes of a video or a frame that there is not, or takes nothing.
[[nodiscard]] LabelSet take_selected(const LabelSet& set, const SelectedDataset& selected, const Path& file);

}  // namespace thermal
