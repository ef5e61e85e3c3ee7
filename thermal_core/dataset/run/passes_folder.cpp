#include "dataset/run/passes_folder.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/run/render_job.h"
#include "dataset/run/tracing.h"
#include "io/manifest_file.h"
#include "io/system/files.h"

namespace thermal {
namespace {

bool has_clips(const Path& passes) {
  std::error_code error;
  const std::filesystem::directory_iterator entries(passes, error);
  return error || std::ranges::any_of(entries, [](const auto& entry) { return entry.is_directory(); });
}

/// Whether the passes are of another config, as `veldt render` may have left them.
bool holds_others(const Layout& layout, const ResolvedConfig& config) {
  if (!std::filesystem::exists(layout.passes_config())) return false;
  const Json there =
      Json::parse(read_file(layout.passes_config()), nullptr, false);  // of a damaged file, too
  return !differences(config.document, there).empty();
}

}  // namespace

void begin_passes(const Layout& layout, const ResolvedConfig& config, const std::vector<std::string>& clips) {
  make_own_folder(layout.passes());
  for (const std::string& clip : clips) {
    if (std::filesystem::exists(layout.unusable(clip))) std::filesystem::remove_all(layout.passes(clip));
    make_folder(layout.passes(clip));
  }
  write_file_atomically(layout.passes_config(), to_text(config.document));
}

void check_same_passes(const Layout& layout, const ResolvedConfig& config) {
  if (!std::filesystem::exists(layout.passes_config())) return;
  const Json there = read_json(layout.passes_config());
  const std::vector<std::string> found = differences(config.document, there);
  if (found.empty()) return;
  throw ConfigError(fmt::format("{} holds passes of another config: {}; expected {}, or another folder",
                                layout.passes().string(), fmt::join(found, ", "),
                                expected_config(config.document, there)));
}

std::vector<LeftOver> end_passes(const Layout& layout, const ResolvedConfig& config,
                                 const std::vector<std::string>& clips) {
  std::vector<LeftOver> left_over;
  if (!std::filesystem::is_directory(layout.passes()) || holds_others(layout, config)) return left_over;
  const auto sweep = [&left_over](const Path& folder) {
    if (auto left = sweep_folder(folder)) left_over.push_back(*std::move(left));
  };
  for (const std::string& clip : clips) sweep(layout.passes(clip));
  if (!has_clips(layout.passes())) sweep(layout.passes());
  return left_over;
}

PlannedManifests::PlannedManifests(const DatasetSpec& spec, const GenerateOptions& options)
    : spec_(spec),
      layout_{options.out, options.scratch},
      store_(options.plan, options.assets),
      scene_(store_.scene(spec)) {}

Manifest PlannedManifests::of(const ClipSpec& clip) const {
  return manifest_of(scene_, store_.track(clip, scene_), spec_, clip);
}

void PlannedManifests::write(const std::vector<ClipSpec>& clips) const {
  for (const ClipSpec& clip : clips) {
    const std::string text = to_text(of(clip));
    const Path folder = layout_.passes(clip.id);
    if (has_content(folder / "manifest.json", text)) continue;
    if (std::filesystem::exists(folder / passes_name(0)))
      throw ConfigError(fault("--out", folder.string(), "", "no frames there, or frames of this plan"));
    write_file_atomically(folder / "manifest.json", text);
  }
}

std::vector<RenderJob::Task> passes_tasks(const DatasetSpec& spec, const GenerateOptions& options,
                                          const std::vector<std::string>& clips, RunMonitor& monitor) {
  const Layout layout{options.out, options.scratch};
  const auto hands = deal_clips(clips, options.jobs);
  const int threads = thread_count(options.threads);
  std::vector<RenderJob::Task> tasks;
  for (const std::vector<std::string>& hand : hands) {
    // Runs that share the folder never share a clip, so the clip's name keeps their logs apart.
    tasks.push_back({.blender = options.blender,
                     .assets = options.assets,
                     .plan = options.plan,
                     .passes = layout.passes(),
                     .log = layout.passes() / (hand.front() + ".log"),
                     .clips = hand,
                     .threads = threads_each(threads, static_cast<int>(hands.size())),
                     .supersample = spec.supersample,
                     .actor_layer = spec.actor_layer,
                     .preview = false,
                     .restarted = [&monitor](const std::string& clip, const std::string& why) {
                       monitor.restarted(clip, why);
                     }});
  }
  return tasks;
}

}  // namespace thermal
