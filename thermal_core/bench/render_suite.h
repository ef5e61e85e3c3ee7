#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/sensor_scene.h"
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
};

/// Mean time of a frame [s].
struct Profile {
  double pixels = 0;
  double objects = 0;
  double frame_s = 0;
  std::map<std::string, double> split_s;
  double peak_mb = 0;  ///< of Blender's memory since its start
};

/// Frames to profile: so many of each clip of a plan, without the first.
struct ProfileFrames {
  std::vector<std::string> clips = {};  ///< empty: the first
  std::vector<int> supersamples = {1};
  int frames = 8;
};

/// Runs profile_render.py to completion. Profiles of all clips with the first supersampling, then with the next; the
/// frames are in CLIP/NxN. IoError with Blender's reason on failure or unexpected output.
[[nodiscard]] std::vector<Profile> profile_frames(const ProfileTask& task, const ProfileFrames& frames);

/// Frames/s of render_passes.py with actor layers, between complete frames, which are written to a folder of the clip's
/// name.
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
