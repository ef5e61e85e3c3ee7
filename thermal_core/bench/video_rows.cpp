#include "bench/video_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/rng.h"
#include "bench/sensor_scene.h"
#include "io/video/video_codec.h"
#include "sensor/analogue_link.h"
#include "sensor/processing.h"

namespace thermal {
namespace {

using Picture = Plane<std::uint8_t>;

constexpr double kMegahertzPerCycle = kSceneWidthPx / 52.0;  // a cycle per pixel, in PAL
constexpr std::size_t kLevelBytes = 2 * sizeof(std::uint8_t);

/// Attenuation of a wave along rows.
template <typename T, typename Pass>
double wave_left(double middle, double height, int period_px, const Pass& pass) {
  const auto phase = [&](int x) { return 2 * std::numbers::pi * x / period_px; };
  Plane<T> wave(kSceneWidthPx, kSceneHeightPx);
  for (int y = 0; y < kSceneHeightPx; ++y)
    for (int x = 0; x < kSceneWidthPx; ++x)
      wave.at(x, y) = static_cast<T>(std::lround(middle + height * std::cos(phase(x))));
  const Plane<T> passed = pass(std::move(wave));
  double sum = 0;
  for (int x = 160; x < 480; ++x) sum += passed.at(x, 100) * std::cos(phase(x));
  return 2 * sum / 320 / height;
}

/// Largest difference from a transfer, for waves of 4 to 80 px.
template <typename T, typename Pass, typename Transfer>
double worst_transfer(double middle, double height, const Pass& pass, const Transfer& transfer) {
  double worst = 0;
  for (const int period_px : {4, 5, 8, 16, 40, 80})
    worst =
        std::max(worst, std::abs(wave_left<T>(middle, height, period_px, pass) - transfer(1.0 / period_px)));
  return worst;
}

StageRow processing_row(const std::string& name, const ProcessingParameters& parameters) {
  Processing processing(parameters);
  const auto pass = [&](const Plane<std::uint16_t>& counts) { return processing.filter(counts); };
  const auto gaussian = [](double sigma_px, double cycles_per_px) {
    return std::exp(-2 * std::pow(std::numbers::pi * sigma_px * cycles_per_px, 2));
  };
  const double worst = worst_transfer<std::uint16_t>(28000, 4000, pass, [&](double cycles_per_px) {
    return gaussian(parameters.noise_filter_sigma_px, cycles_per_px) *
           (1 + parameters.unsharp_amount * (1 - gaussian(parameters.unsharp_sigma_px, cycles_per_px)));
  });
  const StageRow row = {.group = "processing", .name = name, .figures = {{"mtf_rows", worst}}};
  const Plane<std::uint16_t> counts(kSceneWidthPx, kSceneHeightPx, 28000);
  return timed(row, 2 * sizeof(std::uint16_t), [&] { (void)processing.filter(counts); });
}

AnalogueLink link_of(const AnalogueLinkParameters& parameters) {
  return {parameters,
          {.id = "bench", .frame_rate_hz = 25, .width_px = kSceneWidthPx, .height_px = kSceneHeightPx}};
}

Picture passed(const AnalogueLinkParameters& parameters, Picture picture, float field_motion_px = 0) {
  link_of(parameters).pass(field_motion_px, picture);
  return picture;
}

Picture grey_picture() { return {kSceneWidthPx, kSceneHeightPx, 128}; }

StageRow link_row(const std::string& name, const AnalogueLinkParameters& parameters,
                  std::vector<Figure> figures, const ImageMotion& motion = {}) {
  const StageRow row = {.group = "analogue link", .name = name, .figures = std::move(figures)};
  AnalogueLink link = link_of(parameters);
  Picture picture = grey_picture();
  return timed(row, kLevelBytes, [&] { link.pass(motion, picture); });
}

double mean_product(const Picture& picture, int right_px) {
  double sum = 0;
  for (int y = 0; y < kSceneHeightPx; ++y)
    for (int x = 0; x < kSceneWidthPx - right_px; ++x)
      sum += (picture.at(x, y) - 128.0) * (picture.at(x + right_px, y) - 128.0);
  return sum / (kSceneHeightPx * (kSceneWidthPx - right_px));
}

constexpr double kWideMhz = 1000;  // pixels do not affect their neighbours

StageRow motion_row() {
  Picture ramp(kSceneWidthPx, kSceneHeightPx);
  for (int y = 0; y < kSceneHeightPx; ++y)
    for (int x = 0; x < kSceneWidthPx; ++x) ramp.at(x, y) = static_cast<std::uint8_t>(x / 4);
  const AnalogueLinkParameters link = {.bandwidth_mhz = kWideMhz};
  const Picture combed = passed(link, ramp, 8);
  double worst = 0;
  for (int x = 100; x < 500; ++x)
    worst = std::max(worst, std::abs(combed.at(x, 10) - combed.at(x, 11) - 2.0));
  const ImageMotion motion = {Plane<float>(kSceneWidthPx, kSceneHeightPx, 1.3F),
                              Plane<float>(kSceneWidthPx, kSceneHeightPx, 0.7F)};
  return link_row("two fields of what moves", link, {{"worst_levels", worst}}, motion);
}

StageRow noise_row() {
  constexpr double kNoise = 10;
  constexpr double kStreaks = 6;
  const AnalogueLinkParameters link = {
      .bandwidth_mhz = kWideMhz, .noise_levels = kNoise, .streak_levels = kStreaks, .streak_us = 1};
  const Picture noisy = passed(link, grey_picture());
  const double next = kStreaks * kStreaks * std::exp(-1 / kMegahertzPerCycle);
  const double all = kNoise * kNoise + kStreaks * kStreaks + 1.0 / 12;  // rounding
  const double share = kStreaks * kStreaks / all;
  const double fade = std::exp(-2 / kMegahertzPerCycle);
  const double independent = static_cast<double>(kScenePixels) / (1 + 2 * share * share * fade / (1 - fade));
  return link_row("noise and streaks", link,
                  {{"variance_sigma", variance_sigma(mean_product(noisy, 0), all, independent)},
                   {"neighbours_percent", 100 * (mean_product(noisy, 1) / next - 1)}});
}

StageRow bandwidth_row() {
  const AnalogueLinkParameters link = {.bandwidth_mhz = 4.2};
  const double worst = worst_transfer<std::uint8_t>(
      127, 120, [&](Picture picture) { return passed(link, std::move(picture)); },
      [&](double cycles_per_px) {
        return std::exp(-std::numbers::ln2 *
                        std::pow(cycles_per_px * kMegahertzPerCycle / link.bandwidth_mhz, 2));
      });
  return link_row("bandwidth, 4.2 MHz", link, {{"mtf_rows", worst}});
}

StageRow lines_row() {
  constexpr double kDeviation = 10;
  const AnalogueLinkParameters link = {.bandwidth_mhz = kWideMhz, .row_levels = kDeviation, .jitter_px = 1};
  const Picture rows = passed(link, grey_picture());
  double squares = 0;
  for (int y = 0; y < kSceneHeightPx; ++y) squares += std::pow(rows.at(0, y) - 128.0, 2);
  const double variance = kDeviation * kDeviation + 1.0 / 12;
  return link_row("levels and places of rows", link,
                  {{"variance_sigma", variance_sigma(squares / kSceneHeightPx, variance, kSceneHeightPx)}});
}

StageRow whole_link_row() {
  const AnalogueLinkParameters link = {.lines = 576,
                                       .noise_levels = 3,
                                       .streak_levels = 2,
                                       .row_levels = 1,
                                       .drift_levels = 1,
                                       .hum_levels = 0.5,
                                       .jitter_px = 0.2,
                                       .dropouts_per_s = 10};
  const Picture sent = passed(link, grey_picture());
  return link_row("analogue_pal, all stages", link, {{"deviation_levels", std::sqrt(mean_product(sent, 0))}});
}

/// A frame of a video with new noise.
Picture frame_of(std::uint32_t number) {
  Picture frame(kSceneWidthPx, kSceneHeightPx);
  std::vector<float> noise(kScenePixels);
  fill_normal({.seed = 1, .stream = 1, .clip = 1, .frame = number}, 0, noise);
  const std::vector<double> scene = scene_temperatures_k(number);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double level = 25 * (scene[i] - 282) + 20 + 2 * static_cast<double>(noise[i]);
    frame.pixels()[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0));
  }
  return frame;
}

StageRow codec_row(const std::string& name) {
  constexpr std::uint32_t kFrames = 8;
  std::vector<Picture> frames;
  for (std::uint32_t number = 0; number < kFrames; ++number) frames.push_back(frame_of(number));
  VideoCodec codec({.name = name, .bitrate_kbit_s = 4000}, kSceneRateHz, kSceneWidthPx, kSceneHeightPx);
  double squares = 0;
  double bits = 0;
  const auto pass_all = [&] {
    squares = 0;
    bits = 0;
    for (const Picture& frame : frames) {
      Picture decoded = frame;
      bits += 8 * static_cast<double>(codec.pass(decoded));
      for (std::size_t i = 0; i < frame.size(); ++i)
        squares += std::pow(frame.pixels()[i] - static_cast<double>(decoded.pixels()[i]), 2) / kFrames;
    }
  };
  pass_all();  // until the rate settles
  pass_all();
  const StageRow row = {.group = "codec",
                        .name = name + ", 4000 kbit/s at 30 Hz",
                        .figures = {{"rms_levels", std::sqrt(squares / static_cast<double>(kScenePixels))},
                                    {"kbit_s", 1e-3 * bits / kFrames * kSceneRateHz}}};
  std::size_t next = 0;
  return timed(row, kLevelBytes, [&] {
    Picture frame = frames[next++ % kFrames];
    (void)codec.pass(frame);
  });
}

}  // namespace

std::vector<StageRow> video_rows() {
  return {processing_row("noise filter, 0.8 px", {.noise_filter_sigma_px = 0.8}),
          processing_row("unsharp mask, 1 x 2 px", {.unsharp_amount = 1, .unsharp_sigma_px = 2}),
          processing_row("both", {.noise_filter_sigma_px = 0.8, .unsharp_amount = 1, .unsharp_sigma_px = 2}),
          motion_row(),
          noise_row(),
          bandwidth_row(),
          lines_row(),
          whole_link_row(),
          codec_row("h264"),
          codec_row("mpeg4"),
          codec_row("mjpeg")};
}

}  // namespace thermal
