#include "sensor/shutter.h"

#include <cmath>
#include <limits>
#include <string>

#include "support/catch.h"

namespace shutter_test {

using namespace thermal;

TEST_CASE("Without an interval the shutter never closes") {
  const Shutter shutter({.interval_s = 0, .freeze_s = 0.5}, 1, "a");
  CHECK(shutter.begins_s() == 0);
  for (const double time_s : {0.0, 0.5, 1e6}) {
    const ShutterState state = shutter.at(time_s);
    CHECK(state.event == 0);
    CHECK(state.since_intervals == 0);
    CHECK_FALSE(state.closed);
  }
}

TEST_CASE("The shutter closes on its timer, to the frame") {
  const double frame_rate_hz = GENERATE(9.0, 30.0, 60.0);
  const double freeze_s = GENERATE(0.0, 0.5, 1.0);
  constexpr double kInterval = 12.34;
  const Shutter shutter({.interval_s = kInterval, .freeze_s = freeze_s}, 7, "clip");
  const double first_s = kInterval - shutter.begins_s();  // the first closing within the clip
  const auto frames = static_cast<int>(10.5 * kInterval * frame_rate_hz);
  int events = 0;
  for (int frame = 0; frame < frames; ++frame) {
    CAPTURE(frame_rate_hz, freeze_s, frame);
    const double time_s = frame / frame_rate_hz;
    while (first_s + events * kInterval <= time_s) ++events;
    const double since_s = time_s - (first_s + (events - 1) * kInterval);
    const ShutterState state = shutter.at(time_s);
    REQUIRE(state.event == static_cast<std::uint32_t>(events));
    REQUIRE_THAT(state.since_intervals, WithinAbs(since_s / kInterval, 1e-12));  // rounding of times to 1e2 s
    REQUIRE(state.closed == (since_s < freeze_s));
  }
  CHECK(events >= 10);
}

TEST_CASE(
    "The shutter is closed from its closing on, and open again when the picture has frozen long enough") {
  const Shutter shutter({.interval_s = 8, .freeze_s = 0.5}, 1, "a");
  const Shutter never_frozen({.interval_s = 8, .freeze_s = 0}, 1, "a");
  const double closing_s = 8 - shutter.begins_s();  // exact: a phase has 24 bits
  constexpr double kMoment = 1e-6;
  CHECK_FALSE(shutter.at(closing_s - kMoment).closed);
  CHECK(shutter.at(closing_s).closed);
  CHECK(shutter.at(closing_s).event == 1);
  CHECK(shutter.at(closing_s + 0.5 - kMoment).closed);
  CHECK_FALSE(shutter.at(closing_s + 0.5).closed);
  CHECK_FALSE(never_frozen.at(closing_s).closed);
}

TEST_CASE("The elapsed fraction of the interval is always 0 to 1, despite rounding") {
  const double interval_s = GENERATE(1.0 / 3, 0.7, 180.0, 1e-3);
  const Shutter shutter({.interval_s = interval_s, .freeze_s = 0}, 1, "a");
  for (int event = 1; event < 2000; ++event) {
    double time_s = event * interval_s - shutter.begins_s();
    for (int step = 0; step < 4; ++step) time_s = std::nextafter(time_s, 0);
    for (int step = 0; step < 8; ++step) {
      const double since = shutter.at(time_s).since_intervals;
      REQUIRE(since >= 0);
      REQUIRE(since <= 1);
      time_s = std::nextafter(time_s, std::numeric_limits<double>::infinity());
    }
  }
}

TEST_CASE("A clip starts anywhere in the interval, a function of seed and clip") {
  const ShutterParameters parameters = {.interval_s = 10, .freeze_s = 0.5};
  CHECK(Shutter(parameters, 1, "a").begins_s() == Shutter(parameters, 1, "a").begins_s());
  CHECK(Shutter(parameters, 1, "a").begins_s() != Shutter(parameters, 2, "a").begins_s());
  CHECK(Shutter(parameters, 1, "a").begins_s() != Shutter(parameters, 1, "b").begins_s());
  constexpr int kClips = 4000;
  double sum = 0;
  for (int clip = 0; clip < kClips; ++clip) {
    const double begins_s = Shutter(parameters, 1, "clip" + std::to_string(clip)).begins_s();
    REQUIRE(begins_s >= 0);
    REQUIRE(begins_s < 10);
    sum += begins_s;
  }
  CHECK_THAT(sum / kClips, WithinAbs(5, 5 * 10 / std::sqrt(12.0 * kClips)));  // 5 sigma of a uniform's mean
}

}  // namespace shutter_test
