#pragma once

#include <chrono>
#include <string>

#include "cli/command.h"
#include "dataset/progress.h"

namespace veldt {

/// Commands that only read a dataset's clips show no progress bar before this time.
inline constexpr std::chrono::seconds kClipPatience(2);

/// Shows the progress of a run on standard error: a bar with rate and time left on a terminal, a line every few
/// seconds elsewhere, or one JSON object per line for machines.
class ProgressBar {
 public:
  /// `opening`: what the run does before its first frame. Nothing is shown on a terminal for runs shorter than
  /// `patience`.
  explicit ProgressBar(const CommonOptions& options, std::string opening = "starting",
                       std::string unit = "frames", std::chrono::seconds patience = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const thermal::Progress& progress);
  /// Reports that Blender crashed while rendering a clip and is restarted.
  void show_restart(const std::string& clip, const std::string& why);
  /// Reports that an existing clip is made again.
  void show_remade(const std::string& clip);
  /// Reports a skipped frame, as JSON only; the summary lists skipped frames for people.
  void show_skipped(const std::string& clip, const thermal::SkippedFrame& frame);

 private:
  enum class Style { none, bar, plain, json };
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static Style style_of(const CommonOptions& options);
  [[nodiscard]] std::string time_left(const thermal::Progress& progress, double per_s) const;
  void show_bar(const thermal::Progress& progress, double per_s);
  void show_plain(const thermal::Progress& progress, double per_s) const;
  void show_event(const thermal::Json& event, const std::string& line);
  void show_json(const thermal::Progress& progress, double per_s) const;

  Style style_;
  std::string opening_;
  std::string unit_;         ///< of the counts
  Clock::time_point begin_;  ///< of the display
  Clock::time_point last_shown_;
  Clock::time_point first_at_;  ///< rate and time left exclude work before the first frame
  int first_ = 0;
  bool line_open_ = false;
};

/// Callbacks for a run: progress and restarts to `bar`, stop on a signal.
[[nodiscard]] thermal::RunHooks hooks_for(ProgressBar& bar);

/// "1:05", "2:03:00".
[[nodiscard]] std::string clock_time(double seconds);

}  // namespace veldt
