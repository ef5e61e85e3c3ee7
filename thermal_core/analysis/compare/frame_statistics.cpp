#include "analysis/compare/frame_statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/order_statistics.h"

namespace thermal {
namespace {

/// Smallest level with at least this share of the pixels at or below it.
std::size_t level_at(const std::array<double, kGreyLevels>& shares, double share) {
  double sum = 0;
  for (std::size_t level = 0; level < kGreyLevels; ++level) {
    sum += shares[level];
    if (sum >= share) return level;
  }
  return kGreyLevels - 1;
}

void find_comb(std::size_t low, std::size_t high, GreyLevels& found) {
  double sum = 0;
  double steps = 0;
  double empty = 0;
  for (std::size_t level = low; level <= high; ++level) {
    sum += found.shares[level];
    empty += found.shares[level] == 0 ? 1 : 0;
    if (level > low) steps += std::abs(found.shares[level] - found.shares[level - 1]);
  }
  const auto levels = static_cast<double>(high - low + 1);
  found.empty_share = empty / levels;
  if (levels > 1) found.roughness = steps / (levels - 1) / (sum / levels);
}

}  // namespace

GreyLevels grey_levels(const Plane<float>& frame) {
  GreyLevels found;
  const double share = 1.0 / static_cast<double>(frame.size());
  std::array<std::size_t, kGreyLevels> counts{};
  double sum = 0;
  double squares = 0;
  for (const float pixel : frame.pixels()) {
    const auto level = static_cast<double>(pixel);
    ++counts[static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 255L))];
    sum += level;
    squares += level * level;
  }
  for (std::size_t level = 0; level < kGreyLevels; ++level)
    found.shares[level] = static_cast<double>(counts[level]) * share;
  found.mean = sum * share;
  found.deviation = std::sqrt(std::max(0.0, squares * share - found.mean * found.mean));
  const std::size_t low = level_at(found.shares, 0.01);
  const std::size_t high = level_at(found.shares, 0.99);
  found.low = static_cast<double>(low);
  found.high = static_cast<double>(high);
  find_comb(low, high, found);
  return found;
}

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

namespace {

cv::Mat mat_of(const Plane<float>& frame) {
  cv::Mat mat(frame.height_px(), frame.width_px(), CV_32F);
  std::ranges::copy(frame.pixels(), mat.ptr<float>());
  return mat;
}

/// Mean square of the second differences of means over this many pixels each, times `pixels`.
double roughness_of_means(const cv::Mat& means, int pixels) {
  double squares = 0;
  const auto count = static_cast<int>(means.total());
  const auto* values = means.ptr<double>();
  for (int k = 1; k + 1 < count; ++k) {
    const double bend = values[k - 1] - 2 * values[k] + values[k + 1];
    squares += bend * bend;
  }
  return squares / (count - 2) * pixels;
}

/// Moments of one orientation's coefficients, whose mean is 0.
struct Moments {
  double squares = 0;
  double fourths = 0;

  void add(double value) {
    squares += value * value;
    fourths += value * value * value * value;
  }
};

}  // namespace

std::optional<double> stripe_excess(const Plane<float>& frame) {
  const cv::Mat mat = mat_of(frame);
  cv::Mat rows;
  cv::Mat columns;
  cv::reduce(mat, rows, 1, cv::REDUCE_AVG, CV_64F);
  cv::reduce(mat, columns, 0, cv::REDUCE_AVG, CV_64F);
  const double by_rows = roughness_of_means(rows, frame.width_px());
  const double by_columns = roughness_of_means(columns, frame.height_px());
  if (by_rows <= 0 || by_columns <= 0) return {};
  return std::log10(by_rows / by_columns);
}

double spot_balance(const Plane<float>& frame) {
  constexpr double kFinePx = 2;
  constexpr double kCoarsePx = 3.2;
  constexpr int kWindowPx = 13;
  constexpr double kDeviations = 3;
  constexpr double kLeastLevels = 0.5;
  constexpr double kDeviationOfMedian = 1.4826;  // of a normal distribution over the median of its magnitude
  const cv::Mat mat = mat_of(frame);
  cv::Mat fine;
  cv::Mat coarse;
  cv::GaussianBlur(mat, fine, {}, kFinePx);
  cv::GaussianBlur(mat, coarse, {}, kCoarsePx);
  const cv::Mat response = fine - coarse;
  const cv::Mat magnitude = cv::abs(response);
  cv::Mat strongest;
  cv::dilate(magnitude, strongest, cv::Mat::ones(kWindowPx, kWindowPx, CV_8U));
  const double threshold = std::max(
      kLeastLevels, kDeviations * kDeviationOfMedian *
                        median_of(std::vector<double>(magnitude.begin<float>(), magnitude.end<float>())));
  const cv::Mat spots = (magnitude == strongest) & (magnitude > threshold);
  return std::log10((cv::countNonZero(spots & (response > 0)) + 1.0) /
                    (cv::countNonZero(spots & (response < 0)) + 1.0));
}

std::optional<double> wavelet_kurtosis(const Plane<float>& frame) {
  constexpr int kSide = 4;
  std::array<Moments, 3> moments;
  double count = 0;
  for (int y = 0; y + kSide <= frame.height_px(); y += kSide) {
    for (int x = 0; x + kSide <= frame.width_px(); x += kSide) {
      const auto sum = [&](int left, int top) {
        return static_cast<double>(frame.at(x + left, y + top)) +
               static_cast<double>(frame.at(x + left + 1, y + top)) +
               static_cast<double>(frame.at(x + left, y + top + 1)) +
               static_cast<double>(frame.at(x + left + 1, y + top + 1));
      };
      const double a = sum(0, 0);
      const double b = sum(2, 0);
      const double c = sum(0, 2);
      const double d = sum(2, 2);
      moments[0].add(a + b - c - d);
      moments[1].add(a - b + c - d);
      moments[2].add(a - b - c + d);
      count += 1;
    }
  }
  double kurtosis = 0;
  for (const Moments& one : moments) {
    if (one.squares <= 0) return {};
    kurtosis += one.fourths * count / (one.squares * one.squares) / static_cast<double>(moments.size());
  }
  return kurtosis;
}

double longest_line_px(const Plane<float>& frame) {
  constexpr double kBlurPx = 1.5;
  constexpr double kWeak = 40;
  constexpr double kStrong = 80;
  constexpr double kAngle = std::numbers::pi / 180;
  constexpr int kVotes = 60;
  constexpr double kLeastPx = 30;
  constexpr double kGapPx = 8;
  cv::Mat smooth;
  cv::GaussianBlur(mat_of(frame), smooth, {}, kBlurPx);
  smooth.convertTo(smooth, CV_8U);
  cv::Mat edges;
  cv::Canny(smooth, edges, kWeak, kStrong);
  std::vector<cv::Vec4i> lines;
  cv::HoughLinesP(edges, lines, 1, kAngle, kVotes, kLeastPx, kGapPx);
  double longest = 0;
  for (const cv::Vec4i& line : lines)
    longest = std::max(longest, std::hypot(line[2] - line[0], line[3] - line[1]));
  return longest;
}

Structure structure_of(const Plane<float>& frame) {
  return {.stripes = stripe_excess(frame),
          .spots = spot_balance(frame),
          .tails = wavelet_kurtosis(frame),
          .line_px = longest_line_px(frame)};
}

}  // namespace thermal
