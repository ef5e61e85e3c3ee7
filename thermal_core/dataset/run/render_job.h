#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "io/assets.h"
#include "io/json/file.h"
#include "io/system/child_process.h"
#include "io/system/files.h"

namespace thermal {

/// A failure that a script in Blender reported with an event "error".
struct ReportedFailure {
  std::string message;  ///< "ModuleNotFoundError: No module named 'numpy'"
  std::string where;    ///< "blender_scripts/planner/noise.py:8"; may be empty
  std::string hint;     ///< what to do about it; may be empty
  bool config = false;  ///< the config is at fault, and not Blender

  /// "message (where); hint".
  [[nodiscard]] std::string in_words() const;
};

/// The failure of an event, as one line each whatever it holds. Json::exception if a field has the wrong type.
[[nodiscard]] ReportedFailure reported_failure(const Json& event);

/// What a Blender printed last, in its own words: up to three lines of `log` from byte `from` on, joined by " / ".
/// Empty lines and "Blender quit" are left out, a line past 200 bytes is cut, and only the last 64 KiB are read.
/// Empty if there is nothing, or no log.
[[nodiscard]] std::string last_error_line_in(const Path& log, std::uintmax_t from);

/// Why a Blender ended that reported no failure, with its last words unless it was killed: "Blender ended with exit
/// code 1 while building the scene: Error: no memory". `doing` is "building the scene" or the like.
[[nodiscard]] std::string unreported_end(const ExitStatus& status, const std::string& doing,
                                         const std::string& last_error_line);

/// A clip that Blender died over twice. Other clips may go well.
class ClipLost : public Error {
 public:
  ClipLost(const std::string& why, bool killed) : Error(why), killed_(killed) {}
  /// A signal ended Blender: what was asked for is not to blame, and it may go well another time.
  [[nodiscard]] bool killed() const noexcept { return killed_; }

 private:
  bool killed_;
};

/// Renders the passes of some clips, one after another, in the background. A Blender that dies is started again, once
/// a clip, on the frames that are not there yet; if it dies once more, the clip is lost and another Blender goes on
/// with the next.
class RenderJob {
 public:
  /// What Blender renders.
  struct Task {
    Path blender;
    Assets assets;
    Path plan;    ///< folder of a plan with its baked scene
    Path passes;  ///< gets a folder for each clip
    Path log;     ///< what the Blenders of this job print, one after another
    std::vector<std::string> clips;
    int threads = 0;      ///< 0: as many as Blender takes by itself
    int supersample = 1;  ///< rays along each side of a pixel
    bool actor_layer = false;
    bool preview = false;  ///< pictures for people instead: the frames of one clip, kPreview
    /// Called from a thread of its own when Blender died and is started again: over which clip, and why it died.
    std::function<void(const std::string& clip, const std::string& why)> restarted;
  };
  static constexpr const char* kPreview = "preview";

  /// Starts Blender. It dies with this process.
  explicit RenderJob(const Task& task);
  /// Ends Blender.
  ~RenderJob();
  RenderJob(const RenderJob&) = delete;
  RenderJob& operator=(const RenderJob&) = delete;

  /// Returns when the frame's file is whole. Otherwise says in words why it never will be: ClipLost; or what ends the job, of which no clip is to blame: ConfigError; TryAgainError if
  /// Blender was killed as it built the scene or the disk is full; else IoError. Cancelled when `cancelled` says so.
  void wait_for_frame(const std::string& clip, int frame, const std::function<bool()>& cancelled);

  /// How many frames a clip has, as Blender reports when it begins with the clip. Waits for that as above.
  [[nodiscard]] int wait_for_count(const std::string& clip, const std::function<bool()>& cancelled);

  /// How many leading frames of a clip are whole.
  [[nodiscard]] int frames_ready(const std::string& clip);

  /// Waits until nothing is left to render; only what ends the job is a fault here.
  void wait_for_end(const std::function<bool()>& cancelled);

  /// Throws what ended the job, if something did.
  void rethrow_fault();

 private:
  /// Whose doing an early end is.
  enum class FailureCause { config, blender, circumstances };
  /// What is known of the Blender that runs.
  struct Run {
    bool scene_built = false;
    FailureCause cause = FailureCause::blender;
    std::string failure;           ///< why it ended early, in one line
    std::uintmax_t log_begin = 0;  ///< where its part of the log begins
    std::string doing = "building the scene";
  };

  void run(const std::stop_token& stop);
  [[nodiscard]] bool run_once(const std::stop_token& stop);
  [[nodiscard]] Task task_left();
  void take_line(const std::string& line);
  void take_event(const Json& event);
  void leave_if_whole(const std::string& clip);
  [[nodiscard]] bool take_end(const ExitStatus& status);
  void explain(const ExitStatus& status);
  [[nodiscard]] bool may_try_again();
  void wait_until(const std::function<bool()>& done, const std::function<bool()>& cancelled,
                  const std::string& clip);
  [[noreturn]] void throw_failure() const;

  Task task_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> left_;      ///< clips that are not rendered, in order
  std::map<std::string, int> ready_;  ///< leading whole frames of a clip
  std::map<std::string, int> frames_;
  std::map<std::string, ClipLost> lost_;
  Run run_;
  int deaths_in_clip_ = 0;   ///< over the first of left_
  int deaths_in_scene_ = 0;  ///< one after another, before a scene was built
  bool ended_ = false;
  std::exception_ptr fault_;  ///< what ended the job
  std::jthread runner_;       ///< starts the Blenders, which die with it, and listens to them
};

/// The arguments Blender is started with.
[[nodiscard]] std::vector<std::string> render_command(const RenderJob::Task& task);

/// Distributes clips among `jobs` Blender processes, or fewer with fewer clips: the j-th gets clips j, j + jobs, …
[[nodiscard]] std::vector<std::vector<std::string>> deal_clips(const std::vector<std::string>& clips,
                                                               int jobs);

/// Number of threads for one of several Blender processes that share `threads`, at least one.
[[nodiscard]] int threads_each(int threads, int jobs);

/// Called with each clip, in the order of its task; for several tasks at the same time. `cancelled` becomes true for
/// all as soon as one throws.
using ClipWork =
    std::function<void(const std::string& clip, RenderJob& job, const std::function<bool()>& cancelled)>;

/// Renders tasks at the same time, with one Blender process and one thread each, and returns when `work` has had all
/// their clips. `work` may use `threads` threads in total (0: thread_count(0), which they share). If `work` or a job
/// throws, all stop, and the first exception is rethrown.
void run_workers(const std::vector<RenderJob::Task>& tasks, int threads, const ClipWork& work,
                 const std::function<bool()>& cancelled);

}  // namespace thermal
