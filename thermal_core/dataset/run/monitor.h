#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "dataset/dataset_file.h"
#include "dataset/progress.h"
#include "dataset/run/options.h"
#include "io/config/spec.h"

namespace thermal {

/// Disk space used by a clip, and an estimate of what it still needs.
struct ClipSpace {
  /// Files of one kind, one per frame.
  struct Files {
    std::int64_t worst_bytes = 0;  ///< size of one, used until the first exists
    std::int64_t bytes = 0;        ///< of the existing ones
    int count = 0;

    void add(std::int64_t file_bytes) {
      bytes += file_bytes;
      ++count;
    }
    /// The mean of the existing ones, rounded up; the worst case without any.
    [[nodiscard]] std::int64_t bytes_per_frame() const;
  };

  int frames = 0;
  Files passes;
  Files pictures;  ///< ir8 and ir16 together

  /// Bytes of the frames still to be made.
  [[nodiscard]] std::int64_t needed_bytes() const;
};

/// Which files of a clip a run writes.
struct ClipFiles {
  bool passes = true;
  bool pictures = true;  ///< whether it is converted
};

/// A clip without any files yet.
[[nodiscard]] ClipSpace space_for(const DatasetSpec& spec, const ClipSpec& clip, const ClipFiles& files);

/// "850 kB", "85 MB", "1.2 GB": two digits or more; kB is 1000 bytes and the smallest unit.
[[nodiscard]] std::string bytes_in_words(std::int64_t bytes);

/// TryAgainError if less than twice the needed space is left. `folder` and `whose` are for the message.
void check_space(std::int64_t left_bytes, std::int64_t needed_bytes, const std::string& folder,
                 const std::string& whose);

/// Follows the files of a clip as they are written, and reports the disk space it still needs; from any thread.
/// Exceptions of the report pass through.
class SpaceWatch {
 public:
  using Report = std::function<void(std::int64_t needed_bytes)>;

  /// Counts the passes left by an earlier run.
  SpaceWatch(const DatasetSpec& spec, const ClipSpec& clip, const Layout& layout, const ClipFiles& files,
             Report report);

  /// Records that this many leading frames of the passes are complete.
  void passes_ready(int frames);
  /// Records one more frame's pictures.
  void pictures_written();

 private:
  void report() const { report_(space_.needed_bytes()); }

  std::string id_;
  Layout layout_;
  Report report_;
  std::mutex mutex_;
  ClipSpace space_;
};

/// Collects reports of a run's workers, from any thread, and passes them one by one to the run's hooks, its outcome
/// and its check of disk space.
class RunMonitor {
 public:
  RunMonitor(const RunHooks& hooks, const Path& out, int frames_total);

  void begin(const ClipSpec& clip);
  void frame_done(const std::string& clip);
  void made(const ClipSpec& clip);
  /// `killed`: whether it failed because Blender was killed.
  void lost(const ClipSpec& clip, const std::string& why, bool killed);
  void restarted(const std::string& clip, const std::string& why);

  /// Sets the space that a clip being made still needs. TryAgainError if all of them together may not fit.
  void needs(const std::string& clip, std::int64_t bytes);

  [[nodiscard]] bool stop_wanted();
  /// Everything except clips that existed before and whether the dataset is complete.
  [[nodiscard]] RunOutcome outcome();

 private:
  void end(const ClipSpec& clip);

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
