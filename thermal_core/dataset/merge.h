#pragma once

#include <string>
#include <vector>

#include "dataset/generate.h"
#include "io/link_files.h"

namespace thermal {

struct MergeOptions {
  std::vector<Path> sources;        ///< datasets, each with some of one config's clips
  Path out;                         ///< none of them; may hold some of the clips already
  Linking linking = Linking::hard;  ///< where the file system can; else copies
};

struct MergeOutcome {
  RunOutcome run;                    ///< `made` are the clips that were merged
  std::vector<std::string> missing;  ///< clips of the config that are whole nowhere
};

/// Joins datasets that were made as shards into one, with the bytes of a dataset made in one go. Sources are only read;
/// every file is checked against its SHA-256 before its clip, under a temporary name until then, is there. A clip may
/// be in several of them if its pixels and labels are the same. A clip whose files have changed is named in the
/// outcome, and the others go on. What is in `out` already is left alone.
/// ConfigError if a source is no dataset, or not of the first one's config or this program's version; DataError, naming
/// both, if two are of one clip and differ; IoError, TryAgainError or Cancelled.
MergeOutcome merge(const MergeOptions& options, const RunHooks& hooks);

}  // namespace thermal
