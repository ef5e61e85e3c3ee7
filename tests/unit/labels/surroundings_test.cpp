#include "labels/surroundings.h"

#include <algorithm>
#include <random>

#include "support/catch.h"
#include "support/drawn.h"

namespace surroundings_test {

using namespace thermal;

namespace {

std::vector<Instance> instances_in(const Plane<std::uint16_t>& plane) {
  const std::vector<std::uint16_t> actors = {1, 2, 3, 4};
  return extract_instances(plane, survey_indices(plane), IndexSet(actors));
}

/// A picture of this value, with the instances' pixels at others.
Plane<float> painted(const Plane<std::uint16_t>& plane, float around, const std::vector<float>& of_index) {
  Plane<float> picture(plane.width_px(), plane.height_px(), around);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (plane.pixels()[i] > 0) picture.pixels()[i] = of_index.at(plane.pixels()[i]);
  }
  return picture;
}

/// The documented definition, pixel by pixel over the whole picture.
TargetMeans counted(const Plane<float>& picture, const Plane<std::uint16_t>& plane,
                    const Instance& instance) {
  double target = 0;
  double ring = 0;
  int ring_pixels = 0;
  const PixelBox& box = instance.box;
  const int reach_px = 2 + std::max(4, (std::max(box.width_px, box.height_px) + 1) / 2);
  for (int y = 0; y < plane.height_px(); ++y) {
    for (int x = 0; x < plane.width_px(); ++x) {
      const auto value = static_cast<double>(picture.at(x, y));
      if (plane.at(x, y) == instance.index) target += value;
      const int beyond_px = std::max({box.x_px - x, x - (box.x_px + box.width_px - 1), box.y_px - y,
                                      y - (box.y_px + box.height_px - 1)});
      if (beyond_px <= 2 || beyond_px > reach_px || plane.at(x, y) != 0) continue;
      ring += value;
      ++ring_pixels;
    }
  }
  TargetMeans means = {.target = target / instance.area_px, .ring = {}};
  if (ring_pixels > 0) means.ring = ring / ring_pixels;
  return means;
}

}  // namespace

TEST_CASE("The ring is half of the larger side wide, and at least four pixels") {
  CHECK(ring_px({0, 0, 1, 1}) == 4);
  CHECK(ring_px({0, 0, 8, 3}) == 4);
  CHECK(ring_px({0, 0, 3, 9}) == 5);
  CHECK(ring_px({0, 0, 10, 9}) == 5);
  CHECK(ring_px({0, 0, 100, 9}) == 50);
}

TEST_CASE("The mean of a target is that of its own pixels, in any number of pieces") {
  const Plane<std::uint16_t> plane = drawn({"1..", "...", "..1"});
  Plane<float> picture(3, 3, 100);
  picture.at(0, 0) = 3;
  picture.at(2, 2) = 5;
  CHECK(target_means(picture, instances_in(plane)).at(0).target == 4);
}

TEST_CASE("Two pixels around the box are excluded as blur, and so are distant ones") {
  // One pixel at x = 8 of a single row: the guard reaches to 6 and 10, the ring to 2 and 14.
  Plane<std::uint16_t> plane(20, 1);
  plane.at(8, 0) = 1;
  const auto ring_with = [&](int x) {
    Plane<float> picture(20, 1, 0);
    picture.at(x, 0) = 8;
    return target_means(picture, instances_in(plane)).at(0).ring.value();
  };
  for (int x = 0; x < 20; ++x) {
    CAPTURE(x);
    const bool in_ring = (x >= 2 && x <= 5) || (x >= 11 && x <= 14);
    CHECK(ring_with(x) == (in_ring ? 1 : 0));  // one of eight
  }
}

TEST_CASE("Other actors in the ring do not count, and without pixels there is no ring") {
  const Plane<std::uint16_t> plane = drawn({"1..2......"});
  const std::vector<TargetMeans> means = target_means(painted(plane, 7, {0, 20, 90}), instances_in(plane));
  CHECK(means[0].target == 20);
  CHECK(means[0].ring == 7);
  CHECK(means[1].ring == 7);
  const Plane<std::uint16_t> full = drawn({"1122"});
  CHECK_FALSE(target_means(painted(full, 7, {0, 20, 90}), instances_in(full)).at(0).ring);
  const Plane<std::uint16_t> guarded = drawn({"..1.."});
  CHECK_FALSE(target_means(painted(guarded, 7, {0, 20}), instances_in(guarded)).at(0).ring);
  CHECK(target_means(Plane<float>(4, 4, 1), {}).empty());
}

TEST_CASE("On random pictures, means equal a count of every pixel") {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const int width_px = 1 + static_cast<int>(random() % 40);
    const int height_px = 1 + static_cast<int>(random() % 40);
    Plane<std::uint16_t> plane(width_px, height_px);
    for (int shapes = 0; shapes < 5; ++shapes) {
      const int left = static_cast<int>(random() % static_cast<unsigned>(width_px));
      const int top = static_cast<int>(random() % static_cast<unsigned>(height_px));
      const auto index = static_cast<std::uint16_t>(random() % 5);
      for (int y = top; y < std::min(height_px, top + 6); ++y) {
        for (int x = left; x < std::min(width_px, left + 4); ++x) plane.at(x, y) = index;
      }
    }
    Plane<float> picture(width_px, height_px);  // whole numbers, so that sums are exact in any order
    for (float& value : picture.pixels()) value = static_cast<float>(random() % 1000);
    const std::vector<Instance> instances = instances_in(plane);
    const std::vector<TargetMeans> means = target_means(picture, instances);
    REQUIRE(means.size() == instances.size());
    for (std::size_t k = 0; k < means.size(); ++k) {
      const TargetMeans expected = counted(picture, plane, instances[k]);
      REQUIRE(means[k].target == expected.target);
      REQUIRE(means[k].ring == expected.ring);
    }
  }
}

}  // namespace surroundings_test
