#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset/layout.h"
#include "io/json/stream.h"
#include "io/system/spool.h"

namespace thermal {

/// Labels of one clip of a dataset.
struct ClipLabels {
  std::string clip;
  std::string source;  ///< file, for messages
  /// Reads its document like parse_json_elements(); may be called twice.
  std::function<void(const TakeElement& take)> read;
};

/// Joins clips' documents into the dataset's, on one line: ids are renumbered, file names become relative to the
/// dataset's folder, a category keeps its id. `spool` holds annotations while images are written.
void join_annotations(const std::string& dataset, const std::vector<ClipLabels>& clips, Spool spool,
                      const TakeText& take);

/// Writes a dataset's annotations.json: the labels of these complete clips, in this order. In constant memory. Returns
/// the SHA-256 of the file. IoError with a file that cannot be read or written, TryAgainError if the disk is full.
std::string write_joined_annotations(const Layout& layout, const std::string& dataset,
                                     const std::vector<std::string>& clips);

}  // namespace thermal
