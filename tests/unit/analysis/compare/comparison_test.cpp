#include "analysis/compare/comparison.h"

#include <cmath>
#include <set>

#include "base/error.h"
#include "base/order_statistics.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace comparison_test {

using namespace thermal;

namespace {

/// Clips of this many frames each.
FrameSource source_of(bool is_dataset, const std::vector<std::size_t>& clips) {
  FrameSource source = {.name = "x", .is_dataset = is_dataset, .frames = {}, .no_boxes = {}};
  for (std::size_t clip = 0; clip < clips.size(); ++clip) {
    for (std::size_t k = 0; k < clips[clip]; ++k)
      source.frames.push_back({.file = "", .name = "", .video = clip, .altitude_m = {}, .boxes = {}});
  }
  return source;
}

std::vector<std::size_t> units(const FrameSource& source) {
  std::vector<std::size_t> all(source.frames.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
  return units_of(source, all);
}

}  // namespace

TEST_CASE("Pictures of a folder are units, clips are if there are ten, and runs of frames otherwise") {
  CHECK(units(source_of(false, {3})) == std::vector<std::size_t>{0, 1, 2});
  CHECK(units(source_of(true, std::vector<std::size_t>(10, 2))) ==
        std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9});
  CHECK(units(source_of(true, {10, 10})) ==
        std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9});
  CHECK(units(source_of(true, {4})) == std::vector<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("Halves hold every frame once, and whole units") {
  std::vector<FrameFigures> frames(9);
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].unit = k / 2;  // 5 units
  const Halves halves = halves_of(frames, 1, 3);
  const auto units_in = [](const MeasuredFrames& half) {
    std::set<std::size_t> found;
    for (const FrameFigures* frame : half) found.insert(frame->unit);
    return found;
  };
  CHECK(halves.first.size() + halves.second.size() == 9);
  CHECK(units_in(halves.first).size() == 3);
  CHECK(units_in(halves.second).size() == 2);
}

TEST_CASE("A difference is good within twice that of halves, or if there is none") {
  CHECK(ComparedMeasure{1, 3, 2, 1, 2}.is_good());
  CHECK_FALSE(ComparedMeasure{1, 3.1, 2.1, 1, 2.1}.is_good());
  CHECK(ComparedMeasure{1, 1, 0, 0, {}}.is_good());
  CHECK_FALSE(ComparedMeasure{1, 2, 1, 0, {}}.is_good());
  CHECK_FALSE(ComparedMeasure{1, {}, {}, 0, {}}.is_good());
}

TEST_CASE("Every measure has a value's place") {
  CHECK(values_of({}).size() == measures().size());
  const FrameFigures frame;
  CHECK(frame_table({&frame}).rows[0].size() == frame_features().size());
}

TEST_CASE("Too few frames are asked for") {
  CompareOptions options;
  options.most_frames = 3;
  CHECK(message_of<ConfigError>([&] { options.validate(); }) == "--frames = 3; expected at least 4");
}

TEST_CASE("Quantiles lie between neighbours") {
  CHECK(quantile_of({4, 1, 3, 2}, 0.5) == 2.5);
  CHECK(quantile_of({4, 1, 3, 2}, 1) == 4);
  CHECK(quantile_of({7}, 0.3) == 7);
  CHECK(median_of({}) == 0);
  CHECK(deviation_of({1, 3}) == std::sqrt(2.0));
  CHECK(evenly(10, 4) == std::vector<std::size_t>{0, 2, 5, 7});
  CHECK(evenly(2, 4) == std::vector<std::size_t>{0, 1});
}

}  // namespace comparison_test
