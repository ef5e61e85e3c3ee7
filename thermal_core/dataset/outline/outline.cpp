#include "dataset/outline/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "imaging/typical_heat.h"

namespace thermal {
namespace {

/// Rays over the picture: a grid of five by five.
std::vector<SceneOutline::ViewDirection> directions_from(double height_m, double look_angle_rad,
                                                         const CameraIntrinsics& camera) {
  const double half_width = 0.5 * camera.width_px / camera.fx_px;
  const double half_height = 0.5 * camera.height_px / camera.fy_px;
  const double x_middle = (0.5 * camera.width_px - camera.cx_px) / camera.fx_px;
  const double y_middle = (0.5 * camera.height_px - camera.cy_px) / camera.fy_px;
  std::vector<SceneOutline::ViewDirection> view_directions;
  for (int row = -2; row <= 2; ++row) {
    for (int column = -2; column <= 2; ++column) {
      const double x = x_middle + half_width * column / 2;
      const double y = y_middle + half_height * row / 2;
      const double length = std::sqrt(x * x + y * y + 1);
      // Downward part of the ray (x, y, 1) of a camera pitched down by the look angle.
      const double down = (std::sin(look_angle_rad) + y * std::cos(look_angle_rad)) / length;
      if (down <= 0.01) continue;  // at the sky
      view_directions.push_back(
          {.range_m = height_m / down, .ground_cosine = down, .axis_cosine = 1 / length});
    }
  }
  return view_directions;
}

double least_netd_k(const Config& config) {
  double netd_k = config.clips.empty() ? config.netd_k : HUGE_VAL;
  for (const ClipConfig& clip : config.clips) netd_k = std::min(netd_k, settings_of(config, clip).netd_k);
  return netd_k;
}

}  // namespace

SceneOutline empty_outline(const Config& config) {
  SceneOutline outline = {
      .covers = {}, .conditions = {}, .response = config.sensor.response, .netd_k = least_netd_k(config)};
  if (config.heat_balance) return outline;
  const std::pair<std::string, TermChoice> of_heat[] = {{"place", config.terms.place},
                                                        {"facing", config.terms.facing}};
  for (const auto& [term, choice] : of_heat) {
    if (choice == TermChoice::on) outline.impossible.emplace(term, "temperatures are those of Table 1");
  }
  return outline;
}

void add_actors(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline) {
  for (const std::string& name : names) {
    outline.covers.push_back({.material = &materials.find(name, "species: material"),
                              .share = kActorShare / static_cast<double>(names.size()),
                              .actor = true});
  }
}

ViewingConditions::Conditions& ViewingConditions::conditions_of(const ClipConfig& clip) {
  const ClipSettings& settings = settings_of(config_, clip);
  const auto [place, is_new] = places_.try_emplace({clip.season, &settings}, nights_.size());
  if (!is_new) return nights_[place->second];
  Conditions viewing = {.season = clip.season,
                        .weather = weather_at_start(config_, clip),
                        .response = settings.sensor.response};
  const auto found = std::ranges::find_if(nights_, [&viewing](const Conditions& one) {
    return one.weather == viewing.weather && one.response == viewing.response;
  });
  place->second = static_cast<std::size_t>(found - nights_.begin());
  if (found == nights_.end()) nights_.push_back(std::move(viewing));
  return nights_[place->second];
}

void ViewingConditions::add(const ClipConfig& clip, double mean_height_m, double mean_look_angle_deg,
                            const CameraIntrinsics& camera) {
  const double height_m = std::max(1.0, std::round(mean_height_m));
  const double look_angle_deg = std::round(mean_look_angle_deg);
  Conditions& viewing = conditions_of(clip);
  const bool is_new = viewing.seen.insert({height_m, look_angle_deg, camera.fx_px, camera.fy_px}).second;
  if (!is_new) return;  // many clips have similar flights
  const double angle = look_angle_deg * std::numbers::pi / 180;
  add(clip, directions_from(height_m, angle, camera));
}

void ViewingConditions::add(const ClipConfig& clip,
                            const std::vector<SceneOutline::ViewDirection>& view_directions) {
  auto& all = conditions_of(clip).view_directions;
  all.insert(all.end(), view_directions.begin(), view_directions.end());
}

std::vector<SceneOutline::Conditions> ViewingConditions::list(const SceneOutline& outline,
                                                              const MaterialLibrary& library) const {
  std::vector<SceneOutline::Conditions> conditions;
  for (const Season season : {Season::winter, Season::summer})
    for (const Conditions& one : nights_)
      if (one.season == season)
        conditions.push_back(
            {.weather = one.weather, .response = one.response, .view_directions = one.view_directions});
  if (!config_.heat_balance) return conditions;
  parallel_for(conditions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) heat_conditions(outline.covers, library, conditions[k]);
  });
  return conditions;
}

KeptTerms::KeptTerms(const Config& config, const SceneOutline& outline) : choices_{config.terms} {
  for (const ClipConfig& clip : config.clips) {
    const TermChoices& own = settings_of(config, clip).terms;
    if (std::ranges::find(choices_, own) == choices_.end()) choices_.push_back(own);
  }
  budgets_ = weigh_terms(outline, choices_);
}

const Terms& KeptTerms::of(const ClipSettings& settings) const {
  const auto found = std::ranges::find(choices_, settings.terms);
  return budgets_.at(static_cast<std::size_t>(found - choices_.begin())).kept;
}

namespace {

/// Empty for the published model.
std::optional<PhysicsSettings> physics_of(const Config& config, const ClipConfig& clip, const Terms& terms,
                                          HeatDays& heat, std::shared_ptr<const GroundMaps> ground) {
  if (!config.physical) return std::nullopt;
  PhysicsSettings physics = {.terms = terms,
                             .weather = weather_of(config, clip),
                             .response = settings_of(config, clip).sensor.response,
                             .seed = config.seed};
  if (config.heat_balance)
    physics.heat = HeatSettings{.day = heat.of(physics.weather.day), .ground = std::move(ground)};
  return physics;
}

}  // namespace

ClipTask task_of(const Config& config, const ClipConfig& clip, const Terms& terms, HeatDays& heat,
                 std::shared_ptr<const GroundMaps> ground) {
  const ClipSettings& settings = settings_of(config, clip);
  return {.variant = "",
          .clip = clip,
          .seed = config.seed,
          .sensor = settings.sensor,
          .distortion = settings.distortion,
          .labels = settings.labels,
          .link = settings.link,
          .codec = settings.codec,
          .physics = physics_of(config, clip, terms, heat, std::move(ground)),
          .folder = {}};
}

Json to_json(const Budget& budget) {
  Json terms = Json::array();
  for (const TermEffect& effect : budget.effects) {
    terms.push_back({{"term", effect.name},
                     {"choice", choice_name(effect.choice)},
                     {"spread_mk", 1e3 * effect.spread_k},
                     {"actor_shift_mk", 1e3 * effect.actor_shift_k},
                     {"kept", effect.kept}});
    if (!effect.impossible.empty()) terms.back()["impossible"] = effect.impossible;
  }
  return {{"terms", std::move(terms)}, {"dropped_mk", 1e3 * budget.dropped_k}};
}

namespace {

constexpr double kWalkingMPerS = 1.5;  // of actors

/// Of a config's clips, those cut from its flights included: config files state them, or leave them at 12 m/s.
std::map<std::string, double> speeds_of_clips_m_s(const Config& config) {
  constexpr double kUsualMPerS = 12;
  std::map<std::string, double> speeds_m_s;
  for (const Json& clip : config.resolved.at("clips"))
    speeds_m_s[clip.at("id")] = clip.value(Json::json_pointer("/flight/speed_m_s"), kUsualMPerS);
  return speeds_m_s;
}

}  // namespace

SceneOutline outline_of(const Config& config, const DatasetPlan& plan, const MaterialLibrary& materials) {
  SceneOutline outline = empty_outline(config);
  for (const auto& [name, share] : plan.cover_shares)
    outline.covers.push_back({.material = &materials.find(name, "plan: covers"), .share = share});
  if (config.engine != Engine::embree &&
      std::ranges::any_of(outline.covers, [](const auto& cover) { return cover.material->mirrors(); }))
    outline.impossible.emplace("mirror", "the engine blender does not trace what water mirrors");
  add_actors({plan.actor_materials.begin(), plan.actor_materials.end()}, materials, outline);
  ViewingConditions conditions(config);
  std::map<std::string, const ClipConfig*> configs;
  for (const ClipConfig& clip : config.clips) configs[clip.id] = &clip;
  const std::map<std::string, double> speeds_m_s = speeds_of_clips_m_s(config);
  for (const ClipPlan& clip : plan.clips) {
    const ClipConfig& own = *configs.at(clip.id);
    const ClipSettings& settings = settings_of(config, own);
    conditions.add(own, clip.mean_agl_m, clip.mean_look_angle_deg, settings.camera);
    const double px_per_s =
        settings.camera.fx_px * (speeds_m_s.at(clip.id) + kWalkingMPerS) / std::max(1.0, clip.mean_agl_m);
    outline.smear_px = std::max(outline.smear_px, px_per_s * settings.sensor.time_constant_s);
  }
  outline.conditions = conditions.list(outline, materials);
  return outline;
}

}  // namespace thermal
