#include "sensor/housing.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/image.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace housing_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

constexpr int kSide = 64;

/// What a housing of 1 W m^-2 sr^-1 leaves of a scene of none, as radiance.
Plane<float> pattern_of(const HousingParameters& parameters, const std::string& clip,
                        const ShutterState& shutter) {
  Housing housing(parameters, 1, 1, clip, kSide, kSide, 1, 1);
  housing.begin_frame(shutter);
  Plane<float> picture(kSide, kSide);
  housing.apply(0, picture.pixels());
  return picture;
}

}  // namespace

TEST_CASE("Gain errors have their standard deviation, half of the variance from pixel to pixel") {
  constexpr int kClips = 400;
  double squares = 0;
  double steps = 0;
  for (int clip = 0; clip < kClips; ++clip) {
    const Plane<float> picture = pattern_of({.gain_error_share = 0.1}, "clip" + std::to_string(clip), {});
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        squares += std::pow(static_cast<double>(picture.at(x, y)), 2);
        if (x > 0) steps += std::pow(static_cast<double>(picture.at(x, y) - picture.at(x - 1, y)), 2);
      }
    }
  }
  constexpr double kPixels = kClips * kSide * kSide;
  // The smooth half of a clip is the mean square of 15 normals: a standard error of sqrt(2 / 15) of it. That of the
  // pixels, sqrt(2 / 4096), is small beside it.
  CHECK_THAT(squares / kPixels, WithinRel(0.01, kSigmas * 0.5 * std::sqrt(2.0 / 15 / kClips) * 1.01));
  // Steps of independent pixels have twice their variance, and neighbours share pixels: sqrt(3 / n). A smooth wave
  // of at most 3 half waves in 64 px has steps of 0.022 of its variance, and half of the variance is smooth.
  CHECK_THAT(steps / (kPixels * (kSide - 1) / kSide),
             WithinRel(0.01, 0.022 + kSigmas * std::sqrt(3 / kPixels)));
}

TEST_CASE("The halo's size at the corners has its standard deviation over the closings") {
  constexpr std::uint32_t kEvents = 4000;
  double squares = 0;
  for (std::uint32_t event = 1; event <= kEvents; ++event) {
    const Plane<float> halo = pattern_of({.halo_k = 0.1}, "a", {.event = event, .since_intervals = 1});
    const double to_corner = 32.0 * 32 / (31.5 * 31.5);
    squares += std::pow(to_corner * static_cast<double>(halo.at(0, 0)), 2);
  }
  CHECK_THAT(squares / kEvents, WithinRel(0.01, kSigmas * std::sqrt(2.0 / kEvents)));
}

}  // namespace housing_test
