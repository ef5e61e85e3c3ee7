#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/clip_maker.h"
#include "dataset/generate.h"

namespace thermal {

struct ConvertOptions {
  Path home;
  std::vector<Path> passes;           ///< folders, each one clip: EXR files and a manifest.json
  Path manifest;                      ///< instead of the folder's own; only with one folder
  std::optional<Json> config;         ///< document, not yet resolved; without one, defaults and winter
  std::string config_name;            ///< for faults in it
  std::vector<std::string> settings;  ///< "key=value", applied to the config
  std::optional<Json> variants;       ///< document: a dataset each, in a folder of its name in `out`
  std::string variants_name;          ///< for faults in it
  Path out;
  ReadLimits limits = {};
  bool strict = false;  ///< the first bad frame or clip ends the run
  int threads = 0;
};

/// The frames a clip was made without.
struct ClipSkips {
  std::string clip;
  Path folder;  ///< of its passes
  std::vector<SkippedFrame> frames;
};

/// How a dataset of a run came out.
struct ConvertOutcome {
  std::string variant;  ///< empty: the only dataset
  Path out;             ///< its folder
  RunOutcome run;
  std::vector<ClipSkips> skips;            ///< of clips this run made, and of those that were there
  std::vector<std::string> left_out = {};  ///< automatic terms, each with what the passes lack for it
};

/// Turns passes that exist into a dataset, or into one a variant: then a variant is the config with its changes
/// over it, and the passes of a clip are read once for all variants that lack it. Progress counts frames of
/// passes, each once. A frame that cannot be converted is named in the outcome, and its clip is made without it; a clip
/// that cannot be made is named, and the others go on. The next run reads the frames that a clip goes without, and
/// makes it anew if one of them can be converted now. Nothing is written outside `out`: a folder in it that is a link
/// is an IoError.
/// ConfigError, IoError, TryAgainError or Cancelled; DataError for manifests, and for the first bad frame if strict.
std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks);

}  // namespace thermal
