#include <cmath>
#include <vector>

#include "support/cameras.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace white_noise_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

/// A camera with white noise alone, of 10 counts.
SensorParameters white_sensor() {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise.amount = 1;
  parameters.netd_mk = 100;
  return parameters;
}

constexpr double kVariance = 100 + 1.0 / 12;  // counts squared, plus the rounding to counts

std::vector<float> noise_of(const Plane<std::uint16_t>& ir16) {
  std::vector<float> noise;
  for (const std::uint16_t count : ir16.pixels()) noise.push_back(static_cast<float>(count) - 30000);
  return noise;
}

/// Mean product of pixels dx, dy apart, in units of their variance.
double correlation(const std::vector<float>& noise, int side_px, int dx, int dy) {
  const int begin = std::max(0, -dx);
  const int end = std::min(side_px, side_px - dx);
  double sum = 0;
  for (int y = 0; y + dy < side_px; ++y) {
    const float* here = &noise[static_cast<std::size_t>(y * side_px)];
    const float* there = &noise[static_cast<std::size_t>((y + dy) * side_px)] + dx;
    float row = 0;
    for (int x = begin; x < end; ++x) row += here[x] * there[x];
    sum += static_cast<double>(row);
  }
  return sum / (kVariance * (end - begin) * (side_px - dy));
}

}  // namespace

TEST_CASE("A camera's white noise is normal, and its spectrum over time is flat") {
  constexpr int kFrames = 4096;
  constexpr int kWidth = 64;
  constexpr int kHeight = 48;
  constexpr double kPixels = kWidth * kHeight;
  std::vector<double> cycles;
  for (int k = 0; k < 24; ++k) cycles.push_back(3 + 85 * k);  // to 0.96 of Nyquist, with independent windows
  statistics::Spectrum spectrum(cycles, kFrames, kWidth * kHeight);
  ThermalCamera camera = cameras::camera(white_sensor(), {.width_px = kWidth, .height_px = kHeight});
  const Plane<float> scene = cameras::uniform_scene(kWidth, kHeight, 300);
  SensorFrame frame;
  double second = 0;
  double fourth = 0;
  for (int i = 0; i < kFrames; ++i) {
    camera.expose(scene, frame);
    const std::vector<float> noise = noise_of(frame.ir16);
    spectrum.add(i, noise);
    for (const float value : noise) {
      const double square = static_cast<double>(value) * static_cast<double>(value);
      second += square;
      fourth += square * square;
    }
  }
  constexpr double kValues = kPixels * kFrames;
  // A slope of 1.7 % per kelvin between radiance and temperature changes the variance of (0.1 K)^2 by 1e-5 and the
  // kurtosis by 1e-4 at most.
  CHECK_THAT(second / kValues, WithinRel(kVariance, kSigmas * std::sqrt(2 / kValues) + 1e-5));
  CHECK_THAT(fourth / kValues / std::pow(second / kValues, 2),
             WithinAbs(3, kSigmas * std::sqrt(24 / kValues) + 1e-4));
  double chi_square = 0;
  std::vector<double> powers;
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    powers.push_back(spectrum.power(k) / (kPixels * kVariance));
    CAPTURE(cycles[k]);
    CHECK_THAT(powers[k], WithinAbs(1, kSigmas / std::sqrt(kPixels)));
    chi_square += kPixels * std::pow(powers[k] - 1, 2);
  }
  CHECK_THAT(chi_square, WithinAbs(24, kSigmas * std::sqrt(2 * 24.0)));
  const statistics::Line line = statistics::fit_line(cycles, powers);
  CHECK_THAT(line.slope, WithinAbs(0, kSigmas * line.slope_per_noise / std::sqrt(kPixels)));
}

TEST_CASE("White noise of different pixels is independent: no tiles, no stripes") {
  constexpr int kSide = 256;
  constexpr int kReach = 64;
  ThermalCamera camera = cameras::camera(white_sensor(), {.width_px = kSide, .height_px = kSide});
  const std::vector<float> noise = noise_of(camera.expose(cameras::uniform_scene(kSide, kSide, 300)).ir16);
  int shifts = 0;
  int beyond = 0;
  double largest = 0;
  for (int dy = 0; dy <= kReach; ++dy) {
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) {
      const double pairs = (kSide - std::abs(dx)) * (kSide - dy);
      const double sigmas = std::abs(correlation(noise, kSide, dx, dy)) * std::sqrt(pairs);
      ++shifts;
      beyond += sigmas > 1.96 ? 1 : 0;
      largest = std::max(largest, sigmas);
    }
  }
  // 5 % of the shifts exceed 1.96 / sqrt(N); their number is binomial.
  CHECK_THAT(beyond, WithinAbs(0.05 * shifts, kSigmas * std::sqrt(0.05 * 0.95 * shifts)));
  // 8384 shifts: the largest of them exceeds 6 sigma once in 60,000 sound pictures.
  CHECK(largest < 6);
}

TEST_CASE("White noise does not repeat later in the picture, or in later frames") {
  constexpr int kSide = 512;
  ThermalCamera camera = cameras::camera(white_sensor(), {.width_px = kSide, .height_px = kSide});
  const Plane<float> scene = cameras::uniform_scene(kSide, kSide, 300);
  const std::vector<float> first = noise_of(camera.expose(scene).ir16);
  const std::vector<float> second = noise_of(camera.expose(scene).ir16);
  const auto sigmas = [](const std::vector<float>& a, const std::vector<float>& b, std::size_t shift) {
    double sum = 0;
    for (std::size_t i = shift; i < a.size(); ++i) {
      sum += static_cast<double>(a[i]) * static_cast<double>(b[i - shift]);
    }
    return std::abs(sum) / (kVariance * std::sqrt(static_cast<double>(a.size() - shift)));
  };
  // Batches of 64 numbers, blocks of 256 pixels and chunks of 16384 begin here.
  for (std::size_t shift = 64; shift < first.size() / 2; shift = shift < 1024 ? shift + 64 : shift * 2) {
    CAPTURE(shift);
    CHECK(sigmas(first, first, shift) < kSigmas);
    CHECK(sigmas(second, first, shift) < kSigmas);
    CHECK(sigmas(first, second, shift) < kSigmas);
  }
  CHECK(sigmas(first, second, 0) < kSigmas);
}

}  // namespace white_noise_test
