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

double least_netd_k(const DatasetSpec& spec) {
  double netd_k = spec.clips.empty() ? spec.settings->netd_k : HUGE_VAL;
  for (const ClipSpec& clip : spec.clips) netd_k = std::min(netd_k, clip.settings->netd_k);
  return netd_k;
}

}  // namespace

SceneOutline empty_outline(const DatasetSpec& spec) {
  SceneOutline outline = {.covers = {},
                          .conditions = {},
                          .response = spec.settings->sensor.response,
                          .netd_k = least_netd_k(spec)};
  if (spec.heat_balance) return outline;
  const std::pair<std::string, TermChoice> of_heat[] = {{"place", spec.settings->terms.place},
                                                        {"facing", spec.settings->terms.facing}};
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

ViewingConditions::Conditions& ViewingConditions::conditions_of(const ClipSpec& clip) {
  const auto [place, is_new] = places_.try_emplace({clip.season, clip.settings.get()}, nights_.size());
  if (!is_new) return nights_[place->second];
  Conditions viewing = {.season = clip.season,
                        .weather = clip.weather_at(0, spec_.heat_balance),  // the same for clips under one
                        .response = clip.settings->sensor.response};
  const auto found = std::ranges::find_if(nights_, [&viewing](const Conditions& one) {
    return one.weather == viewing.weather && one.response == viewing.response;
  });
  place->second = static_cast<std::size_t>(found - nights_.begin());
  if (found == nights_.end()) nights_.push_back(std::move(viewing));
  return nights_[place->second];
}

void ViewingConditions::add(const ClipSpec& clip, double mean_height_m, double mean_look_angle_deg,
                            const CameraIntrinsics& camera) {
  const double height_m = std::max(1.0, std::round(mean_height_m));
  const double look_angle_deg = std::round(mean_look_angle_deg);
  Conditions& viewing = conditions_of(clip);
  const bool is_new = viewing.seen.insert({height_m, look_angle_deg, camera.fx_px, camera.fy_px}).second;
  if (!is_new) return;  // many clips have similar flights
  const double angle = look_angle_deg * std::numbers::pi / 180;
  add(clip, directions_from(height_m, angle, camera));
}

void ViewingConditions::add(const ClipSpec& clip,
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
  if (!spec_.heat_balance) return conditions;
  parallel_for(conditions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) heat_conditions(outline.covers, library, conditions[k]);
  });
  return conditions;
}

KeptTerms::KeptTerms(const DatasetSpec& spec, const SceneOutline& outline) : choices_{spec.settings->terms} {
  for (const ClipSpec& clip : spec.clips) {
    const TermChoices& own = clip.settings->terms;
    if (std::ranges::find(choices_, own) == choices_.end()) choices_.push_back(own);
  }
  budgets_ = weigh_terms(outline, choices_);
}

const Terms& KeptTerms::of(const ClipSpec& clip) const {
  const auto found = std::ranges::find(choices_, clip.settings->terms);
  return budgets_.at(static_cast<std::size_t>(found - choices_.begin())).kept;
}

namespace {

/// Empty for the published model.
std::optional<PhysicsSettings> physics_of(const DatasetSpec& spec, const ClipSpec& clip, const Terms& terms,
                                          HeatDays& heat, std::shared_ptr<const GroundMaps> ground) {
  if (!spec.physical) return std::nullopt;
  PhysicsSettings physics = {.terms = terms,
                             .weather = clip.weather_at(clip.middle_s(), spec.heat_balance),
                             .response = clip.settings->sensor.response,
                             .seed = spec.seed};
  if (spec.heat_balance)
    physics.heat = HeatSettings{.day = heat.of(physics.weather.day), .ground = std::move(ground)};
  return physics;
}

}  // namespace

ClipTask task_of(const DatasetSpec& spec, const ClipSpec& clip, const Terms& terms, HeatDays& heat,
                 std::shared_ptr<const GroundMaps> ground) {
  return {.variant = "",
          .clip = clip,
          .seed = spec.seed,
          .physics = physics_of(spec, clip, terms, heat, std::move(ground)),
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

SceneOutline outline_of(const DatasetSpec& spec, const DatasetPlan& plan, const MaterialLibrary& materials) {
  constexpr double kWalkingMPerS = 1.5;  // of actors
  SceneOutline outline = empty_outline(spec);
  for (const auto& [name, share] : plan.cover_shares)
    outline.covers.push_back({.material = &materials.find(name, "plan: covers"), .share = share});
  if (spec.engine != Engine::embree &&
      std::ranges::any_of(outline.covers, [](const auto& cover) { return cover.material->mirrors(); }))
    outline.impossible.emplace("mirror", "the engine blender does not trace what water mirrors");
  add_actors({plan.actor_materials.begin(), plan.actor_materials.end()}, materials, outline);
  ViewingConditions conditions(spec);
  for (std::size_t k = 0; k < plan.clips.size(); ++k) {
    const ClipPlan& planned = plan.clips[k];
    const ClipSpec& clip = spec.clips[k];
    const ClipSettings& settings = *clip.settings;
    conditions.add(clip, planned.mean_agl_m, planned.mean_look_angle_deg, settings.camera);
    const double px_per_s =
        settings.camera.fx_px * (clip.speed_m_s + kWalkingMPerS) / std::max(1.0, planned.mean_agl_m);
    outline.smear_px = std::max(outline.smear_px, px_per_s * settings.sensor.time_constant_s);
  }
  outline.conditions = conditions.list(outline, materials);
  return outline;
}

}  // namespace thermal
