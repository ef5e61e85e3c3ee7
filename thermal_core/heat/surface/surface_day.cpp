#include "heat/surface/surface_day.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "heat/weather/air_profile.h"
#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

double mean_air_k(const DayAround& around) {
  double sum = 0;
  for (const Forcing& forcing : around.forcing) sum += forcing.air_k;
  return sum / static_cast<double>(around.forcing.size());
}

double step_s(const DayAround& around) { return 86400.0 / static_cast<double>(around.forcing.size()); }

/// Ground as it advances from step to step.
class GroundBody {
 public:
  /// `surface_k`: at the start. `like`: whose layers it starts with; null: all have that temperature.
  GroundBody(const GroundProperties& properties, const Layers& layers, const DayAround& around,
             double surface_k, const SurfaceDay* like)
      : balance_(properties.surface),
        conduction_(properties, layers, step_s(around), surface_k),
        day_sum_k_(conduction_.layers_k().size()),
        surface_k_(surface_k),
        before_k_(surface_k) {
    if (like != nullptr && like->layers_k.size() == day_sum_k_.size())
      conduction_.set_layers_k(like->layers_k);
  }

  /// Also extrapolates the surface's temperature from the step before, as a first guess.
  void prepare() {
    uptake_ = conduction_.prepare();
    const double before_k = std::exchange(before_k_, surface_k_);
    surface_k_ += surface_k_ - before_k;
  }

  /// Surface temperature with this incoming radiation in the prepared step.
  double balance(const Forcing& forcing, const Incoming& incoming) {
    surface_k_ = balance_.balanced_k(forcing, incoming, uptake_, surface_k_);
    return surface_k_;
  }

  double finish() {
    const double flux = conduction_.finish(surface_k_);
    surface_sum_k_ += surface_k_;
    for (std::size_t i = 0; i < day_sum_k_.size(); ++i) day_sum_k_[i] += conduction_.layers_k()[i];
    return flux;
  }

  [[nodiscard]] double surface_k() const { return surface_k_; }
  [[nodiscard]] const std::vector<double>& layers_k() const { return conduction_.layers_k(); }

  /// Moves each layer to the surface's daily mean, which all depths have on a day that repeats itself.
  void end_day(std::size_t steps, bool settle) {
    std::vector<double> layers_k = conduction_.layers_k();
    for (std::size_t i = 0; i < layers_k.size(); ++i) {
      layers_k[i] += (surface_sum_k_ - day_sum_k_[i]) / static_cast<double>(steps);
      day_sum_k_[i] = 0;
    }
    surface_sum_k_ = 0;
    if (settle) conduction_.set_layers_k(layers_k);
  }

 private:
  SurfaceBalance balance_;
  Conduction conduction_;
  HeatUptake uptake_;
  std::vector<double> day_sum_k_;
  double surface_sum_k_ = 0;
  double surface_k_;
  double before_k_;  ///< a step before
};

/// Surfaces give off at least this much heat per kelvin, nearly all of it radiation.
constexpr double kLeastExchangeWM2K = 4;

/// Computes days until one repeats the day before. `step(i, day)` advances a body and fills day.surface_k[i]; it
/// returns the heat that went in. `end_day(settle)` may move the body nearer to its periodic state if `settle`.
/// `warm`: the first day starts from that of a similar surface, not from an even temperature, whose means say little.
template <typename Step, typename EndDay>
void settle(const HeatSteps& steps, std::span<SurfaceDay*> days, bool warm, const Step& step,
            const EndDay& end_day) {
  const int least = warm ? 2 : 3;
  const auto count = days.front()->surface_k.size();
  std::vector<std::vector<double>> before(days.size());
  for (int number = 1;; ++number) {
    for (std::size_t k = 0; k < days.size(); ++k) before[k] = days[k]->surface_k;
    double heat_j_s = 0;
    for (std::size_t i = 0; i < count; ++i) heat_j_s += step(i);
    double change_k = 0;
    for (std::size_t k = 0; k < days.size(); ++k) {
      for (std::size_t i = 0; i < count; ++i)
        change_k = std::max(change_k, std::abs(days[k]->surface_k[i] - before[k][i]));
    }
    const double closure_w_m2 = heat_j_s / static_cast<double>(count);
    const bool done = number >= least && change_k <= steps.settled_k &&
                      std::abs(closure_w_m2) <= kLeastExchangeWM2K * steps.settled_k;
    for (SurfaceDay* day : days) {
      day->days = number;
      day->unsettled_k = change_k;
      day->closure_w_m2 = closure_w_m2;
    }
    if (done || number >= steps.most_days) return;
    end_day(number >= least - 1);
  }
}

/// Finds the start value that a day also ends with, by the secant method on the days computed so far.
class FixedPoint {
 public:
  explicit FixedPoint(double begin) : begin_(begin) {}

  /// The value to begin the next day with, after one that ended with `end`.
  double next(double end) {
    constexpr double kNearlyOne = 0.9999;
    const double slope = begin_ == old_begin_ ? 0 : (end - old_end_) / (begin_ - old_begin_);
    old_begin_ = begin_;
    old_end_ = end;
    // After the first day, and where the secant is degenerate, the next day continues.
    begin_ = known_ ? begin_ + (end - begin_) / (1 - std::clamp(slope, 0.0, kNearlyOne)) : end;
    known_ = true;
    return begin_;
  }

 private:
  double begin_;
  double old_begin_ = 0;
  double old_end_ = 0;
  bool known_ = false;
};

/// The forcing with the air that is around leaves at a height.
std::vector<Forcing> forcing_at_height(const DayAround& around, double height_m) {
  std::vector<Forcing> raised(around.forcing.begin(), around.forcing.end());
  for (std::size_t i = 0; i < raised.size(); ++i)
    raised[i].air_k += StableAir(raised[i], around.ground_at_k(i)).warmer_k(height_m);
  return raised;
}

SurfaceDay first_day(const DayAround& around, const SurfaceDay* like) {
  if (like != nullptr) return {.surface_k = like->surface_k, .layers_k = {}};
  return {.surface_k = std::vector<double>(around.forcing.size(), mean_air_k(around)), .layers_k = {}};
}

}  // namespace

double SurfaceDay::at_k(double solar_h) const noexcept {
  const auto count = static_cast<double>(surface_k.size());
  const double position = (solar_h / 24 - std::floor(solar_h / 24)) * count;  // 0 is the last step's end
  const auto before = std::min(static_cast<std::size_t>(position), surface_k.size() - 1);
  const double from = surface_k[(before + surface_k.size() - 1) % surface_k.size()];
  return from + (position - static_cast<double>(before)) * (surface_k[before] - from);
}

SurfaceDay day_of_ground(const GroundProperties& properties, const Site& site, const DayAround& around,
                         const HeatSteps& steps, const SurfaceDay* like) {
  SurfaceDay day = first_day(around, like);
  GroundBody body(properties, steps.layers, around, day.surface_k.back(), like);
  SurfaceDay* days[] = {&day};
  settle(
      steps, days, like != nullptr,
      [&](std::size_t i) {
        const Forcing& forcing = around.forcing[i];
        body.prepare();
        day.surface_k[i] = body.balance(forcing, incoming_at(forcing, site, around.ground_at_k(i)));
        return body.finish();
      },
      [&](bool recentre) { body.end_day(around.forcing.size(), recentre); });
  day.layers_k = body.layers_k();
  return day;
}

SurfaceDay day_of_slab(const SlabProperties& properties, const Site& site, const DayAround& around,
                       const HeatSteps& steps, const SurfaceDay* like) {
  SurfaceDay day = first_day(around, like);
  SurfaceDay* days[] = {&day};
  const double stored = properties.heat_capacity_j_m2_k / step_s(around);
  const double behind = properties.behind_w_m2_k;
  const SurfaceBalance balance(properties.surface);
  double slab_k = day.surface_k.back();
  FixedPoint morning(slab_k);
  settle(
      steps, days, like != nullptr,
      [&](std::size_t i) {
        const Forcing& forcing = around.forcing[i];
        const Incoming incoming = incoming_at(forcing, site, around.ground_at_k(i));
        const HeatUptake uptake = {.slope_w_m2_k = stored + behind,
                                   .offset_w_m2 = stored * slab_k + behind * forcing.air_k};
        const double next_k = balance.balanced_k(forcing, incoming, uptake, slab_k);
        const double heat = stored * (next_k - slab_k);
        slab_k = day.surface_k[i] = next_k;
        return heat;
      },
      [&](bool) { slab_k = morning.next(slab_k); });
  return day;
}

CanopyDay day_of_canopy(const CanopyProperties& canopy, const GroundProperties& ground, const Site& site,
                        const DayAround& around, const HeatSteps& steps, Stand stand,
                        const SurfaceDay* like) {
  CanopyDay day = {.leaves = first_day(around, like), .ground = first_day(around, like)};
  double leaves_k = day.leaves.surface_k.back();
  GroundBody body(ground, steps.layers, around, leaves_k, like);
  SurfaceDay* days[] = {&day.leaves, &day.ground};
  const double stored = canopy.heat_capacity_j_m2_k * canopy.leaf_area_index / step_s(around);
  const LeafLayer layer(canopy, stand);
  const std::vector<Forcing> at_height = forcing_at_height(around, canopy.height_m);
  settle(
      steps, days, like != nullptr,
      [&](std::size_t i) {
        const Forcing& forcing = around.forcing[i];
        const Incoming above = incoming_at(at_height[i], site, around.ground_at_k(i));
        const Forcing among = layer.among(at_height[i], around.ground_at_k(i));
        const Incoming at_leaves = incoming_at(among, site, around.ground_at_k(i));
        body.prepare();
        const double old_k = leaves_k;
        const auto left_over = [&](double leaf_k) {
          const double ground_k = body.balance(forcing, layer.below(above, leaf_k));
          const SurfaceFlux flux = layer.flux(among, at_leaves, ground_k, leaf_k);
          return SurfaceFlux{flux.flux_w_m2 - stored * (leaf_k - old_k), flux.slope_w_m2_k - stored};
        };
        leaves_k = balanced_temperature_k(left_over, old_k);
        body.balance(forcing, layer.below(above, leaves_k));
        day.leaves.surface_k[i] = leaves_k;
        day.ground.surface_k[i] = body.surface_k();
        return body.finish() + stored * (leaves_k - old_k);
      },
      [&](bool recentre) { body.end_day(around.forcing.size(), recentre); });
  day.leaves.layers_k = day.ground.layers_k = body.layers_k();
  return day;
}

double seen_from_above_k(const CanopyProperties& canopy, double leaves_k, double ground_k) noexcept {
  const double emitted_w_m2 = std::lerp(blackbody_w_m2(ground_k), blackbody_w_m2(leaves_k), canopy.cover());
  return std::sqrt(std::sqrt(emitted_w_m2 / kStefanBoltzmann));
}

}  // namespace thermal
