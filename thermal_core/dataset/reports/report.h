#pragma once

#include <cstddef>
#include <functional>

#include "dataset/progress.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// Options of a report.
struct ReportRequest {
  Path source;  ///< anything that read_labels() reads
  Path out;     ///< the page; empty: report.html in the dataset, or beside a COCO file
  Assets assets;
  bool unfinished_too = false;  ///< accept a dataset with missing clips
  /// Called for each clip of a Veldt dataset whose track is read.
  std::function<void(const Progress&)> show = {};
};

/// Result of a report.
struct ReportOutcome {
  Path out;
  std::size_t clips = 0;  ///< or videos
  std::size_t images = 0;
  std::size_t labels = 0;
  std::size_t bytes = 0;
};

/// Writes one self-contained HTML page about a dataset, atomically. The same dataset gives the same bytes. Errors as
/// read_labels(); also DataError or IoError for frames of a Veldt dataset that cannot be read.
ReportOutcome write_report(const ReportRequest& request);

}  // namespace thermal
