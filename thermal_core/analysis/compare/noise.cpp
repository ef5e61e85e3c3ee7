#include "analysis/compare/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/order_statistics.h"

namespace thermal {
namespace {

constexpr int kBlockPx = 16;

/// A block minus its best-fitting plane; empty if it holds black or white.
using Block = std::array<double, std::size_t{kBlockPx} * kBlockPx>;
std::optional<Block> flattened(const Plane<float>& frame, int left, int top) {
  constexpr double kMiddle = 0.5 * (kBlockPx - 1);
  constexpr double kCount = kBlockPx * kBlockPx;
  constexpr double kMoment =
      kCount * (kBlockPx * kBlockPx - 1) / 12.0;  // sum of squared distances from the middle
  Block block{};
  double sum = 0;
  double across = 0;
  double down = 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const int x = static_cast<int>(k) % kBlockPx;
    const int y = static_cast<int>(k) / kBlockPx;
    const auto level = static_cast<double>(frame.at(left + x, top + y));
    if (level <= 0 || level >= 255) return {};
    block[k] = level;
    sum += level;
    across += level * (x - kMiddle);
    down += level * (y - kMiddle);
  }
  for (std::size_t k = 0; k < block.size(); ++k) {
    const std::size_t row = k / kBlockPx;
    const double x = static_cast<double>(k % kBlockPx) - kMiddle;
    const double y = static_cast<double>(row) - kMiddle;
    block[k] -= sum / kCount + (across * x + down * y) / kMoment;
  }
  return block;
}

FlatNoise noise_of(const Block& block) {
  constexpr std::size_t kRow = kBlockPx;
  double squares = 0;
  double along = 0;
  double diagonal = 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    squares += block[k] * block[k];
    if (k % kRow + 1 == kRow) continue;
    along += block[k] * block[k + 1];
    if (k + kRow + 1 < block.size()) diagonal += block[k] * block[k + kRow + 1];
  }
  const auto count = static_cast<double>(block.size());
  FlatNoise noise = {.deviation = std::sqrt(squares / (count - 3))};
  if (squares <= 0) return noise;
  const auto mean = [](double sum, std::size_t pairs) { return sum / static_cast<double>(pairs); };
  noise.along_rows = mean(along, kRow * (kRow - 1)) * count / squares;
  noise.diagonal = mean(diagonal, (kRow - 1) * (kRow - 1)) * count / squares;
  return noise;
}

/// Means of a video over its frames, rows and columns.
class VideoMeans {
 public:
  explicit VideoMeans(const std::vector<Plane<float>>& frames)
      : frames_(frames),
        count_(frames.size()),
        height_(static_cast<std::size_t>(frames[0].height_px())),
        width_(static_cast<std::size_t>(frames[0].width_px())),
        row_(count_ * height_),
        column_(count_ * width_),
        frame_(count_),
        pixel_(height_ * width_),
        still_row_(height_),
        still_column_(width_) {
    for (std::size_t t = 0; t < count_; ++t) add(t);
  }

  /// Mean squares of the model's effects, each over its degrees of freedom.
  [[nodiscard]] VideoNoise variances() const {
    const double t = static_cast<double>(count_);
    const double v = static_cast<double>(height_);
    const double h = static_cast<double>(width_);
    VideoNoise found;
    found.random = random_squares() / ((t - 1) * (v - 1) * (h - 1));
    found.rows = squares_of(row_, still_row_) / ((t - 1) * (v - 1)) - found.random / h;
    found.columns = squares_of(column_, still_column_) / ((t - 1) * (h - 1)) - found.random / v;
    double squares = 0;
    for (const double mean : frame_) squares += (mean - mean_) * (mean - mean_);
    found.frames = squares / (t - 1) - found.rows / v - found.columns / h - found.random / (v * h);
    return found;
  }

 private:
  void add(std::size_t t) {
    const double t_share = 1.0 / static_cast<double>(count_);
    const double v_share = 1.0 / static_cast<double>(height_);
    const double h_share = 1.0 / static_cast<double>(width_);
    for (std::size_t v = 0; v < height_; ++v) {
      const auto levels = frames_[t].row(static_cast<int>(v));
      for (std::size_t h = 0; h < width_; ++h) {
        const auto level = static_cast<double>(levels[h]);
        row_[t * height_ + v] += level * h_share;
        column_[t * width_ + h] += level * v_share;
        frame_[t] += level * v_share * h_share;
        pixel_[v * width_ + h] += level * t_share;
        still_row_[v] += level * t_share * h_share;
        still_column_[h] += level * t_share * v_share;
        mean_ += level * t_share * v_share * h_share;
      }
    }
  }

  [[nodiscard]] double random_squares() const {
    double squares = 0;
    for (std::size_t t = 0; t < count_; ++t) {
      for (std::size_t v = 0; v < height_; ++v) {
        const auto levels = frames_[t].row(static_cast<int>(v));
        for (std::size_t h = 0; h < width_; ++h) {
          const double rest = static_cast<double>(levels[h]) - row_[t * height_ + v] -
                              column_[t * width_ + h] - pixel_[v * width_ + h] + frame_[t] + still_row_[v] +
                              still_column_[h] - mean_;
          squares += rest * rest;
        }
      }
    }
    return squares;
  }

  /// Squares of the means of rows or columns, minus those of their frame and of their position.
  [[nodiscard]] double squares_of(const std::vector<double>& lines, const std::vector<double>& still) const {
    double squares = 0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double rest = lines[k] - frame_[k / still.size()] - still[k % still.size()] + mean_;
      squares += rest * rest;
    }
    return squares;
  }

  const std::vector<Plane<float>>& frames_;
  std::size_t count_;
  std::size_t height_;
  std::size_t width_;
  std::vector<double> row_;
  std::vector<double> column_;
  std::vector<double> frame_;
  std::vector<double> pixel_;
  std::vector<double> still_row_;
  std::vector<double> still_column_;
  double mean_ = 0;
};

/// A frame without its finest details, which are noise, scaled to a mean of 0 and a deviation of 1; 0 if it has none.
cv::Mat smoothed(const Plane<float>& frame) {
  constexpr double kBlurPx = 2;
  cv::Mat mat(frame.height_px(), frame.width_px(), CV_32F);
  std::copy(frame.pixels().begin(), frame.pixels().end(), mat.ptr<float>());
  cv::GaussianBlur(mat, mat, {}, kBlurPx);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(mat, mean, deviation);
  return (mat - mean) / std::max(deviation[0], 1e-9);
}

/// Shift between two smoothed frames, by least squares: their difference is the gradient times the shift. For shifts of
/// up to about the blur.
double shift_px(const cv::Mat& first, const cv::Mat& second) {
  cv::Mat across;
  cv::Mat down;
  const cv::Mat middle = 0.5 * (first + second);
  cv::Sobel(middle, across, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(middle, down, CV_32F, 0, 1, 3, 1.0 / 8);
  const cv::Mat difference = first - second;
  const double xx = across.dot(across);
  const double yy = down.dot(down);
  const double xy = across.dot(down);
  const double x = across.dot(difference);
  const double y = down.dot(difference);
  const double determinant = xx * yy - xy * xy;
  if (determinant <= 0) return 0;
  return std::hypot(x * yy - y * xy, y * xx - x * xy) / determinant;
}

}  // namespace

std::optional<FlatNoise> flat_noise(const Plane<float>& frame) {
  constexpr std::size_t kLeastBlocks = 10;
  constexpr double kFlattest = 0.1;
  std::vector<FlatNoise> blocks;
  std::vector<double> deviations;
  for (int top = 0; top + kBlockPx <= frame.height_px(); top += kBlockPx) {
    for (int left = 0; left + kBlockPx <= frame.width_px(); left += kBlockPx) {
      const auto block = flattened(frame, left, top);
      if (!block) continue;
      blocks.push_back(noise_of(*block));
      deviations.push_back(blocks.back().deviation);
    }
  }
  if (blocks.size() < kLeastBlocks) return {};
  FlatNoise found = {.deviation = quantile_of(std::move(deviations), kFlattest)};
  std::vector<double> along;
  std::vector<double> diagonal;
  for (const FlatNoise& block : blocks) {
    if (block.deviation > found.deviation || !block.along_rows) continue;
    along.push_back(*block.along_rows);
    diagonal.push_back(*block.diagonal);
  }
  if (along.empty()) return found;
  found.along_rows = median_of(std::move(along));
  found.diagonal = median_of(std::move(diagonal));
  return found;
}

VideoNoise video_noise(const std::vector<Plane<float>>& frames) {
  const VideoNoise variances = VideoMeans(frames).variances();
  const auto deviation = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
  return {deviation(variances.random), deviation(variances.rows), deviation(variances.columns),
          deviation(variances.frames)};
}

bool is_still(const std::vector<Plane<float>>& frames) {
  constexpr double kMostShiftPx = 0.1;
  constexpr double kLeastCorrelation = 0.9;  // cuts and rotations have less; estimate
  const Plane<float>& first = frames.front();
  for (const Plane<float>& frame : frames) {
    if (frame.width_px() != first.width_px() || frame.height_px() != first.height_px()) return false;
  }
  const cv::Mat before = smoothed(first);
  const cv::Mat after = smoothed(frames.back());
  const double correlation = before.dot(after) / static_cast<double>(first.size());
  return correlation >= kLeastCorrelation && shift_px(before, after) < kMostShiftPx;
}

}  // namespace thermal
