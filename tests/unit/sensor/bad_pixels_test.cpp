#include "sensor/bad_pixels.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "support/catch.h"

namespace bad_pixels_test {

using namespace thermal;

namespace {

constexpr double kFrameRate = 30;

BadPixels dead_of(double share, int width_px, int height_px, bool replace = true, std::uint32_t seed = 1) {
  return {{.dead_share = share, .replace_dead = replace}, seed, "a", kFrameRate, width_px, height_px};
}

/// A picture in which no two pixels are equal.
Plane<float> ramp(int width_px, int height_px) {
  Plane<float> picture(width_px, height_px);
  for (std::size_t i = 0; i < picture.size(); ++i) picture.pixels()[i] = 10 + static_cast<float>(i * i % 977);
  return picture;
}

/// Mean of the working pixels at the given places around a pixel; -1: there are none.
double living_mean(const Plane<float>& picture, const std::set<std::size_t>& dead, std::size_t pixel,
                   const std::vector<std::pair<int, int>>& places) {
  const int x = static_cast<int>(pixel) % picture.width_px();
  const int y = static_cast<int>(pixel) / picture.width_px();
  std::vector<double> values;
  for (const auto& [dx, dy] : places) {
    if (x + dx < 0 || x + dx >= picture.width_px() || y + dy < 0 || y + dy >= picture.height_px()) continue;
    if (dead.count(static_cast<std::size_t>((y + dy) * picture.width_px() + x + dx)) > 0) continue;
    values.push_back(static_cast<double>(picture.at(x + dx, y + dy)));
  }
  double sum = 0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return values.empty() ? -1 : sum;
}

double expected_of(const Plane<float>& picture, const std::set<std::size_t>& dead, std::size_t pixel) {
  const double sides = living_mean(picture, dead, pixel, {{-1, 0}, {1, 0}, {0, -1}, {0, 1}});
  if (sides >= 0) return sides;
  const double corners = living_mean(picture, dead, pixel, {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}});
  return corners >= 0 ? corners : 0;
}

}  // namespace

TEST_CASE("A dead pixel shows the mean of its working neighbours, on borders and in clusters too") {
  const double share = GENERATE(0.02, 0.3, 0.7, 0.95);
  const auto [width_px, height_px] =
      GENERATE(table<int, int>({{40, 30}, {1, 60}, {60, 1}, {3, 3}, {67, 13}}));
  CAPTURE(share, width_px, height_px);
  BadPixels bad = dead_of(share, width_px, height_px);
  const std::set<std::size_t> dead(bad.dead().begin(), bad.dead().end());
  const Plane<float> before = ramp(width_px, height_px);
  Plane<float> after = before;
  bad.apply(0, 1, after);
  for (std::size_t i = 0; i < after.size(); ++i) {
    CAPTURE(i);
    if (dead.count(i) == 0) {
      REQUIRE(after.pixels()[i] == before.pixels()[i]);
    } else {  // four values below 1000 are summed in single precision
      REQUIRE_THAT(static_cast<double>(after.pixels()[i]), WithinRel(expected_of(before, dead, i), 3e-7));
    }
  }
}

TEST_CASE("Pixels are dark if all are dead") {
  Plane<float> picture = ramp(5, 4);
  dead_of(1, 5, 4).apply(0, 1, picture);
  CHECK(picture == Plane<float>(5, 4));
}

TEST_CASE("Dead pixels that are not replaced measure nothing") {
  BadPixels bad = dead_of(0.2, 40, 30, false);
  Plane<float> picture = ramp(40, 30);
  bad.apply(0, 1, picture);
  REQUIRE_FALSE(bad.dead().empty());
  for (const std::size_t pixel : bad.dead()) CHECK(picture.pixels()[pixel] == 0);
}

TEST_CASE("Without bad pixels nothing changes") {
  BadPixels bad({}, 1, "a", kFrameRate, 17, 9);
  Plane<float> picture = ramp(17, 9);
  bad.apply(0, 1, picture);
  CHECK(picture == ramp(17, 9));
}

TEST_CASE("Blinking pixels jump by their height, and others stay") {
  BadPixels bad({.blinking_share = 0.3, .blinking_ratio = 8, .blinking_hz = 3}, 1, "a", kFrameRate, 40, 30);
  const std::set<std::size_t> blinking(bad.blinking().begin(), bad.blinking().end());
  int up = 0;
  for (std::uint32_t frame = 0; frame < 20; ++frame) {
    Plane<float> picture(40, 30, 100);
    bad.apply(frame, 0.5F, picture);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const float jump = picture.pixels()[i] - 100;
      REQUIRE((jump == 0 || (jump == 4 && blinking.count(i) > 0)));
      up += jump == 4 ? 1 : 0;
    }
  }
  CHECK(up > 0);
}

TEST_CASE("A pixel that blinks beside a dead one counts among its neighbours") {
  BadPixels bad({.dead_share = 0.4, .blinking_share = 1, .blinking_ratio = 8, .blinking_hz = 0}, 1, "a",
                kFrameRate, 40, 30);
  const std::set<std::size_t> dead(bad.dead().begin(), bad.dead().end());
  BadPixels only_blinking({.blinking_share = 1, .blinking_ratio = 8, .blinking_hz = 0}, 1, "a", kFrameRate,
                          40, 30);
  Plane<float> jumped(40, 30, 100);
  only_blinking.apply(0, 1, jumped);
  Plane<float> picture(40, 30, 100);
  bad.apply(0, 1, picture);
  for (const std::size_t pixel : bad.dead()) {
    REQUIRE_THAT(static_cast<double>(picture.pixels()[pixel]),
                 WithinRel(expected_of(jumped, dead, pixel), 3e-7));
  }
}

TEST_CASE("Which pixels are bad is a function of seed and clip") {
  const BadPixelParameters parameters = {.dead_share = 0.1, .blinking_share = 0.1};
  const BadPixels bad(parameters, 1, "a", kFrameRate, 40, 30);
  const BadPixels same(parameters, 1, "a", 9, 40, 30);
  CHECK(same.dead() == bad.dead());
  CHECK(same.blinking() == bad.blinking());
  CHECK(bad.dead() != bad.blinking());
  CHECK(BadPixels(parameters, 2, "a", kFrameRate, 40, 30).dead() != bad.dead());
  CHECK(BadPixels(parameters, 1, "b", kFrameRate, 40, 30).dead() != bad.dead());
  const BadPixels more({.dead_share = 0.2}, 1, "a", kFrameRate, 40, 30);
  CHECK(std::includes(more.dead().begin(), more.dead().end(), bad.dead().begin(), bad.dead().end()));
}

TEST_CASE("A pixel that fails during the clip shows 0 from then on, and the camera does not know it") {
  const BadPixelParameters parameters = {.late_dead_per_hour = 2};  // 3600 s at 30 Hz: 108,000 frames
  BadPixels bad(parameters, 1, "a", kFrameRate, 40, 30);
  BadPixels leaping(parameters, 1, "a", kFrameRate, 40, 30);
  REQUIRE_FALSE(bad.late_dead().empty());
  std::set<std::size_t> failed;
  for (const std::uint32_t frame : {0U, 1000U, 20000U, 108000U}) {
    Plane<float> picture = ramp(40, 30);
    bad.apply(frame, 1, picture);
    for (const BadPixels::LateDead& late : bad.late_dead())
      if (late.frame <= frame) failed.insert(late.pixel);
    for (std::size_t i = 0; i < picture.size(); ++i)
      REQUIRE(picture.pixels()[i] == (failed.count(i) > 0 ? 0 : ramp(40, 30).pixels()[i]));
    if (frame == 108000U) {
      Plane<float> same = ramp(40, 30);
      leaping.apply(frame, 1, same);
      CHECK(same == picture);
    }
  }
  CHECK(failed.size() > 900);
  for (std::size_t i = 1; i < bad.late_dead().size(); ++i)
    REQUIRE(bad.late_dead()[i].frame >= bad.late_dead()[i - 1].frame);
}

TEST_CASE("A pixel fails at the same time at every frame rate, a function of seed and clip") {
  const auto first_s = [](double rate_hz, std::uint32_t seed, const char* clip) {
    return BadPixels({.late_dead_per_hour = 0.1}, seed, clip, rate_hz, 40, 30).late_dead().front().frame /
           rate_hz;
  };
  CHECK_THAT(first_s(9, 1, "a"), WithinRel(first_s(60, 1, "a"), 1e-12));
  CHECK(first_s(60, 2, "a") != first_s(60, 1, "a"));
  CHECK(first_s(60, 1, "b") != first_s(60, 1, "a"));
  CHECK(BadPixels({.dead_share = 0.1}, 1, "a", 60, 40, 30).late_dead().empty());
}

}  // namespace bad_pixels_test
