#pragma once

#include <functional>
#include <string>

#include "dataset/clip/record.h"

namespace thermal {

/// Progress of a run.
struct Progress {
  std::string clip;  ///< the one at work
  int done = 0;      ///< frames, or clips of validate
  int total = 0;     ///< of the whole run, counting only what this run has to do
};

/// Callbacks of a long run. All may be empty; no two are called at once.
struct RunHooks {
  std::function<void(const Progress&)> progress;
  std::function<bool()> cancelled;
  /// Blender crashed while rendering a clip and is restarted, with the reason.
  std::function<void(const std::string& clip, const std::string& why)> restarted = {};
  /// A frame is skipped, and the clip continues without it.
  std::function<void(const std::string& clip, const SkippedFrame& frame)> skipped = {};
  /// An existing clip is made again, because its passes or their manifest have changed.
  std::function<void(const std::string& clip)> remade = {};

  void report(const Progress& state) const {
    if (progress) progress(state);
  }
  [[nodiscard]] bool stop_wanted() const { return cancelled && cancelled(); }
};

}  // namespace thermal
