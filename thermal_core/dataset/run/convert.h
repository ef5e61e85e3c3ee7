#pragma once

#include <string>
#include <vector>

#include "dataset/clip/record.h"
#include "dataset/progress.h"
#include "dataset/run/convert_requests.h"
#include "dataset/run/options.h"

namespace thermal {

/// The frames missing from a clip.
struct ClipSkips {
  std::string clip;
  Path folder;  ///< of its passes
  std::vector<SkippedFrame> frames;
};

/// Result of a run for one dataset.
struct ConvertOutcome {
  std::string variant;  ///< empty: the only dataset
  Path out;             ///< its folder
  RunOutcome run;
  std::vector<ClipSkips> skips;            ///< of clips made in this run, and of existing ones
  std::vector<std::string> left_out = {};  ///< automatic terms, each with what the passes lack for it
};

/// What a run would do with a clip.
struct ConvertStep {
  enum class Action { make, make_again, keep };
  std::string clip;
  int frames = 0;  ///< of its passes
  Action action = Action::make;
};

/// What a run would do for one dataset.
struct ConvertForecast {
  std::string variant;  ///< empty: the only dataset
  Path out;             ///< its folder
  std::vector<ConvertStep> steps;
  std::vector<std::string> left_out = {};  ///< automatic terms, each with what the passes lack for it
};

/// What convert() would do, without writing anything. Faults are those that convert() has before its first frame.
[[nodiscard]] std::vector<ConvertForecast> forecast_convert(const ConvertOptions& options);

/// Makes a dataset from existing passes, or one per variant: a variant is the config with its changes applied, and
/// the passes of a clip are read once for all variants that lack it. Progress counts frames of passes, each once. A
/// frame that cannot be converted is listed in the outcome, and its clip is made without it; a clip that cannot be
/// made is listed, and the others are still made. The next run reads the skipped frames again, and remakes the clip
/// if one of them can be converted now; it remakes clips whose manifest or passes have changed (passes_identity.h), and
/// reports them. Nothing is written outside `out`: a folder in it that is a link is an
/// IoError.
/// ConfigError, IoError, TryAgainError or Cancelled; DataError for manifests and, in strict mode, for the first bad
/// frame.
std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks);

}  // namespace thermal
