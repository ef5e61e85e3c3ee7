#pragma once

#include <map>
#include <mutex>
#include <string>

#include "dataset/run/options.h"
#include "dataset/run/progress.h"

namespace thermal {

/// Collects reports of a run's workers, from any thread, and passes them one by one to the run's hooks, its outcome
/// and its check of disk space.
class RunMonitor {
 public:
  RunMonitor(const RunHooks& hooks, const Path& out, int frames_total);

  void begin(const ClipConfig& clip);
  void frame_done(const std::string& clip);
  void made(const ClipConfig& clip);
  /// `killed`: because Blender was.
  void lost(const ClipConfig& clip, const std::string& why, bool killed);
  void restarted(const std::string& clip, const std::string& why);

  /// Sets the space that a clip being made still needs. TryAgainError if all of them together may not fit.
  void needs(const std::string& clip, std::int64_t bytes);

  [[nodiscard]] bool stop_wanted();
  /// Everything except clips that existed before and whether the dataset is complete.
  [[nodiscard]] RunOutcome outcome();

 private:
  void end(const ClipConfig& clip);

  const RunHooks& hooks_;
  Path out_;
  std::mutex mutex_;
  Progress progress_;
  RunOutcome outcome_;
  bool all_killed_ = true;                     ///< of failed clips
  std::map<std::string, int> frames_done_;     ///< of each clip being made
  std::map<std::string, std::int64_t> needs_;  ///< bytes, of each clip being made
};

}  // namespace thermal
