#include "base/image.h"

#include <algorithm>
#include <cstdint>

#include "support/catch.h"

namespace image_test {

using namespace thermal;

TEST_CASE("A new plane holds one value everywhere") {
  const Plane<float> plane(3, 2, 7.5F);
  CHECK(plane.width_px() == 3);
  CHECK(plane.height_px() == 2);
  CHECK(plane.size() == 6);
  CHECK(std::count(plane.pixels().begin(), plane.pixels().end(), 7.5F) == 6);
}

TEST_CASE("Pixels lie row by row, the top row first") {
  Plane<int> plane(3, 2);
  for (int i = 0; i < 6; ++i) plane.pixels()[static_cast<std::size_t>(i)] = i;
  CHECK(plane.at(2, 0) == 2);
  CHECK(plane.at(0, 1) == 3);
  CHECK(plane.row(1).size() == 3);
  CHECK(plane.row(1)[2] == 5);
}

TEST_CASE("Planes are equal when size and pixels are") {
  Plane<std::uint8_t> plane(2, 3, 1);
  const Plane<std::uint8_t> same(2, 3, 1);
  CHECK(plane == same);
  CHECK_FALSE(plane == Plane<std::uint8_t>(3, 2, 1));  // as many pixels, another shape
  plane.at(1, 2) = 2;
  CHECK_FALSE(plane == same);
}

TEST_CASE("A plane without pixels is empty") {
  CHECK(Plane<float>().empty());
  CHECK(Plane<float>(0, 5).empty());
  CHECK_FALSE(Plane<float>(1, 1).empty());
}

}  // namespace image_test
