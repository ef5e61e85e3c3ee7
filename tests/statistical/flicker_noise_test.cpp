#include "sensor/flicker_noise.h"

#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "support/cameras.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace flicker_noise_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

double mean_square(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

constexpr double kFrameRate = 60;
constexpr int kFrames = 16384;
constexpr std::size_t kPixels = 10240;

/// Whole cycles of the clip, evenly spaced over 0.02 to 20 Hz; windows overlap from 3 cycles on.
std::vector<double> three_decades() {
  std::vector<double> cycles;
  for (int k = 0; k <= 12; ++k) {
    const double hz = 0.02 * std::pow(10, k / 4.0);
    const double nearest = std::round(hz * kFrames / kFrameRate);
    cycles.push_back(k == 0 ? nearest : std::max(nearest, cycles.back() + 3));
  }
  return cycles;
}

/// Mean over pixels of the periodograms of one run, in chunks of pixels, each through all frames.
std::vector<double> measured_powers(const FlickerDesign& design, const std::vector<double>& cycles) {
  constexpr std::size_t kChunk = 512;
  FlickerNoise noise(3, "clip", design, kPixels);
  std::vector<std::vector<double>> chunks(kPixels / kChunk);
  parallel_for(kPixels, kChunk, [&](std::size_t begin, std::size_t end) {
    statistics::Spectrum spectrum(cycles, kFrames, end - begin);
    std::vector<float> pixels;
    for (int frame = 0; frame < kFrames; ++frame) {
      pixels.assign(end - begin, 0);
      noise.add(static_cast<std::uint32_t>(frame), begin, 1, pixels);
      spectrum.add(frame, pixels);
    }
    for (std::size_t k = 0; k < cycles.size(); ++k) chunks[begin / kChunk].push_back(spectrum.power(k));
  });
  std::vector<double> powers(cycles.size());
  for (const std::vector<double>& chunk : chunks) {
    for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += chunk[k] / kPixels;
  }
  return powers;
}

/// The spectrum of the processes alone, through Hann's window: two thirds of it, and a sixth from either side.
double windowed(const FlickerDesign& design, double cycles) {
  const auto density = [&](double at) {
    return kFrameRate / 2 * design.density(at * kFrameRate / kFrames, kFrameRate) - design.white_variance;
  };
  return (4 * density(cycles) + density(cycles - 1) + density(cycles + 1)) / 6;
}

/// The variance of the processes, without the white part.
double slow_variance(const FlickerDesign& design) { return design.variance() - design.white_variance; }

}  // namespace

TEST_CASE("1/f noise is as strong in the first frame as in any later one") {
  constexpr std::size_t kMany = 65536;
  const double rate_hz = GENERATE(9.0, 60.0);
  const FlickerDesign design = FlickerDesign::fit(rate_hz, 0.5);
  FlickerNoise noise(3, "clip", design, kMany);
  for (std::uint32_t frame = 0; frame <= 500; ++frame) {
    std::vector<float> pixels(kMany);
    noise.add(frame, 0, 2, pixels);
    if (frame > 1 && frame % 7 != 0 && frame < 499) continue;
    CAPTURE(frame);
    // Pixels are independent normals.
    CHECK_THAT(mean_square(pixels), WithinRel(4 * slow_variance(design), kSigmas * std::sqrt(2.0 / kMany)));
  }
}

TEST_CASE("1/f noise has the same correlation from the first frame on") {
  constexpr std::size_t kMany = 65536;
  const FlickerDesign design = FlickerDesign::fit(9, 0.5);
  FlickerNoise noise(4, "clip", design, kMany);
  std::array<std::vector<float>, 302> frames;
  for (std::uint32_t frame = 0; frame < frames.size(); ++frame) {
    frames[frame].resize(kMany);
    noise.add(frame, 0, 1, frames[frame]);
  }
  for (const std::size_t lag : {std::size_t{1}, std::size_t{9}, std::size_t{90}}) {
    const auto covariance = [&](std::size_t frame) {
      double sum = 0;
      for (std::size_t i = 0; i < kMany; ++i) {
        sum += static_cast<double>(frames[frame][i]) * static_cast<double>(frames[frame + lag][i]);
      }
      return sum / kMany;
    };
    // Each is a mean of products of normals of that variance: deviation at most sqrt(2 / n) of it, and at most
    // sqrt(2) more for the two, were they independent.
    CHECK_THAT(covariance(0) - covariance(200),
               WithinAbs(0, kSigmas * slow_variance(design) * 2 / std::sqrt(kMany)));
  }
}

TEST_CASE("The spectrum of the noise that is made is that of the design, and with white noise 1 + knee / f") {
  constexpr double kKneeHz = 0.5;
  const FlickerDesign design = FlickerDesign::fit(kFrameRate, kKneeHz);
  const std::vector<double> cycles = three_decades();
  const std::vector<double> powers = measured_powers(design, cycles);
  // A periodogram scatters by its own size, reduced by the average over the pixels.
  const double scatter = 1 / std::sqrt(static_cast<double>(kPixels));
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    const double hz = cycles[k] * kFrameRate / kFrames;
    CAPTURE(hz);
    CHECK_THAT(powers[k], WithinRel(windowed(design, cycles[k]), kSigmas * scatter));
    // White noise of variance 1 has power 1. The design is within 0.5 dB, 12 %; the window adds up to 1 % at
    // its 5 lowest cycles: 1 / (3 cycles^2).
    const double sum = 1 + kKneeHz * (design.white_variance + powers[k]);
    CHECK_THAT(sum / (1 + kKneeHz / hz), WithinAbs(1, 0.12 + 0.013 + kSigmas * scatter));
  }
}

TEST_CASE("1/f noise of one pixel is independent of its neighbours'") {
  constexpr std::size_t kMany = std::size_t{1} << 18;
  const FlickerDesign design = FlickerDesign::fit(9, 0.5);
  FlickerNoise noise(3, "clip", design, kMany);
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::vector<float> pixels(kMany);
    noise.add(frame, 0, 1, pixels);
    for (const std::size_t shift : std::array<std::size_t, 6>{1, 16, 64, 256, 512, 16384}) {
      double sum = 0;
      for (std::size_t i = shift; i < kMany; ++i) {
        sum += static_cast<double>(pixels[i]) * static_cast<double>(pixels[i - shift]);
      }
      const double pairs = static_cast<double>(kMany - shift);
      CAPTURE(frame, shift);
      CHECK_THAT(sum / pairs / slow_variance(design), WithinAbs(0, kSigmas / std::sqrt(pairs)));
    }
  }
}

TEST_CASE("In a camera's picture 1/f noise adds its variance at the requested knee") {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise = {.amount = 1, .flicker_knee_hz = GENERATE(0.25, 2.0)};
  parameters.netd_mk = 100;
  constexpr int kSide = 256;
  ThermalCamera camera = cameras::camera(parameters, {.width_px = kSide, .height_px = kSide});
  const SensorFrame frame = camera.expose(cameras::uniform_scene(kSide, kSide, 300));
  double squares_k2 = 0;
  for (const std::uint16_t count : frame.ir16.pixels()) squares_k2 += std::pow(0.01 * count - 300, 2);
  const double knee_hz = parameters.noise.flicker_knee_hz;
  const double flicker = knee_hz * FlickerDesign::fit(9, knee_hz).variance();
  // White noise of (100 mK)^2 plus that times the design's variance; rounding to counts adds 1/12 of one squared. A
  // slope of 1.3 % per kelvin between radiance and temperature changes the variance of 0.3 K by 1e-5.
  CHECK_THAT(squares_k2 / (kSide * kSide),
             WithinRel(0.01 * (1 + flicker) + 1e-4 / 12, kSigmas * std::sqrt(2.0) / kSide));
}

TEST_CASE("A closing of the shutter makes 1/f noise independent of all before it, and no weaker") {
  const FlickerDesign design = FlickerDesign::fit(kFrameRate, 0.5);
  const bool closes = GENERATE(false, true);
  FlickerNoise noise(5, "clip", design, kPixels);
  std::vector<std::vector<float>> frames;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    if (closes && frame > 0) noise.restart_at(frame, frame);
    frames.emplace_back(kPixels);
    for (std::size_t first = 0; first < kPixels; first += 1024)
      noise.add(frame, first, 1, std::span(frames.back()).subspan(first, 1024));
  }
  constexpr double kScatter = 1 / 101.19;  // of a correlation of 10,240 independent pairs
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
    double product = 0;
    for (std::size_t i = 0; i < kPixels; ++i)
      product += static_cast<double>(frames[static_cast<std::size_t>(a)][i]) *
                 static_cast<double>(frames[static_cast<std::size_t>(b)][i]);
    const double correlation = product / kPixels / slow_variance(design);
    CAPTURE(closes, a, b, correlation);
    CHECK((closes ? std::abs(correlation) < kSigmas * kScatter : correlation > 0.5));
  }
  for (const std::vector<float>& frame : frames)
    CHECK_THAT(mean_square(frame) / slow_variance(design), WithinAbs(1, kSigmas * std::sqrt(2.0 / kPixels)));
}

TEST_CASE("The camera begins its 1/f noise again when the shutter closes, and only then") {
  SensorParameters parameters;
  parameters.noise.flicker_knee_hz = 100;
  parameters.shutter.interval_s = 1;
  parameters.netd_mk = 100;
  const auto pictures = [&](double interval_s) {
    parameters.shutter.interval_s = interval_s;
    ThermalCamera camera =
        cameras::camera(parameters, {.width_px = 128, .height_px = 80, .frame_rate_hz = 10});
    std::vector<Plane<std::uint16_t>> frames;
    for (int frame = 0; frame < 11; ++frame)
      frames.push_back(camera.expose(Plane<float>(128, 80, 50.0F)).ir16);
    return frames;
  };
  const auto shutter = pictures(1);
  const auto none = pictures(0);
  int closed = -1;
  for (int frame = 0; frame < 11 && closed < 0; ++frame) {
    if (shutter[static_cast<std::size_t>(frame)].pixels()[0] !=
        none[static_cast<std::size_t>(frame)].pixels()[0])
      closed = frame;
  }
  CHECK(closed > 0);  // within a second and a frame, the same bits until then
}

}  // namespace flicker_noise_test
