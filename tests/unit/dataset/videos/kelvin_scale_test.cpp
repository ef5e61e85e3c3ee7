#include "dataset/videos/kelvin_scale.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace kelvin_scale_test {

using namespace thermal;

namespace {

std::array<std::uint16_t, kLevels - 1> rising(int first, int step) {
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  for (std::size_t k = 0; k < thresholds.size(); ++k)
    thresholds[k] = static_cast<std::uint16_t>(first + step * static_cast<int>(k));
  return thresholds;
}

std::string labels_of(const std::vector<ScaleTick>& ticks) {
  std::string labels;
  for (const ScaleTick& tick : ticks) labels += (labels.empty() ? "" : " ") + tick.label;
  return labels;
}

}  // namespace

// Places are sums and quotients of numbers below 1000 with errors of some eps: 1e-12 is a thousand times that.
constexpr double kRounding = 1e-12;

TEST_CASE("A threshold of a tone curve is the lower edge of the level above it") {
  const KelvinScale scale = scale_of_curve(rising(27000, 10), 0.01);
  CHECK(scale.position_of(270.0).value() == 1.0 / 256);  // thresholds[0]: where level 1 begins
  CHECK_THAT(scale.position_of(27000 * 0.01 + 254 * 0.1).value_or(0), WithinAbs(255.0 / 256, kRounding));
  CHECK_THAT(scale.position_of(270.05).value(), WithinAbs(1.5 / 256, kRounding));  // half of level 1
}

TEST_CASE("Levels without an end have no place") {
  const KelvinScale scale = scale_of_curve(rising(27000, 10), 0.01);
  CHECK_FALSE(scale.position_of(269.99));
  CHECK_FALSE(scale.position_of(295.5));
}

TEST_CASE("A threshold of 65535 is never reached") {
  std::array<std::uint16_t, kLevels - 1> thresholds = rising(30000, 1);
  std::fill(thresholds.begin() + 100, thresholds.end(), std::uint16_t{65535});
  const KelvinScale scale = scale_of_curve(thresholds, 0.01);
  CHECK_THAT(scale.position_of(30099 * 0.01).value(), WithinAbs(100.0 / 256, kRounding));
  CHECK_FALSE(scale.position_of(30100 * 0.01));
  CHECK_THAT(scale.known().high_k, WithinAbs(30099 * 0.01, kRounding));
}

TEST_CASE("Levels below the least that a curve shows stand for no temperature") {
  std::array<std::uint16_t, kLevels - 1> thresholds = rising(26000, 10);
  std::fill(thresholds.begin(), thresholds.begin() + 12, std::uint16_t{1});
  const KelvinScale scale = scale_of_curve(thresholds, 0.01);
  CHECK_FALSE(scale.position_of(200));
  CHECK_THAT(scale.known().low_k, WithinAbs(26120 * 0.01, kRounding));
  CHECK(labels_of(ticks_of(scale, 0.15)) == "265 270 275 280 285");
}

TEST_CASE("Levels that a curve leaves out take no temperatures") {
  std::array<std::uint16_t, kLevels - 1> thresholds = rising(30000, 1);
  for (std::size_t k = 10; k < 20; ++k) thresholds[k] = 30010;
  const KelvinScale scale = scale_of_curve(thresholds, 0.01);
  CHECK_THAT(scale.position_of(30010 * 0.01).value(), WithinAbs(20.0 / 256, kRounding));
  CHECK_THAT(scale.position_of(300.095).value(),
             WithinAbs(10.5 / 256, 1e-9));  // 0.005 K of 0.01 K: 1e-11 / 0.01
}

TEST_CASE("A curve that shows black has no ticks") {
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  thresholds.fill(65535);
  CHECK(ticks_of(scale_of_curve(thresholds, 0.01), 0.05).empty());
}

TEST_CASE("A linear scale reaches from one end of the bar to the other") {
  const KelvinScale scale = linear_scale({270, 300});
  CHECK(scale.position_of(270).value() == 0);
  CHECK(scale.position_of(285).value() == 0.5);
  CHECK(scale.position_of(300).value() == 1);
  CHECK_FALSE(scale.position_of(300.01));
}

TEST_CASE("Ticks are round temperatures, as many as fit") {
  const auto ticks = [](double low_k, double high_k, double gap) {
    return labels_of(ticks_of(linear_scale({low_k, high_k}), gap));
  };
  CHECK(ticks(270, 300, 0.1) == "270 275 280 285 290 295 300");
  CHECK(ticks(270, 300, 0.05) == "270 272 274 276 278 280 282 284 286 288 290 292 294 296 298 300");
  CHECK(ticks(270, 300, 0.3) == "270 280 290 300");
  CHECK(ticks(269.6, 275.8, 0.1) == "270 271 272 273 274 275");
  CHECK(ticks(0, 655.35, 0.1) == "0 100 200 300 400 500 600");
  CHECK(ticks(299.98, 300.42, 0.2) == "300 300.1 300.2 300.3 300.4");
}

TEST_CASE("Ticks are finer where the scale is stretched") {
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  for (std::size_t k = 0; k < thresholds.size();
       ++k)  // 270 to 271 K on half of the bar, 271 to 300 K on the other
    thresholds[k] =
        static_cast<std::uint16_t>(k < 128 ? 27000 + k * 100 / 128 : 27100 + (k - 128) * 2900 / 127);
  CHECK(labels_of(ticks_of(scale_of_curve(thresholds, 0.01), 0.08)) ==
        "270 270.2 270.5 270.7 270.9 275 280 285 290 295");
}

TEST_CASE("Ticks keep their distance and carry their places") {
  const KelvinScale scale = linear_scale({251.3, 318.9});
  const std::vector<ScaleTick> ticks = ticks_of(scale, 0.07);
  REQUIRE(ticks.size() > 5);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    CHECK(ticks[k].position == scale.position_of(ticks[k].temperature_k).value());
    CHECK(std::stod(ticks[k].label) == ticks[k].temperature_k);
    if (k > 0) CHECK(ticks[k].position - ticks[k - 1].position >= 0.07);
  }
}

TEST_CASE("Levels of counts are those of the bar") {
  const std::vector<std::uint8_t> levels = levels_of_counts(linear_scale({270, 295.6}), 0.01);
  CHECK(levels[0] == 0);
  CHECK(levels[27009] == 0);  // bands of 0.1 K
  CHECK(levels[27010] == 1);
  CHECK(levels[28285] == 128);  // 282.85 K, 12.85 K above the lowest
  CHECK(levels[29560] == 255);
  CHECK(levels[65535] == 255);
}

TEST_CASE("A range of temperatures is two numbers, the lower first") {
  const KelvinRange range = parse_kelvin_range("270:300.5");
  CHECK(range.low_k == 270);
  CHECK(range.high_k == 300.5);
  for (const char* text :
       {"", "270", "300:270", "270:270", "a:b", "270:300:310", "-1:5", "nan:300", "0:inf", "0:10001"}) {
    CAPTURE(text);
    CHECK(message_of<ConfigError>([&] { (void)parse_kelvin_range(text); }) ==
          "--range = \"" + std::string(text) +
              "\"; expected LO:HI in kelvin, 0 <= LO < HI <= 10000, such as 270:300");
  }
}

}  // namespace kelvin_scale_test
