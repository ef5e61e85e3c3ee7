#pragma once

#include <string>
#include <vector>

#include "dataset/clip/task.h"
#include "dataset/run/convert_options.h"
#include "io/config/config.h"

namespace thermal {

/// One dataset to make from passes.
struct ConvertRequest {
  std::string variant;  ///< empty: the only one
  std::string where;    ///< start of messages about the variant; empty if there is only one
  Config config;        ///< with these clips only
  Path out;
};

/// The requested datasets: one, or one per variant. ConfigError for any of them.
[[nodiscard]] std::vector<ConvertRequest> convert_requests(const ConvertOptions& options,
                                                           const std::vector<ClipPasses>& sources);

}  // namespace thermal
