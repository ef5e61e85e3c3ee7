#include "analysis/compare/radial_power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/core.hpp>

namespace thermal {
namespace {

constexpr double kReferencePixels = 640.0 * 512.0;

std::vector<double> hann_window(int count) {
  std::vector<double> window(static_cast<std::size_t>(count), 1.0);
  for (int k = 0; k < count && count > 1; ++k)
    window[static_cast<std::size_t>(k)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * k / (count - 1));
  return window;
}

cv::Mat windowed(const Plane<float>& frame) {
  const std::vector<double> across = hann_window(frame.width_px());
  const std::vector<double> down = hann_window(frame.height_px());
  double sum = 0;
  for (const float level : frame.pixels()) sum += static_cast<double>(level);
  const double mean = sum / static_cast<double>(frame.size());
  cv::Mat weighted(frame.height_px(), frame.width_px(), CV_64F);
  for (int y = 0; y < frame.height_px(); ++y) {
    const auto row = frame.row(y);
    auto* out = weighted.ptr<double>(y);
    for (std::size_t x = 0; x < row.size(); ++x)
      out[x] = (static_cast<double>(row[x]) - mean) * across[x] * down[static_cast<std::size_t>(y)];
  }
  return weighted;
}

/// Means of values between edges.
class BinnedMeans {
 public:
  explicit BinnedMeans(const std::vector<double>& edges)
      : edges_(edges), sums_(edges.size() - 1), counts_(edges.size() - 1) {}

  void add(double radius, double power) {
    const auto above = std::upper_bound(edges_.begin(), edges_.end(), radius);
    if (above == edges_.begin() || above == edges_.end()) return;
    const auto bin = static_cast<std::size_t>(above - edges_.begin() - 1);
    sums_[bin] += power;
    counts_[bin] += 1;
  }

  [[nodiscard]] std::vector<double> means() const {
    std::vector<double> means(sums_.size());
    for (std::size_t k = 0; k < means.size(); ++k) means[k] = counts_[k] > 0 ? sums_[k] / counts_[k] : 0;
    return means;
  }

 private:
  std::vector<double> edges_;
  std::vector<double> sums_;
  std::vector<double> counts_;
};

/// Frequency of a row or column of a transform, cycles a pixel; its sign does not matter.
double frequency_of(int place, int count) {
  return static_cast<double>(std::min(place, count - place)) / static_cast<double>(count);
}

}  // namespace

const std::vector<double>& curve_edges() {
  static const std::vector<double> kEdges = [] {
    constexpr int kSteps = 28;  // four an octave
    std::vector<double> made;
    for (int k = 0; k <= kSteps; ++k) made.push_back(0.5 * std::pow(2.0, 0.25 * (k - kSteps)));
    return made;
  }();
  return kEdges;
}

RadialPower radial_power(const Plane<float>& frame) {
  cv::Mat transform;
  cv::dft(windowed(frame), transform, cv::DFT_COMPLEX_OUTPUT);
  BinnedMeans bands({kBandEdges.begin(), kBandEdges.end()});
  BinnedMeans curve(curve_edges());
  const double scale = kReferencePixels / static_cast<double>(frame.size());
  for (int y = 0; y < transform.rows; ++y) {
    const auto* row = transform.ptr<cv::Vec2d>(y);
    for (int x = 0; x < transform.cols; ++x) {
      const double radius = std::hypot(frequency_of(x, transform.cols), frequency_of(y, transform.rows));
      const double power = scale * (row[x][0] * row[x][0] + row[x][1] * row[x][1]);
      bands.add(radius, power);
      curve.add(radius, power);
    }
  }
  RadialPower found = {.bands = {}, .curve = curve.means()};
  const std::vector<double> means = bands.means();
  std::copy(means.begin(), means.end(), found.bands.begin());
  return found;
}

}  // namespace thermal
