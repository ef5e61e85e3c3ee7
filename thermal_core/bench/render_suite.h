#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/stage_row.h"
#include "io/files.h"

namespace thermal {

/// One thing that was measured; all rows of a group have the same figures.
struct RenderRow {
  std::string group;
  std::string name;
  std::vector<Figure> figures;
};

struct RenderSuiteTask {
  Path blender;
  Path home;
  std::function<void(const std::string&)> tell = {};  ///< what is measured next
};

/// What a frame of passes takes, by scene, supersampling and step; processes against threads, and whether they
/// make the same bits; files of passes against copying and writing their bytes. Takes minutes. IoError if Blender fails.
[[nodiscard]] std::vector<RenderRow> run_render_suite(const RenderSuiteTask& task);

}  // namespace thermal
