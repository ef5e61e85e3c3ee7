#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dataset/progress.h"
#include "dataset/run/options.h"
#include "io/config/config.h"
#include "io/system/files.h"

namespace thermal {

/// What is joined.
struct MergeOptions {
  std::vector<Path> sources;  ///< datasets, each with some of one config's clips
  Path out;                   ///< not one of them; may hold some of the clips already
  std::optional<ResolvedConfig> config =
      {};          ///< of all sources, if it is known; then a source may lack its dataset
  int shards = 0;  ///< with `config`: number of shards, to find those that miss clips; 0: unknown
  Linking linking = Linking::hard;  ///< where the file system supports them; otherwise copies
};

/// What was joined, and what is missing.
struct MergeOutcome {
  RunOutcome run;                                           ///< `made` are the merged clips
  std::vector<std::string> missing;                         ///< clips of the config that are complete nowhere
  std::vector<std::pair<Path, std::string>> left_out = {};  ///< sources without a dataset, and what is wrong
  std::vector<int> shards_to_make = {};                     ///< that have missing or failed clips; sorted
};

/// Joins datasets that were made as shards into one, with the same bytes as a dataset made in one run. Sources are
/// only read; every file is checked against its SHA-256 before its clip, which has a temporary name until then, is
/// committed. A clip may be in several of them if its pixels and labels are the same. A clip with changed files is
/// listed in the outcome, and the others are still merged. Existing contents of `out` are kept.
/// ConfigError if a source is not a dataset, or differs from the first in config or program version; DataError with
/// both if two have different versions of a clip; IoError, TryAgainError or Cancelled.
MergeOutcome merge(const MergeOptions& options, const RunHooks& hooks);

}  // namespace thermal
