#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// The part of a COCO file before its images.
struct CocoHead {
  std::vector<std::pair<std::string, std::int64_t>> categories;  ///< names with ids, in the file's order
  std::vector<std::string> videos;                               ///< names
};

/// The lists `categories` and `videos` of a COCO file as Veldt writes it, up to the list `images`, which may have
/// gigabytes and is not read. Memory is that of one entry.
/// DataError with file, place and value for an entry without its name or id, or if there are no categories; IoError if
/// the file cannot be read, is no regular one, or if it or its folder is a link.
[[nodiscard]] CocoHead read_coco_head(const Path& file);

}  // namespace thermal
