#include "analysis/compare/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "analysis/compare/order_statistics.h"

namespace thermal {
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
