#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "io/config/spectra.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"
#include "support/catch.h"
#include "support/golden.h"

// How the spectrum splits the published figures between bands, against LOWTRAN 7.

namespace air_bands_test {

using namespace thermal;

namespace {

// The columns of air_bands.csv.
constexpr std::array<std::pair<double, double>, 6> kBandsUm = {
    {{8, 14}, {7.5, 13.5}, {7.5, 14}, {10.5, 12.5}, {8, 9}, {10, 11}}};
constexpr std::size_t kFirstColumn = 4;

SpectralResponse band(std::size_t column) {
  return SpectralResponse::flat(kBandsUm.at(column).first, kBandsUm.at(column).second);
}

/// LOWTRAN's figure of a band if its figure of another were the one that we have: in depths, whose ratio we take from
/// it.
double scaled(double transmitted, double transmitted_base, double our_base) {
  return std::pow(our_base, std::log(transmitted) / std::log(transmitted_base));
}

/// Largest differences of transmission or emissivity by band.
std::array<double, kBandsUm.size()> worst(const std::string& kind, std::size_t base, double most) {
  std::array<double, kBandsUm.size()> largest{};
  for (const GoldenRow& row : read_golden("air_bands.csv")) {
    const auto& n = row.numbers;
    if (row.texts[0] != kind || n[3] > most) continue;
    const Air air = {n[1], n[2]};
    const bool sky = kind == "sky";
    const auto through = [&](std::size_t column) {
      const BandAir ours(air, band(column));
      return sky ? 1 - ours.sky_emissivity(std::cos(n[3] * 3.14159265358979 / 180))
                 : ours.path_transmittance(n[3]);
    };
    const auto of_lowtran = [&](std::size_t column) {
      return sky ? 1 - n[kFirstColumn + column] : n[kFirstColumn + column];
    };
    for (std::size_t column = 0; column < kBandsUm.size(); ++column) {
      const double expected = scaled(of_lowtran(column), of_lowtran(base), through(base));
      largest.at(column) = std::max(largest.at(column), std::abs(through(column) - expected));
    }
  }
  std::printf("%s up to %.0f:", kind.c_str(), most);
  for (std::size_t column = 0; column < kBandsUm.size(); ++column) {
    std::printf(" %.1f-%.1f um %.4f", kBandsUm.at(column).first, kBandsUm.at(column).second,
                largest.at(column));
  }
  std::printf("\n");
  return largest;
}

}  // namespace

TEST_CASE("Sky and path are split between bands as by LOWTRAN 7") {
  const auto zenith = worst("sky", 0, 0);
  const auto slant = worst("sky", 0, 75);
  const auto path = worst("path", 2, 122);
  const auto far = worst("path", 2, 1000);
  // The spectrum has three tables and one factor, where LOWTRAN has lines that saturate one by one. Bounds are what
  // was measured, rounded up.
  for (const std::size_t wide : {0U, 1U, 2U}) {
    CHECK(zenith.at(wide) < 0.01);
    CHECK(slant.at(wide) < 0.02);
    CHECK(path.at(wide) < 0.005);
    CHECK(far.at(wide) < 0.015);
  }
  for (std::size_t column = 0; column < kBandsUm.size(); ++column) {
    CHECK(zenith.at(column) < 0.11);
    CHECK(slant.at(column) < 0.15);
    CHECK(path.at(column) < 0.0075);
    CHECK(far.at(column) < 0.075);
  }
}

TEST_CASE("What the responses make of sky and path") {
  const std::string folder = std::string(VELDT_SOURCE_DIR) + "/assets/responses/";
  const SpectralResponse germanium = read_response(folder + "vox_germanium.csv");
  const std::array<std::pair<const char*, SpectralResponse>, 4> all = {
      {{"8-14", SpectralResponse::flat(8, 14)},
       {"7.5-13.5", SpectralResponse::flat(7.5, 13.5)},
       {"vox_germanium", germanium},
       {"10.5-12.5", SpectralResponse::flat(10.5, 12.5)}}};
  for (const Air& air : {Air{273, 0.6}, Air{293, 0.7}}) {
    for (const auto& [name, response] : all) {
      const BandAir ours(air, response);
      const BandRadiance black(response);
      const double air_w = black.radiance(air.temperature_k);
      const auto sky_k = [&](double emissivity) { return black.temperature(emissivity * air_w); };
      const double published = clear_sky_emissivity(air);
      // Soil of .914 at the air's temperature reflects .086 of the sky.
      const auto soil_k = [&](double sky) { return black.temperature(air_w * (1 - 0.086 * (1 - sky))); };
      const auto person_k = [&](double through) {
        return black.temperature(through * black.radiance(310) + (1 - through) * air_w);
      };
      const double through = ours.path_transmittance(122);
      const double grey = path_transmittance(air, 122);
      std::printf(
          "%.0f K, %s: sky %.3f (band figure %.3f), zenith %.3f, sky's temperature %.1f K (%+.1f), soil "
          "%+.0f mK, "
          "absorbed at 122 m %.4f (%.4f), person of 310 K %+.0f mK\n",
          air.temperature_k, name, ours.sky_emissivity(), published, ours.sky_emissivity(1),
          sky_k(ours.sky_emissivity()), sky_k(ours.sky_emissivity()) - sky_k(published),
          1e3 * (soil_k(ours.sky_emissivity()) - soil_k(published)), 1 - through, 1 - grey,
          1e3 * (person_k(through) - person_k(grey)));
      CHECK(ours.sky_emissivity() > 0.5 * published);
      CHECK(1 - through < 1.2 * (1 - grey));
    }
  }
}

TEST_CASE("Weighting the path by contrasts at the air's temperature errs little for a person") {
  for (const Air& air : {Air{270, 0.6}, Air{293, 0.7}}) {
    for (const auto& [begin_um, end_um] : {kBandsUm[0], kBandsUm[1]}) {
      const SpectralResponse response = SpectralResponse::flat(begin_um, end_um);
      const BandRadiance black(response);
      const double by_air = BandAir(air, response).path_transmittance(122);
      // The spectrum of the path from narrow bands, weighted with the person's own contrast.
      const double air_w = black.radiance(air.temperature_k);
      double error_w = by_air * (black.radiance(310) - air_w);
      for (double at_um = begin_um; at_um < end_um - 1e-9; at_um += 0.05) {
        const SpectralResponse narrow = SpectralResponse::flat(at_um, at_um + 0.05);
        const BandRadiance one(narrow);
        error_w -= (one.radiance(310) - one.radiance(air.temperature_k)) *
                   BandAir(air, narrow).path_transmittance(122);
      }
      const double more_mk = 1e3 * error_w / black.evaluate(310).derivative_w_m2_sr_k;
      std::printf("person of 310 K, air of %.0f K, %.1f-%.1f um, 122 m: %+.1f mK\n", air.temperature_k,
                  begin_um, end_um, more_mk);
      CHECK(std::abs(more_mk) < 40);
    }
  }
}

}  // namespace air_bands_test
