#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "sensor/processing.h"
#include "support/cameras.h"
#include "support/catch.h"
#include "support/planes.h"

namespace detail_test {

using namespace thermal;

namespace {

using Counts = Plane<std::uint16_t>;

constexpr double kCountsPerNetd = 4;

Counts random_counts(int width_px, int height_px) {
  return planes::random_counts(width_px, height_px, 29000, 400);
}

/// Cold on the left, `height` counts warmer from column `edge` on.
Counts step(int width_px, int height_px, int edge, int height) {
  Counts counts(width_px, height_px, 29000);
  for (int y = 0; y < height_px; ++y)
    for (int x = edge; x < width_px; ++x) counts.at(x, y) = static_cast<std::uint16_t>(29000 + height);
  return counts;
}

/// He's guided filter as the paper has it, in double precision and pixel by pixel.
std::vector<double> reference_detail(const Counts& ir16, int radius, double edge_counts) {
  const int width = ir16.width_px();
  const int height = ir16.height_px();
  const auto mean = [&](int x, int y, const auto& value) {
    double sum = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        sum += value(std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1));
    return sum / ((2 * radius + 1) * (2 * radius + 1));
  };
  const auto count = [&](int x, int y) { return static_cast<double>(ir16.at(x, y)); };
  const auto gain = [&](int x, int y) {
    const double middle = mean(x, y, count);
    const double variance = mean(x, y, [&](int u, int v) { return std::pow(count(u, v) - middle, 2); });
    return variance / (variance + edge_counts * edge_counts);
  };
  const auto offset = [&](int x, int y) { return mean(x, y, count) * (1 - gain(x, y)); };
  std::vector<double> detail;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      detail.push_back(count(x, y) - mean(x, y, gain) * count(x, y) - mean(x, y, offset));
  return detail;
}

}  // namespace

TEST_CASE("Detail is the picture less its guided filter, up to the border") {
  const auto [width_px, height_px] =
      GENERATE(std::pair(19, 13), std::pair(1, 7), std::pair(7, 1), std::pair(1, 1));
  const int radius_px = GENERATE(1, 3);
  const double edge_counts = GENERATE(20.0, 200.0);
  CAPTURE(width_px, height_px, radius_px, edge_counts);
  const Counts ir16 = random_counts(width_px, height_px);
  Plane<float> detail;
  find_detail(ir16, radius_px, edge_counts, detail);
  const std::vector<double> exact = reference_detail(ir16, radius_px, edge_counts);
  // Offsets of up to 65,535 counts in single precision, summed over 49 pixels: 49 x 65,535 x 6e-8 / 7 = 0.03 counts.
  for (std::size_t i = 0; i < ir16.size(); ++i)
    REQUIRE(std::abs(static_cast<double>(detail.pixels()[i]) - exact[i]) < 0.03);
}

TEST_CASE("A faint edge overshoots by the gain times its detail, on both sides") {
  constexpr int kHeight = 40;  // 10 NETDs
  const int radius_px = GENERATE(1, 3);
  const double gain = GENERATE(1.0, 4.0);
  const double noise_netd = GENERATE(0.0, 2.5);
  CAPTURE(radius_px, gain, noise_netd);
  DetailEnhancer enhancer({.detail = {.gain_dn_per_netd = gain,
                                      .radius_px = radius_px,
                                      .edge_netd = 1000,
                                      .noise_netd = noise_netd}},
                          kCountsPerNetd);
  Plane<std::uint8_t> ir8(41, 9, 128);
  enhancer.sharpen(step(41, 9, 20, kHeight), ir8);
  // The base is the mean of means, a triangle of 2 w - 1 pixels for windows of w: beside the edge, (w - 1) / 2 w of its
  // weight lies on the other side.
  const int w = 2 * radius_px + 1;
  const double detail_netd = kHeight / kCountsPerNetd * (w - 1) / (2.0 * w);
  const double change = gain * std::max(0.0, detail_netd - noise_netd);
  CHECK_THAT(ir8.at(20, 4) - 128.0, WithinAbs(change, 0.51));
  CHECK_THAT(ir8.at(19, 4) - 128.0, WithinAbs(-change, 0.51));
  CHECK(ir8.at(5, 4) == 128);
  CHECK(ir8.at(35, 4) == 128);
}

TEST_CASE("A strong edge has no halo") {
  DetailEnhancer enhancer({.detail = {.gain_dn_per_netd = 4, .edge_netd = 10, .noise_netd = 2.5}},
                          kCountsPerNetd);
  Plane<std::uint8_t> ir8(41, 9, 128);
  enhancer.sharpen(step(41, 9, 20, 4000), ir8);  // 1000 NETDs
  CHECK(std::ranges::all_of(ir8.pixels(), [](std::uint8_t level) { return level == 128; }));
}

TEST_CASE("Detail of black_hot is darker where it is warmer, and levels stay in range") {
  const Counts counts = random_counts(50, 40);
  AgcParameters parameters = {.detail = {.gain_dn_per_netd = 3, .noise_netd = 2.5}};
  const auto sharpened = [&](Polarity polarity, std::uint8_t level) {
    Plane<std::uint8_t> ir8(50, 40, level);
    parameters.polarity = polarity;
    DetailEnhancer(parameters, kCountsPerNetd).sharpen(counts, ir8);
    return ir8;
  };
  const Plane<std::uint8_t> white = sharpened(Polarity::white_hot, 100);
  const Plane<std::uint8_t> black = sharpened(Polarity::black_hot, 155);
  for (std::size_t i = 0; i < counts.size(); ++i)
    REQUIRE(std::abs(white.pixels()[i] + black.pixels()[i] - 255) <= 1);  // halves round up in both
  CHECK(std::ranges::max(sharpened(Polarity::white_hot, 250).pixels()) == 255);
  CHECK(std::ranges::min(sharpened(Polarity::white_hot, 5).pixels()) == 0);
  parameters.black_level = 12;
  parameters.white_level = 244;
  CHECK(std::ranges::max(sharpened(Polarity::white_hot, 240).pixels()) == 244);
  CHECK(std::ranges::min(sharpened(Polarity::white_hot, 15).pixels()) == 12);
  CHECK(std::ranges::max(sharpened(Polarity::black_hot, 240).pixels()) == 243);
  CHECK(std::ranges::min(sharpened(Polarity::black_hot, 15).pixels()) == 11);
}

TEST_CASE("Noise alone is hardly sharpened at the defaults") {
  SensorParameters parameters;
  parameters.agc = {.mode = AgcMode::linear, .low_k = 295, .high_k = 305};  // 1.02 levels a NETD
  const auto deviation = [](const Plane<std::uint8_t>& ir8) {
    double sum = 0;
    double squares = 0;
    for (const std::uint8_t level : ir8.pixels()) {
      sum += level;
      squares += level * level;
    }
    const auto pixels = static_cast<double>(ir8.size());
    return std::sqrt(squares / pixels - sum / pixels * (sum / pixels));
  };
  const auto exposed = [&](double gain) {
    parameters.agc.detail.gain_dn_per_netd = gain;
    ThermalCamera camera = cameras::camera(parameters, {.width_px = 160, .height_px = 120});
    return deviation(camera.expose(cameras::uniform_scene(160, 120, 300)).ir8);
  };
  CHECK(exposed(1) < 1.1 * exposed(0));
}

TEST_CASE("Without a gain a camera's picture is the same as before, and sharpening changes 8 bits alone") {
  SensorParameters parameters = cameras::full_sensor();
  const auto exposed = [&](double gain, int threads) {
    parameters.agc.detail.gain_dn_per_netd = gain;
    return with_threads(threads, [&] {
      ThermalCamera camera = cameras::camera(parameters, {.width_px = 64, .height_px = 48});
      (void)camera.expose(cameras::uniform_scene(64, 48, 300));
      return camera.expose(cameras::uniform_scene(64, 48, 303));
    });
  };
  const SensorFrame plain = exposed(0, 1);
  const SensorFrame sharp = exposed(4, 1);
  CHECK(sharp.ir16 == plain.ir16);
  CHECK(sharp.curve == plain.curve);
  CHECK_FALSE(sharp.ir8 == plain.ir8);
  CHECK(exposed(4, 4).ir8 == sharp.ir8);
  Plane<std::uint8_t> again;
  apply_tone_curve(plain.curve, Polarity::white_hot, plain.ir16, again);
  CHECK(again == plain.ir8);
}

TEST_CASE("What is not measured and what is clipped keeps its level beyond the headroom") {
  const Polarity polarity = GENERATE(Polarity::white_hot, Polarity::black_hot);
  Counts counts = random_counts(20, 20);
  counts.at(5, 5) = 0;
  counts.at(9, 9) = 65535;
  const std::uint8_t unmeasured = polarity == Polarity::black_hot ? 255 : 0;
  const auto clipped = static_cast<std::uint8_t>(255 - unmeasured);
  Plane<std::uint8_t> ir8(20, 20, 128);
  ir8.at(5, 5) = unmeasured;
  ir8.at(9, 9) = clipped;
  DetailEnhancer enhancer({.polarity = polarity,
                           .black_level = 12,
                           .white_level = 244,
                           .detail = {.gain_dn_per_netd = 4, .noise_netd = 0}},
                          kCountsPerNetd);
  enhancer.sharpen(counts, ir8);
  CHECK(ir8.at(5, 5) == unmeasured);
  CHECK(ir8.at(9, 9) == clipped);
  const auto [low, high] = std::ranges::minmax(ir8.row(15));
  CHECK((low >= 11 && high <= 244));
}

}  // namespace detail_test
