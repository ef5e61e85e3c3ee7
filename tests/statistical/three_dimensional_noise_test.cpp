#include <cmath>
#include <vector>

#include "support/cameras.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace three_dimensional_noise_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

constexpr int kFrames = 10000;
constexpr int kRows = 48;
constexpr int kColumns = 64;
constexpr double kT = kFrames;
constexpr double kV = kRows;
constexpr double kH = kColumns;

/// One number per component of three-dimensional noise, of which there are seven.
struct Components {
  double tvh = 0;
  double tv = 0;
  double th = 0;
  double vh = 0;
  double t = 0;
  double v = 0;
  double h = 0;
};

double squared(double value) { return value * value; }

/// Sums of a cube of pixels, relative to a middle value, over one, two and all of its three directions.
class CubeSums {
 public:
  void add(int frame, const Plane<std::uint16_t>& ir16, int middle) {
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const double value = ir16.at(x, y) - middle;
        const auto pixel = static_cast<std::size_t>(y * kColumns + x);
        over_t_[pixel] += value;
        over_h_[static_cast<std::size_t>(frame * kRows + y)] += value;
        over_v_[static_cast<std::size_t>(frame * kColumns + x)] += value;
        squares_ += value * value;
      }
    }
  }

  /// Mean squares of a three-way analysis of variance without repetition.
  [[nodiscard]] Components mean_squares() const {
    std::vector<double> t(kFrames);
    std::vector<double> v(kRows);
    std::vector<double> h(kColumns);
    double mean = 0;
    for (std::size_t i = 0; i < over_h_.size(); ++i) t[i / kRows] += over_h_[i] / (kV * kH);
    for (std::size_t i = 0; i < over_t_.size(); ++i) {
      v[i / kColumns] += over_t_[i] / (kT * kH);
      h[i % kColumns] += over_t_[i] / (kT * kV);
      mean += over_t_[i] / (kT * kV * kH);
    }
    Components sums;
    for (const double value : t) sums.t += kV * kH * squared(value - mean);
    for (const double value : v) sums.v += kT * kH * squared(value - mean);
    for (const double value : h) sums.h += kT * kV * squared(value - mean);
    for (std::size_t i = 0; i < over_h_.size(); ++i) {
      sums.tv += kH * squared(over_h_[i] / kH - t[i / kRows] - v[i % kRows] + mean);
    }
    for (std::size_t i = 0; i < over_v_.size(); ++i) {
      sums.th += kV * squared(over_v_[i] / kV - t[i / kColumns] - h[i % kColumns] + mean);
    }
    for (std::size_t i = 0; i < over_t_.size(); ++i) {
      sums.vh += kT * squared(over_t_[i] / kT - v[i / kColumns] - h[i % kColumns] + mean);
    }
    sums.tvh =
        squares_ - kT * kV * kH * squared(mean) - sums.t - sums.v - sums.h - sums.tv - sums.th - sums.vh;
    return {.tvh = sums.tvh / ((kT - 1) * (kV - 1) * (kH - 1)),
            .tv = sums.tv / ((kT - 1) * (kV - 1)),
            .th = sums.th / ((kT - 1) * (kH - 1)),
            .vh = sums.vh / ((kV - 1) * (kH - 1)),
            .t = sums.t / (kT - 1),
            .v = sums.v / (kV - 1),
            .h = sums.h / (kH - 1)};
  }

 private:
  std::vector<double> over_t_ = std::vector<double>(kRows * kColumns);
  std::vector<double> over_h_ = std::vector<double>(kFrames * kRows);
  std::vector<double> over_v_ = std::vector<double>(kFrames * kColumns);
  double squares_ = 0;
};

/// Expected mean squares for given variances of the components: a mean along one direction still contains a fraction
/// of everything that varies along it, which is why the plain variances of means are too large in a finite cube
/// (Haefner and Burks, Finite sampling corrected 3D noise with confidence intervals, Applied Optics 54, 2015).
Components expected_mean_squares(const Components& variance) {
  Components mean;
  mean.tvh = variance.tvh;
  mean.tv = mean.tvh + kH * variance.tv;
  mean.th = mean.tvh + kV * variance.th;
  mean.vh = mean.tvh + kT * variance.vh;
  mean.t = mean.tv + mean.th - mean.tvh + kV * kH * variance.t;
  mean.v = mean.tv + mean.vh - mean.tvh + kT * kH * variance.v;
  mean.h = mean.th + mean.vh - mean.tvh + kT * kV * variance.h;
  return mean;
}

/// The variances with these expected mean squares: unbiased.
Components unbiased(const Components& mean) {
  return {.tvh = mean.tvh,
          .tv = (mean.tv - mean.tvh) / kH,
          .th = (mean.th - mean.tvh) / kV,
          .vh = (mean.vh - mean.tvh) / kT,
          .t = (mean.t - mean.tv - mean.th + mean.tvh) / (kV * kH),
          .v = (mean.v - mean.tv - mean.vh + mean.tvh) / (kT * kH),
          .h = (mean.h - mean.th - mean.vh + mean.tvh) / (kT * kV)};
}

/// Standard deviations of the unbiased variances: mean squares of normals are independent, each chi-square over
/// its degrees of freedom, with variance 2 mean^2 / freedoms.
Components deviations(const Components& mean) {
  const double tvh = 2 * squared(mean.tvh) / ((kT - 1) * (kV - 1) * (kH - 1));
  const double tv = 2 * squared(mean.tv) / ((kT - 1) * (kV - 1));
  const double th = 2 * squared(mean.th) / ((kT - 1) * (kH - 1));
  const double vh = 2 * squared(mean.vh) / ((kV - 1) * (kH - 1));
  return {.tvh = std::sqrt(tvh),
          .tv = std::sqrt(tv + tvh) / kH,
          .th = std::sqrt(th + tvh) / kV,
          .vh = std::sqrt(vh + tvh) / kT,
          .t = std::sqrt(2 * squared(mean.t) / (kT - 1) + tv + th + tvh) / (kV * kH),
          .v = std::sqrt(2 * squared(mean.v) / (kV - 1) + tv + vh + tvh) / (kT * kH),
          .h = std::sqrt(2 * squared(mean.h) / (kH - 1) + th + vh + tvh) / (kT * kV)};
}

}  // namespace

TEST_CASE("Every component of three-dimensional noise has the requested strength in 10,000 frames") {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.netd_mk = 80;  // 8 counts: rounding to counts is white noise of 1/12
  parameters.noise = {.amount = 1,
                      .fixed_pattern_ratio = 0.5,
                      .row_ratio = 0.4,
                      .column_ratio = 0.35,
                      .temporal_row_ratio = 0.3,
                      .temporal_column_ratio = 0.25,
                      .frame_ratio = 0.2};
  ThermalCamera camera =
      cameras::camera(parameters, {.width_px = kColumns, .height_px = kRows, .frame_rate_hz = 30});
  const Plane<float> scene = cameras::uniform_scene(kColumns, kRows, 300);
  CubeSums sums;
  SensorFrame frame;
  for (int i = 0; i < kFrames; ++i) {
    camera.expose(scene, frame);
    sums.add(i, frame.ir16, 30000);
  }
  const double white = 64;  // counts squared
  const Components asked = {.tvh = white + 1.0 / 12,
                            .tv = white * squared(parameters.noise.temporal_row_ratio),
                            .th = white * squared(parameters.noise.temporal_column_ratio),
                            .vh = white * squared(parameters.noise.fixed_pattern_ratio),
                            .t = white * squared(parameters.noise.frame_ratio),
                            .v = white * squared(parameters.noise.row_ratio),
                            .h = white * squared(parameters.noise.column_ratio)};
  const Components found = unbiased(sums.mean_squares());
  const Components sigma = deviations(expected_mean_squares(asked));
  // 99.9 % of a normal distribution are within 3.29 sigma; that all seven are is only required for this seed, because
  // one sound seed in 140 fails. No sound seed fails 5 sigma; v and h have only 47 and 63 degrees of freedom, whose
  // longer upper tails exceed 5 sigma once in 60,000.
  // A slope of 1.7 % per kelvin between radiance and temperature changes a variance of (0.12 K)^2 by 1e-5.
  const auto check = [](const char* name, double found_variance, double asked_variance, double deviation) {
    CAPTURE(name, found_variance, asked_variance, deviation);
    CHECK_THAT(found_variance, WithinAbs(asked_variance, kSigmas * deviation));
    CHECK_THAT(found_variance, WithinAbs(asked_variance, 3.29 * deviation));
  };
  check("tvh", found.tvh, asked.tvh, sigma.tvh);
  check("tv", found.tv, asked.tv, sigma.tv);
  check("th", found.th, asked.th, sigma.th);
  check("vh", found.vh, asked.vh, sigma.vh);
  check("t", found.t, asked.t, sigma.t);
  check("v", found.v, asked.v, sigma.v);
  check("h", found.h, asked.h, sigma.h);
}

}  // namespace three_dimensional_noise_test
