#pragma once

#include <map>
#include <mutex>
#include <string>

#include "dataset/generate.h"

namespace thermal {

/// What the workers of a run tell of it, from any thread: one after another it goes on to the run's hooks, its outcome
/// and its watch over the disk.
class RunBoard {
 public:
  RunBoard(const RunHooks& hooks, const Path& out, int frames_total);

  void begin(const ClipConfig& clip);
  void frame_done(const std::string& clip);
  void made(const ClipConfig& clip);
  /// `killed`: because Blender was.
  void lost(const ClipConfig& clip, const std::string& why, bool killed);
  void restarted(const std::string& clip, const std::string& why);

  /// What a clip that is being made still needs. TryAgainError where all of them together may not find room.
  void needs(const std::string& clip, std::int64_t bytes);

  [[nodiscard]] bool stop_wanted();
  /// All but what was there before and whether the dataset is complete.
  [[nodiscard]] RunOutcome outcome();

 private:
  void end(const ClipConfig& clip);

  const RunHooks& hooks_;
  Path out_;
  std::mutex mutex_;
  Progress progress_;
  RunOutcome outcome_;
  bool all_killed_ = true;                     ///< of the clips that were lost
  std::map<std::string, int> frames_done_;     ///< of each clip that is being made
  std::map<std::string, std::int64_t> needs_;  ///< bytes, of each clip that is being made
};

}  // namespace thermal
