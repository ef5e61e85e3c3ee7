#pragma once

#include <string>
#include <vector>

#include "dataset/clip_maker.h"
#include "dataset/convert.h"
#include "io/config.h"

namespace thermal {

/// One dataset to make of passes.
struct ConvertRequest {
  std::string variant;  ///< empty: the only one
  std::string where;    ///< begins faults of what the variant asks for; empty for the only one
  Config config;        ///< with these clips alone
  Path out;
};

/// The datasets that are asked for: one, or one a variant. ConfigError for any of them.
[[nodiscard]] std::vector<ConvertRequest> convert_requests(const ConvertOptions& options,
                                                           const std::vector<ClipPasses>& sources);

}  // namespace thermal
