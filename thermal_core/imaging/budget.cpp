#include "imaging/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"

namespace thermal {
namespace {

/// A shift and the fraction of the pictures it applies to.
struct Weighted {
  double value = 0;
  double weight = 0;
};

/// Weighted quantile: the value below which a fraction of the weight lies.
double percentile(const std::vector<Weighted>& sorted, double share) {
  double total = 0;
  for (const Weighted& entry : sorted) total += entry.weight;
  double below = 0;
  for (const Weighted& entry : sorted) {
    below += entry.weight;
    if (below >= share * total) return entry.value;
  }
  return sorted.back().value;
}

double spread(std::vector<Weighted> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  return percentile(values, 0.95) - percentile(values, 0.05);
}

/// Radiance of one material under one set of conditions, term by term.
class MaterialModel {
 public:
  /// @param air  in the sensor's response; must outlive this object
  MaterialModel(const Material& material, const SceneOutline::Conditions& viewing,
                const SpectralResponse& response, const BandAir& air)
      : material_(material),
        weather_(viewing.weather),
        temperature_k_(viewing.temperature_k(material, "")),
        air_(air),
        blackbody_(response),
        band_(response, material.spectrum.value_or(EmissivitySpectrum(
                            viewing.heated_k.empty() ? material.emissivity : material.measured_emissivity))),
        air_radiance_(blackbody_.radiance(weather_.air.temperature_k)),
        emitted_as_air_(band_.radiance(weather_.air.temperature_k)) {}

  [[nodiscard]] double apparent_k(double radiance) const { return blackbody_.temperature(radiance); }
  [[nodiscard]] double temperature_k() const { return temperature_k_; }
  [[nodiscard]] double emitted(double temperature_k) const { return band_.radiance(temperature_k); }

  /// Emission and reflection at an angle; a fall-off factor of 1 ignores the angle.
  [[nodiscard]] double with_sky(double factor, double cosine) const {
    const double sky = material_.mirrors() ? air_.sky_emissivity(cosine) : air_.sky_emissivity();
    return factor * emitted(temperature_k()) + (air_radiance_ - factor * emitted_as_air_) * sky;
  }

  /// The same for a surface that mirrors another, of some radiance.
  [[nodiscard]] double with_mirrored(double factor, double radiance) const {
    return factor * emitted(temperature_k()) +
           (air_radiance_ - factor * emitted_as_air_) * radiance / air_radiance_;
  }

  [[nodiscard]] double with_path(double radiance, double range_m) const {
    const double through = air_.path_transmittance(range_m);
    return through * radiance + (1 - through) * air_radiance_ + from_inversion(range_m);
  }

  /// Additional radiance of the path by an inversion.
  [[nodiscard]] double from_inversion(double range_m) const {
    const Air& air = weather_.air;
    if (!(air.inversion_k > 0)) return 0;
    return (blackbody_.radiance(air.temperature_k + air.inversion_k) - air_radiance_) *
           air_.mean_path_absorption(range_m);
  }

 private:
  const Material& material_;
  const Weather& weather_;
  double temperature_k_;
  const BandAir& air_;
  BandRadiance blackbody_;
  BandRadiance band_;
  double air_radiance_;
  double emitted_as_air_;
};

/// Share of the pixels of water, at an angle of incidence, that mirror its shore: reflected rays reach the far shore
/// below the height of the objects there. For a disc, 2 distance / (pi radius). Both lengths are estimates.
double shore_share(double cosine) {
  constexpr double kHeightM = 4;
  constexpr double kRadiusM = 50;
  const double distance_m = kHeightM * std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  return std::min(1.0, 2 * distance_m / (std::numbers::pi * kRadiusM));
}

/// Shifts by each term under one set of conditions.
class ConditionShifts {
 public:
  ConditionShifts(const SceneOutline& outline, const SceneOutline::Conditions& viewing)
      : outline_(outline),
        conditions_(viewing),
        response_(viewing.response ? *viewing.response : outline.response),
        air_(viewing.weather.air, response_) {
    for (const SceneOutline::Cover& cover : outline.covers) {
      add_cover(cover);
      if (cover.material->mirrors()) add_mirror(cover);
    }
    add_smear();
    add_falloff();
  }

  [[nodiscard]] TermEffect effect(const TermInfo& term) const {
    const std::vector<Weighted>& all = shifts_.at(index_of(term.name));
    return {.name = std::string(term.name),
            .choice = TermChoice::automatic,
            .spread_k = std::max(spread(all), spread(on_actors_.at(index_of(term.name)))),
            .actor_shift_k = actor_shifts_.at(index_of(term.name)),
            .kept = false};
  }

 private:
  static std::size_t index_of(std::string_view name) {
    const auto found = std::find_if(std::begin(kTerms), std::end(kTerms),
                                    [name](const TermInfo& term) { return term.name == name; });
    return static_cast<std::size_t>(found - std::begin(kTerms));
  }

  void add(std::string_view term, double shift_k, double weight, bool actor) {
    const std::size_t index = index_of(term);
    shifts_.at(index).push_back({shift_k, weight});
    if (actor) actor_shifts_.at(index) = std::max(actor_shifts_.at(index), std::abs(shift_k));
  }

  /// Adds the shifts by exposures or directions of a cover. The percentiles of actors are over actors alone.
  void add_heat(std::string_view term,
                const std::map<std::string, std::vector<SceneOutline::ExposureShift>>& by_material,
                const SceneOutline::Cover& cover) {
    const auto found = by_material.find(cover.material->name);
    if (found == by_material.end()) return;
    for (const auto& [shift_k, share] : found->second) {
      add(term, shift_k, share * cover.share, cover.actor);
      if (cover.actor) on_actors_.at(index_of(term)).push_back({shift_k, share});
    }
  }

  [[nodiscard]] MaterialModel model_of(const SceneOutline::Cover& cover) const {
    return {*cover.material, conditions_, response_, air_};
  }

  void add_cover(const SceneOutline::Cover& cover) {
    const MaterialModel model = model_of(cover);
    add_heat("place", conditions_.by_exposure, cover);
    add_heat("facing", conditions_.facing, cover);
    add_variation(cover);
    add_parts(cover, model);
    const double direct_k = model.apparent_k(model.emitted(model.temperature_k()));
    const double share = cover.share / static_cast<double>(conditions_.view_directions.size());
    for (const SceneOutline::ViewDirection& direction : conditions_.view_directions) {
      const double sky = model.with_sky(1, direction.ground_cosine);
      const double sky_k = model.apparent_k(sky);
      const double factor = angular_factor(cover.material->angular, direction.ground_cosine);
      const double tilted_k = model.apparent_k(model.with_sky(factor, direction.ground_cosine));
      add("sky", sky_k - direct_k, share, cover.actor);
      add("angular", tilted_k - sky_k, share, cover.actor);
      add("path", model.apparent_k(model.with_path(sky, direction.range_m)) - sky_k, share, cover.actor);
    }
  }

  /// For water's pixels alone: those that mirror the sky are not shifted, the others mirror everything that is not
  /// water.
  void add_mirror(const SceneOutline::Cover& water) {
    const MaterialModel model = model_of(water);
    for (const SceneOutline::Cover& cover : outline_.covers) {
      if (cover.material->mirrors()) continue;
      const double mirrored = model_of(cover).with_sky(1, 1);
      for (const SceneOutline::ViewDirection& direction : conditions_.view_directions) {
        const double factor = angular_factor(water.material->angular, direction.ground_cosine);
        const double sky_k = model.apparent_k(model.with_sky(factor, direction.ground_cosine));
        const double shift_k = model.apparent_k(model.with_mirrored(factor, mirrored)) - sky_k;
        const double share = shore_share(direction.ground_cosine);
        add("mirror", shift_k, cover.share * share, false);
        add("mirror", 0, cover.share * (1 - share), false);
      }
    }
  }

  /// Quantiles of a normal distribution at 5, 15, … 95 % represent the field.
  void add_variation(const SceneOutline::Cover& cover) {
    constexpr double kQuantiles[] = {-1.645, -1.036, -0.674, -0.385, -0.126,
                                     0.126,  0.385,  0.674,  1.036,  1.645};
    for (const double quantile : kQuantiles) {
      add("variation", quantile * cover.material->variation.stddev_k, cover.share / std::size(kQuantiles),
          cover.actor);
    }
  }

  void add_parts(const SceneOutline::Cover& cover, const MaterialModel& model) {
    if (!cover.actor) return;
    const double mean_k = model.apparent_k(model.emitted(model.temperature_k()));
    for (const auto& [part, values] : cover.material->parts) {
      const double part_k = conditions_.temperature_k(*cover.material, part);
      add("parts", model.apparent_k(model.emitted(part_k)) - mean_k, 1, true);
    }
  }

  /// Apparent temperature without reflection and path.
  [[nodiscard]] double direct_k(const SceneOutline::Cover& cover) const {
    const MaterialModel model = model_of(cover);
    return model.apparent_k(model.emitted(model.temperature_k()));
  }

  /// At the borders of a surface with the mean ground, as many pixels lose contrast as the picture moves.
  void add_smear() {
    if (!(outline_.smear_px > 0)) return;
    double ground_k = 0;
    double shares = 0;
    for (const SceneOutline::Cover& cover : outline_.covers) {
      if (cover.actor) continue;
      ground_k += cover.share * direct_k(cover);
      shares += cover.share;
    }
    for (const SceneOutline::Cover& cover : outline_.covers) {
      if (!(shares > 0)) break;
      const double shift_k = std::abs(direct_k(cover) - ground_k / shares) * std::min(1.0, outline_.smear_px);
      for (const double value_k : {0.0, shift_k}) {
        add("smear", value_k, cover.share / 2, cover.actor);
        if (cover.actor) on_actors_.at(index_of("smear")).push_back({value_k, cover.share / 2});
      }
    }
  }

  /// The signal is unchanged; the noise grows.
  void add_falloff() {
    for (const SceneOutline::ViewDirection& direction : conditions_.view_directions) {
      add("falloff", outline_.netd_k * std::pow(direction.axis_cosine, -4), 1, false);
    }
  }

  const SceneOutline& outline_;
  const SceneOutline::Conditions& conditions_;
  const SpectralResponse& response_;
  BandAir air_;
  std::array<std::vector<Weighted>, std::size(kTerms)> shifts_;
  std::array<std::vector<Weighted>, std::size(kTerms)>
      on_actors_;  ///< those of actors again, for terms of actors alone
  std::array<double, std::size(kTerms)> actor_shifts_{};
};

std::string_view name_of(bool Terms::*term) {
  const auto* found = std::ranges::find(kTerms, term, &TermInfo::kept);
  return found->name;
}

bool is_kept(const TermEffect& effect, double netd_k) {
  if (effect.choice == TermChoice::on && !effect.impossible.empty())
    throw ConfigError(fault("terms." + effect.name, "on", "", "off or auto, because " + effect.impossible));
  if (effect.choice != TermChoice::automatic) return effect.choice == TermChoice::on;
  return effect.impossible.empty() && effect.spread_k > netd_k / 3;
}

/// Effects of all terms under the worst conditions, in the order of kTerms. Conditions are evaluated in parallel.
std::vector<TermEffect> effects_of(const SceneOutline& outline) {
  std::vector<std::vector<TermEffect>> of_nights(outline.conditions.size());
  parallel_for(of_nights.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const ConditionShifts viewing(outline, outline.conditions[k]);
      for (const TermInfo& term : kTerms) of_nights[k].push_back(viewing.effect(term));
    }
  });
  std::vector<TermEffect> worst;
  for (const TermInfo& term : kTerms) {
    TermEffect effect{.name = std::string(term.name)};
    for (const std::vector<TermEffect>& viewing : of_nights) {
      const TermEffect& one = viewing.at(worst.size());
      effect.spread_k = std::max(effect.spread_k, one.spread_k);
      effect.actor_shift_k = std::max(effect.actor_shift_k, one.actor_shift_k);
    }
    worst.push_back(std::move(effect));
  }
  return worst;
}

Budget decide(const SceneOutline& outline, const std::vector<TermEffect>& effects,
              const TermChoices& choices) {
  Budget budget;
  for (const TermInfo& term : kTerms) {
    TermEffect effect = effects.at(budget.effects.size());
    effect.choice = choices.*term.choice;
    const bool matters = effect.choice == TermChoice::on || effect.spread_k > 0;
    if (term.needed != nullptr && !(budget.kept.*term.needed) && matters)
      effect.impossible = "the term " + std::string(name_of(term.needed)) + " is off";
    if (const auto lacking = outline.impossible.find(effect.name); lacking != outline.impossible.end())
      effect.impossible = lacking->second;
    effect.kept = is_kept(effect, outline.netd_k);
    budget.kept.*term.kept = effect.kept;
    if (!effect.kept) budget.dropped_k += effect.spread_k;
    budget.effects.push_back(std::move(effect));
  }
  return budget;
}

}  // namespace

std::vector<Budget> weigh_terms(const SceneOutline& outline, const std::vector<TermChoices>& choices) {
  const std::vector<TermEffect> effects = effects_of(outline);
  std::vector<Budget> budgets;
  for (const TermChoices& one : choices) budgets.push_back(decide(outline, effects, one));
  return budgets;
}

Budget weigh_terms(const SceneOutline& outline, const TermChoices& choices) {
  return weigh_terms(outline, std::vector<TermChoices>{choices}).front();
}

double SceneOutline::Conditions::temperature_k(const Material& material, const std::string& part) const {
  const auto found = heated_k.find(material.name);
  if (found == heated_k.end()) return material.part_temperature_k(part, weather);
  const auto of_part = found->second.find(part);
  return of_part == found->second.end() ? found->second.at("") : of_part->second;
}

MaterialShift shift_of(const Material& material, const SceneOutline::Conditions& viewing, double range_m,
                       const SpectralResponse& response) {
  const BandAir air(viewing.weather.air, response);
  const MaterialModel model(material, viewing, response, air);
  const double direct_k = model.apparent_k(model.emitted(model.temperature_k()));
  const double sky = model.with_sky(1, 1);
  const double sky_k = model.apparent_k(sky);
  const double seen = model.with_path(sky, range_m);
  return {.sky_k = sky_k - direct_k,
          .path_k = model.apparent_k(seen) - sky_k,
          .inversion_k = model.apparent_k(seen) - model.apparent_k(seen - model.from_inversion(range_m))};
}

}  // namespace thermal
