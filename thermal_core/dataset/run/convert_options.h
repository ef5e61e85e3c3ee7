#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"
#include "io/system/files.h"
#include "io/system/read_limits.h"

namespace thermal {

/// What `veldt convert` is given.
struct ConvertOptions {
  Assets assets;
  std::vector<Path> passes = {};           ///< folders, each one clip: EXR files and a manifest.json
  Path manifest = {};                      ///< replaces the folder's own; only with one folder
  std::optional<Json> config = {};         ///< document, not resolved; without one, defaults and winter
  std::string config_name = {};            ///< for messages
  std::vector<std::string> settings = {};  ///< "key=value", applied to the config
  std::optional<Json> variants = {};       ///< document: one dataset each, in a folder of its name in `out`
  std::string variants_name = {};          ///< for messages
  Path out = {};
  ReadLimits limits = {};
  bool strict = false;  ///< stop at the first bad frame or clip
  int threads = 0;
};

}  // namespace thermal
