#include <cmath>
#include <limits>
#include <sstream>

#include "radiometry/band_radiance.h"
#include "radiometry/planck.h"
#include "support/catch.h"
#include "support/golden.h"

namespace band_radiance_points_test {

using namespace thermal;

namespace {

/// The stated bound of the reference: relative error per unit of the problem's condition.
constexpr double kPromise = 2e-15;

/// One of 200 in-band radiances computed with 60 digits: 1 K to 1e6 K, bands from 1 pm to 100 um wide.
struct Point {
  double temperature_k;
  BandRadiance band;
  double end_um;  ///< of the band: its long-wave end
  double radiance;
  double derivative;
  double ln_radiance;

  /// Condition, the factor by which the relative error of an input is magnified: T L'/L. A rounding of T, of c2 or of
  /// all wavelengths together changes x = c2 / (wavelength T) alike, and L by this factor. Never below 1; where
  /// large, it is the x of the band's long-wave end, 1030 at 1 K and 14 um. Computed from the logarithm, so that it
  /// is known where L underflows.
  [[nodiscard]] double condition() const {
    const double x_end = kSecondRadiationConstant * 1e6 / (end_um * temperature_k);
    return std::isnormal(radiance) ? temperature_k * (derivative / radiance) : x_end + 4;
  }
};

/// "8:0 10:1" as samples of a curve.
template <typename Curve>
std::vector<typename Curve::Sample> samples_of(const std::string& text) {
  std::vector<typename Curve::Sample> samples;
  std::istringstream cells(text);
  double wavelength_um = 0;
  double value = 0;
  for (char colon = 0; cells >> wavelength_um >> colon >> value;) samples.push_back({wavelength_um, value});
  return samples;
}

std::vector<Point> points() {
  std::vector<Point> result;
  for (const GoldenRow& row : read_golden("band_radiance_points.csv")) {
    const SpectralResponse response(samples_of<SpectralResponse>(row.texts[1]));
    const bool black = row.texts[2].empty();
    const EmissivitySpectrum emissivity =
        black ? EmissivitySpectrum(1) : EmissivitySpectrum(samples_of<EmissivitySpectrum>(row.texts[2]));
    result.push_back({.temperature_k = row.numbers[0],
                      .band = BandRadiance(response, emissivity),
                      .end_um = response.end_um(),
                      .radiance = row.numbers[3],
                      .derivative = row.numbers[4],
                      .ln_radiance = row.numbers[5]});
  }
  return result;
}

}  // namespace

TEST_CASE("Radiances of bands of any shape, width and temperature keep to the stated error") {
  int tested = 0;
  for (const Point& point : points()) {
    if (!std::isnormal(point.radiance)) continue;  // too small for a double: the test after the next
    CAPTURE(point.temperature_k, point.end_um, point.condition());
    CHECK_THAT(point.band.radiance(point.temperature_k),
               WithinRel(point.radiance, kPromise * point.condition()));
    ++tested;
  }
  CHECK(tested == 178);
}

TEST_CASE("Derivatives do too, with a condition larger by at most one") {
  for (const Point& point : points()) {
    if (!std::isnormal(point.radiance) || !std::isnormal(point.derivative)) continue;
    CAPTURE(point.temperature_k, point.end_um, point.condition());
    CHECK_THAT(point.band.evaluate(point.temperature_k).derivative_w_m2_sr_k,
               WithinRel(point.derivative, kPromise * (point.condition() + 1)));
  }
}

TEST_CASE("Logarithms are accurate for all 200 points, also where the radiance underflows") {
  const std::vector<Point> all = points();
  CHECK(all.size() == 200);
  for (const Point& point : all) {
    CAPTURE(point.temperature_k, point.end_um, point.condition());
    // An absolute error of the logarithm is a relative one of the radiance. On top, the logarithm is a sum of
    // x at the end, the logarithm of nu / x (at most 40) and that of the integral (at most 60 for these
    // bands), each rounded by half an eps of itself and their sum twice more.
    const double x_end = kSecondRadiationConstant * 1e6 / (point.end_um * point.temperature_k);
    const double sizes = x_end + 40 + 60 + 2 * std::abs(point.ln_radiance);
    const double rounding = sizes * std::numeric_limits<double>::epsilon() / 2;
    CHECK_THAT(point.band.evaluate(point.temperature_k).ln_radiance,
               WithinAbs(point.ln_radiance, kPromise * point.condition() + rounding));
  }
}

TEST_CASE("The inverse finds the temperature of each, from the radiance and from its logarithm") {
  for (const Point& point : points()) {
    CAPTURE(point.temperature_k, point.end_um);
    // dT / T = (dL / L) / condition: forward error and that of the logarithm shrink; documented: 1e-9.
    CHECK_THAT(point.band.temperature_from_ln(point.ln_radiance), WithinRel(point.temperature_k, 1e-9));
    if (!std::isnormal(point.radiance)) continue;
    CHECK_THAT(point.band.temperature(point.radiance), WithinRel(point.temperature_k, 1e-9));
  }
}

TEST_CASE("A surface that emits nothing in the band has no radiance at any temperature") {
  const BandRadiance band(SpectralResponse::flat(8, 14), EmissivitySpectrum(0));
  for (const double temperature_k : {1.0, 300.0, 1e6}) {
    const BandValue value = band.evaluate(temperature_k);
    CHECK(value.radiance_w_m2_sr == 0);
    CHECK(value.derivative_w_m2_sr_k == 0);
    CHECK(value.ln_radiance == -std::numeric_limits<double>::infinity());
  }
}

}  // namespace band_radiance_points_test
