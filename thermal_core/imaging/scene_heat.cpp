#include "imaging/scene_heat.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/parallel.h"
#include "heat/body/fire.h"
#include "heat/weather/forcing.h"

namespace thermal {
namespace {

std::vector<float> sunlit_cells(const GroundMaps& maps, const DayWeather& day, double solar_h) {
  const auto found = std::ranges::find(maps.sunlit, day.sun, &SunlitHours::path);
  if (found == maps.sunlit.end()) return {};
  const SunMemory memory = sun_memory(day, solar_h);
  // Cells share few patterns of hours; the low and high half of a pattern index tables.
  constexpr std::size_t kHalf = 12;
  std::vector<float> low(1U << kHalf);
  std::vector<float> high(1U << kHalf);
  for (std::uint32_t bits = 0; bits < low.size(); ++bits) {
    low[bits] = sunlit_share(memory, bits);
    high[bits] = sunlit_share(memory, bits << kHalf);
  }
  constexpr std::size_t kCellsPerChunk = 16384;
  std::vector<float> share(found->hours.size());
  parallel_for(share.size(), kCellsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::uint32_t hours = found->hours[cell];
      share[cell] = low[hours & 0xFFFU] + high[hours >> kHalf & 0xFFFU];
    }
  });
  return share;
}

/// Ground around a fire. After the fire, it returns the heat that it took up, as a bed does.
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
  const float last_k = spot.excess_k.back();  // no step at its end
  for (float& excess_k : spot.excess_k) excess_k = std::max(0.0F, excess_k - last_k);
  return spot;
}

/// Uniform below the body, fading at its rim (estimate); nothing where the ground is warmer than an animal.
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

/// The surfaces at one moment of a clip.
struct Moment {
  double later_h = 0;  ///< offset from the clip's midpoint [h]
  std::shared_ptr<const HeatedSurfaces> surfaces;
};

/// Two moments, between which temperatures are linear.
struct Ends {
  Moment first;
  Moment last;

  [[nodiscard]] double hours() const noexcept { return last.later_h - first.later_h; }
  [[nodiscard]] double middle_h() const noexcept { return (first.later_h + last.later_h) / 2; }
};

/// Divides a clip into spans.
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

  /// Deviation of open level surfaces from linear change.
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

/// Sets the rate of change, and the value half-way between the ends.
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

const MaterialMoment& heat_of(const HeatOfMoment& moment, const std::string& material) {
  const auto found = moment.materials.find(material);
  if (found != moment.materials.end()) return found->second;
  throw ConfigError(
      fmt::format("material {}: no heat; expected of everything that ground is made of", material));
}

/// Ground of a clip from its maps.
class GroundOfClip {
 public:
  GroundOfClip(const HeatSettings& settings, const Weather& weather, const Manifest& manifest,
               const SceneHeatTerms& terms, const GroundAppearanceOf& appearance_of, std::uint32_t seed)
      : maps_(*settings.ground),
        day_(*settings.day),
        solar_h_(weather.solar_h),
        cold_pool_k_(weather.cold_pool_k),
        by_slope_(terms.facing),
        appearance_of_(appearance_of),
        ground_(ground_of_window(maps_, window_of(maps_, manifest), terms.variation, seed)) {}

  [[nodiscard]] GroundTexture between(const Ends& ends) const {
    const std::vector<float> sunlit_first = sunlit_at(ends.first);
    const std::vector<float> sunlit_last = sunlit_at(ends.last);
    return ground_temperatures(maps_, ground_,
                               {.first = moment_of(ends.first, sunlit_first),
                                .last = moment_of(ends.last, sunlit_last),
                                .hours = ends.hours(),
                                .open_moisture = ends.first.surfaces->moment().ground_moisture,
                                .by_slope = by_slope_});
  }

  [[nodiscard]] GroundDetail detail(std::uint32_t seed) const {
    return {.crown_tops = {maps_, ground_.maps}, .waters = {maps_, ground_.maps}, .warp = GroundWarp(seed)};
  }

 private:
  [[nodiscard]] std::vector<float> sunlit_at(const Moment& moment) const {
    return sunlit_cells(maps_, day_.weather(), solar_h_ + moment.later_h);
  }

  /// Cold air drains after sunset; the sun ends that within half an hour (estimate).
  [[nodiscard]] double cold_pool_k(const Forcing& forcing) const {
    constexpr double kEndedSine = 0.1;
    return cold_pool_k_ * std::clamp(1 - forcing.sun[2] / kEndedSine, 0.0, 1.0);
  }

  [[nodiscard]] GroundMoment moment_of(const Moment& moment, const std::vector<float>& sunlit) const {
    const HeatOfMoment& heat = moment.surfaces->moment();
    GroundMoment ground = {.parts = {}, .sunlit = sunlit, .cold_pool_k = cold_pool_k(heat.forcing)};
    for (const std::string& name : ground_part_names(maps_.covers)) {
      const MaterialMoment& by_exposure = heat_of(heat, name);
      const GroundAppearance appearance =
          appearance_of_(name, by_exposure.temperature_k({.moisture = heat.ground_moisture}));
      ground.parts.push_back(
          {.heat = &by_exposure, .shift = appearance.shift, .variation_k = appearance.variation_k});
    }
    return ground;
  }

  const GroundMaps& maps_;
  const HeatOfDay& day_;
  double solar_h_;
  double cold_pool_k_;
  bool by_slope_;
  const GroundAppearanceOf& appearance_of_;
  GroundOfWindow ground_;
};

double hours_of(const Manifest& manifest) {
  if (manifest.frames.empty()) return 0;
  return (manifest.frames.back().time_s - manifest.frames.front().time_s) / 3600;
}

}  // namespace

SceneHeat heat_of_scene(const std::vector<Surface>& surfaces, const std::vector<ActorState>& states,
                        const HeatSettings& settings, const Weather& weather, const Manifest& manifest,
                        const SceneHeatTerms& terms, const GroundAppearanceOf& appearance_of,
                        std::uint32_t seed) {
  const auto moment_at = [&](double later_h) {
    return Moment{later_h, std::make_shared<const HeatedSurfaces>(surfaces, states, settings, weather,
                                                                  3600 * later_h, terms)};
  };
  SceneHeat heat = {
      .spans = {}, .spots = warm_spots(manifest, settings.day->at(weather.solar_h)), .ground = {}};
  std::optional<GroundOfClip> ground;
  if (terms.place) {
    ground.emplace(settings, weather, manifest, terms, appearance_of, seed);
    heat.ground.emplace(ground->detail(seed));
  }
  for (const Ends& ends : Spans(moment_at).of_clip(hours_of(manifest))) {
    heat.spans.push_back({.middle_h = ends.middle_h(),
                          .hours = ends.hours(),
                          .surfaces = surfaces_between(ends),
                          .ground = {}});
    if (ground) heat.spans.back().ground = ground->between(ends);
  }
  return heat;
}

}  // namespace thermal
