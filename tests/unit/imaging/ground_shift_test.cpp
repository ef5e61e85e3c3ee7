#include <cmath>

#include "imaging/ground/temperatures.h"
#include "radiometry/spectral_response.h"
#include "support/catch.h"

namespace ground_shift_test {

using namespace thermal;

namespace {

const SpectralResponse kBand = SpectralResponse::flat(8, 14);
const Air kAir = {275, 0.5, 0};

BandRadiance grey(double emissivity) { return BandRadiance(kBand, EmissivitySpectrum(emissivity)); }

/// What a grey surface emits and reflects, worked out without SoilAppearance [W m^-2 sr^-1].
double seen(double emissivity, double temperature_k, double sky_view) {
  const BandRadiance black = grey(1);
  const double sky = BandAir(kAir, kBand).sky_emissivity();
  const double received = black.radiance(kAir.temperature_k) * (1 - sky_view * (1 - sky));
  return emissivity * black.radiance(temperature_k) + (1 - emissivity) * received;
}

}  // namespace

TEST_CASE("Soil is drawn as it is, and other ground so that it looks alike under all of the sky and none") {
  const SoilAppearance appearance(grey(0.914), BandAir(kAir, kBand), kAir.temperature_k, true);
  const GroundShift none = appearance.shift(grey(0.914), 270);
  CHECK_THAT(none.without_sky_k, WithinAbs(0, 1e-6));
  CHECK_THAT(none.by_sky_view_k, WithinAbs(0, 1e-6));
  for (const double emissivity : {0.92, 0.958, 1.0}) {
    const GroundShift shift = appearance.shift(grey(emissivity), 270);
    for (const double sky_view : {0.0, 1.0}) {
      const double drawn_k = 270 + shift.without_sky_k + sky_view * shift.by_sky_view_k;
      CHECK_THAT(seen(0.914, drawn_k, sky_view) / seen(emissivity, 270, sky_view), WithinAbs(1, 1e-7));
    }
  }
}

TEST_CASE("Grass looks 1 to 2 K warmer than soil of its temperature below a clear sky") {
  const SoilAppearance appearance(grey(0.914), BandAir(kAir, kBand), kAir.temperature_k, true);
  const GroundShift shift = appearance.shift(grey(0.958), 273);
  const double clear_k = shift.without_sky_k + shift.by_sky_view_k;
  CHECK(clear_k > 1);
  CHECK(clear_k < 2.5);
  CHECK(std::abs(shift.without_sky_k) < 0.15);  // what hides the sky is as warm as air
}

TEST_CASE("The shift of a temperature serves those 10 K beside it, to 0.5 K") {
  const SoilAppearance appearance(grey(0.914), BandAir(kAir, kBand), kAir.temperature_k, true);
  const GroundShift shift = appearance.shift(grey(0.958), 270);
  for (const double temperature_k : {260.0, 280.0}) {
    const GroundShift own = appearance.shift(grey(0.958), temperature_k);
    CHECK_THAT(shift.without_sky_k + shift.by_sky_view_k - own.without_sky_k - own.by_sky_view_k,
               WithinAbs(0, 0.5));
  }
}

TEST_CASE(
    "Parts that are 10 K apart look colder by up to 0.14 K if their temperatures are mixed, not their "
    "radiances") {
  const BandRadiance band = grey(0.95);
  for (const double share : {0.25, 0.5, 0.75}) {
    const double mixed = (1 - share) * band.radiance(270) + share * band.radiance(280);
    const double error_k = band.temperature(mixed) - (270 + 10 * share);
    CHECK(error_k > 0);
    CHECK(error_k < 0.14);
    if (share == 0.5) CHECK(error_k > 0.1);
  }
}

}  // namespace ground_shift_test
