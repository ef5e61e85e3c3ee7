#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "io/child_process.h"
#include "io/files.h"

namespace thermal {

/// A Blender that renders the passes of some clips, one after another, in the background.
class RenderJob {
 public:
  struct Task {
    Path blender;
    Path home;
    Path config;  ///< resolved
    Path passes;  ///< gets a folder for each clip
    Path log;     ///< what Blender prints
    std::vector<std::string> clips;
    int threads = 0;       ///< 0: one a core
    bool preview = false;  ///< pictures for people instead: the frames of one clip, kPreview
  };
  static constexpr const char* kPreview = "preview";

  /// Starts Blender. It dies with the thread that calls this.
  explicit RenderJob(const Task& task);
  ~RenderJob();
  RenderJob(const RenderJob&) = delete;
  RenderJob& operator=(const RenderJob&) = delete;

  /// Returns when the frame's file is whole (frame -1: when the clip's manifest is). Otherwise says in words
  /// why it never will be: ConfigError; TryAgainError if Blender was killed or the disk is full; else IoError.
  /// Cancelled when `cancelled` says so.
  void wait_for_frame(const std::string& clip, int frame, const std::function<bool()>& cancelled);

  /// How many frames a clip has, as Blender told with its manifest; 0 before.
  [[nodiscard]] int frames_of(const std::string& clip);

  /// Waits until Blender has ended; the same faults.
  void wait_for_end(const std::function<bool()>& cancelled);

 private:
  /// How many leading frames of a clip are whole, counting the manifest as one.
  using Ready = std::map<std::string, int>;
  /// Whose doing an early end is.
  enum class Blame { config, blender, circumstances };

  void listen(const std::stop_token& stop);
  void take_event(const std::string& line);
  void take_end(const ExitStatus& status);
  void wait_until(const std::function<bool()>& done, const std::function<bool()>& cancelled);
  [[noreturn]] void throw_failure() const;

  Task task_;
  ChildProcess process_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Ready ready_;
  std::map<std::string, int> frames_;
  bool ended_ = false;
  Blame blame_ = Blame::blender;
  std::string failure_;  ///< why Blender ended early; empty if it did not
  std::string doing_ = "building the scene";
  std::jthread listener_;
};

/// The arguments Blender is started with.
[[nodiscard]] std::vector<std::string> render_command(const RenderJob::Task& task);

}  // namespace thermal
