#include "cli/progress_bar.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/printable.h"
#include "cli/output.h"
#include "cli/stop_signal.h"

namespace veldt {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kPlainInterval = std::chrono::seconds(5);

double seconds_left(const thermal::Progress& progress, double frames_per_s) {
  return frames_per_s > 0 ? (progress.frames_total - progress.frames_done) / frames_per_s : 0;
}

}  // namespace

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  const long hours = whole / 3600;
  const long minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

ProgressBar::ProgressBar(const CommonOptions& options, std::string opening)
    : style_(style_of(options)), opening_(std::move(opening)) {}

ProgressBar::~ProgressBar() {
  if (line_open_) print_error("\n");
}

ProgressBar::Style ProgressBar::style_of(const CommonOptions& options) {
  if (options.quiet || options.progress == "none") return Style::none;
  if (options.progress == "json") return Style::json;
  if (options.progress == "plain") return Style::plain;
  return ::isatty(STDERR_FILENO) != 0 ? Style::bar : Style::plain;
}

void ProgressBar::show(const thermal::Progress& progress) {
  const auto now = Clock::now();
  if (progress.frames_done > 0 && first_frame_ == 0) {
    first_frame_ = progress.frames_done;
    first_frame_at_ = now;
  }
  const double elapsed_s = std::chrono::duration<double>(now - first_frame_at_).count();
  const int since = progress.frames_done - first_frame_;
  const double frames_per_s = since > 0 && elapsed_s > 0 ? since / elapsed_s : 0;
  const bool finished = progress.frames_done == progress.frames_total;
  if (style_ == Style::json) show_json(progress, frames_per_s);
  if (style_ == Style::bar) show_bar(progress, frames_per_s);
  if (style_ == Style::plain && (finished || now - last_shown_ >= kPlainInterval)) {
    show_plain(progress, frames_per_s);
    last_shown_ = now;
  }
}

std::string ProgressBar::time_left(const thermal::Progress& progress, double frames_per_s) const {
  if (frames_per_s > 0) return "ETA " + clock_time(seconds_left(progress, frames_per_s));
  return progress.frames_done > 0 ? "starting" : opening_;
}

void ProgressBar::show_bar(const thermal::Progress& progress, double frames_per_s) {
  const int filled = progress.frames_total > 0 ? kBarWidth * progress.frames_done / progress.frames_total : 0;
  print_error("\r\x1b[K[{:=<{}}{: <{}}] {}/{} frames  {:.1f} frames/s  {}  {}", "", filled, "",
              kBarWidth - filled, progress.frames_done, progress.frames_total, frames_per_s,
              time_left(progress, frames_per_s), progress.clip);
  std::fflush(stderr);
  line_open_ = true;
}

void ProgressBar::show_plain(const thermal::Progress& progress, double frames_per_s) const {
  print_error("{}/{} frames, {:.1f} frames/s, {}, clip {}\n", progress.frames_done, progress.frames_total,
              frames_per_s, time_left(progress, frames_per_s), progress.clip);
}

void ProgressBar::show_json(const thermal::Progress& progress, double frames_per_s) {
  const thermal::Json line = {{"clip", progress.clip},
                              {"frames_done", progress.frames_done},
                              {"frames_total", progress.frames_total},
                              {"frames_per_s", frames_per_s},
                              {"left_s", seconds_left(progress, frames_per_s)}};
  print_event(line);
}

void ProgressBar::show_restart(const std::string& clip, const std::string& why) {
  show_event({{"event", "restart"}, {"clip", clip}, {"reason", why}},
             fmt::format("clip {}: {}; restarting Blender", clip, why));
}

void ProgressBar::show_remade(const std::string& clip) {
  show_event({{"event", "remade"}, {"clip", clip}},
             fmt::format("clip {}: its manifest or its passes have changed; making it again", clip));
}

void ProgressBar::show_event(const thermal::Json& event, const std::string& line) {
  if (style_ == Style::none) return;
  if (line_open_) print_error("\n");
  line_open_ = false;
  if (style_ == Style::json) return print_event(event);
  print_error("{}\n", line);
}

void ProgressBar::show_skipped(const std::string& clip, const thermal::SkippedFrame& frame) {
  if (style_ != Style::json) return;
  const thermal::Json line = {{"event", "skipped"},
                              {"clip", clip},
                              {"frame_index", frame.frame_index},
                              {"file", thermal::printable(frame.file)},
                              {"reason", frame.reason}};
  print_event(line);
}

thermal::RunHooks hooks_for(ProgressBar& bar) {
  return {
      .progress = [&bar](const thermal::Progress& progress) { bar.show(progress); },
      .cancelled = [] { return stop_signal() != 0; },
      .restarted = [&bar](const std::string& clip, const std::string& why) { bar.show_restart(clip, why); },
      .skipped = [&bar](const std::string& clip,
                        const thermal::SkippedFrame& frame) { bar.show_skipped(clip, frame); },
      .remade = [&bar](const std::string& clip) { bar.show_remade(clip); }};
}

}  // namespace veldt
