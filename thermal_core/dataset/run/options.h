#pragma once

#include <map>
#include <string>
#include <vector>

#include "dataset/dataset_index.h"
#include "dataset/run/shards.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// What `veldt generate` is given.
struct GenerateOptions {
  Assets assets;
  Path out;
  Path plan;  ///< folder of the plan; of plan_to_generate(): OUT/plan
  /// Clips are made in this folder, which belongs to this run alone, and put into `out` when complete. `out` may then be
  /// an object store: it sees whole new files only, a clip's record last. Empty: in `out` itself.
  Path scratch = {};
  Path blender;
  std::vector<std::string> clips;  ///< only these; empty: all
  Shard shard;
  int jobs = 1;     ///< number of Blender processes
  int threads = 0;  ///< for all of them together, and for the conversion; 0: thread_count(0)
  bool keep_passes = false;
};

/// Result of a run.
struct RunOutcome {
  std::vector<std::string> made;              ///< clips made in this run
  std::vector<std::string> already_there;     ///< clips that were complete before
  std::map<std::string, std::string> failed;  ///< clips that could not be made, with the reason
  bool try_again = false;                     ///< none could be made, and only because Blender was killed
  int frames_made = 0;
  bool complete = false;                     ///< the dataset now has all its clips
  std::vector<UnusableShare> unusable = {};  ///< of clips made and already there
  std::vector<LeftOver> left_over = {};      ///< the next run removes it
};

}  // namespace thermal
