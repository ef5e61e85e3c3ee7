#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/stage_row.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// Frames for Blender to render.
struct ProfileTask {
  Path blender;
  Assets assets;
  Path plan;        ///< folder of a plan
  Path out;         ///< receives the frames; Blender's log is beside it
  int threads = 0;  ///< 0: thread_count(0)
  int frames = 8;   ///< of the plan's first clip; the first of them is not counted
  int supersample = 1;
};

/// Mean time of a frame [s].
struct Profile {
  double pixels = 0;
  double objects = 0;
  double frame_s = 0;
  std::map<std::string, double> split_s;
};

/// Runs profile_render.py to completion. IoError with Blender's reason if it fails or reports nothing.
[[nodiscard]] Profile profile_frames(const ProfileTask& task);

/// Frames/s of render_passes.py with actor layers, from one complete frame to the next; they are in a folder of the clip's name.
[[nodiscard]] double rendered_per_s(const ProfileTask& task, const std::string& clip);

/// The steps of a frame, in order.
[[nodiscard]] const std::vector<std::string>& frame_steps();

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
