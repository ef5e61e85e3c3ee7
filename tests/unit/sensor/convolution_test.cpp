#include "sensor/optics/convolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "base/parallel.h"
#include "sensor/optics/psf.h"
#include "support/catch.h"

namespace convolution_test {

using namespace thermal;

namespace {

constexpr double kFloatRounding = 6e-8;  // half of float's eps

Plane<float> random_picture(int width_px, int height_px) {
  Plane<float> picture(width_px, height_px);
  std::mt19937 random(static_cast<unsigned>(1000 * width_px + height_px));
  for (float& pixel : picture.pixels()) pixel = 1 + static_cast<float>(random() % 1000) / 10;
  return picture;
}

int radius_px(double sigma_px) { return static_cast<int>(std::ceil(4 * sigma_px)); }

/// Bound of the relative error of a positive picture: along each axis a pixel is a sum of 2 radius + 1 products
/// of a rounded weight, which rounds 2 radius + 3 times at most.
double relative_bound(double sigma_px) { return 2 * (2 * radius_px(sigma_px) + 3) * kFloatRounding; }

int mirrored(int at, int size) {
  while (at < 0 || at >= size) at = at < 0 ? -1 - at : 2 * size - 1 - at;
  return at;
}

/// The documented result of Convolution with gaussian_kernel, in double precision.
double blurred_at(const Plane<float>& picture, double sigma_px, int x, int y) {
  const int radius = radius_px(sigma_px);
  double sum = 0;
  double weights = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const double weight = std::exp(-(dx * dx + dy * dy) / (2 * sigma_px * sigma_px));
      const int from_x = mirrored(x + dx, picture.width_px());
      const int from_y = mirrored(y + dy, picture.height_px());
      sum += weight * static_cast<double>(picture.at(from_x, from_y));
      weights += weight;
    }
  }
  return sum / weights;
}

double sum_of(const Plane<float>& picture) {
  return std::accumulate(picture.pixels().begin(), picture.pixels().end(), 0.0);
}

Plane<float> flipped(const Plane<float>& picture) {
  Plane<float> result = picture;
  std::reverse(result.pixels().begin(), result.pixels().end());
  return result;
}

Plane<float> convolved(Plane<float> picture, const HalfKernel& kernel) {
  Convolution(kernel).apply(picture);
  return picture;
}

Plane<float> blurred(const Plane<float>& picture, double sigma_px) {
  return convolved(picture, gaussian_kernel(sigma_px));
}

double kernel_sum(const HalfKernel& kernel) {
  double sum = static_cast<double>(kernel[0]);
  for (std::size_t tap = 1; tap < kernel.size(); ++tap) sum += 2 * static_cast<double>(kernel[tap]);
  return sum;
}

}  // namespace

TEST_CASE("Without a sigma the picture stays as it is") {
  const Plane<float> picture = random_picture(17, 9);
  CHECK(blurred(picture, 0) == picture);
  CHECK(blurred(Plane<float>(), 1).empty());
}

TEST_CASE("A blur is the documented convolution, including borders") {
  const auto [width_px, height_px] =
      GENERATE(table<int, int>({{33, 21}, {16, 16}, {1, 1}, {1, 9}, {9, 1}, {2, 3}}));
  const double sigma_px =
      GENERATE(0.3, 1.0, 2.5);  // the last extends beyond the small pictures several times
  CAPTURE(width_px, height_px, sigma_px);
  const Plane<float> picture = random_picture(width_px, height_px);
  const Plane<float> result = blurred(picture, sigma_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      REQUIRE_THAT(static_cast<double>(result.at(x, y)),
                   WithinRel(blurred_at(picture, sigma_px, x, y), relative_bound(sigma_px)));
    }
  }
}

TEST_CASE("A blur conserves the sum, including borders") {
  const auto [width_px, height_px] = GENERATE(table<int, int>({{64, 48}, {5, 4}, {1, 1}, {1, 50}, {50, 1}}));
  const double sigma_px = GENERATE(0.5, 1.0, 3.0);
  const Plane<float> picture = random_picture(width_px, height_px);
  CHECK_THAT(sum_of(blurred(picture, sigma_px)), WithinRel(sum_of(picture), relative_bound(sigma_px)));
}

TEST_CASE("Every kernel conserves energy to 1e-6, of points in corners and on borders too") {
  const HalfKernel kernel =
      GENERATE(gaussian_kernel(0.5), gaussian_kernel(3), gaussian_psf(0.3), gaussian_psf(0.8));
  // The middle weight absorbs the rounding, so the sum is off by at most that weight's own rounding.
  CHECK_THAT(kernel_sum(kernel), WithinAbs(1, kFloatRounding * static_cast<double>(kernel[0])));
  const auto [width_px, height_px] = GENERATE(table<int, int>({{24, 20}, {3, 2}, {1, 1}, {1, 7}, {7, 1}}));
  const int x = GENERATE_COPY(0, width_px / 2, width_px - 1);
  const int y = GENERATE_COPY(0, height_px / 2, height_px - 1);
  CAPTURE(width_px, height_px, x, y);
  Plane<float> point(width_px, height_px);
  point.at(x, y) = 1000;
  CHECK_THAT(sum_of(convolved(point, kernel)), WithinRel(1000.0, 1e-6));
}

TEST_CASE("A constant picture stays constant to rounding") {
  const HalfKernel kernel = gaussian_psf(0.7);
  const Plane<float> flat = convolved(Plane<float>(70, 50, 63.75F), kernel);
  // 2 radius + 1 rounded products and as many sums, along each axis; the kernel's own sum is off by 6e-8.
  const double bound = 2 * (4 * static_cast<double>(kernel.size()) * kFloatRounding + 6e-8);
  for (const float value : flat.pixels()) REQUIRE_THAT(static_cast<double>(value), WithinRel(63.75, bound));
}

TEST_CASE("One convolution serves pictures of several sizes") {
  Convolution convolution(gaussian_kernel(1));
  for (const int width_px : {40, 7, 40}) {
    Plane<float> picture = random_picture(width_px, 11);
    const Plane<float> expected = blurred(picture, 1);
    convolution.apply(picture);
    CHECK(picture == expected);
  }
}

TEST_CASE("A point spreads equally in all four directions, bit for bit") {
  Plane<float> point(31, 31);
  point.at(15, 15) = 1;  // so that only the weights' products are rounded, in the same way in either order
  const Plane<float> spread = blurred(point, 1.7);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      REQUIRE(spread.at(x, y) == spread.at(30 - x, y));
      REQUIRE(spread.at(x, y) == spread.at(x, 30 - y));
      REQUIRE(spread.at(x, y) == spread.at(y, x));
    }
  }
}

TEST_CASE("A point spreads by the requested sigma") {
  const double sigma_px = GENERATE(0.8, 1.0, 2.0);
  Plane<float> point(41, 41);
  point.at(20, 20) = 1;
  const Plane<float> spread = blurred(point, sigma_px);
  double variance = 0;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) variance += (x - 20) * (x - 20) * static_cast<double>(spread.at(x, y));
  }
  // The tails cut at 4 sigma hold 6.3e-5 of the weight and up to 1.2e-3 of the variance; sampling at pixel
  // centres changes the variance by 4 pi^2 sigma^2 exp(-2 pi^2 sigma^2) 2, which is 1.7e-4 at 0.8 px.
  CHECK_THAT(variance, WithinRel(sigma_px * sigma_px, 1.4e-3));
}

TEST_CASE("Turning the picture turns the result, bit for bit") {
  const Plane<float> picture = random_picture(37, 18);
  CHECK(blurred(flipped(picture), 1) == flipped(blurred(picture, 1)));
}

TEST_CASE("A NaN affects pixels within the kernel's radius, and no others") {
  Plane<float> picture = random_picture(31, 21);
  const Plane<float> clean = blurred(picture, 1);
  picture.at(15, 10) = std::numeric_limits<float>::quiet_NaN();
  const Plane<float> spoilt = blurred(picture, 1);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 31; ++x) {
      const bool reached = std::abs(x - 15) <= 4 && std::abs(y - 10) <= 4;
      REQUIRE(std::isnan(spoilt.at(x, y)) == reached);
      if (!reached) REQUIRE(spoilt.at(x, y) == clean.at(x, y));
    }
  }
}

TEST_CASE("Threads change nothing") {
  const Plane<float> picture = random_picture(128, 100);
  const auto blurred_with = [&picture](int threads) {
    return with_threads(threads, [&picture] { return blurred(picture, 1.3); });
  };
  CHECK(blurred_with(1) == blurred_with(2));
}

}  // namespace convolution_test
