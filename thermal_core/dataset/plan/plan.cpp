#include "dataset/plan/plan.h"

#include "base/error.h"
#include "io/assets.h"
#include "io/json/camera.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

Json without_season(const Json& flown) {
  Json entries = flown;
  for (Json& entry : entries) entry.erase("season");
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

/// A clip cut from a flight, in the form of a config.
Json to_document(const ClipPlan& clip, const Json& flight) {
  return {{"id", clip.id},
          {"of_flight", clip.of_flight},
          {"season", flight.at("season")},
          {"start_s", clip.start_s},
          {"frames", clip.frames},
          {"frame_rate_hz", clip.frame_rate_hz},
          {"flight", flight.at("flight")}};
}

}  // namespace

Json planned_part(const Config& config) {
  const Json& all = config.resolved;
  return {{"name", all.at("name")},
          {"seed", all.at("seed")},
          {"scene", all.at("scene")},
          {"camera", to_json(config.camera)},
          {"render", {{"view_margin_px", config.view_margin_px}}},
          {"clips", without_season(all.at("clips"))},
          {"flights", without_season(all.at("flights"))}};
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

Config with_flights_cut(Config config, const DatasetPlan& plan) {
  std::map<std::string, const Json*> flights;
  for (const Json& flight : config.resolved.at("flights")) flights[flight.at("id")] = &flight;
  Json cut = Json::array();
  for (const ClipPlan& clip : plan.clips)
    if (!clip.of_flight.empty()) cut.push_back(to_document(clip, *flights.at(clip.of_flight)));
  return with_clips(std::move(config), cut);
}

}  // namespace thermal
