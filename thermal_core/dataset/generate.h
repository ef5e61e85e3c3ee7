#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dataset/dataset_index.h"
#include "dataset/layout.h"
#include "dataset/plan/planning.h"
#include "dataset/progress.h"
#include "io/config.h"

namespace thermal {

/// One part of a dataset's clips: those whose position in the config, modulo `count`, is `index`.
struct Shard {
  int index = 0;
  int count = 1;
};

struct GenerateOptions {
  Path home;
  Path out;
  Path blender;
  std::vector<std::string> clips;  ///< only these; empty: all
  Shard shard;
  int jobs = 1;     ///< number of Blender processes
  int threads = 0;  ///< for all of them together, and for the conversion; 0: one per core
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
};

/// The config's clips that a run makes. ConfigError for an unknown id.
[[nodiscard]] std::vector<ClipConfig> choose_clips(const Config& config, const std::vector<std::string>& ids,
                                                   const Shard& shard);

/// Plans a dataset into OUT/plan, or uses the plan that is there (plan_into). One of several runs that share the folder
/// does so; the others wait for it. ConfigError if `out` holds a dataset of another config; then nothing changes.
[[nodiscard]] DatasetPlan plan_to_generate(const Path& out, const Config& config, const std::string& name,
                                           const PlanOptions& options);

/// The same for passes alone: ConfigError if `out` holds passes of another config.
[[nodiscard]] DatasetPlan plan_to_render(const Path& out, const Config& config, const std::string& name,
                                         const PlanOptions& options);

/// The same for a preview, into OUT/preview/plan, beside a dataset of any config.
DatasetPlan plan_to_preview(const Path& out, const Config& config, const std::string& name,
                            PlanOptions options);

/// Makes a dataset: Blender renders, and frames are converted while later ones render. Resumes an unfinished dataset;
/// leaves a finished one alone. `config` has the clips of the plan (with_flights_cut), which plan_to_generate() has
/// written. Other runs may make other clips of it at the same time. A clip over which Blender crashes twice, or whose passes cannot be converted, is listed in
/// the outcome, and the others are still made; the next run tries it again.
/// ConfigError, IoError, TryAgainError or Cancelled; finished clips stay.
RunOutcome generate(const Config& config, const DatasetPlan& plan, const GenerateOptions& options,
                    const RunHooks& hooks);

/// Renders passes and manifests only, into passes/<clip>; otherwise like generate().
RunOutcome render(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

/// Renders a map of the config's place, and colour stills of it, into preview/; overwrites earlier ones. Returns the
/// number of pictures.
int preview(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

}  // namespace thermal
