#include "cli/progress_bar.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"

namespace veldt {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kPlainInterval = std::chrono::seconds(5);

double seconds_left(const thermal::Progress& progress, double per_s) {
  return per_s > 0 ? (progress.total - progress.done) / per_s : 0;
}

}  // namespace

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  const long hours = whole / 3600;
  const long minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

ProgressBar::ProgressBar(const CommonOptions& options, std::string opening, std::string unit,
                         std::chrono::seconds patience)
    : style_(style_of(options)),
      opening_(std::move(opening)),
      unit_(std::move(unit)),
      begin_(Clock::now() + patience) {}

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
  if (now < begin_ && style_ != Style::json) return;
  if (progress.done > 0 && first_ == 0) {
    first_ = progress.done;
    first_at_ = now;
  }
  const double elapsed_s = std::chrono::duration<double>(now - first_at_).count();
  const int since = progress.done - first_;
  const double per_s = since > 0 && elapsed_s > 0 ? since / elapsed_s : 0;
  const bool finished = progress.done == progress.total;
  if (style_ == Style::json) show_json(progress, per_s);
  if (style_ == Style::bar) show_bar(progress, per_s);
  if (style_ == Style::plain && (finished || now - last_shown_ >= kPlainInterval)) {
    show_plain(progress, per_s);
    last_shown_ = now;
  }
}

std::string ProgressBar::time_left(const thermal::Progress& progress, double per_s) const {
  if (per_s > 0) return "ETA " + clock_time(seconds_left(progress, per_s));
  return progress.done > 0 ? "starting" : opening_;
}

void ProgressBar::show_bar(const thermal::Progress& progress, double per_s) {
  const int filled = progress.total > 0 ? kBarWidth * progress.done / progress.total : 0;
  print_error("\r\x1b[K[{:=<{}}{: <{}}] {}/{} {}  {:.1f} {}/s  {}  {}", "", filled, "", kBarWidth - filled,
              progress.done, progress.total, unit_, per_s, unit_, time_left(progress, per_s),
              thermal::printable(progress.clip));
  std::fflush(stderr);
  line_open_ = true;
}

void ProgressBar::show_plain(const thermal::Progress& progress, double per_s) const {
  print_error("{}/{} {}, {:.1f} {}/s, {}, clip {}\n", progress.done, progress.total, unit_, per_s, unit_,
              time_left(progress, per_s), thermal::printable(progress.clip));
}

void ProgressBar::show_json(const thermal::Progress& progress, double per_s) const {
  const thermal::Json line = {{"clip", progress.clip},
                              {fmt::format("{}_done", unit_), progress.done},
                              {fmt::format("{}_total", unit_), progress.total},
                              {fmt::format("{}_per_s", unit_), per_s},
                              {"left_s", seconds_left(progress, per_s)}};
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
