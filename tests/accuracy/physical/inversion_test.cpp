#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "accuracy/physical/chain_scene.h"
#include "base/error.h"
#include "heat/weather/air_profile.h"
#include "imaging/budget.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"
#include "support/catch.h"
#include "support/message_of.h"

// Air that is warmer at the camera than at the ground, against integrals over the path.

namespace inversion_test {

using namespace thermal;

namespace {

const Air kNight = {273, 0.6, 0, 4};
const Air kSummerNight = {293, 0.7, 0, 4};
constexpr int kSlices = 20000;

const SpectralResponse kBand = chain_scene::settings({}).response;

/// Mean of the absorption over a path, by the midpoint rule.
double mean_absorption(const BandAir& air, double range_m) {
  double sum = 0;
  for (int k = 0; k < kSlices; ++k) sum += 1 - air.path_transmittance(range_m * (k + 0.5) / kSlices);
  return sum / kSlices;
}

/// What the path radiates, with air whose temperature falls linearly from the camera to the ground.
double path_radiance(const Air& air, const BandRadiance& black, double range_m) {
  const BandAir band_air(air, kBand);
  double sum = 0;
  double before = 1;
  for (int k = 0; k < kSlices; ++k) {
    const double through = band_air.path_transmittance(range_m * (k + 1) / kSlices);
    const double share = (k + 0.5) / kSlices;
    sum += (before - through) * black.radiance(air.temperature_k + air.inversion_k * (1 - share));
    before = through;
  }
  return sum;
}

Plane<float> radiance(double inversion_k, float depth_m, bool path) {
  PhysicsSettings settings = chain_scene::settings({.path = path});
  settings.weather.air = kNight;
  settings.weather.air.inversion_k = inversion_k;
  const Manifest described = chain_scene::manifest();
  const Passes from = chain_scene::uniform_passes(chain_scene::kWidth, chain_scene::kHeight,
                                                  chain_scene::kSoil, depth_m, {0, 0, 1});
  return SceneRadiance(described, chain_scene::library(), settings).radiance(from, described.frames[0]);
}

}  // namespace

TEST_CASE(
    "The mean absorption of a path is that of an integral, from centimetres to where the path model ends") {
  for (const Air& air : {kNight, kSummerNight, Air{318, 0.8, 0}, Air{273, 0, 0}}) {
    const BandAir band_air(air, kBand);
    for (const double range_m : {0.01, 1.0, 10.0, 29.9, 30.0, 61.0, 122.0, 400.0, 999.0}) {
      CAPTURE(air.temperature_k, range_m);
      const double mean = band_air.mean_path_absorption(range_m);
      // The midpoint rule errs by the square of a slice, 2.5e-9, times curvature and range; the corner at 30 m by more.
      CHECK_THAT(mean, WithinRel(mean_absorption(band_air, range_m), 1e-6));
      CHECK(mean <= 1 - band_air.path_transmittance(range_m));
    }
    CHECK(band_air.mean_path_absorption(0) == 0);
    CHECK(band_air.mean_path_absorption(-1) == 0);
    CHECK(band_air.mean_path_absorption(1e9) == band_air.mean_path_absorption(1000));
    CHECK(band_air.mean_path_absorption(std::nan("")) == band_air.mean_path_absorption(1000));
  }
}

TEST_CASE("Under an inversion the path radiates what the integral over warmer air gives, within 1 mK") {
  const BandRadiance black(chain_scene::settings({}).response);
  double worst_mk = 0;
  for (const float depth_m : {5.0F, 40.0F, 61.0F, 122.0F, 300.0F}) {
    const Plane<float> without = radiance(0, depth_m, true);
    const Plane<float> with = radiance(4, depth_m, true);
    const int x = chain_scene::kWidth / 2;
    const int y = chain_scene::kHeight / 2;
    const double range_m = static_cast<double>(depth_m) *
                           std::hypot(0.5 / chain_scene::kFocalPx, 0.5 / chain_scene::kFocalPx, 1);
    const double through = BandAir(kNight, kBand).path_transmittance(range_m);
    const double expected = path_radiance(kNight, black, range_m) - (1 - through) * black.radiance(273);
    const double got = static_cast<double>(with.at(x, y)) - static_cast<double>(without.at(x, y));
    const double per_k = black.evaluate(273).derivative_w_m2_sr_k;
    std::printf("inversion of 4 K, %.0f m: +%.0f mK, error %.2f mK\n", range_m, 1e3 * expected / per_k,
                1e3 * (got - expected) / per_k);
    worst_mk = std::max(worst_mk, std::abs(1e3 * (got - expected) / per_k));
  }
  // Radiance along the path is taken as linear where temperature is: L'' / L' = .012 / K, so by at most .012 x 16 / 8 = 24
  // mK in the middle of the path, two thirds of that on average, times the .06 that its air absorbs on 120 m.
  CHECK(worst_mk < 1);
  CHECK(radiance(4, 61, false) == radiance(0, 61, false));
}

TEST_CASE("An inversion of 4 K is worth 57 to 149 mK, which the budget states") {
  const SpectralResponse band = SpectralResponse::flat(8, 14);
  const auto shift = [&](Air air, double range_m) {
    Weather weather;
    weather.air = air;
    return shift_of(chain_scene::library().find("grass", "test"), {.weather = weather, .view_directions = {}},
                    range_m, band);
  };
  const MaterialShift near = shift(kNight, 61);
  const MaterialShift far = shift(kSummerNight, 122);
  std::printf("budget, inversion of 4 K: winter 61 m +%.0f mK, summer 122 m +%.0f mK\n",
              1e3 * near.inversion_k, 1e3 * far.inversion_k);
  CHECK(near.inversion_k > 0.05);
  CHECK(far.inversion_k < 0.16);
  Air even = kNight;
  even.inversion_k = 0;
  CHECK(shift(even, 61).inversion_k == 0);
  CHECK_THAT(near.path_k - shift(even, 61).path_k, WithinAbs(near.inversion_k, 1e-9));
}

TEST_CASE("An inversion is from 0 to 20 K") {
  CHECK(message_of<ConfigError>([] {
          Air{273, 0.6, 0, 20.5}.validate();
        }) == "weather.inversion_k = 20.5 K; expected 0 to 20 K");
  CHECK_NOTHROW(Air{273, 0.6, 0, 20}.validate());
}

TEST_CASE("An inversion that is not stated follows from the cooled ground and the cameras' height") {
  Manifest manifest = chain_scene::manifest();
  PhysicsSettings settings = chain_scene::settings({});
  settings.weather = weather_of(Season::winter);
  CHECK(with_inversion(settings, manifest).air.inversion_k == 0);
  settings.weather.inversion_by_balance = true;
  CHECK(with_inversion(settings, manifest).air.inversion_k == 0);  // no balance
  const std::map<std::string, MaterialHeat> heat = {{"soil", GroundHeat()}};
  settings.heat = HeatSettings{.day = std::make_shared<HeatOfDay>(settings.weather.day, heat), .ground = {}};
  const auto inversion_k = [&](double agl_m) {
    for (ManifestFrame& frame : manifest.frames) frame.agl_m = agl_m;
    return with_inversion(settings, manifest).air.inversion_k;
  };
  const HeatOfMoment moment = settings.heat->day->at(settings.weather.solar_h);
  for (const double agl_m : {20.0, 61.0, 122.0}) {
    CHECK(inversion_k(agl_m) == StableAir(moment.forcing, moment.ground_k).warmer_k(agl_m));
    CHECK(inversion_k(agl_m) > 2);
  }
  for (ManifestFrame& frame : manifest.frames) frame.agl_m = {};
  const double usual_k = with_inversion(settings, manifest).air.inversion_k;
  CHECK(usual_k == inversion_k(61));
  settings.weather.solar_h = 13;
  CHECK(inversion_k(61) == 0);
  settings.weather = weather_of(Season::winter);
  settings.weather.air.inversion_k = 1.5;
  CHECK(inversion_k(61) == 1.5);
}

}  // namespace inversion_test
