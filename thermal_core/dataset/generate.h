#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dataset/layout.h"
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
  int jobs = 1;     ///< Blenders at a time
  int threads = 0;  ///< of all of them together, and of the conversion; 0: one a core
  bool keep_passes = false;
};

/// How a run ended.
struct RunOutcome {
  std::vector<std::string> made;              ///< clips this run made
  std::vector<std::string> already_there;     ///< clips that were whole before
  std::map<std::string, std::string> failed;  ///< clips that could not be made: why
  bool try_again = false;                     ///< not one could, and only because Blender was killed
  int frames_made = 0;
  bool complete = false;  ///< the dataset now has all its clips
};

/// Which of the config's clips a run is about. ConfigError for an unknown id.
[[nodiscard]] std::vector<ClipConfig> choose_clips(const Config& config, const std::vector<std::string>& ids,
                                                   const Shard& shard);

/// Makes a dataset: Blenders render, and frames are converted while later ones render. Takes up an unfinished
/// one where it was left; leaves a finished one alone. The config must have been planned (plan_dataset). Other runs
/// may make other clips of it at the same time. A clip that Blender dies over twice, or whose passes cannot be
/// converted, is named in the outcome, and the others go on; the next run tries it again.
/// ConfigError, IoError, TryAgainError or Cancelled; what was finished by then stays.
RunOutcome generate(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

/// Renders passes and manifests only, into passes/<clip>; as generate() in all else.
RunOutcome render(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

/// Renders a map of what the config makes, and colour stills of it, into preview/; anew each time. Returns how
/// many pictures.
int preview(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

}  // namespace thermal
