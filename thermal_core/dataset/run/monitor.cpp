#include "dataset/run/monitor.h"

#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

// A frame's passes are ten channels of four bytes per pixel. RLE reduces dense savanna to 24 bytes, but other scenes
// may not shrink at all, and the joined actors' layer adds to that.
constexpr std::int64_t kPassesBytesPerPixel = 40;
// Three bytes before PNG, which hardly reduces noise; one more for labels, preview and PNG's overhead.
constexpr std::int64_t kPicturesBytesPerPixel = 4;

/// 0 if the file has been removed meanwhile.
std::int64_t size_bytes(const Path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? 0 : static_cast<std::int64_t>(bytes);
}

}  // namespace

std::int64_t ClipSpace::Files::bytes_per_frame() const {
  return count == 0 ? worst_bytes : (bytes + count - 1) / count;
}

std::int64_t ClipSpace::needed_bytes() const {
  return (frames - passes.count) * passes.bytes_per_frame() +
         (frames - pictures.count) * pictures.bytes_per_frame();
}

ClipSpace space_for(const DatasetSpec& spec, const ClipSpec& clip, const ClipFiles& files) {
  const std::int64_t finer = spec.supersample;
  const std::int64_t wide_px = finer * (spec.width_px + 2 * spec.overscan_px);
  const std::int64_t high_px = finer * (spec.height_px + 2 * spec.overscan_px);
  const std::int64_t picture_px = std::int64_t{spec.width_px} * spec.height_px;
  return {.frames = clip.frames,
          .passes = {.worst_bytes = files.passes ? kPassesBytesPerPixel * wide_px * high_px : 0},
          .pictures = {.worst_bytes = files.pictures ? kPicturesBytesPerPixel * picture_px : 0}};
}

std::string bytes_in_words(std::int64_t bytes) {
  constexpr std::array kUnits = {"kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000;
    ++unit;
  }
  const bool one_digit = value < 9.95 && unit > 0;
  return fmt::format("{:.{}f} {}", value, one_digit ? 1 : 0, kUnits[unit]);
}

void check_space(std::int64_t left_bytes, std::int64_t needed_bytes, const std::string& folder,
                 const std::string& whose) {
  if (left_bytes / 2 >= needed_bytes) return;
  throw TryAgainError(fmt::format("{} = {} left; expected at least 2 x the {} that {} still needs", folder,
                                  bytes_in_words(left_bytes), bytes_in_words(needed_bytes), whose));
}

SpaceWatch::SpaceWatch(const DatasetSpec& spec, const ClipSpec& clip, const Layout& layout,
                       const ClipFiles& files, Report report)
    : id_(clip.id), layout_(layout), report_(std::move(report)), space_(space_for(spec, clip, files)) {
  int there = 0;
  while (there < clip.frames && std::filesystem::exists(layout_.passes(id_) / passes_name(there))) ++there;
  passes_ready(there);
}

void SpaceWatch::passes_ready(int frames) {
  const std::lock_guard lock(mutex_);
  while (space_.passes.count < frames)
    space_.passes.add(size_bytes(layout_.passes(id_) / passes_name(space_.passes.count)));
  report();
}

void SpaceWatch::pictures_written() {
  const std::lock_guard lock(mutex_);
  const Path folder = layout_.unfinished_clip(id_);
  const std::string name = frame_name(space_.pictures.count);
  space_.pictures.add(size_bytes(folder / "ir8" / name) + size_bytes(folder / "ir16" / name));
  report();
}

RunMonitor::RunMonitor(const RunHooks& hooks, const Path& out, int frames_total) : hooks_(hooks), out_(out) {
  progress_.total = frames_total;
}

void RunMonitor::begin(const ClipSpec& clip) {
  const std::lock_guard lock(mutex_);
  frames_done_[clip.id] = 0;
  progress_.clip = clip.id;
  hooks_.report(progress_);
}

void RunMonitor::frame_done(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  ++frames_done_[clip];
  ++progress_.done;
  progress_.clip = clip;
  hooks_.report(progress_);
}

void RunMonitor::made(const ClipSpec& clip) {
  const std::lock_guard lock(mutex_);
  outcome_.made.push_back(clip.id);
  outcome_.frames_made += clip.frames;
  end(clip);
}

void RunMonitor::lost(const ClipSpec& clip, const std::string& why, bool killed) {
  const std::lock_guard lock(mutex_);
  outcome_.failed[clip.id] = why;
  all_killed_ = all_killed_ && killed;
  progress_.done += clip.frames - frames_done_[clip.id];  // those will never come
  end(clip);
  hooks_.report(progress_);
}

void RunMonitor::end(const ClipSpec& clip) {
  frames_done_.erase(clip.id);
  needs_.erase(clip.id);
}

void RunMonitor::restarted(const std::string& clip, const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (hooks_.restarted) hooks_.restarted(clip, why);
}

void RunMonitor::needs(const std::string& clip, std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  needs_[clip] = bytes;
  std::int64_t all_bytes = 0;
  std::vector<std::string> clips;
  for (const auto& [id, needed_bytes] : needs_) {
    all_bytes += needed_bytes;
    clips.push_back(id);
  }
  const std::string whose = fmt::format("{} {}", clips.size() == 1 ? "clip" : "clips", list_names(clips));
  check_space(free_bytes(out_), all_bytes, out_.string(), whose);
}

bool RunMonitor::stop_wanted() {
  const std::lock_guard lock(mutex_);
  return hooks_.stop_wanted();
}

RunOutcome RunMonitor::outcome() {
  const std::lock_guard lock(mutex_);
  RunOutcome outcome = outcome_;
  outcome.try_again = outcome.made.empty() && !outcome.failed.empty() && all_killed_;
  return outcome;
}

}  // namespace thermal
