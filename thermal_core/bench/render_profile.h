#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/files.h"

namespace thermal {

/// Frames for Blender to render.
struct ProfileTask {
  Path blender;
  Path home;
  Path config;
  Path out;         ///< gets the frames; its log lies beside it
  int threads = 0;  ///< 0: one a core
  int frames = 8;   ///< of the config's first clip; the first of them is not counted
};

/// What a frame takes [s], the mean of a few.
struct Profile {
  double pixels = 0;
  double objects = 0;
  double frame_s = 0;
  std::map<std::string, double> split_s;
};

/// Runs profile_render.py to its end. IoError with Blender's own reason if it fails or tells nothing.
[[nodiscard]] Profile profile_frames(const ProfileTask& task);

/// Frames/s of render_passes.py, from one whole frame to the next; they lie in a folder of the clip's name.
[[nodiscard]] double rendered_per_s(const ProfileTask& task, const std::string& clip);

/// The steps of a frame, in their order.
[[nodiscard]] const std::vector<std::string>& frame_steps();

}  // namespace thermal
