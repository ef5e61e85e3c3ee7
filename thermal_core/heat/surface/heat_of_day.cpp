#include "heat/surface/heat_of_day.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/parallel.h"

namespace thermal {
namespace {

const std::vector<double> kViewNodes = {0.1, 0.4, 0.75, 1};
const std::vector<double> kSunlitNodes = {0, 0.5, 1};
const std::vector<double> kMoistureNodes = {0, 0.1, 0.25, 0.5, 0.75, 1};
const std::vector<double> kDepthNodesM = {0, 0.1, 0.25, 0.5, 1, 2};
const std::vector<double> kOne = {1};

template <typename Properties>
bool varies(const ByMoisture<Properties>& states) {
  return states[0] != states[1] || states[1] != states[2];
}

HeatNodes nodes_of(const MaterialHeat& heat) {
  if (const auto* ground = std::get_if<GroundHeat>(&heat)) {
    return {.sky_view = kViewNodes,
            .sunlit = kSunlitNodes,
            .moisture = varies(ground->states) ? kMoistureNodes : kOne};
  }
  if (const auto* leaves = std::get_if<LeavesHeat>(&heat)) {
    return {.sky_view = kViewNodes,
            .sunlit = leaves->is_cover ? kSunlitNodes : kOne,
            .moisture = varies(leaves->states) ? kMoistureNodes : kOne};
  }
  const bool is_water = !std::get<SlabHeat>(heat).is_body;
  return {.sky_view = kViewNodes,
          .sunlit = kSunlitNodes,
          .moisture = is_water ? kDepthNodesM : kOne,
          .is_water = is_water};
}

OrientationFit fit_of(const MaterialHeat& heat) {
  if (const auto* ground = std::get_if<GroundHeat>(&heat))
    return ground->is_body ? OrientationFit::of_bodies() : OrientationFit::of_ground();
  if (const auto* leaves = std::get_if<LeavesHeat>(&heat))
    return leaves->is_cover ? OrientationFit::of_ground() : OrientationFit::of_level();
  return std::get<SlabHeat>(heat).is_body ? OrientationFit::of_bodies() : OrientationFit::of_level();
}

/// Position of a value among rising nodes: the node below, and the share of the next one.
struct Between {
  std::size_t node = 0;
  double share = 0;
};

Between between_nodes(const std::vector<double>& nodes, double value) noexcept {
  if (nodes.size() == 1 || !(value > nodes.front())) return {};
  std::size_t node = 0;
  while (node + 2 < nodes.size() && value >= nodes[node + 1]) ++node;
  const double share = (value - nodes[node]) / (nodes[node + 1] - nodes[node]);
  return {.node = node, .share = std::min(share, 1.0)};
}

/// Weights of the nodes of an axis at a value.
using Weights = std::array<double, 6>;

/// Of the polynomial through all nodes.
Weights smooth_weights(const std::vector<double>& nodes, double value) noexcept {
  Weights weights{};
  const double inside = nodes.size() == 1 ? nodes.front() : std::clamp(value, nodes.front(), nodes.back());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) weight *= (inside - nodes[j]) / (nodes[i] - nodes[j]);
    }
    weights[i] = weight;
  }
  return weights;
}

/// Level ground at a node; leaves deep in a crown get the same share of sun as of sky.
SurfaceExposure level_exposure(const HeatNodes& nodes, std::size_t node) {
  const std::size_t moistures = nodes.moisture.size();
  const std::size_t suns = nodes.sunlit.size();
  const double sky_view = nodes.sky_view[node / (moistures * suns)];
  return {.normal = {0, 0, 1},
          .sky_view = sky_view,
          .sunlit = suns == 1 ? sky_view : nodes.sunlit[node / moistures % suns],
          .moisture = nodes.is_water ? 0 : nodes.moisture[node % moistures],
          .depth_m = nodes.is_water ? nodes.moisture[node % moistures] : 1};
}

/// Properties of a depth of water, mixed all through, from those of one metre. The heat uptake of its wet bed in a day
/// counts as 6 cm more: 2.8 MJ/(m^3 K) times the penetration depth of 0.13 m, over sqrt(2).
SlabProperties at_depth(SlabProperties metre, double depth_m) noexcept {
  constexpr double kBedM = 0.06;
  metre.heat_capacity_j_m2_k *= (depth_m + kBedM) / (1 + kBedM);
  return metre;
}

/// Index of the level column in full sun below an open sky.
std::size_t open_node(const HeatNodes& nodes, std::size_t moisture) {
  return (nodes.sky_view.size() * nodes.sunlit.size() - 1) * nodes.moisture.size() + moisture;
}

const GroundHeat& ground_of(const std::map<std::string, MaterialHeat>& materials, const std::string& name,
                            const std::string& user) {
  const auto found = materials.find(name);
  const auto* ground = found == materials.end() ? nullptr : std::get_if<GroundHeat>(&found->second);
  if (ground != nullptr) return *ground;
  throw ConfigError(fault(user, fmt::format("\"{}\"", name), "", "a material with heat.ground"));
}

/// What leaves grow on; soil for all other materials.
const GroundHeat& ground_below(const std::map<std::string, MaterialHeat>& materials,
                               const std::string& name) {
  if (const auto* leaves = std::get_if<LeavesHeat>(&materials.at(name)))
    return ground_of(materials, leaves->ground, "material " + name + ": heat.leaves.ground");
  return ground_of(materials, "soil", "materials of heat");
}

}  // namespace

double moisture_after_rain(double days) noexcept { return 0.7 * std::exp(-days / 6); }

SurfaceDay day_of(const MaterialHeat& heat, const GroundHeat& soil, const SurfaceExposure& exposure,
                  const DayAround& around, const HeatSteps& steps, const SurfaceDay* like) {
  const Site site = {.normal = exposure.normal, .sky_view = exposure.sky_view, .sunlit = exposure.sunlit};
  if (const auto* ground = std::get_if<GroundHeat>(&heat))
    return day_of_ground(at_moisture(ground->states, exposure.moisture), site, around, steps, like);
  if (const auto* slab = std::get_if<SlabHeat>(&heat))
    return day_of_slab(slab->is_body ? slab->properties : at_depth(slab->properties, exposure.depth_m), site,
                       around, steps, like);
  const auto& leaves = std::get<LeavesHeat>(heat);
  const CanopyProperties canopy = at_moisture(leaves.states, exposure.moisture);
  CanopyDay day = day_of_canopy(canopy, at_moisture(soil.states, exposure.moisture), site, around, steps,
                                leaves.is_cover ? Stand::cover : Stand::alone, like);
  if (!leaves.is_cover) return std::move(day.leaves);
  for (std::size_t i = 0; i < day.leaves.surface_k.size(); ++i) {
    double& seen_k = day.leaves.surface_k[i];
    seen_k = seen_from_above_k(canopy, seen_k, day.ground.surface_k[i]);
  }
  return std::move(day.leaves);
}

MaterialMoment::MaterialMoment(HeatNodes nodes, std::vector<double> level_k,
                               std::vector<Orientation> slopes_k)
    : nodes_(std::move(nodes)), level_k_(std::move(level_k)), slopes_k_(std::move(slopes_k)) {
  assert(level_k_.size() == nodes_.count() && slopes_k_.size() == nodes_.moisture.size());
}

double MaterialMoment::level_k(const SurfaceExposure& exposure) const noexcept {
  const Weights view = smooth_weights(nodes_.sky_view, exposure.sky_view);
  const Weights sun = smooth_weights(nodes_.sunlit, exposure.sunlit);
  const Between wet = between_nodes(nodes_.moisture, nodes_.moisture_at(exposure));
  const std::size_t next = nodes_.moisture.size() > 1 ? 1 : 0;
  double sum_k = 0;
  for (std::size_t v = 0; v < nodes_.sky_view.size(); ++v) {
    for (std::size_t s = 0; s < nodes_.sunlit.size(); ++s) {
      const double* by_moisture =
          &level_k_[(v * nodes_.sunlit.size() + s) * nodes_.moisture.size() + wet.node];
      sum_k += view[v] * sun[s] * (by_moisture[0] + wet.share * (by_moisture[next] - by_moisture[0]));
    }
  }
  return sum_k;
}

Orientation MaterialMoment::orientation(const SurfaceExposure& exposure) const noexcept {
  const Between wet = between_nodes(nodes_.moisture, nodes_.moisture_at(exposure));
  const std::size_t next = nodes_.moisture.size() > 1 ? 1 : 0;
  const double sunlit = std::clamp(exposure.sunlit, 0.0, 1.0);
  Orientation sum;
  sum.sun = slopes_k_[wet.node].sun;
  for (std::size_t i = 0; i < Orientation::kTerms; ++i) {
    const double low = slopes_k_[wet.node].coefficients[i];
    const double high = slopes_k_[wet.node + next].coefficients[i];
    sum.coefficients[i] = sunlit * (low + wet.share * (high - low));
  }
  sum.coefficients[0] += level_k(exposure);
  return sum;
}

double MaterialMoment::temperature_k(const SurfaceExposure& exposure) const noexcept {
  return orientation(exposure).at(exposure.normal);
}

HeatOfDay::HeatOfDay(const DayWeather& weather, std::map<std::string, MaterialHeat> materials,
                     const HeatSteps& steps)
    : weather_(weather), materials_(std::move(materials)), steps_(steps) {
  weather.validate();
  forcing_ = forcing_of_day(weather, steps.per_day);
  for (const auto& [name, heat] : materials_) (void)ground_below(materials_, name);
  const GroundHeat& soil = ground_of(materials_, "soil", "materials of heat");
  const double moisture = moisture_after_rain(weather.rain_days_ago);
  ground_ = day_of(soil, soil, {.moisture = moisture}, {.forcing = forcing_}, steps);
}

void HeatOfDay::compute(const std::set<std::string>& materials) const {
  struct Series {
    const std::string* material;
    Columns* columns;
    std::size_t moisture;
  };
  std::vector<Series> all;
  for (const std::string& name : materials) {
    const auto found = materials_.find(name);
    if (found == materials_.end() || columns_.contains(name)) continue;
    const MaterialHeat& heat = found->second;
    Columns& columns = columns_.emplace(name, Columns{nodes_of(heat), fit_of(heat), {}, {}}).first->second;
    const std::size_t moistures = columns.nodes.moisture.size();
    columns.level.resize(columns.nodes.count());
    columns.slopes.resize((columns.fit.directions().size() - 1) * moistures);
    for (std::size_t m = 0; m < moistures; ++m) all.push_back({&found->first, &columns, m});
  }
  parallel_for(all.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) compute(*all[i].material, all[i].moisture, *all[i].columns);
  });
}

/// Each column starts as the one before it ended.
void HeatOfDay::compute(const std::string& material, std::size_t moisture, Columns& columns) const {
  const MaterialHeat& heat = materials_.at(material);
  const GroundHeat& soil = ground_below(materials_, material);
  const DayAround around = {.forcing = forcing_, .ground_k = ground_.surface_k};
  const HeatNodes& nodes = columns.nodes;
  const SurfaceDay* before = nullptr;
  const auto fill = [&](const SurfaceExposure& exposure, SurfaceDay& day) {
    day = day_of(heat, soil, exposure, around, steps_, before);
    before = &day;
  };
  for (std::size_t i = moisture; i < columns.level.size(); i += nodes.moisture.size())
    fill(level_exposure(nodes, i), columns.level[i]);
  const std::size_t slopes = columns.fit.directions().size() - 1;
  for (std::size_t i = 0; i < slopes; ++i) {
    fill({.normal = columns.fit.directions()[1 + i], .moisture = nodes.moisture[moisture]},
         columns.slopes[moisture * slopes + i]);
  }
}

MaterialMoment HeatOfDay::moment_of(const Columns& columns, double solar_h, const EastNorthUp& sun) {
  std::vector<double> level_k;
  for (const SurfaceDay& day : columns.level) level_k.push_back(day.at_k(solar_h));
  const std::size_t slopes = columns.fit.directions().size() - 1;
  std::vector<Orientation> slopes_k;
  std::vector<double> excess_k(slopes + 1);
  for (std::size_t m = 0; m < columns.nodes.moisture.size(); ++m) {
    const double open_k = level_k[open_node(columns.nodes, m)];
    for (std::size_t d = 0; d < slopes; ++d)
      excess_k[1 + d] = columns.slopes[m * slopes + d].at_k(solar_h) - open_k;
    slopes_k.push_back(columns.fit.fit(excess_k, sun));
  }
  return {columns.nodes, std::move(level_k), std::move(slopes_k)};
}

HeatOfMoment HeatOfDay::at(double solar_h, const std::set<std::string>& materials) const {
  HeatOfMoment moment = {.forcing = forcing_at(weather_, solar_h),
                         .ground_k = ground_.at_k(solar_h),
                         .ground_moisture = moisture_after_rain(weather_.rain_days_ago),
                         .sun = sun_of_surfaces(weather_.sun, solar_h),
                         .materials = {}};
  const std::scoped_lock lock(mutex_);
  // While it waits, this thread must not take on work that needs columns itself.
  run_isolated([&] { compute(materials); });
  for (const std::string& name : materials) {
    if (const auto found = columns_.find(name); found != columns_.end())
      moment.materials.emplace(name, moment_of(found->second, solar_h, moment.sun));
  }
  return moment;
}

std::size_t HeatOfDay::columns() const {
  const std::scoped_lock lock(mutex_);
  std::size_t count = 0;
  for (const auto& [name, columns] : columns_) count += columns.level.size() + columns.slopes.size();
  return count;
}

}  // namespace thermal
