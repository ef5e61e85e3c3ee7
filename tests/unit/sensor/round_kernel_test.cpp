#include "sensor/optics/round_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/rng.h"
#include "sensor/optics/optics.h"
#include "sensor/optics/psf.h"
#include "support/catch.h"

namespace round_kernel_test {

using namespace thermal;

namespace {

using std::numbers::pi;

const SpectralResponse kBand = SpectralResponse::flat(8, 14);
constexpr PixelSampling kQuarters = {4, true};

struct Lens {
  double f_number;
  double pixel_pitch_um;
  double defocus_um = 0;
};

OpticsParameters optics_of(const Lens& lens) {
  return {.psf = Psf::physical,
          .f_number = lens.f_number,
          .defocus_um = lens.defocus_um,
          .pixel_pitch_um = lens.pixel_pitch_um};
}

/// Largest difference between the kernel's transfer and the lens's, in all directions up to Nyquist.
double worst_misfit(const Lens& lens, const PixelSampling& sampling) {
  const OpticsParameters optics = optics_of(lens);
  const RoundKernel kernel = round_kernel(optics, kBand, sampling);
  const OpticsTransfer wanted(optics, kBand);
  double worst = 0;
  for (int i = 0; i <= 50; ++i) {
    for (int j = 0; j <= 50; ++j) {
      const double misfit = sampled_mtf(kernel, sampling, 0.01 * i, 0.01 * j) - wanted.at(0.01 * i, 0.01 * j);
      worst = std::max(worst, std::abs(misfit));
    }
  }
  return worst;
}

Plane<float> random_plane(int width_px, int height_px, std::uint32_t stream, float low, float high) {
  Plane<float> plane(width_px, height_px);
  fill_uniform({.seed = 5, .stream = stream, .clip = 0, .frame = 0}, 0, plane.pixels());
  for (float& value : plane.pixels()) value = low + (high - low) * value;
  return plane;
}

double sum_of(const Plane<float>& plane) {
  return std::accumulate(plane.pixels().begin(), plane.pixels().end(), 0.0);
}

/// Means and detail of a picture of quarters, twice as fine.
struct Picture {
  explicit Picture(const Plane<float>& fine)
      : means(fine.width_px() / 2, fine.height_px() / 2), detail{means, means, means} {
    for (int y = 0; y < means.height_px(); ++y) {
      for (int x = 0; x < means.width_px(); ++x) {
        const float a = fine.at(2 * x, 2 * y);
        const float b = fine.at(2 * x + 1, 2 * y);
        const float c = fine.at(2 * x, 2 * y + 1);
        const float d = fine.at(2 * x + 1, 2 * y + 1);
        means.at(x, y) = (a + b + c + d) / 4;
        detail.across.at(x, y) = (b + d - a - c) / 4;
        detail.down.at(x, y) = (c + d - a - b) / 4;
        detail.crossed.at(x, y) = (a + d - b - c) / 4;
      }
    }
  }

  Plane<float> means;
  SubpixelDetail detail;
};

/// A wave, as quarters.
Plane<float> wave(int width_px, int height_px, double across_cycles_per_px, double down_cycles_per_px) {
  Plane<float> fine(2 * width_px, 2 * height_px);
  for (int y = 0; y < fine.height_px(); ++y) {
    for (int x = 0; x < fine.width_px(); ++x) {
      const double turns = across_cycles_per_px * ((x + 0.5) / 2 - width_px / 2.0) +
                           down_cycles_per_px * ((y + 0.5) / 2 - height_px / 2.0);
      fine.at(x, y) = static_cast<float>(std::cos(2 * pi * turns));
    }
  }
  return fine;
}

}  // namespace

TEST_CASE("With quarters of pixels, a lens's transfer is within .01 in all directions up to Nyquist") {
  const Lens lens =
      GENERATE(Lens{1, 12}, Lens{1, 17}, Lens{1.25, 12}, Lens{1.25, 17}, Lens{1.4, 12}, Lens{2, 17},
               Lens{1, 12, 30}, Lens{1, 12, 60}, Lens{1.25, 17, 40}, Lens{1.25, 17, 60});
  const int across = GENERATE(2, 4);
  CAPTURE(lens.f_number, lens.pixel_pitch_um, lens.defocus_um, across);
  CHECK(worst_misfit(lens, {across, true}) < 0.01);
}

TEST_CASE("Without them it is within .06 for means of samples, and .08 for single ones") {
  const Lens lens = GENERATE(Lens{1, 12}, Lens{1.25, 17}, Lens{1.4, 12}, Lens{2, 17});
  CAPTURE(lens.f_number, lens.pixel_pitch_um);
  CHECK(worst_misfit(lens, {1, false}) < 0.08);
  CHECK(worst_misfit(lens, {3, false}) < 0.06);
  CHECK(worst_misfit(lens, {64, false}) < 0.06);
}

TEST_CASE("A wave passes with its frequency's transfer, in all directions") {
  constexpr int kSide = 96;
  const OpticsParameters optics = optics_of({1.25, 17});
  const OpticsTransfer wanted(optics, kBand);
  RoundConvolution convolution(round_kernel(optics, kBand, {2, true}));
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.23}, {0.31, 0.31}, {0.5, 0.0}, {0.45, 0.2}, {0.45, -0.4}}) {
    CAPTURE(x, y);
    Picture picture(wave(kSide, kSide, x, y));
    convolution.apply(picture.detail, picture.means);
    double product = 0;
    double square = 0;
    for (int row = 24; row < kSide - 24; ++row) {
      for (int column = 24; column < kSide - 24; ++column) {
        const double phase = 2 * pi * (x * (column + 0.5 - kSide / 2.0) + y * (row + 0.5 - kSide / 2.0));
        product += std::cos(phase) * static_cast<double>(picture.means.at(column, row));
        square += std::cos(phase) * std::cos(phase);
      }
    }
    if (square > 1) CHECK_THAT(product / square, WithinAbs(wanted.at(x, y), 0.011));
  }
}

TEST_CASE("No pixel is below the coldest or above the warmest quarter") {
  const Lens lens = GENERATE(Lens{1, 12}, Lens{1.25, 17}, Lens{1.25, 17, 60});
  RoundConvolution convolution(round_kernel(optics_of(lens), kBand, kQuarters));
  // 1200 K in a quarter of one pixel beside 270 K, band radiances in W m^-2 sr^-1.
  Plane<float> fine(128, 96, 27.0F);
  fine.at(63, 47) = 2600;
  Picture picture(fine);
  convolution.apply(picture.detail, picture.means);
  const auto [least, most] = std::ranges::minmax(picture.means.pixels());
  CHECK(least >= 27 * (1 - 1e-5F));
  CHECK(most < 2600);
  Picture noisy(random_plane(128, 96, 1, 20, 200));
  convolution.apply(noisy.detail, noisy.means);
  for (const float value : noisy.means.pixels()) REQUIRE((value >= 20 && value <= 200));
}

TEST_CASE("Light is conserved, of points in corners and on borders too") {
  const PixelSampling sampling = GENERATE(PixelSampling{1, false}, kQuarters);
  RoundConvolution convolution(round_kernel(optics_of({1.25, 17}), kBand, sampling));
  const auto [width_px, height_px] = GENERATE(table<int, int>({{48, 40}, {4, 4}, {8, 4}}));
  const int x = GENERATE_COPY(0, width_px / 2, width_px - 1);
  const int y = GENERATE_COPY(0, height_px - 1);
  CAPTURE(width_px, height_px, x, y);
  Plane<float> fine(2 * width_px, 2 * height_px);
  fine.at(2 * x, 2 * y + 1) = 4000;
  Picture picture(fine);
  convolution.apply(sampling.quarters ? picture.detail : SubpixelDetail(), picture.means);
  CHECK_THAT(sum_of(picture.means), WithinRel(1000.0, 2e-6));
}

TEST_CASE("A constant picture stays constant, of any size") {
  RoundConvolution convolution(round_kernel(optics_of({1.25, 17}), kBand, {}));
  const auto [width_px, height_px] = GENERATE(table<int, int>({{70, 50}, {1, 1}, {1, 9}, {13, 2}, {3, 3}}));
  Plane<float> flat(width_px, height_px, 63.75F);
  convolution.apply({}, flat);
  for (const float value : flat.pixels()) REQUIRE_THAT(static_cast<double>(value), WithinRel(63.75, 3e-6));
  Plane<float> none;
  convolution.apply({}, none);
  CHECK(none.empty());
}

TEST_CASE("A mirrored scene is a mirrored picture, and threads change no bit") {
  constexpr int kWidth = 50;
  constexpr int kHeight = 38;
  const Plane<float> fine = random_plane(2 * kWidth, 2 * kHeight, 2, 20, 80);
  RoundConvolution convolution(round_kernel(optics_of({1.25, 17}), kBand, kQuarters));
  Picture picture(fine);
  with_threads(1, [&] { convolution.apply(picture.detail, picture.means); });
  Picture again(fine);
  with_threads(4, [&] { convolution.apply(again.detail, again.means); });
  CHECK(again.means == picture.means);
  Plane<float> turned_fine = fine;
  std::ranges::reverse(turned_fine.pixels());
  Picture turned(turned_fine);
  convolution.apply(turned.detail, turned.means);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 8; x < kWidth - 8; ++x)
      REQUIRE_THAT(static_cast<double>(turned.means.at(kWidth - 1 - x, kHeight - 1 - y)),
                   WithinRel(static_cast<double>(picture.means.at(x, y)), 0.02));  // blocks begin elsewhere
  }
}

}  // namespace round_kernel_test
