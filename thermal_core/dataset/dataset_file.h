#pragma once

#include "io/json/file.h"

namespace thermal {

/// Reads dataset.json of an untrusted dataset, checking its format, version, and the ids of its clips, which become
/// names of folders. DataError with file, key and value if it is not a dataset's, or of a version other than 1, if
/// `clips` is not a list of objects with `id` and `status`, if an id is not a name (RelativeName::part_of), or if two
/// are equal; IoError if it cannot be read.
[[nodiscard]] Json read_dataset_file(const Path& root);

}  // namespace thermal
