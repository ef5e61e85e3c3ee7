#include "sensor/smear.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "sensor/thermal_camera.h"
#include "support/catch.h"

namespace smear_test {

using namespace thermal;
using std::numbers::pi;

namespace {

constexpr double kTau = 0.01;

ImageMotion motion_of(int width, int height, float x_px, float y_px) {
  return {.x_px = Plane<float>(width, height, x_px), .y_px = Plane<float>(width, height, y_px)};
}

Plane<float> noise_picture(int width, int height) {
  Plane<float> picture(width, height);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture.pixels()[i] = 30 + static_cast<float>(i * 2654435761U % 1000) / 100;
  return picture;
}

/// Transfer of smear and of the lag after it, at (x, y) cycles per pixel.
std::complex<double> transfer(double motion_x, double motion_y, double interval_s, double x, double y) {
  const double kept = std::exp(-interval_s / kTau);
  std::complex<double> smear;
  for (const SmearTap& tap : smear_taps(motion_x, motion_y, interval_s / kTau))
    smear += static_cast<double>(tap.weight) * std::polar(1.0, 2 * pi * (x * tap.x_px + y * tap.y_px));
  return smear * (1 - kept) / (1.0 - kept * std::polar(1.0, 2 * pi * (x * motion_x + y * motion_y)));
}

/// That of exp(-t / tau) / tau over all ages.
std::complex<double> exponential(double motion_x, double motion_y, double interval_s, double x, double y) {
  return 1.0 / std::complex<double>(1, -2 * pi * (x * motion_x + y * motion_y) * kTau / interval_s);
}

double worst_to(double most_cycles, double motion_x, double motion_y, double interval_s) {
  double worst = 0;
  for (double f = 0; f <= most_cycles; f += 0.01) {
    const double x = motion_x == 0 ? 0 : f;
    const double y = motion_y == 0 ? 0 : f;
    worst = std::max(worst, std::abs(transfer(motion_x, motion_y, interval_s, x, y) -
                                     exponential(motion_x, motion_y, interval_s, x, y)));
  }
  return worst;
}

/// A wave that has moved by `moved_px` along x.
Plane<float> wave(double moved_px) {
  Plane<float> picture(160, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 160; ++x)
      picture.at(x, y) = static_cast<float>(40 + 10 * std::cos(2 * pi * 0.11 * (x - moved_px)));
  return picture;
}

/// A bar 10 K warmer and 6 px wide, through optics whose blur is a Gaussian of 0.5 px, as that of fast lenses and
/// pixels.
double bar_k(double x_px) {
  constexpr double kBlur = 0.5 * std::numbers::sqrt2;
  return 30 + 5 * (std::erf((x_px + 3) / kBlur) - std::erf((x_px - 3) / kBlur));
}

/// As the exponential of all ages sees it, moving by so much in a time constant.
double smeared_bar_k(double x_px, double tau_px) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += bar_k(x_px - tau_px * std::log1p(-(i + 0.5) / kSteps));
  return sum / kSteps;
}

SensorParameters quiet(double time_constant_s) {
  SensorParameters parameters;
  parameters.optics.psf = Psf::gaussian;
  parameters.optics.blur_sigma_px = 0;
  parameters.noise.amount = 0;
  parameters.time_constant_s = time_constant_s;
  return parameters;
}

}  // namespace

TEST_CASE("Smear and lag together have the exponential's transfer") {
  for (const double interval_s : {1 / 60.0, 1 / 30.0, 1 / 9.0}) {
    for (const double px : {0.3, -1.0, 2.6, 10.0, 30.0}) {
      CAPTURE(interval_s, px);
      CHECK(worst_to(0.3, px, 0, interval_s) < 0.01);
      CHECK(worst_to(0.3, 0, px, interval_s) < 0.01);
      CHECK(worst_to(0.3, px, px, interval_s) < (px < 20 ? 0.018 : 0.09));
      CHECK(worst_to(0.35, px, 0, interval_s) < 0.07);
    }
    CHECK(worst_to(0.3, 80, 0, interval_s) < 0.06);  // sampled with less effort
  }
}

TEST_CASE("Weights are positive in sum, and no motion is one sample") {
  for (const double px : {0.0, 0.2, 7.5, 39.9, 1000.0, -4096.0}) {
    double sum = 0;
    for (const SmearTap& tap : smear_taps(px, -px / 2, 3)) sum += static_cast<double>(tap.weight);
    CHECK_THAT(sum, WithinAbs(1, 1e-5));
  }
  REQUIRE(smear_taps(0, 0, 3).size() == 1);
  CHECK(smear_taps(0, 0, 3).front().x_px == 0);
}

TEST_CASE(
    "A camera sees a steadily moving wave as the exponential over all ages does, from the first frame on") {
  constexpr double kRate = 30;
  constexpr double kMotionPx = 2.5;
  const ImageMotion motion = motion_of(160, 8, kMotionPx, 0);
  Smear smear(1 / kRate, kTau);
  const double kept = std::exp(-1 / (kRate * kTau));
  const std::complex<double> exact = exponential(kMotionPx, 0, 1 / kRate, 0.11, 0);
  Plane<float> state;
  for (int n = 0; n < 4; ++n) {
    Plane<float> seen = wave(n * kMotionPx);
    if (n == 0) {
      smear.apply_to_first(motion, seen);
      state = seen;
    } else {
      smear.apply(motion, seen);
      for (std::size_t i = 0; i < seen.size(); ++i)
        state.pixels()[i] += static_cast<float>(1 - kept) * (seen.pixels()[i] - state.pixels()[i]);
    }
    for (int x = 60; x < 100; ++x) {
      const double expected = 40 + 10 * (exact * std::polar(1.0, 2 * pi * 0.11 * (x - n * kMotionPx))).real();
      CHECK_THAT(static_cast<double>(state.at(x, 4)), WithinAbs(expected, 0.1));
    }
  }
}

TEST_CASE("The edges of a moving bar are within 0.5 K, at any place between pixels") {
  for (const double rate_hz : {9.0, 30.0, 60.0}) {
    for (const double speed_px_s : {20.0, 84.0, 250.0}) {
      const double motion_px = speed_px_s / rate_hz;
      double worst_k = 0;
      for (const double place : {0.0, 0.3, 0.5, 0.8}) {
        Plane<float> picture(120, 1);
        for (int x = 0; x < 120; ++x) picture.at(x, 0) = static_cast<float>(bar_k(x - 80 - place));
        Smear(1 / rate_hz, kTau).apply_to_first(motion_of(120, 1, static_cast<float>(motion_px), 0), picture);
        for (int x = 0; x < 120; ++x)
          worst_k = std::max(worst_k, std::abs(static_cast<double>(picture.at(x, 0)) -
                                               smeared_bar_k(x - 80 - place, speed_px_s * kTau)));
      }
      CAPTURE(rate_hz, speed_px_s);
      CHECK(worst_k < 0.5);
    }
  }
}

TEST_CASE("What does not move stays as it is, to the bit") {
  const Plane<float> picture = noise_picture(70, 40);
  const auto smeared = [&](const ImageMotion& motion) {
    Smear smear(1 / 30.0, kTau);
    Plane<float> out = picture;
    smear.apply_to_first(motion, out);
    smear.apply(motion, out);
    return out;
  };
  CHECK(smeared({}) == picture);
  CHECK(smeared(motion_of(70, 40, 0, 0)) == picture);
  CHECK(smeared(motion_of(70, 40, 0.01F, -0.01F)) == picture);
  CHECK(smeared(motion_of(70, 40, std::numeric_limits<float>::quiet_NaN(), 0)) == picture);
  ImageMotion partly = motion_of(70, 40, 0, 0);
  partly.x_px.at(50, 20) = 3;
  partly.y_px.at(3, 30) = std::numeric_limits<float>::infinity();
  const Plane<float> one = smeared(partly);
  int changed = 0;
  for (std::size_t i = 0; i < one.size(); ++i) changed += one.pixels()[i] == picture.pixels()[i] ? 0 : 1;
  CHECK(changed == 1);
}

TEST_CASE("Rows that are read later see what moves farther along") {
  constexpr int kWidth = 200;
  constexpr int kHeight = 48;
  constexpr double kCycles = 0.06;
  const double motion_px = GENERATE(3.0, -7.0);
  const double readout = GENERATE(0.25, 1.0);  // of an interval
  CAPTURE(motion_px, readout);
  Plane<float> picture(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      picture.at(x, y) = static_cast<float>(40 + 10 * std::cos(2 * pi * kCycles * x));
  }
  const auto phase_turns = [&](const Plane<float>& plane, int y) {
    std::complex<double> sum;
    for (int x = 50; x < 150; ++x)  // six periods
      sum += (static_cast<double>(plane.at(x, y)) - 40) * std::polar(1.0, -2 * pi * kCycles * x);
    return std::arg(sum) / (2 * pi);
  };
  const ImageMotion motion = motion_of(kWidth, kHeight, static_cast<float>(motion_px), 0);
  Plane<float> at_once = picture;
  Smear(1 / 30.0, kTau).apply(motion, at_once);
  Smear(1 / 30.0, kTau, readout / 30).apply(motion, picture);
  for (int y = 0; y < kHeight; ++y) {
    CAPTURE(y);
    const double later = ((y + 0.5) / kHeight - 0.5) * readout;
    const double moved_px = (phase_turns(at_once, y) - phase_turns(picture, y)) / kCycles;
    // Rows are rounded to 1/64 of an interval.
    REQUIRE_THAT(moved_px, WithinAbs(motion_px * later, std::abs(motion_px) / 128 + 0.02));
  }
}

TEST_CASE("Without a readout time, rows are the same to the bit, and the first frame is shifted too") {
  const Plane<float> picture = noise_picture(90, 33);
  const ImageMotion motion = motion_of(90, 33, 2.5F, -1.25F);
  Plane<float> usual = picture;
  Smear(1 / 30.0, kTau).apply(motion, usual);
  Plane<float> zero = picture;
  Smear(1 / 30.0, kTau, 0).apply(motion, zero);
  CHECK(zero == usual);
  Plane<float> first = picture;
  Smear(1 / 30.0, kTau).apply_to_first(motion, first);
  Plane<float> slanted = picture;
  Smear(1 / 30.0, kTau, 0.0164).apply_to_first(motion, slanted);
  CHECK(std::ranges::equal(slanted.row(16), first.row(16)));  // the middle row
  CHECK_FALSE(std::ranges::equal(slanted.row(0), first.row(0)));
}

TEST_CASE("A camera without a time constant has no smear") {
  const Plane<float> picture = noise_picture(64, 48);
  const auto frames = [&](double time_constant_s, const ImageMotion& motion) {
    ThermalCamera camera(quiet(time_constant_s),
                         {.id = "c", .frame_rate_hz = 30, .width_px = 64, .height_px = 48, .noise_gain = {}},
                         60);
    SensorFrame frame;
    for (int n = 0; n < 2; ++n) camera.expose(picture, {}, motion, frame);
    return frame.ir16;
  };
  const ImageMotion moving = motion_of(64, 48, 3, 1);
  CHECK(frames(0, moving) == frames(0, {}));
  CHECK(frames(1e-9, moving) == frames(0, {}));
  CHECK(frames(kTau, motion_of(64, 48, 0, 0)) == frames(kTau, {}));
  CHECK_FALSE(frames(kTau, moving) == frames(kTau, {}));
}

TEST_CASE("Rounded motion shifts what a pixel has seen by less than a tenth of a pixel") {
  constexpr int kWidth = 400;
  constexpr int kHeight = 20;
  constexpr double kCycles = 0.06;
  const double ages = GENERATE(0.5, 1.7, 11.0, 50.0);
  const auto value = [](double x, double y) { return 40 + 10 * std::cos(2 * pi * kCycles * (x + y)); };
  Plane<float> picture(kWidth, kHeight);
  ImageMotion motion = motion_of(kWidth, kHeight, 0, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      picture.at(x, y) = static_cast<float>(value(x, y));
      motion.x_px.at(x, y) = 0.05F * static_cast<float>(x);
      motion.y_px.at(x, y) = 0.3F * static_cast<float>(y);
    }
  }
  Smear(ages * kTau, kTau).apply(motion, picture);
  double worst_k = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 100; x < 300; ++x) {
      double exact_k = 0;
      for (const SmearTap& tap : smear_taps(motion.x_px.at(x, y), motion.y_px.at(x, y), ages))
        exact_k +=
            static_cast<double>(tap.weight) * value(x + tap.x_px, std::clamp(y + tap.y_px, 0, kHeight - 1));
      worst_k = std::max(worst_k, std::abs(static_cast<double>(picture.at(x, y)) - exact_k));
    }
  }
  CAPTURE(ages, worst_k);
  constexpr double kSteepest = 10 * 2 * pi * kCycles;  // K per pixel
  CHECK(worst_k < 0.1 * kSteepest);
}

TEST_CASE("Extreme motion stays within what was seen, and edges go on as they end") {
  for (const float px : {-1000.0F, -4.0F, 45.0F, 1e30F}) {
    Smear smear(1 / 30.0, kTau);
    Plane<float> flat(70, 40, 30);
    smear.apply(motion_of(70, 40, px, px / 3), flat);
    for (const float value : flat.pixels()) REQUIRE_THAT(value, WithinAbs(30, 1e-3));
    Plane<float> picture = noise_picture(70, 40);
    smear.apply(motion_of(70, 40, px, px / 3), picture);
    for (const float value : picture.pixels()) REQUIRE((value >= 30 && value < 45));
  }
}

TEST_CASE("No pixel gets colder than the coldest that it was mixed from") {
  Plane<float> picture(64, 32, 30);
  picture.at(30, 15) = 2000;
  for (const float px : {0.3F, 1.5F, 6.0F}) {
    Smear smear(1 / 30.0, kTau);
    Plane<float> out = picture;
    smear.apply(motion_of(64, 32, px, -px), out);
    CHECK(*std::ranges::min_element(out.pixels()) >= 30);
    CHECK(*std::ranges::max_element(out.pixels()) < 2000);
  }
}

TEST_CASE("Smear has the same bits with any number of threads") {
  ImageMotion motion = motion_of(300, 260, 0, 0);
  for (int y = 0; y < 260; ++y) {
    for (int x = 0; x < 300; ++x) {
      motion.x_px.at(x, y) = 0.01F * static_cast<float>(x) + (x % 50 == 7 ? 2.0F : 0.0F);
      motion.y_px.at(x, y) = 2 - 0.02F * static_cast<float>(y);
    }
  }
  const auto smeared = [&](int threads) {
    return with_threads(threads, [&] {
      Smear smear(1 / 30.0, kTau);
      Plane<float> out = noise_picture(300, 260);
      smear.apply_to_first(motion, out);
      smear.apply(motion, out);
      return out;
    });
  };
  CHECK(smeared(1) == smeared(4));
}

}  // namespace smear_test
