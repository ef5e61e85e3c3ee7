#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/clip/task.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "io/json/file.h"
#include "io/pass_buffer.h"
#include "io/system/files.h"

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

/// One dataset to make from passes.
struct ConvertRequest {
  std::string variant;    ///< empty: the only one
  std::string where;      ///< start of messages about the variant; empty if there is only one
  ResolvedConfig config;  ///< with the clips of the sources alone, in their order
  Path out;
};

/// The requested datasets: one, or one per variant. ConfigError for any of them.
[[nodiscard]] std::vector<ConvertRequest> convert_requests(const ConvertOptions& options,
                                                           const std::vector<ClipPasses>& sources);

}  // namespace thermal
