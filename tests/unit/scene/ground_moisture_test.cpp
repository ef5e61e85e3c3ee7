#include <cmath>
#include <vector>

#include "scene/ground_maps.h"
#include "support/catch.h"

namespace ground_moisture_test {

using Catch::Matchers::WithinAbs;

namespace {

/// A place of 400 m, of cells of 4 m.
struct Land {
  static constexpr std::size_t kCells = 100;
  static constexpr double kSizeM = 400;

  template <typename Map>
  static std::vector<float> on_lines(const Map& map) {
    std::vector<float> values;
    for (std::size_t row = 0; row <= kCells; ++row)
      for (std::size_t column = 0; column <= kCells; ++column)
        values.push_back(static_cast<float>(
            map(4.0 * static_cast<double>(column) - 200, 4.0 * static_cast<double>(row) - 200)));
    return values;
  }

  std::vector<float> height_m = on_lines([](double, double) { return 5; });
  std::vector<float> shore_m = {};

  [[nodiscard]] thermal::BakedGround ground() const {
    return {.size_m = kSizeM,
            .cells = kCells,
            .covers = {},
            .height_m = height_m,
            .shore_m = shore_m,
            .cover = {},
            .canopy = {}};
  }
};

}  // namespace

TEST_CASE("Level ground and even slopes without water are dry") {
  Land land;
  for (const std::uint8_t one : thermal::ground_moisture(land.ground(), 400)) REQUIRE(one == 0);
  land.height_m = Land::on_lines([](double x, double) { return 0.1 * x; });
  const auto slope = thermal::ground_moisture(land.ground(), 100);
  CHECK(slope[50 * 100 + 50] == 0);
}

TEST_CASE("Ground is saturated in water, and dries by a factor of e every 4 m from the shore") {
  Land land;
  land.shore_m = Land::on_lines([](double x, double) { return x; });
  const auto moisture = thermal::ground_moisture(land.ground(), 400);
  const std::size_t middle = 200 * 400;
  CHECK(moisture[middle + 0] == 255);
  CHECK(moisture[middle + 199] == 255);
  for (const std::size_t beyond : {0U, 3U, 10U, 30U}) {
    const double distance_m = static_cast<double>(beyond) + 0.5;
    CHECK_THAT(moisture[middle + 200 + beyond], WithinAbs(255 * std::exp(-distance_m / 4), 0.51));
  }
}

TEST_CASE("Hollows are moist, up to half where they are 2 m below their surroundings") {
  Land land;
  land.height_m = Land::on_lines([](double x, double y) { return -6 * std::exp(-(x * x + y * y) / 200); });
  const auto moisture = thermal::ground_moisture(land.ground(), 400);
  CHECK(moisture[200 * 400 + 200] == 128);
  CHECK(moisture[20 * 400 + 20] == 0);
  land.height_m = Land::on_lines([](double x, double y) { return 6 * std::exp(-(x * x + y * y) / 200); });
  CHECK(thermal::ground_moisture(land.ground(), 400)[200 * 400 + 200] == 0);  // a hill
}

TEST_CASE("The foot of a cliff is no hollow, and a valley is one") {
  Land land;
  land.height_m = Land::on_lines([](double x, double) { return x < 0 ? 0 : 20; });
  const auto cliff = thermal::ground_moisture(land.ground(), 400);
  for (std::size_t column = 0; column < 400; ++column) CHECK(cliff[200 * 400 + column] == 0);
  land.height_m = Land::on_lines([](double x, double y) { return 0.04 * std::abs(x + y); });
  const auto valley = thermal::ground_moisture(land.ground(), 400);
  CHECK_THAT(valley[200 * 400 + 199] / 255.0, WithinAbs(0.5 * 0.04 * 30 * std::sqrt(2) / 2, 0.03));
  CHECK(valley[300 * 400 + 300] == 0);
}

TEST_CASE("A single cell of ground is dry, and moist by its shore") {
  const std::vector<float> corners = {1, 2, 3, 4};
  const std::vector<float> shore_m = {-1, -1, 1, 1};
  thermal::BakedGround ground{
      .size_m = 20, .cells = 1, .covers = {}, .height_m = corners, .shore_m = {}, .cover = {}, .canopy = {}};
  CHECK(thermal::ground_moisture(ground, 1)[0] == 0);
  ground.shore_m = shore_m;
  CHECK(thermal::ground_moisture(ground, 1)[0] == 255);
}

TEST_CASE("Water is as deep as the ground is below it, and there is none on land") {
  Land land;
  CHECK(thermal::water_depths_m(land.ground(), std::vector<float>(400 * 400, 9.0F), 400).empty());
  // A bed that falls by 0.1 towards the west below a level of 5 m, from the shore at x = 0 on.
  land.shore_m = Land::on_lines([](double x, double) { return x; });
  land.height_m = Land::on_lines([](double x, double) { return 5 + 0.1 * x; });
  std::vector<float> highest_m;
  for (std::size_t i = 0; i < 400U * 400U; ++i) {
    const double x = static_cast<double>(i % 400) + 0.5 - 200;
    highest_m.push_back(static_cast<float>(x < 0 ? 5 : x < 100 ? 5 + 0.1 * x : 90));  // a tower on land
  }
  const auto depth_m = thermal::water_depths_m(land.ground(), highest_m, 400);
  const std::size_t middle = 200 * 400;
  for (const std::size_t off : {0U, 3U, 40U})
    CHECK_THAT(depth_m[middle + 199 - off], WithinAbs(0.1 * (static_cast<double>(off) + 0.5), 1e-5));
  CHECK_THAT(depth_m[middle + 200], WithinAbs(0, 1e-5));
  CHECK(depth_m[middle + 350] == 0);
}

}  // namespace ground_moisture_test
