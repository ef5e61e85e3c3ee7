#pragma once

#include <cstddef>

#include "io/files.h"

namespace thermal {

struct ReportRequest {
  Path source;  ///< whatever read_labels() reads
  Path out;     ///< the page; empty: report.html in the dataset, or beside a COCO file
  Path home;
  bool unfinished_too = false;  ///< of a dataset of which clips are missing, what is there
};

struct ReportOutcome {
  Path out;
  std::size_t clips = 0;  ///< or videos
  std::size_t images = 0;
  std::size_t labels = 0;
  std::size_t bytes = 0;
};

/// Writes one HTML page that tells what a dataset is, and needs nothing but itself; atomically. The same dataset gives
/// the same bytes. Faults are those of read_labels(); also DataError or IoError for frames of a dataset of ours that
/// can't be read.
ReportOutcome write_report(const ReportRequest& request);

}  // namespace thermal
