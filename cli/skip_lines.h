#pragma once

#include <string>
#include <vector>

#include "dataset/run/convert.h"

namespace veldt {

/// "clip one: frame 1 skipped: one/000001.exr: REASON" for every skipped frame; consecutive frames with
/// the same reason share a line, "clip one: frames 1 to 3 skipped: one/000001.exr to 000003.exr: REASON". At most 20
/// lines a clip, then "clip one: 7 more frames skipped". A frame that several datasets skip is listed once.
[[nodiscard]] std::vector<std::string> skip_lines(const std::vector<thermal::ConvertOutcome>& outcomes);

}  // namespace veldt
