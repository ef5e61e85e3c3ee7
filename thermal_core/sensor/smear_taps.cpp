#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/cholesky.h"
#include "base/clones.h"
#include "sensor/smear.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kOldest = 16;         // time constants: older samples weigh 1e-7
constexpr double kLongPx = 40;         // longer motion is sampled more coarsely
constexpr int kMostNodes = 66;         // of the quadrature of shorter motion
constexpr int kMostSteps = 256;        // of longer motion
constexpr int kReachPx = 3;            // of the interpolation
constexpr double kLeastWeight = 1e-3;  // of a sample that is kept

struct Node {
  double position = 0;  ///< 0 to 1 within the interval
  double weight = 0;
};

/// Nodes and weights of Gauss and Legendre on 0 to 1, by Newton's method (Numerical Recipes, 4.6).
std::vector<Node> legendre_nodes(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      double value = 1;
      double before = 0;
      for (int k = 0; k < count; ++k) {
        const double older = before;
        before = value;
        value = ((2 * k + 1) * x * before - k * older) / (k + 1);
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back({.position = (1 - x) / 2, .weight = 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

const std::vector<Node>& nodes_of(int count) {
  static const auto kAll = [] {
    std::array<std::vector<Node>, kMostNodes + 1> all;
    for (int n = 1; n <= kMostNodes; ++n) all.at(static_cast<std::size_t>(n)) = legendre_nodes(n);
    return all;
  }();
  return kAll.at(static_cast<std::size_t>(count));
}

constexpr std::size_t kSamples = 2 * kReachPx;
constexpr std::size_t kLanes = 8;  // fills the processor's registers; lanes past the samples are 0
using Weights = std::array<double, kLanes>;

/// Adds the products of weights down and across to a part of a grid.
VELDT_CLONES void add_products(const double* down, const double* across, double* __restrict out,
                               std::size_t width) {
  for (std::size_t row = 0; row < kSamples; ++row, out += width)
    for (std::size_t i = 0; i < kLanes; ++i) out[i] += down[row] * across[i];
}

VELDT_CLONES void mix_weights(const double* one, const double* other, double share, double* __restrict out) {
  for (std::size_t i = 0; i < kLanes; ++i) out[i] = (1 - share) * one[i] + share * other[i];
}

/// Mean of cos(2 pi f x) over the frequencies that the interpolation is optimised for.
double correlation(double px) {
  constexpr double kBand = 0.32;  // cycles per pixel
  const double x = 2 * pi * kBand * px;
  return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
}

/// Weights with a sum of 1 whose transfer is closest, by least squares over these frequencies, to a shift by a fraction
/// of a pixel.
Weights shift_weights(double fraction) {
  std::vector<double> matrix;
  std::vector<double> right;
  for (int i = 0; i < static_cast<int>(kSamples); ++i) {
    for (int k = 0; k < static_cast<int>(kSamples); ++k) matrix.push_back(correlation(i - k));
    right.push_back(correlation(i - (kReachPx - 1) - fraction));
  }
  Weights weights{};
  std::ranges::copy(solve_with_sum(matrix, right, std::vector<double>(kSamples, 1)), weights.begin());
  return weights;
}

/// Interpolation weights of the 6 samples around a position, by its fraction of a pixel.
class Interpolation {
 public:
  Interpolation() {
    for (std::size_t step = 0; step < all_.size(); ++step)
      all_.at(step) = shift_weights(static_cast<double>(step) / kSteps);
  }

  [[nodiscard]] Weights at(double fraction) const {
    const double position = fraction * kSteps;
    const auto step = static_cast<std::size_t>(std::min(position, kSteps - 1.0));
    const double share = position - static_cast<double>(step);
    Weights weights{};
    mix_weights(all_.at(step).data(), all_.at(step + 1).data(), share, weights.data());
    return weights;
  }

 private:
  static constexpr int kSteps = 256;
  std::array<Weights, kSteps + 1> all_{};
};

/// Path of a pixel's samples, from the youngest (0) to the oldest (1).
struct Way {
  double from_x_px = 0;
  double from_y_px = 0;
  double x_px = 0;
  double y_px = 0;

  [[nodiscard]] double x_at(double position) const noexcept { return from_x_px + position * x_px; }
  [[nodiscard]] double y_at(double position) const noexcept { return from_y_px + position * y_px; }
  [[nodiscard]] double length_px() const noexcept { return std::hypot(x_px, y_px); }
};

/// Sums of weights over a rectangle of samples.
class TapGrid {
 public:
  explicit TapGrid(const Way& way)
      : left_(static_cast<int>(std::floor(std::min(way.from_x_px, way.from_x_px + way.x_px))) - kReachPx),
        top_(static_cast<int>(std::floor(std::min(way.from_y_px, way.from_y_px + way.y_px))) - kReachPx),
        width_(static_cast<int>(std::ceil(std::abs(way.x_px)) + kLanes + 3)),
        weights_(static_cast<std::size_t>(width_) *
                 static_cast<std::size_t>(std::ceil(std::abs(way.y_px)) + kSamples + 3)) {}

  void add(double x_px, double y_px, double weight) {
    static const Interpolation kInterpolation;
    const double x = std::floor(x_px);
    const double y = std::floor(y_px);
    const Weights across = kInterpolation.at(x_px - x);
    Weights down = kInterpolation.at(y_px - y);
    for (double& share : down) share *= weight;
    const int first_x = static_cast<int>(x) - (kReachPx - 1) - left_;
    const int first_y = static_cast<int>(y) - (kReachPx - 1) - top_;
    add_products(down.data(), across.data(), &weights_[static_cast<std::size_t>(first_y * width_ + first_x)],
                 static_cast<std::size_t>(width_));
  }

  [[nodiscard]] std::vector<SmearTap> taps() const {
    std::vector<SmearTap> taps;
    taps.reserve(weights_.size());
    double sum = 0;
    for (const double weight : weights_) sum += std::abs(weight) < kLeastWeight ? 0 : weight;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      if (std::abs(weights_[i]) < kLeastWeight) continue;
      const auto at = static_cast<int>(i);
      taps.push_back({.x_px = left_ + at % width_,
                      .y_px = top_ + at / width_,
                      .weight = static_cast<float>(weights_[i] / sum)});
    }
    return taps;
  }

 private:
  int left_;
  int top_;
  int width_;
  std::vector<double> weights_;
};

std::vector<SmearTap> short_taps(const Way& way, double ages) {
  TapGrid grid(way);
  for (const Node& node : nodes_of(6 + static_cast<int>(std::ceil(1.5 * way.length_px())))) {
    const double density = ages * std::exp(-ages * node.position) / -std::expm1(-ages);
    grid.add(way.x_at(node.position), way.y_at(node.position), node.weight * density);
  }
  return grid.taps();
}

/// Integral of the age, in intervals, over the youngest `share` of the weight.
double age_integral(double share, double ages) {
  const double all = -std::expm1(-ages);
  const double rest = 1 - all * share;
  return ((rest > 0 ? rest * std::log(rest) : 0) + all * share) / (all * ages);
}

/// Steps of equal weight, each at its mean age, between four pixels.
std::vector<SmearTap> long_taps(const Way& way, double ages) {
  const double dense_px = way.length_px() * std::min(1.0, 1 / ages);
  const int steps = std::clamp(static_cast<int>(std::ceil(8 * dense_px)), 64, kMostSteps);
  std::vector<SmearTap> taps;
  taps.reserve(4 * static_cast<std::size_t>(steps));
  for (int i = 0; i < steps; ++i) {
    const double position =
        steps * (age_integral((i + 1.0) / steps, ages) - age_integral(static_cast<double>(i) / steps, ages));
    const double x = std::floor(way.x_at(position));
    const double y = std::floor(way.y_at(position));
    const double right = way.x_at(position) - x;
    const double down = way.y_at(position) - y;
    for (int corner = 0; corner < 4; ++corner) {
      const double share = (corner % 2 == 1 ? right : 1 - right) * (corner / 2 == 1 ? down : 1 - down);
      taps.push_back({.x_px = static_cast<int>(x) + corner % 2,
                      .y_px = static_cast<int>(y) + corner / 2,
                      .weight = static_cast<float>(share / steps)});
    }
  }
  return taps;
}

}  // namespace

std::vector<SmearTap> smear_taps(double x_px, double y_px, double ages, double begins) {
  const double shown = std::min(1.0, kOldest / ages);
  const Way way = {
      .from_x_px = begins * x_px, .from_y_px = begins * y_px, .x_px = x_px * shown, .y_px = y_px * shown};
  return way.length_px() < kLongPx ? short_taps(way, ages * shown) : long_taps(way, ages * shown);
}

}  // namespace thermal
