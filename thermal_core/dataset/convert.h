#pragma once

#include <optional>
#include <string>
#include <vector>

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
  int threads = 0;
};

/// How a dataset of a run came out.
struct ConvertOutcome {
  std::string variant;  ///< empty: the only dataset
  Path out;             ///< its folder
  RunOutcome run;
};

/// Turns passes that exist into a dataset, or into one a variant: then a variant is the config with its changes
/// over it, and the passes of a clip are read once for all variants that lack it. Progress counts frames of
/// passes, each once. A clip that cannot be converted is named in the outcome, and the others go on.
/// ConfigError, IoError, TryAgainError or Cancelled; DataError only for manifests.
std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks);

}  // namespace thermal
