#include "imaging/scene_heat.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "heat/body/fire.h"
#include "heat/body/warm_ground.h"
#include "heat/weather/sun_memory.h"

namespace thermal {
namespace {

/// The variation field has five octaves, each 0.6 times as strong as the one before. Those down to two cells of the
/// maps are part of the maps; the field adds the finer ones.
struct SplitVariation {
  double map_stddev_k = 0;
  double fine_stddev_k = 0;
  double fine_length_m = 1;
};

SplitVariation split(const TemperatureVariation& variation, double cell_m) {
  constexpr double kRoughness2 = 0.36;
  constexpr int kOctaves = 5;
  double all = 0;
  double fine = 0;
  double strength = 1;
  double length_m = variation.correlation_length_m;
  SplitVariation result;
  for (int octave = 0; octave < kOctaves; ++octave, strength *= kRoughness2, length_m /= 2) {
    all += strength;
    if (length_m >= 2 * cell_m) continue;
    if (fine == 0) result.fine_length_m = length_m;
    fine += strength;
  }
  result.map_stddev_k = variation.stddev_k * std::sqrt(1 - fine / all);
  result.fine_stddev_k = variation.stddev_k * std::sqrt(fine / all);
  return result;
}

std::vector<float> sunlit_cells(const GroundMaps& maps, const DayWeather& day, double solar_h) {
  const auto found = std::ranges::find(maps.sunlit, day.sun, &SunlitHours::path);
  if (found == maps.sunlit.end()) return {};
  const SunMemory memory = sun_memory(day, solar_h);
  // Cells share few patterns of hours; low and high half of a pattern are looked up.
  constexpr std::size_t kHalf = 12;
  std::vector<float> low(1U << kHalf);
  std::vector<float> high(1U << kHalf);
  for (std::uint32_t bits = 0; bits < low.size(); ++bits) {
    low[bits] = sunlit_share(memory, bits);
    high[bits] = sunlit_share(memory, bits << kHalf);
  }
  std::vector<float> share(found->hours.size());
  std::ranges::transform(found->hours, share.begin(), [&](std::uint32_t hours) {
    return low[hours & 0xFFFU] + high[hours >> kHalf & 0xFFFU];
  });
  return share;
}

/// Ground around a fire. What it took up while the fire burnt, it gives back as a bed does.
WarmSpot fireside(const FirePlace& place, double later_s, const Surroundings& around) {
  constexpr double kReachM = 12;
  constexpr std::size_t kSteps = 96;
  const FireState state = fire_state(place, later_s);
  const GroundProperties ground;
  const double left =
      state.burning ? 1 : bed_share_left(state.fire.burning_s, std::max(1.0, state.since_s), WarmedGround());
  WarmSpot spot = {.x_m = place.place_m[0], .y_m = place.place_m[1], .reach = kReachM, .excess_k = {}};
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double distance_m = kReachM * static_cast<double>(step) / kSteps;
    const double warm_k = fireside_ground_k(state.fire, around, ground, around.ground_k, distance_m);
    spot.excess_k.push_back(static_cast<float>(left * (warm_k - around.ground_k)));
  }
  const float last_k = spot.excess_k.back();  // without a step at its end
  for (float& excess_k : spot.excess_k) excess_k = std::max(0.0F, excess_k - last_k);
  return spot;
}

/// Even below the body, and vague at its rim (estimate); none where the ground is warmer than an animal.
WarmSpot warm_bed(const WarmBed& bed, double later_s, double ground_k) {
  constexpr double kReach = 1.1;
  constexpr double kEven = 0.85;
  constexpr std::size_t kSteps = 44;
  const WarmedGround ground;
  const double excess_k = std::max(0.0, bed_excess_k({.time_s = bed.lain_s}, ground, ground_k)) *
                          bed_share_left(bed.lain_s, bed.left_s + later_s, ground);
  WarmSpot spot = {.x_m = bed.place_m[0],
                   .y_m = bed.place_m[1],
                   .heading_rad = bed.heading_rad,
                   .half_length_m = bed.half_m[0],
                   .half_width_m = bed.half_m[1],
                   .reach = kReach,
                   .excess_k = {}};
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double out = kReach * static_cast<double>(step) / kSteps;
    const double share = std::clamp((kReach - out) / (kReach - kEven), 0.0, 1.0);
    spot.excess_k.push_back(static_cast<float>(share * excess_k));
  }
  return spot;
}

WarmSpots warm_spots(const Manifest& manifest, const HeatOfMoment& moment) {
  const Surroundings around = {.forcing = moment.forcing, .ground_k = moment.ground_k};
  std::vector<WarmSpot> spots;
  for (const ManifestObject& object : manifest.objects) {
    if (object.fire) spots.push_back(fireside(*object.fire, middle_s(manifest), around));
  }
  for (const WarmBed& bed : manifest.beds)
    spots.push_back(warm_bed(bed, middle_s(manifest), moment.ground_k));
  return WarmSpots(std::move(spots));
}

/// The surfaces at a moment of a clip.
struct Moment {
  double later_h = 0;  ///< than the middle of the clip
  std::shared_ptr<const HeatedSurfaces> surfaces;
};

/// Two moments, between which temperatures follow straight lines.
struct Ends {
  Moment first;
  Moment last;

  [[nodiscard]] double hours() const noexcept { return last.later_h - first.later_h; }
  [[nodiscard]] double middle_h() const noexcept { return (first.later_h + last.later_h) / 2; }
};

/// Cuts a clip into spans.
class Spans {
 public:
  explicit Spans(std::function<Moment(double later_h)> moment_at) : moment_at_(std::move(moment_at)) {}

  [[nodiscard]] std::vector<Ends> of_clip(double hours) {
    if (!(hours > 0)) return {{moment_at_(0), moment_at_(0)}};
    constexpr int kMostHalvings = 4;
    cut({moment_at_(-hours / 2), moment_at_(hours / 2)}, kMostHalvings);
    return std::move(spans_);
  }

 private:
  void cut(const Ends& ends, int halvings) {
    constexpr float kBendK = 0.01F;
    const Moment middle = moment_at_(ends.middle_h());
    if (halvings == 0 || bend_k(ends, middle) <= kBendK) return spans_.push_back(ends);
    cut({ends.first, middle}, halvings - 1);
    cut({middle, ends.last}, halvings - 1);
  }

  /// How far open level surfaces are from a straight line.
  static float bend_k(const Ends& ends, const Moment& middle) {
    float most_k = 0;
    for (std::size_t i = 0; i < middle.surfaces->surfaces().size(); ++i) {
      const auto at_k = [i](const Moment& moment) {
        return moment.surfaces->surfaces()[i].middle.temperature_k;
      };
      most_k = std::max(most_k, std::abs(at_k(middle) - (at_k(ends.first) + at_k(ends.last)) / 2));
    }
    return most_k;
  }

  std::function<Moment(double later_h)> moment_at_;
  std::vector<Ends> spans_;
};

/// What an hour adds, and what is half-way between the ends.
void set_between(const SurfaceWarmth& first, const SurfaceWarmth& last, double hours,
                 HeatedSurface& surface) {
  const auto set = [per_hours = hours > 0 ? static_cast<float>(1 / hours) : 0.0F](
                       float from, float to, float& middle, float& per_h) {
    middle = from + (to - from) / 2;
    per_h = (to - from) * per_hours;
  };
  const auto set_all = [&set](const auto& from, const auto& to, auto& middle, auto& per_h) {
    for (std::size_t i = 0; i < from.size(); ++i) set(from[i], to[i], middle[i], per_h[i]);
  };
  SurfaceWarmth& middle = surface.middle;
  SurfaceWarmth& per_h = surface.per_h;
  set(first.temperature_k, last.temperature_k, middle.temperature_k, per_h.temperature_k);
  set_all(first.by_normal, last.by_normal, middle.by_normal, per_h.by_normal);
  set_all(first.sun, last.sun, middle.sun, per_h.sun);
  set_all(first.by_depth_k, last.by_depth_k, middle.by_depth_k, per_h.by_depth_k);
}

std::vector<HeatedSurface> surfaces_between(const Ends& ends) {
  const std::vector<HeatedSurface>& first = ends.first.surfaces->surfaces();
  const std::vector<HeatedSurface>& last = ends.last.surfaces->surfaces();
  std::vector<HeatedSurface> surfaces = first;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    set_between(first[i].middle, last[i].middle, ends.hours(), surfaces[i]);
  return surfaces;
}

/// Ground of a clip by its maps.
class GroundOfClip {
 public:
  GroundOfClip(const HeatSettings& settings, const Weather& weather, const Manifest& manifest,
               const SceneHeatTerms& terms, std::uint32_t seed)
      : settings_(settings), weather_(weather), manifest_(manifest), terms_(terms), seed_(seed) {}

  void add_to(const Ends& ends, HeatSpan& span) const {
    const std::vector<Cover>& covers = ends.first.surfaces->covers();
    for (HeatedSurface& surface : span.surfaces) {
      if (surface.cover >= 0) refine(*covers[static_cast<std::size_t>(surface.cover)].material, surface);
    }
    const std::vector<float> sunlit_first = sunlit_at(ends.first);
    const std::vector<float> sunlit_last = sunlit_at(ends.last);
    const GroundWarmth warmth = {.first = moment_of(ends.first, sunlit_first),
                                 .last = moment_of(ends.last, sunlit_last),
                                 .hours = ends.hours(),
                                 .open_moisture = ends.first.surfaces->moment().ground_moisture,
                                 .by_slope = terms_.facing};
    std::vector<CoverVariation> variations;
    for (const Cover& cover : covers) variations.push_back(map_variation(*cover.material));
    span.ground = std::make_unique<GroundTemperatures>(
        *settings_.ground, window_of(*settings_.ground, manifest_), variations, warmth, seed_);
  }

 private:
  /// Leaves to the field what the maps are too coarse for.
  void refine(const Material& material, HeatedSurface& surface) const {
    const SplitVariation variation = split_of(material);
    surface.variation_stddev_k = static_cast<float>(variation.fine_stddev_k);
    surface.per_correlation_length = static_cast<float>(1 / variation.fine_length_m);
  }

  [[nodiscard]] std::vector<float> sunlit_at(const Moment& moment) const {
    return sunlit_cells(*settings_.ground, settings_.day->weather(), weather_.solar_h + moment.later_h);
  }

  static GroundMoment moment_of(const Moment& moment, const std::vector<float>& sunlit) {
    GroundMoment ground = {.covers = {}, .sunlit = sunlit};
    for (const Cover& cover : moment.surfaces->covers())
      ground.covers.push_back(&moment.surfaces->moment().materials.at(cover.heat));
    return ground;
  }

  [[nodiscard]] SplitVariation split_of(const Material& material) const {
    return split(terms_.variation ? material.variation : TemperatureVariation{},
                 settings_.ground->size_m / static_cast<double>(settings_.ground->cells));
  }

  [[nodiscard]] CoverVariation map_variation(const Material& material) const {
    return {.stddev_k = split_of(material).map_stddev_k,
            .correlation_length_m = material.variation.correlation_length_m};
  }

  const HeatSettings& settings_;
  const Weather& weather_;
  const Manifest& manifest_;
  const SceneHeatTerms& terms_;
  std::uint32_t seed_;
};

double hours_of(const Manifest& manifest) {
  if (manifest.frames.empty()) return 0;
  return (manifest.frames.back().time_s - manifest.frames.front().time_s) / 3600;
}

}  // namespace

float SceneHeat::middle_k(std::size_t surface) const {
  const auto holds_middle = [](const HeatSpan& span) { return span.middle_h + span.hours / 2 >= 0; };
  const HeatSpan& span = *std::ranges::find_if(spans, holds_middle);
  const HeatedSurface& heated = span.surfaces.at(surface);
  return heated.middle.temperature_k - static_cast<float>(span.middle_h) * heated.per_h.temperature_k;
}

SceneHeat heat_of_scene(const std::vector<Surface>& surfaces, const std::vector<ActorState>& states,
                        const HeatSettings& settings, const Weather& weather, const Manifest& manifest,
                        const SceneHeatTerms& terms, std::uint32_t seed) {
  const auto moment_at = [&](double later_h) {
    return Moment{later_h, std::make_shared<const HeatedSurfaces>(surfaces, states, settings, weather,
                                                                  3600 * later_h, terms)};
  };
  SceneHeat heat = {.spans = {}, .spots = warm_spots(manifest, settings.day->at(weather.solar_h))};
  const GroundOfClip ground(settings, weather, manifest, terms, seed);
  for (const Ends& ends : Spans(moment_at).of_clip(hours_of(manifest))) {
    heat.spans.push_back({.middle_h = ends.middle_h(),
                          .hours = ends.hours(),
                          .surfaces = surfaces_between(ends),
                          .ground = nullptr});
    if (terms.place) ground.add_to(ends, heat.spans.back());
  }
  return heat;
}

}  // namespace thermal
