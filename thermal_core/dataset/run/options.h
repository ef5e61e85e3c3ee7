#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "dataset/dataset_index.h"
#include "io/assets.h"
#include "io/config/spec.h"
#include "io/system/files.h"

namespace thermal {

/// Estimated cost of a run.
struct Estimate {
  double seconds = 0;  ///< on two cores of a typical machine of 2020 or later
  double bytes = 0;    ///< of the finished dataset, without passes
};

/// Estimates a run over `frames` frames of a dataset's camera, in this many clips, by its engine. From
/// measurements of the savanna and the demo, for Blender by `veldt bench --suite render`: within a factor of two,
/// unless the place is far larger or emptier.
[[nodiscard]] Estimate estimate_run(const DatasetSpec& spec, int clips, int frames);

/// Of that, a clip of so many frames. How far clips of the same length differ, by the plants in view, is not known
/// before: by a quarter in flights at one height and angle of configs/airsim_w.json, by up to half in others.
[[nodiscard]] double clip_seconds(const DatasetSpec& spec, int frames);

/// One of `count` parts of a dataset's clips, which are made separately: 0 <= index < count.
struct Shard {
  int index = 0;
  int count = 1;
};

/// The shard of each of a config's clips, by its position. Shards cost nearly the same: the most expensive clips are
/// dealt first, each to the shard with the least work so far, so that no two shards differ by more than the most
/// expensive clip. Depends on the clips' frames and the number of shards alone, so that every machine deals alike.
/// @param count  of shards, at least 1; with more shards than clips, some get none
[[nodiscard]] std::vector<int> deal_shards(const DatasetSpec& spec, int count);

/// What `veldt generate` is given.
struct GenerateOptions {
  Assets assets;
  Path out;
  Path plan;  ///< its folder
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

/// The config's clips that a run makes. ConfigError for an unknown id.
[[nodiscard]] std::vector<ClipSpec> choose_clips(const DatasetSpec& spec, const std::vector<std::string>& ids,
                                                 const Shard& shard);

/// The ids of clips, in their order.
[[nodiscard]] std::vector<std::string> ids_of(const std::vector<ClipSpec>& clips);

/// How many frames the clips have together.
[[nodiscard]] int frames_of(const std::vector<ClipSpec>& clips);

/// Positions of some clips among all of a dataset: the part of its folder that a run locks.
[[nodiscard]] std::vector<std::size_t> places_of(const std::vector<std::string>& some,
                                                 const std::vector<std::string>& all);

}  // namespace thermal
