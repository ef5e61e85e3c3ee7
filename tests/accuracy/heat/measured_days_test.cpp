#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "heat/surface/surface_day.h"
#include "heat/weather/humid_air.h"
#include "support/catch.h"
#include "support/golden.h"

// Whole days that others measured, hour by hour: what the balance makes of the same sun, air and sky. See ACCURACY.md.
namespace measured_days_test {

using namespace thermal;

namespace {

/// A line of tests/data/measured_days.csv.
struct Hour {
  double solar_h, sun_w_m2, sky_w_m2, air_k, wind_m_s, vapour_hpa, surface_k, leaf_k;
};

std::vector<Hour> hours_of(const std::string& place) {
  std::vector<Hour> hours;
  for (const GoldenRow& row : read_golden("measured_days.csv")) {
    const auto& n = row.numbers;
    if (row.texts[0] == place) hours.push_back({n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]});
  }
  std::ranges::sort(hours, {}, &Hour::solar_h);
  return hours;
}

/// Straight lines between the hours, over midnight too.
Hour between(const std::vector<Hour>& hours, double solar_h) {
  const auto after = std::ranges::lower_bound(hours, solar_h, {}, &Hour::solar_h);
  const Hour& b = after == hours.end() ? hours.front() : *after;
  const Hour& a = after == hours.begin() ? hours.back() : *(after - 1);
  const double from_h = a.solar_h > solar_h ? a.solar_h - 24 : a.solar_h;
  const double to_h = b.solar_h < solar_h ? b.solar_h + 24 : b.solar_h;
  const double share = (solar_h - from_h) / (to_h - from_h);
  const auto mix = [&](double Hour::*value) { return std::lerp(a.*value, b.*value, share); };
  return {solar_h,
          mix(&Hour::sun_w_m2),
          mix(&Hour::sky_w_m2),
          mix(&Hour::air_k),
          mix(&Hour::wind_m_s),
          mix(&Hour::vapour_hpa),
          mix(&Hour::surface_k),
          mix(&Hour::leaf_k)};
}

Forcing forcing_of(const Hour& hour, const SunPath& sun, double elevation_m) {
  Forcing forcing = {.air_k = hour.air_k,
                     .wind_m_s = hour.wind_m_s,
                     .vapour_hpa = hour.vapour_hpa,
                     .pressure_hpa = pressure_hpa(elevation_m),
                     .sky_w_m2 = hour.sky_w_m2,
                     .sun = sun_direction(sun, hour.solar_h)};
  if (forcing.sky_w_m2 == 0)
    forcing.sky_w_m2 = broadband_sky_emissivity(hour.air_k, hour.vapour_hpa, 0) * blackbody_w_m2(hour.air_k);
  const double sine = forcing.sun[2];
  forcing.global_w_m2 = sine > 0 ? hour.sun_w_m2 : 0;
  forcing.diffuse_w_m2 = (sine > 0.02 ? 0.2 : 1) * forcing.global_w_m2;
  forcing.beam_w_m2 = sine > 0.02 ? 0.8 * forcing.global_w_m2 / sine : 0;
  return forcing;
}

std::vector<Forcing> day_of(const std::vector<Hour>& hours, const SunPath& sun, double elevation_m) {
  constexpr int kSteps = 288;
  std::vector<Forcing> forcing;
  for (int step = 1; step <= kSteps; ++step)
    forcing.push_back(forcing_of(between(hours, 24.0 * step / kSteps), sun, elevation_m));
  return forcing;
}

/// Root of the mean squared difference in the hours without sun [K].
double night_rms_k(const std::vector<Hour>& hours, const SurfaceDay& day, double Hour::*measured) {
  double sum = 0;
  int count = 0;
  for (const Hour& hour : hours) {
    if (hour.sun_w_m2 >= 1) continue;
    sum += std::pow(day.at_k(hour.solar_h) - hour.*measured, 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

// One standard deviation of soil at night that the sources of its properties leave; nothing here is fitted.
constexpr double kUncertaintyK = 1.2;

const GroundProperties kSandyLoam = {
    .surface = {.albedo = 0.25, .emissivity = 0.95, .roughness_m = 0.01, .evaporation = 0.03},
    .conductivity_w_m_k = 0.3,
    .heat_capacity_j_m3_k = 1.28e6};

}  // namespace

TEST_CASE(
    "Soil between shrubs in Arizona cools at night as it was measured, within the uncertainty of its "
    "properties") {
  const std::vector<Hour> hours = hours_of("walnut_gulch");
  REQUIRE(hours.size() == 24);
  const auto forcing = day_of(hours, {31.74, 209}, 1371);
  const SurfaceDay open = day_of_ground(kSandyLoam, {}, {forcing}, {});
  CHECK(night_rms_k(hours, open, &Hour::surface_k) <= kUncertaintyK);
}

TEST_CASE("Leaves of shrubs in Arizona cool at night as they were measured, within the same uncertainty") {
  const std::vector<Hour> hours = hours_of("walnut_gulch");
  const auto forcing = day_of(hours, {31.74, 209}, 1371);
  const CanopyProperties shrub = {.leaf_area_index = 0.5,
                                  .albedo = 0.2,
                                  .leaf_width_m = 0.01,
                                  .height_m = 0.5,
                                  .leaf_conductance_m_s = 0.0033,
                                  .heat_capacity_j_m2_k = 900};
  const CanopyDay day = day_of_canopy(shrub, kSandyLoam, {}, {forcing}, {});
  CHECK(night_rms_k(hours, day.leaves, &Hour::leaf_k) <= kUncertaintyK);
  // The same as shrubs that stand alone. Air and wind are those of 4 m, so a shrub is half as high in what counts as 2 m.
  CanopyProperties alone = shrub;
  alone.height_m /= 2;
  const SurfaceDay soil = day_of_ground(kSandyLoam, {}, {forcing}, {});
  const CanopyDay apart = day_of_canopy(alone, kSandyLoam, {}, {forcing, soil.surface_k}, {}, Stand::alone);
  CHECK(night_rms_k(hours, apart.leaves, &Hour::leaf_k) <= kUncertaintyK);
}

TEST_CASE("Short grass in Switzerland cools at night as it was measured, within the same uncertainty") {
  const std::vector<Hour> hours = hours_of("payerne");
  const auto forcing = day_of(hours, {46.815, 180}, 491);
  const CanopyProperties grass = {.leaf_area_index = 2.5,
                                  .albedo = 0.2,
                                  .leaf_width_m = 0.006,
                                  .leaf_conductance_m_s = 0.0125,
                                  .heat_capacity_j_m2_k = 900};
  const GroundProperties moist = {
      .surface = {.albedo = 0.2, .emissivity = 0.95, .roughness_m = 0.005, .evaporation = 0.5},
      .conductivity_w_m_k = 1.1,
      .heat_capacity_j_m3_k = 2.0e6};
  CanopyDay day = day_of_canopy(grass, moist, {}, {forcing}, {});
  for (std::size_t i = 0; i < forcing.size(); ++i)
    day.leaves.surface_k[i] = seen_from_above_k(grass, day.leaves.surface_k[i], day.ground.surface_k[i]);
  CHECK(night_rms_k(hours, day.leaves, &Hour::surface_k) <= kUncertaintyK);
}

TEST_CASE("Where the balance is known to miss, it misses by no more than ACCURACY.md says") {
  // By day the wind at 4 m, 4 to 5 m/s, takes more heat from our open soil than from soil between shrubs.
  const std::vector<Hour> shrubs = hours_of("walnut_gulch");
  const auto arizona = day_of(shrubs, {31.74, 209}, 1371);
  const SurfaceDay soil = day_of_ground(kSandyLoam, {}, {arizona}, {});
  for (const Hour& hour : shrubs) {
    CAPTURE(hour.solar_h);
    CHECK(std::abs(soil.at_k(hour.solar_h) - hour.surface_k) <= 8.5);
  }
  // Cold air drains into the valley before dawn, which a column does not know.
  const std::vector<Hour> valley = hours_of("alamosa");
  const auto colorado = day_of(valley, {37.7, 1}, 2317);
  GroundProperties desert = kSandyLoam;
  desert.surface.albedo = 0.175;
  CHECK(night_rms_k(valley, day_of_ground(desert, {}, {colorado}, {}), &Hour::surface_k) <= 3.3);
}

}  // namespace measured_days_test
