#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/stage_row.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// One measurement; all rows of a group have the same figures.
struct RenderRow {
  std::string group;
  std::string name;
  std::vector<Figure> figures;
};

struct RenderSuiteTask {
  Path blender;
  Assets assets;
  std::function<void(const std::string&)> announce = {};  ///< the next measurement
};

/// Time of a frame of passes by scene, supersampling and step; processes against threads, and whether their output is
/// identical; files of passes against copying and writing their bytes. Takes minutes. IoError if Blender fails.
[[nodiscard]] std::vector<RenderRow> run_render_suite(const RenderSuiteTask& task);

}  // namespace thermal
