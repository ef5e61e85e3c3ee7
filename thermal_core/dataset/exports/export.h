#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dataset/exports/split_shares.h"
#include "dataset/progress.h"
#include "io/link_files.h"

namespace thermal {

enum class ExportFormat { coco, yolo, mot, birdsai };

struct ExportOptions {
  Path source;  ///< as read_labels() takes it
  ExportFormat format = ExportFormat::coco;
  Path out;  ///< empty or not there yet
  Linking linking = Linking::hard;
  bool ir16 = false;                  ///< the pictures of 16 bits, which only datasets of ours have
  std::vector<SplitShare> splits;     ///< none: all is one
  std::optional<std::uint32_t> seed;  ///< of the splits; none: the dataset's own, or 1
  Path selection;                     ///< frames to take; empty: all
  bool unfinished_too = false;
};

struct ExportedSplit {
  std::string name;
  int clips = 0;
  int pictures = 0;
  std::vector<int> labels;  ///< of each category
};

struct ExportOutcome {
  bool already_there = false;  ///< this very export, finished before: nothing was written
  std::vector<std::string> categories;
  std::vector<ExportedSplit> splits;
  std::map<std::string, int> left_out;  ///< labels by why the format can't hold them
  int copied = 0;                       ///< pictures that were to be linked and could not be
};

/// Writes labels and pictures as other programs read them, in their layout, with export.json that tells what it is of.
/// All is made in OUT.part, which becomes OUT when it is whole, and is removed if it does not.
/// ConfigError if `out` holds anything but this very export, or the request can't be met; DataError for labels or
/// names of files that the format can't hold, and missing pictures; IoError, TryAgainError or Cancelled.
ExportOutcome export_dataset(const ExportOptions& options, const RunHooks& hooks);

/// As flags spell it.
[[nodiscard]] std::string format_name(ExportFormat format) noexcept;

}  // namespace thermal
