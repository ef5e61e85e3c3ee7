#include "analysis/balance/selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "support/catch.h"

namespace selection_test {

using namespace thermal;

namespace {

std::vector<int> frames_to(int count) {
  std::vector<int> frames(static_cast<std::size_t>(count));
  std::iota(frames.begin(), frames.end(), 0);
  return frames;
}

}  // namespace

TEST_CASE("the requested number of frames is selected, ascending, from the available ones") {
  const std::vector<int> frames = {3, 5, 8, 9, 21};
  CHECK(choose_frames(frames, 0, 1, "night").empty());
  CHECK(choose_frames(frames, 5, 1, "night") == frames);
  const std::vector<int> chosen = choose_frames(frames, 3, 1, "night");
  CHECK(chosen.size() == 3);
  CHECK(std::is_sorted(chosen.begin(), chosen.end()));
  CHECK(std::includes(frames.begin(), frames.end(), chosen.begin(), chosen.end()));
}

TEST_CASE("the choice is a function of seed and video, and grows with the count") {
  const std::vector<int> frames = frames_to(100);
  const std::vector<int> chosen = choose_frames(frames, 40, 1, "night");
  CHECK(choose_frames(frames, 40, 1, "night") == chosen);
  CHECK(choose_frames(frames, 40, 2, "night") != chosen);
  CHECK(choose_frames(frames, 40, 1, "day") != chosen);
  const std::vector<int> more = choose_frames(frames, 41, 1, "night");
  CHECK(std::includes(more.begin(), more.end(), chosen.begin(), chosen.end()));
}

TEST_CASE("every frame has the same chance") {
  constexpr int kFrames = 20;
  constexpr int kTimes = 4000;
  std::array<int, kFrames> times{};
  for (std::uint32_t seed = 0; seed < kTimes; ++seed) {
    for (const int frame : choose_frames(frames_to(kFrames), 5, seed, "night"))
      ++times[static_cast<std::size_t>(frame)];
  }
  // Each count is binomial with p = 1/4: 4.5 sigma of 20 counts is exceeded by chance once in 7000 choices of seeds.
  const double sigma = std::sqrt(kTimes * 0.25 * 0.75);
  for (const int count : times) CHECK(std::abs(count - kTimes / 4) < 4.5 * sigma);
}

}  // namespace selection_test
