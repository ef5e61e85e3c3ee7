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
  Path out;
  int threads = 0;
};

/// Turns passes that exist into a dataset. A clip that cannot be converted is named in the outcome, and the
/// others go on.
/// ConfigError, IoError, TryAgainError or Cancelled; DataError only for manifests.
RunOutcome convert(const ConvertOptions& options, const RunHooks& hooks);

}  // namespace thermal
