#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// How a flight looks at the ground: a row of a file of views.
struct View {
  std::map<std::string, Json> values;  ///< altitude_m, look_angle_deg, perhaps speed_m_s
  double weight = 1;
};

/// Reads a CSV file of views. Its first row names the columns altitude_m and look_angle_deg, and perhaps weight and
/// speed_m_s, in any order; lines that start with # are comments. `keys`: the schema's rules of a flight's keys.
/// ConfigError with file and line; IoError.
[[nodiscard]] std::vector<View> read_views(const Path& file, const Json& keys);

/// Such a file's text, of how often each height [m] and look angle [deg] was found.
[[nodiscard]] std::string views_text(const std::map<std::pair<double, double>, int>& counts);

}  // namespace thermal
