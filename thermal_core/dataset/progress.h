#pragma once

#include <functional>
#include <string>

#include "dataset/clip_record.h"

namespace thermal {

/// How far a run is.
struct Progress {
  std::string clip;     ///< the one being worked on
  int frames_done = 0;  ///< of the whole run, counting only frames this run has to make
  int frames_total = 0;
};

/// How a long run talks to whoever started it. All may be empty; no two are called at once.
struct RunHooks {
  std::function<void(const Progress&)> progress;
  std::function<bool()> cancelled;
  /// Blender died over a clip, and why, and was started again.
  std::function<void(const std::string& clip, const std::string& why)> restarted = {};
  /// A clip goes on without a frame.
  std::function<void(const std::string& clip, const SkippedFrame& frame)> skipped = {};

  void report(const Progress& state) const {
    if (progress) progress(state);
  }
  [[nodiscard]] bool stop_wanted() const { return cancelled && cancelled(); }
};

}  // namespace thermal
