#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

/// Estimators that statistical tests share.
namespace statistics {

inline constexpr double kSigmas = 5;  // a sound generator fails one check in 1.7 million

/// Least-squares line through points (x, y): its slope, and the slope's standard deviation for independent y with a
/// standard deviation of 1.
struct Line {
  double slope = 0;
  double slope_per_noise = 0;
};

inline Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  double mean = 0;
  for (const double value : x) mean += value / static_cast<double>(x.size());
  double spread = 0;
  double rise = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    spread += (x[i] - mean) * (x[i] - mean);
    rise += (x[i] - mean) * y[i];
  }
  return {.slope = rise / spread, .slope_per_noise = 1 / std::sqrt(spread)};
}

/// Periodograms of many pixels at chosen frequencies, through Hann's window, which prevents strong low frequencies
/// from leaking into weak high ones.
class Spectrum {
 public:
  /// @param cycles  whole cycles in all frames, more than 1 and fewer than frames / 2
  Spectrum(std::vector<double> cycles, int frames, std::size_t pixels)
      : cycles_(std::move(cycles)),
        frames_(frames),
        real_(cycles_.size(), std::vector<float>(pixels)),
        imaginary_(real_) {}

  void add(int frame, const std::vector<float>& pixels) {
    const double turn = 2 * std::numbers::pi * frame / frames_;
    const double window = 1 - std::cos(turn + std::numbers::pi / frames_);
    for (std::size_t k = 0; k < cycles_.size(); ++k) {
      const auto cosine = static_cast<float>(window * std::cos(cycles_[k] * turn));
      const auto sine = static_cast<float>(window * std::sin(cycles_[k] * turn));
      float* real = real_[k].data();
      float* imaginary = imaginary_[k].data();
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        real[i] += cosine * pixels[i];
        imaginary[i] += sine * pixels[i];
      }
    }
  }

  /// Sum over the pixels of the spectral density, one-sided, times rate / 2: 1 for white noise of variance 1 in
  /// one pixel. The squares of the window sum to 1.5 frames.
  [[nodiscard]] double power(std::size_t k) const {
    double sum = 0;
    for (std::size_t i = 0; i < real_[k].size(); ++i) {
      const auto real = static_cast<double>(real_[k][i]);
      const auto imaginary = static_cast<double>(imaginary_[k][i]);
      sum += real * real + imaginary * imaginary;
    }
    return sum / (1.5 * frames_);
  }

 private:
  std::vector<double> cycles_;
  int frames_;
  std::vector<std::vector<float>> real_;
  std::vector<std::vector<float>> imaginary_;
};

}  // namespace statistics
