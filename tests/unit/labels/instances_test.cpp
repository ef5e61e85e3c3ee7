#include "labels/instances.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "base/error.h"
#include "support/catch.h"
#include "support/drawn.h"
#include "support/message_of.h"

namespace instances_test {

using namespace thermal;

namespace {

using IndexPlane = Plane<std::uint16_t>;
using Pixels = std::set<std::pair<int, int>>;  // (x, y)

/// Rectangles of a few indices, some crossing the border, and scattered single pixels.
IndexPlane random_plane(std::mt19937& random, int width_px, int height_px) {
  IndexPlane plane(width_px, height_px);
  const auto below = [&random](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  for (int shapes = below(8); shapes > 0; --shapes) {
    const int left = below(width_px + 4) - 4;
    const int top = below(height_px + 4) - 4;
    const int right = std::min(width_px, left + 1 + below(12));
    const int bottom = std::min(height_px, top + 1 + below(12));
    const auto index = static_cast<std::uint16_t>(below(5));
    for (int y = std::max(0, top); y < bottom; ++y) {
      for (int x = std::max(0, left); x < right; ++x) plane.at(x, y) = index;
    }
  }
  for (int strewn = below(10); strewn > 0; --strewn) {
    plane.at(below(width_px), below(height_px)) = static_cast<std::uint16_t>(below(5));
  }
  return plane;
}

std::map<std::uint16_t, Pixels> pixels_by_index(const IndexPlane& plane) {
  std::map<std::uint16_t, Pixels> pixels;
  for (int y = 0; y < plane.height_px(); ++y) {
    for (int x = 0; x < plane.width_px(); ++x) pixels[plane.at(x, y)].emplace(x, y);
  }
  return pixels;
}

/// The pixels of a mask; its runs must cover the frame exactly, and only the first may be empty.
Pixels pixels_of(const RunLengths& mask, const IndexPlane& plane) {
  Pixels pixels;
  std::size_t at = 0;
  for (std::size_t run = 0; run < mask.size(); ++run) {
    REQUIRE((mask[run] > 0 || run == 0));
    for (std::uint32_t i = 0; i < mask[run]; ++i, ++at) {
      const auto height = static_cast<std::size_t>(plane.height_px());
      if (run % 2 == 1) pixels.emplace(static_cast<int>(at / height), static_cast<int>(at % height));
    }
  }
  REQUIRE(at == plane.size());
  return pixels;
}

PixelBox box_around(const Pixels& pixels) {
  int left = pixels.begin()->first;
  int right = left;
  int top = pixels.begin()->second;
  int bottom = top;
  for (const auto& [x, y] : pixels) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  return {left, top, right - left + 1, bottom - top + 1};
}

bool reaches_border(const Pixels& pixels, const IndexPlane& plane) {
  return std::any_of(pixels.begin(), pixels.end(), [&plane](const auto& pixel) {
    const auto [x, y] = pixel;
    return x == 0 || y == 0 || x == plane.width_px() - 1 || y == plane.height_px() - 1;
  });
}

std::vector<Instance> instances_in(const IndexPlane& plane, const std::vector<std::uint16_t>& actors) {
  return extract_instances(plane, survey_indices(plane), IndexSet(actors));
}

/// Compares all results of the fast implementation for a plane with a count of every pixel.
void check_against_counting(const IndexPlane& plane) {
  std::map<std::uint16_t, Pixels> expected = pixels_by_index(plane);
  expected.erase(0);
  const std::vector<Instance> instances = instances_in(plane, {1, 2, 3, 4});
  REQUIRE(instances.size() == expected.size());
  for (const Instance& instance : instances) {
    CAPTURE(plane.width_px(), plane.height_px(), instance.index);
    const Pixels& pixels = expected.at(instance.index);
    REQUIRE(pixels_of(instance.mask, plane) == pixels);
    REQUIRE(instance.box == box_around(pixels));
    REQUIRE(instance.area_px == pixels.size());
    REQUIRE(instance.truncated == reaches_border(pixels, plane));
  }
}

}  // namespace

TEST_CASE("An actor's box, area and mask are those of its pixels") {
  const IndexPlane plane = drawn({"......",  //
                                  "..77..",  //
                                  ".7.7..",  //
                                  "......"});
  const std::vector<Instance> instances = instances_in(plane, {7});
  REQUIRE(instances.size() == 1);
  CHECK(instances[0].index == 7);
  CHECK(instances[0].box == PixelBox{1, 1, 3, 2});
  CHECK(instances[0].area_px == 4);
  CHECK_FALSE(instances[0].truncated);
  CHECK(instances[0].mask == RunLengths{6, 1, 2, 1, 3, 2, 9});  // column by column
}

TEST_CASE("An actor in pieces is one instance") {
  const std::vector<Instance> instances = instances_in(drawn({".....", ".4.4.", "....."}), {4});
  REQUIRE(instances.size() == 1);
  CHECK(instances[0].box == PixelBox{1, 1, 3, 1});
  CHECK(instances[0].area_px == 2);
}

TEST_CASE("A box that touches any border is truncated, and only then") {
  const auto truncated = [](const std::vector<std::string>& rows) {
    return instances_in(drawn(rows), {1}).at(0).truncated;
  };
  CHECK(truncated({".1.", "...", "..."}));
  CHECK(truncated({"...", "...", ".1."}));
  CHECK(truncated({"...", "1..", "..."}));
  CHECK(truncated({"...", "..1", "..."}));
  CHECK_FALSE(truncated({"...", ".1.", "..."}));
}

TEST_CASE("A mask's runs continue from the bottom of one column to the top of the next") {
  CHECK(instances_in(drawn({".11.", ".11."}), {1}).at(0).mask == RunLengths{2, 4, 2});
  CHECK(instances_in(drawn({"..1.", ".1.."}), {1}).at(0).mask == RunLengths{3, 2, 3});
}

TEST_CASE("An actor may fill the frame, and the frame may be one pixel") {
  CHECK(instances_in(IndexPlane(1, 1, 3), {3}).at(0).mask == RunLengths{0, 1});
  CHECK(instances_in(IndexPlane(5, 4, 3), {3}).at(0).mask == RunLengths{0, 20});
  CHECK(instances_in(IndexPlane(5, 4, 3), {3}).at(0).box == PixelBox{0, 0, 5, 4});
}

TEST_CASE("Objects that are not actors, and actors out of sight, are not labelled") {
  const IndexPlane plane = drawn({"123"});
  const std::vector<Instance> instances = instances_in(plane, {9, 3, 1});
  REQUIRE(instances.size() == 2);
  CHECK(instances[0].index == 1);  // in ascending order, not as requested
  CHECK(instances[1].index == 3);
  CHECK(instances_in(plane, {}).empty());
}

TEST_CASE("A survey finds every index, with its first place and its count") {
  const std::vector<IndexUse> uses = survey_indices(drawn({"..5.",  //
                                                           "2.55",  //
                                                           "2..."}));
  REQUIRE(uses.size() == 3);
  CHECK(uses[0].index == 0);
  CHECK(uses[0].pixels == 7);
  CHECK(uses[1].index == 2);
  CHECK(uses[1].first_x_px == 0);
  CHECK(uses[1].first_y_px == 1);
  CHECK(uses[1].box == PixelBox{0, 1, 1, 2});
  CHECK(uses[2].index == 5);
  CHECK(uses[2].first_x_px == 2);
  CHECK(uses[2].first_y_px == 0);
  CHECK(uses[2].pixels == 3);
}

TEST_CASE("The largest possible index can be surveyed") {
  const std::vector<IndexUse> uses = survey_indices(IndexPlane(2, 2, 32767));
  REQUIRE(uses.size() == 1);
  CHECK(uses[0].index == 32767);
  CHECK(uses[0].pixels == 4);
}

TEST_CASE("A larger index is refused with its pixel, and is in no set") {
  IndexPlane plane(4, 3, 1);
  plane.at(2, 1) = 32768;
  CHECK(message_of<DataError>([&] { (void)survey_indices(plane); }) ==
        "index at pixel (2, 1) = 32768; expected a whole number from 0 to 32767");
  CHECK_FALSE(IndexSet().contains(65535));
  const std::array<std::uint16_t, 1> largest = {65535};
  CHECK(IndexSet(largest).contains(65535));
}

TEST_CASE("On random planes of any shape, labels equal a count of every pixel") {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const int width_px = 1 + static_cast<int>(random() % 24);
    const int height_px = 1 + static_cast<int>(random() % 24);
    check_against_counting(random_plane(random, width_px, height_px));
  }
}

TEST_CASE("The same on planes one pixel wide or high") {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const int length_px = 1 + static_cast<int>(random() % 40);
    check_against_counting(random_plane(random, length_px, 1));
    check_against_counting(random_plane(random, 1, length_px));
  }
}

TEST_CASE("The use of an index is found, or null") {
  const std::vector<IndexUse> uses = survey_indices(drawn({"3.5"}));
  REQUIRE(find_use(uses, 5) != nullptr);
  CHECK(find_use(uses, 5)->first_x_px == 2);
  CHECK(find_use(uses, 0) == &uses.front());
  CHECK(find_use(uses, 4) == nullptr);
  CHECK(find_use(uses, 32767) == nullptr);
  CHECK(find_use({}, 0) == nullptr);
}

}  // namespace instances_test
