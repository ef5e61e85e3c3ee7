#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sensor/noise.h"
#include "support/catch.h"

using namespace thermal;

namespace {

constexpr double kSigmas = 5;
constexpr double kTwoPi = 2 * std::numbers::pi;

Plane<float> next_of(FlickerNoise& noise, int width_px, int height_px) {
  Plane<float> picture(width_px, height_px);
  noise.add_next(1, picture);
  return picture;
}

double mean_square(const Plane<float>& picture) {
  double sum = 0;
  for (const float value : picture.pixels()) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum / static_cast<double>(picture.size());
}

/// Periodograms of all pixels, averaged, at chosen frequencies.
class Spectrum {
 public:
  Spectrum(std::vector<double> cycles, int frames, std::size_t pixels)
      : cycles_(std::move(cycles)),
        frames_(frames),
        real_(cycles_.size(), std::vector<float>(pixels)),
        imaginary_(real_) {}

  void add(int frame, const Plane<float>& picture) {
    const auto pixels = picture.pixels();
    const double window =
        1 - std::cos(kTwoPi * (frame + 0.5) / frames_);  // Hann's: no leak from low frequencies
    for (std::size_t k = 0; k < cycles_.size(); ++k) {
      const double phase_rad = kTwoPi * cycles_[k] * frame / frames_;
      const auto cosine = static_cast<float>(window * std::cos(phase_rad));
      const auto sine = static_cast<float>(window * std::sin(phase_rad));
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        real_[k][i] += cosine * pixels[i];
        imaginary_[k][i] += sine * pixels[i];
      }
    }
  }

  /// In any unit, the same for all frequencies.
  [[nodiscard]] double power(std::size_t k) const {
    double sum = 0;
    for (std::size_t i = 0; i < real_[k].size(); ++i) {
      sum +=
          std::pow(static_cast<double>(real_[k][i]), 2) + std::pow(static_cast<double>(imaginary_[k][i]), 2);
    }
    return sum / static_cast<double>(real_[k].size());
  }

 private:
  std::vector<double> cycles_;
  int frames_;
  std::vector<std::vector<float>> real_;
  std::vector<std::vector<float>> imaginary_;
};

/// Least-squares line through points (x, y): its slope, and how much unit noise on y would make of it.
struct Line {
  double slope = 0;
  double slope_per_noise = 0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
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

}  // namespace

TEST_CASE("1/f noise is as strong in the first frame as in any later one") {
  constexpr int kSide = 256;
  constexpr double kPixels = kSide * kSide;
  FlickerNoise noise(3, "clip", 9, kSide, kSide);
  for (int frame = 0; frame <= 500; ++frame) {
    const Plane<float> picture = next_of(noise, kSide, kSide);
    if (frame > 1 && frame < 499) continue;
    CAPTURE(frame);
    // Pixels are independent normals of variance 1.
    CHECK_THAT(mean_square(picture), WithinAbs(1, kSigmas * std::sqrt(2 / kPixels)));
  }
}

TEST_CASE("1/f noise of one pixel says nothing of its neighbour's") {
  constexpr int kSide = 512;
  FlickerNoise noise(3, "clip", 9, kSide, kSide);
  (void)next_of(noise, kSide, kSide);
  const Plane<float> picture = next_of(noise, kSide, kSide);
  double across = 0;
  double down = 0;
  for (int y = 1; y < kSide; ++y) {
    for (int x = 1; x < kSide; ++x) {
      const double here = static_cast<double>(picture.at(x, y));
      across += here * static_cast<double>(picture.at(x - 1, y));
      down += here * static_cast<double>(picture.at(x, y - 1));
    }
  }
  constexpr double kPairs = (kSide - 1.0) * (kSide - 1.0);
  CHECK_THAT(across / kPairs, WithinAbs(0, kSigmas / std::sqrt(kPairs)));
  CHECK_THAT(down / kPairs, WithinAbs(0, kSigmas / std::sqrt(kPairs)));
}

TEST_CASE("The spectrum of 1/f noise falls as 1/f over two decades") {
  constexpr int kFrames = 8192;
  constexpr double kFrameRate = 60;
  constexpr int kWidth = 64;
  constexpr int kHeight = 32;
  constexpr double kPixels = kWidth * kHeight;
  // Whole cycles in the clip, evenly spread over 0.03 to 3 Hz, far enough apart to be independent.
  std::vector<double> cycles;
  std::vector<double> decades;
  for (int k = 0; k <= 20; ++k) {
    cycles.push_back(std::round(0.03 * std::pow(10, 0.1 * k) * kFrames / kFrameRate) + (k < 4 ? k : 0));
    decades.push_back(std::log10(cycles.back()));
  }
  Spectrum spectrum(cycles, kFrames, static_cast<std::size_t>(kPixels));
  FlickerNoise noise(3, "clip", kFrameRate, kWidth, kHeight);
  for (int frame = 0; frame < kFrames; ++frame) spectrum.add(frame, next_of(noise, kWidth, kHeight));
  std::vector<double> log_power;
  for (std::size_t k = 0; k < cycles.size(); ++k) log_power.push_back(std::log10(spectrum.power(k)));
  const Line line = fit_line(decades, log_power);

  // A periodogram scatters by its own size; averaged over the pixels, its logarithm by this much.
  const double scatter = 1 / (std::numbers::ln10 * std::sqrt(kPixels));
  const double by_chance = kSigmas * scatter * line.slope_per_noise;
  // Corners a decade apart leave a ripple of 2 sech(pi^2 / ln 10) = 5.5 % or 0.023 in the logarithm, one period a
  // decade; over two periods it tilts a line by at most 1.5 / pi of that.
  const double ripple = 0.023 * 1.5 / std::numbers::pi;
  // No corner above 10 Hz: at 3 Hz 5 % are missing, 0.022 in the logarithm, ten times less a decade below, which
  // tilts the line by less than half of it.
  const double cut = 0.022 / 2;
  CAPTURE(line.slope, by_chance);
  CHECK(by_chance < 0.02);
  CHECK_THAT(line.slope, WithinAbs(-1, by_chance + ripple + cut));
}
