#include "sensor/noise.h"

#include <algorithm>

#include "support/catch.h"

using namespace thermal;

namespace {

constexpr int kWidth = 70;
constexpr int kHeight = 50;

Plane<float> white(std::uint32_t seed, const std::string& clip, std::uint32_t frame, float stddev) {
  Plane<float> picture(kWidth, kHeight);
  add_white_noise(seed, clip, frame, stddev, picture);
  return picture;
}

Plane<float> next_of(FlickerNoise& noise, float stddev = 1) {
  Plane<float> picture(kWidth, kHeight);
  noise.add_next(stddev, picture);
  return picture;
}

}  // namespace

TEST_CASE("White noise depends on seed, clip and frame, and on nothing else") {
  const Plane<float> noise = white(1, "a", 0, 2);
  CHECK(white(1, "a", 0, 2) == noise);
  CHECK_FALSE(white(2, "a", 0, 2) == noise);
  CHECK_FALSE(white(1, "b", 0, 2) == noise);
  CHECK_FALSE(white(1, "a", 1, 2) == noise);
}

TEST_CASE("White noise is added, in proportion to its standard deviation") {
  const Plane<float> once = white(1, "a", 0, 1);
  const Plane<float> twice = white(1, "a", 0, 2);
  Plane<float> on_top(kWidth, kHeight, 64);
  add_white_noise(1, "a", 0, 1, on_top);
  for (std::size_t i = 0; i < once.size(); ++i) {
    REQUIRE(twice.pixels()[i] == 2 * once.pixels()[i]);
    REQUIRE(on_top.pixels()[i] == 64 + once.pixels()[i]);
  }
}

TEST_CASE("The fixed pattern of a clip is within [-1, 1) and its own") {
  const Plane<float> pattern = fixed_pattern(1, "a", kWidth, kHeight);
  const auto [low, high] = std::minmax_element(pattern.pixels().begin(), pattern.pixels().end());
  CHECK(*low >= -1);
  CHECK(*low < -0.99F);  // of 3500 values, one is within the last half percent but once in 40 million clips
  CHECK(*high < 1);
  CHECK(*high > 0.99F);
  CHECK(fixed_pattern(1, "a", kWidth, kHeight) == pattern);
  CHECK_FALSE(fixed_pattern(2, "a", kWidth, kHeight) == pattern);
  CHECK_FALSE(fixed_pattern(1, "b", kWidth, kHeight) == pattern);
}

TEST_CASE("1/f noise runs the same way every time it is run") {
  FlickerNoise first(1, "a", 9, kWidth, kHeight);
  FlickerNoise second(1, "a", 9, kWidth, kHeight);
  for (int frame = 0; frame < 4; ++frame) REQUIRE(next_of(first) == next_of(second));
}

TEST_CASE("1/f noise of another seed or clip runs another way") {
  FlickerNoise noise(1, "a", 9, kWidth, kHeight);
  FlickerNoise other_seed(2, "a", 9, kWidth, kHeight);
  FlickerNoise other_clip(1, "b", 9, kWidth, kHeight);
  const Plane<float> picture = next_of(noise);
  CHECK_FALSE(next_of(other_seed) == picture);
  CHECK_FALSE(next_of(other_clip) == picture);
}

TEST_CASE("1/f noise goes on from frame to frame whatever its amplitude was") {
  FlickerNoise steady(1, "a", 9, kWidth, kHeight);
  FlickerNoise muted(1, "a", 9, kWidth, kHeight);
  (void)next_of(steady);
  CHECK(next_of(muted, 0) == Plane<float>(kWidth, kHeight));
  CHECK(next_of(steady) == next_of(muted));
}
