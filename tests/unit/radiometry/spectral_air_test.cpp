#include "radiometry/spectral_air.h"

#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.h"

namespace spectral_air_test {

using namespace thermal;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Air> airs() {
  std::vector<Air> all;
  for (const double air_k : {233.0, 253.0, 273.0, 293.0, 308.0, 323.0}) {
    for (const double humidity : {0.0, 0.1, 0.5, 1.0}) {
      for (const double cloud : {0.0, 0.5, 1.0}) all.push_back({air_k, humidity, cloud});
    }
  }
  return all;
}

std::vector<SpectralResponse> responses() {
  return {SpectralResponse::flat(8, 14),     SpectralResponse::flat(7.5, 13.5),
          SpectralResponse::flat(10, 10.1),  SpectralResponse::flat(9.6123, 9.6124),
          SpectralResponse::flat(3, 14),     SpectralResponse::flat(3, 5),
          SpectralResponse::flat(0.1, 1000), SpectralResponse({{7, 0}, {10, 1}, {14.9, 0}})};
}

constexpr Air kWinter = {273, 0.6};
constexpr Air kSummer = {293, 0.7};

}  // namespace

TEST_CASE("The bands that the published figures were made for have these figures, in all weather") {
  for (const Air& air : airs()) {
    CAPTURE(air.temperature_k, air.relative_humidity, air.cloud_fraction);
    const double gap = 1 - 0.84 * air.cloud_fraction;
    const BandAir sky(air, SpectralResponse::flat(8, 14));
    CHECK_THAT(1 - sky.sky_emissivity(1), WithinAbs(gap * (1 - clear_zenith_emissivity(air)), 2e-9));
    CHECK_THAT(1 - sky.sky_emissivity(), WithinAbs(gap * (1 - clear_sky_emissivity(air)), 2e-9));
    const BandAir path(air, SpectralResponse::flat(7.5, 14));
    for (const double range_m : {0.0, 1.0, 29.9, 30.0, 61.0, 122.0, 300.0, 1000.0, kNaN}) {
      CHECK_THAT(path.path_transmittance(range_m), WithinAbs(path_transmittance(air, range_m), 2e-9));
    }
  }
}

TEST_CASE("Whatever the response: the sky is a grey between 0 and 1 that brightens towards the horizon") {
  for (const Air& air : airs()) {
    for (const SpectralResponse& response : responses()) {
      CAPTURE(air.temperature_k, air.relative_humidity, air.cloud_fraction, response.begin_um());
      const BandAir band(air, response);
      double before = 0;
      for (const double cosine : {1.0, 0.9, 0.5, 0.2, 0.05}) {
        const double here = band.sky_emissivity(cosine);
        REQUIRE(here >= before);
        REQUIRE(here <= 1);
        before = here;
      }
      for (const double cosine : {0.01, 0.0, -1.0, kNaN, -kInfinity})
        REQUIRE(band.sky_emissivity(cosine) == before);
      REQUIRE(band.sky_emissivity() >= band.sky_emissivity(1));
      REQUIRE(band.sky_emissivity() <= 1);
    }
  }
}

TEST_CASE(
    "Whatever the response: transmittance falls from 1, by Beer's law up to 30 m, and its mean follows") {
  for (const Air& air : airs()) {
    if (air.cloud_fraction > 0) continue;
    for (const SpectralResponse& response : responses()) {
      CAPTURE(air.temperature_k, air.relative_humidity, response.begin_um(), response.end_um());
      const BandAir band(air, response);
      REQUIRE(band.path_transmittance(0) == 1);
      REQUIRE(band.path_transmittance(-kInfinity) == 1);
      REQUIRE(band.path_transmittance(kNaN) == band.path_transmittance(1000));
      REQUIRE(band.path_transmittance(kInfinity) == band.path_transmittance(1000));
      const double near = band.path_transmittance(30 - 1e-9);
      REQUIRE_THAT(band.path_transmittance(15), WithinAbs(std::sqrt(near), 1e-9));
      REQUIRE_THAT(band.path_transmittance(30), WithinAbs(near, 1e-9));
      double before = 1;
      for (double range_m = 0.5; range_m <= 1000; range_m *= 1.3) {
        const double here = band.path_transmittance(range_m);
        REQUIRE(here <= before);
        REQUIRE(here >= 0);
        before = here;
      }
      REQUIRE(band.mean_path_absorption(0) == 0);
      REQUIRE(band.mean_path_absorption(kNaN) == band.mean_path_absorption(1000));
      REQUIRE(band.mean_path_absorption(122) <= 1 - band.path_transmittance(122));
      REQUIRE(band.mean_path_absorption(122) >= 0);
    }
  }
}

TEST_CASE("The window about 10.5 um is clearer than its edges") {
  for (const Air& air : {kWinter, kSummer}) {
    const BandAir middle(air, SpectralResponse::flat(10.5, 11.5));
    const BandAir wide(air, SpectralResponse::flat(8, 14));
    const BandAir short_edge(air, SpectralResponse::flat(7.5, 8));
    const BandAir long_edge(air, SpectralResponse::flat(13.5, 14));
    for (const BandAir* edge : {&short_edge, &long_edge}) {
      CHECK(middle.path_transmittance(122) > wide.path_transmittance(122));
      CHECK(wide.path_transmittance(122) > edge->path_transmittance(122));
      CHECK(middle.sky_emissivity() < wide.sky_emissivity());
      CHECK(wide.sky_emissivity() < edge->sky_emissivity());
    }
  }
  // Ozone, which is above the path.
  const BandAir ozone(kWinter, SpectralResponse::flat(9.4, 9.9));
  const BandAir beside(kWinter, SpectralResponse::flat(10.4, 10.9));
  CHECK(ozone.sky_emissivity(1) > 2 * beside.sky_emissivity(1));
  CHECK(ozone.path_transmittance(122) > 0.98);
}

TEST_CASE("A response cut into many samples is the same response") {
  const BandAir whole(kSummer, SpectralResponse::flat(7.5, 13.5));
  std::vector<SpectralResponse::Sample> samples;
  for (int i = 0; i <= 100000; ++i) samples.push_back({7.5 + 6e-5 * i, 2});
  const BandAir cut(kSummer, SpectralResponse(samples));
  // Panels of 0.05 um err by 1e-9 or less; a hundred thousand sums, by their roundings.
  CHECK_THAT(cut.sky_emissivity(), WithinAbs(whole.sky_emissivity(), 1e-9));
  CHECK_THAT(cut.path_transmittance(122), WithinAbs(whole.path_transmittance(122), 1e-9));
}

TEST_CASE("Beyond the tables the depths are those of their ends") {
  const BandAir end(kSummer, SpectralResponse::flat(14.5, 15));
  const BandAir beyond(kSummer, SpectralResponse::flat(17, 20));
  CHECK_THAT(beyond.path_transmittance(122), WithinAbs(end.path_transmittance(122), 1e-12));
  // Opaque, as water vapour is from 5.5 to 7 um, and not as the window at 3 to 5 um is.
  CHECK(BandAir(kSummer, SpectralResponse::flat(3, 5)).path_transmittance(122) < 0.05);
  const BandAir ultraviolet(kSummer, SpectralResponse::flat(0.001, 0.002));
  CHECK(std::isfinite(ultraviolet.sky_emissivity()));
}

}  // namespace spectral_air_test
