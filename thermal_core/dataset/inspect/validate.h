#pragma once

#include <string>
#include <vector>

#include "dataset/progress.h"
#include "io/system/files.h"

namespace thermal {

/// Result of checking a dataset on disk.
struct DatasetCheck {
  int clips = 0;
  int files = 0;                    ///< number of checked files
  std::vector<std::string> faults;  ///< each naming its file
};

/// Checks that a dataset is complete and every file unchanged: SHA-256 of all of them. Faults inside the dataset are
/// collected, not thrown; IoError if there is no dataset. The frames of `hooks.progress` are those of dataset.json.
[[nodiscard]] DatasetCheck validate_dataset(const Path& root, const RunHooks& hooks = {});

}  // namespace thermal
