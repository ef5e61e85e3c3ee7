#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "imaging/ground/mixture.h"
#include "support/catch.h"

namespace cut_covers_test {

using namespace thermal;

namespace {

/// A place of as many metres as the maps have cells, with covers of half a metre: soil, half grass, half trodden.
GroundMaps place(std::size_t cells) {
  GroundMaps maps;
  maps.size_m = static_cast<double>(cells);
  maps.cells = cells;
  maps.covers.cells = 2 * cells;
  maps.covers.kinds = {"soil", "road", "rock"};
  const std::size_t count = maps.covers.cells * maps.covers.cells;
  maps.covers.kind.assign(count, 0);
  maps.covers.grass.assign(count, 102);
  maps.covers.trodden.assign(count, 51);
  maps.covers.ash.assign(count, 0);
  maps.covers.border.assign(count, 255);
  return maps;
}

/// Lays a kind, on which no grass grows, where `is_there` holds at the middle of a cell [cells of the covers].
template <typename IsThere>
void lay(GroundCovers& covers, std::uint8_t kind, IsThere is_there) {
  for (std::size_t i = 0; i < covers.cells * covers.cells; ++i) {
    const double x = static_cast<double>(i % covers.cells) + 0.5;
    const double y = static_cast<double>(i / covers.cells) + 0.5;
    if (!is_there(x, y)) continue;
    covers.kind[i] = kind;
    covers.grass[i] = 0;
    covers.trodden[i] = 0;
  }
}

}  // namespace

TEST_CASE("Covers are cut as finely as two million cells allow") {
  const GroundMaps maps = place(1024);
  const auto window = [&](std::size_t side) {
    return cut_window(maps, {.first_x = 10, .first_y = 20, .width = side, .height = side});
  };
  CHECK(window(181) == CutWindow{{.first_x = 80, .first_y = 160, .width = 1448, .height = 1448}, 4});
  CHECK(window(182) == CutWindow{{.first_x = 40, .first_y = 80, .width = 728, .height = 728}, 2});
  CHECK(window(363) == CutWindow{{.first_x = 20, .first_y = 40, .width = 726, .height = 726}, 1});
}

TEST_CASE("Kinds meet in lines that keep their place, and shares do not fade there") {
  GroundMaps maps = place(32);
  const double slope = GENERATE(0.0, 0.13, 0.37, 0.77);
  const auto line = [slope](double x) { return 12.1 + slope * x; };
  lay(maps.covers, 1, [&](double x, double y) { return y > line(x); });
  const CutWindow window = cut_window(maps, {.width = 32, .height = 32});
  REQUIRE(window.cuts == 4);
  const CutCovers covers(maps.covers, window);
  double most_off = 0;
  double squares = 0;
  for (std::size_t column = 16; column < 240; ++column) {
    std::size_t row = 0;
    while (covers.at(row, column).kind == 0) ++row;
    CHECK_THAT(covers.at(row - 1, column).grass, WithinAbs(102.0 / 255, 1e-6));
    CHECK_THAT(covers.at(row - 1, column).trodden, WithinAbs(51.0 / 255, 1e-6));
    CHECK(covers.at(row, column).grass == 0);
    const double x = (static_cast<double>(column) + 0.5) / 4;
    const double off = static_cast<double>(row) / 4 - line(x);
    most_off = std::max(most_off, std::abs(off));
    squares += off * off;
  }
  // A cell's middle decides: its border is off by up to half a cell, evenly, whose deviation is 0.29.
  CHECK(most_off < 0.5 + 0.125);
  CHECK(std::sqrt(squares / 224) < 0.29);
}

TEST_CASE("By their distances from cells, straight borders stay straight") {
  GroundMaps maps = place(32);
  const double slope = GENERATE(0.0, 0.13, 0.37, 0.77);
  const auto line = [slope](double x) { return 12.1 + slope * x; };
  lay(maps.covers, 1, [&](double x, double y) { return y > line(x); });
  for (std::size_t i = 0; i < 64 * 64; ++i) {
    const double x = static_cast<double>(i % 64) + 0.5;
    const double y = static_cast<double>(i / 64) + 0.5;
    const double off = std::abs(y - line(x)) / std::sqrt(1 + slope * slope);
    maps.covers.border[i] = static_cast<std::uint8_t>(std::lround(std::min(255.0, off / 1.5 * 255)));
  }
  const CutWindow window = cut_window(maps, {.width = 32, .height = 32});
  const CutCovers covers(maps.covers, window);
  for (std::size_t column = 16; column < 240; ++column) {
    std::size_t row = 0;
    while (covers.at(row, column).kind == 0) ++row;
    // The first row whose middle is beyond it, and a byte's rounding over two cells of two weights.
    const double middle = (static_cast<double>(row) + 0.5) / 4;
    const double y = line((static_cast<double>(column) + 0.5) / 4);
    CHECK(middle > y - 0.02);
    CHECK(middle - 0.25 < y + 0.02);
  }
}

TEST_CASE("A single cell of a kind is lost among others, and shares are smooth within a kind") {
  GroundMaps maps = place(16);
  lay(maps.covers, 2, [](double x, double y) { return x == 10.5 && y == 12.5; });
  for (std::size_t i = 0; i < 32; ++i) maps.covers.ash[8 * 32 + i] = 255;
  const CutWindow window = cut_window(maps, {.width = 16, .height = 16});
  const CutCovers covers(maps.covers, window);
  std::size_t rocky = 0;
  for (std::size_t row = 48; row < 52; ++row)
    for (std::size_t column = 40; column < 44; ++column) rocky += covers.at(row, column).kind == 2 ? 1U : 0U;
  CHECK(rocky == 0);  // its largest weight is (23/32)^2 of the four by four, less than a half
  // Along a column, the weights of a spline: 2/3 at its middle, 1/6 a cell away, none from two cells on.
  const float middle = covers.at(34, 100).ash;
  CHECK(middle > 0.6F);
  CHECK(middle < 0.67F);
  CHECK(covers.at(38, 100).ash < middle);
  CHECK(covers.at(42, 100).ash < 0.01F);
  CHECK(covers.at(44, 100).ash == 0);
}

}  // namespace cut_covers_test
