#include "cli/planning.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "dataset/run/options.h"
#include "io/system/child_process.h"

namespace veldt {
namespace {

/// A line of the table: a clip, or all chosen clips of a flight.
struct PlanRow {
  std::string name;
  int clips = 0;
  int frames = 0;
  int frames_with_actors = 0;
  double min_agl_m = HUGE_VAL;
  double max_agl_m = -HUGE_VAL;

  void add(const thermal::ClipPlan& clip) {
    ++clips;
    frames += clip.frames;
    frames_with_actors += clip.frames_with_actors;
    min_agl_m = std::min(min_agl_m, clip.min_agl_m);
    max_agl_m = std::max(max_agl_m, clip.max_agl_m);
  }
};

void print_row(const PlanRow& row) {
  print("{:<32} {:>6} {:>8} {:>12} {:>8.1f} {:>7.1f}\n", row.name, row.clips, row.frames,
        row.frames_with_actors, row.min_agl_m, row.max_agl_m);
}

/// "45 s", "12 min", "3 h 05 min"
std::string duration_text(double seconds) {
  const int minutes = static_cast<int>(std::lround(seconds / 60));
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (minutes < 100) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

void print_engine(const thermal::DatasetSpec& spec) {
  if (spec.engine_reason.empty()) return;
  const char* name = spec.engine == thermal::Engine::embree ? "embree" : "blender";
  print("engine: {} ({})\n", name, spec.engine_reason);
}

void print_plan(const thermal::DatasetSpec& spec, const thermal::DatasetPlan& plan,
                const std::vector<thermal::ClipSpec>& chosen) {
  std::set<std::string> ids;
  for (const thermal::ClipSpec& clip : chosen) ids.insert(clip.id);
  print("{:<32} {:>6} {:>8} {:>12} {:>16}\n", "clip or flight", "clips", "frames", "with actors",
        "height [m AGL]");
  PlanRow all{.name = "all"};
  PlanRow row;
  for (const thermal::ClipPlan& clip : plan.clips) {
    if (!ids.contains(clip.id)) continue;
    const std::string name = clip.of_flight.empty() ? clip.id : clip.of_flight;
    if (name != row.name && row.clips > 0) print_row(row);
    if (name != row.name) row = PlanRow{.name = name};
    row.add(clip);
    all.add(clip);
  }
  if (row.clips > 0) print_row(row);
  if (all.clips > row.clips) print_row(all);
  print_engine(spec);
  const thermal::Estimate estimate = thermal::estimate_run(spec, all.clips, all.frames);
  print("about {} on 2 cores, {} of disk space\n", duration_text(estimate.seconds),
        bytes_text(estimate.bytes));
}

void plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                        const std::function<void(const thermal::PlanOptions& options)>& plan) {
  constexpr std::chrono::seconds kPatience(10);
  std::vector<thermal::LeftOver> left_over;
  {
    ProgressBar bar(common, "planning", "flights", kPatience);
    ProgressBar maps(common, "building the scene", "cells", kPatience);
    plan({.assets = assets,
          .threads = common.threads,
          .blender = thermal::find_program("blender"),
          .show = hooks_for(bar).progress,
          .show_maps = hooks_for(maps).progress,
          .left_over = [&left_over](const thermal::LeftOver& one) { left_over.push_back(one); }});
  }
  print_left_over(left_over);
}

thermal::PlannedDataset plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                                           const thermal::ResolvedConfig& config, const std::string& name) {
  thermal::PlannedDataset planned;
  plan_with_progress(common, assets, [&](const thermal::PlanOptions& options) {
    planned = thermal::plan_dataset(config, name, options);
  });
  return planned;
}

}  // namespace veldt
