#include "dataset/plan/dataset_plan.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "io/config/sections.h"
#include "io/json/camera.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

/// Clips or flights of a document as the planner sees them, with the cameras that differ from the dataset's.
template <typename Spec>
Json planned_entries(Json entries, const std::vector<Spec>& specs, const CameraIntrinsics& usual) {
  for (std::size_t k = 0; k < specs.size(); ++k) {
    (void)take_sections(entries[k]);
    for (const char* key : {"season", "drawn"}) entries[k].erase(key);
    const CameraIntrinsics& camera = specs[k].settings->camera;
    if (camera != usual) entries[k]["camera"] = to_json(camera);
  }
  return entries;
}

ClipPlan clip_of(const Json& json) {
  return {.id = json.at("id"),
          .of_flight = json.at("of_flight"),
          .start_s = json.at("start_s"),
          .frames = json.at("frames"),
          .frame_rate_hz = json.at("frame_rate_hz"),
          .frames_with_actors = json.at("frames_with_actors"),
          .min_agl_m = json.at("min_agl_m"),
          .max_agl_m = json.at("max_agl_m"),
          .mean_agl_m = json.at("mean_agl_m"),
          .mean_look_angle_deg = json.at("mean_look_angle_deg")};
}

/// Whether a plan's clips are those of a config.
class ClipCheck {
 public:
  ClipCheck(const DatasetSpec& spec, const std::string& name) : spec_(spec), name_(name) {}

  void check(const std::vector<ClipPlan>& clips) const {
    std::set<std::string> ids;
    std::int64_t frames = 0;
    for (std::size_t k = 0; k < std::max(clips.size(), spec_.clips.size()); ++k) {
      check(k < clips.size() ? clips[k] : ClipPlan(), k);
      if (!ids.insert(clips[k].id).second) fail(k, "id", quoted(clips[k].id), "each id once");
      frames += clips[k].frames;
    }
    constexpr int kMostFrames = std::numeric_limits<int>::max();
    if (frames > kMostFrames)
      throw DataError(
          fmt::format("{}: clips have {} frames; expected at most {}", name_, frames, kMostFrames));
  }

 private:
  [[noreturn]] void fail(std::size_t k, const char* key, const std::string& value,
                         const std::string& rule) const {
    throw DataError(
        fmt::format("{}: {}", name_, fault(fmt::format("clips[{}].{}", k, key), value, "", rule)));
  }

  void check(const ClipPlan& clip, std::size_t k) const {
    if (k >= spec_.clips.size()) {
      if (spec_.flight(clip.of_flight) == nullptr)
        fail(k, "of_flight", quoted(clip.of_flight), "a flight of the config");
      return;
    }
    const ClipSpec& own = spec_.clips[k];
    if (clip.id != own.id) fail(k, "id", quoted(clip.id), quoted(own.id) + ", as in the config");
    if (clip.of_flight != own.of_flight)
      fail(k, "of_flight", quoted(clip.of_flight), quoted(own.of_flight) + ", for a clip of the config");
    if (clip.frames != own.frames)
      fail(k, "frames", std::to_string(clip.frames), fmt::format("{}, as in the config", own.frames));
  }

  static std::string quoted(const std::string& text) { return brief(Json(text)); }

  const DatasetSpec& spec_;
  const std::string& name_;
};

}  // namespace

Json planned_part(const ResolvedConfig& config) {
  const Json& all = config.document;
  const DatasetSpec& spec = config.spec;
  Json scene = all.at("scene");
  scene.erase("temperatures");
  Json render = {{"view_margin_px", spec.view_margin_px},
                 {"posed_actors", all.at("render").at("posed_actors")}};
  return {{"name", all.at("name")},
          {"seed", all.at("seed")},
          {"scene", std::move(scene)},
          {"camera", to_json(spec.settings->camera)},
          {"render", std::move(render)},
          {"clips", planned_entries(all.at("clips"), spec.clips, spec.settings->camera)},
          {"flights", planned_entries(all.at("flights"), spec.flights, spec.settings->camera)}};
}

DatasetPlan plan_of(const Json& document, const std::string& name, const Assets& assets) {
  Json checked = document;
  const std::vector<std::string> faults = check_and_fill(checked, assets.schema("plan"));
  if (!faults.empty()) throw DataError(name + ": " + faults.front());
  const Json& outline = checked.at("outline");
  DatasetPlan plan{.clips = {},
                   .cover_shares = outline.at("covers"),
                   .actor_materials = outline.at("actors"),
                   .config = std::move(checked.at("config")),
                   .files = checked.at("files")};
  for (const Json& clip : checked.at("clips")) plan.clips.push_back(clip_of(clip));
  return plan;
}

ResolvedConfig with_flights_cut(ResolvedConfig config, const DatasetPlan& plan, const std::string& name) {
  ClipCheck(config.spec, name).check(plan.clips);
  std::vector<ClipSpec> clips = config.spec.clips;
  for (std::size_t k = clips.size(); k < plan.clips.size(); ++k) {
    const ClipPlan& clip = plan.clips[k];
    clips.push_back(config.spec.flight(clip.of_flight)
                        ->cut({.id = clip.id,
                               .frames = clip.frames,
                               .frame_rate_hz = clip.frame_rate_hz,
                               .start_s = clip.start_s}));
  }
  return with_clips(std::move(config), std::move(clips));
}

}  // namespace thermal
