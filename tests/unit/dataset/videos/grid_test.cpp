#include "dataset/videos/grid.h"

#include <cmath>

#include "support/catch.h"

namespace grid_test {

using namespace thermal;

namespace {

GridRequest request(std::size_t cells, PixelSize frame = {640, 512}) {
  return {.frames = std::vector<PixelSize>(cells, frame),
          .columns = 0,
          .width_px = 0,
          .bar = true,
          .headings = true};
}

bool holds(const Grid& grid, const PixelRect& rect) {
  return rect.x_px >= 0 && rect.y_px >= 0 && rect.right_px() <= grid.width_px &&
         rect.bottom_px() <= grid.height_px;
}

/// All that a grid places.
std::vector<PixelRect> parts_of(const Grid& grid) {
  std::vector<PixelRect> parts = grid.headings;
  for (const GridCell& cell : grid.cells) {
    parts.push_back(cell.caption);
    parts.push_back(cell.picture);
    if (cell.bar.width_px > 0) parts.push_back(cell.bar);
  }
  return parts;
}

}  // namespace

TEST_CASE("Parts of a grid lie inside and apart, whatever the number, shape and width") {
  for (const std::size_t cells : {1U, 2U, 3U, 5U, 12U, 16U}) {
    for (const PixelSize frame :
         {PixelSize{640, 512}, PixelSize{256, 144}, PixelSize{24, 16}, PixelSize{100, 300}}) {
      for (const int width_px : {0, 321, 640, 3840}) {
        CAPTURE(cells, frame.width_px, width_px);
        GridRequest what = request(cells, frame);
        what.width_px = width_px;
        const Grid grid = make_grid(what);
        CHECK(grid.width_px % 2 == 0);
        CHECK(grid.height_px % 2 == 0);
        const std::vector<PixelRect> parts = parts_of(grid);
        for (std::size_t k = 0; k < parts.size(); ++k) {
          CHECK(holds(grid, parts[k]));
          for (std::size_t other = 0; other < k; ++other) CHECK(overlap_px(parts[k], parts[other]) == 0);
        }
      }
    }
  }
}

TEST_CASE("A picture has its frame's shape") {
  GridRequest what = request(2);
  what.frames[1] = {256, 144};
  const Grid grid = make_grid(what);
  for (std::size_t k = 0; k < 2; ++k) {
    const PixelRect& picture = grid.cells[k].picture;
    const double ratio = static_cast<double>(what.frames[k].width_px) / what.frames[k].height_px;
    // The height is rounded to half a pixel.
    CHECK(std::abs(picture.width_px / ratio - picture.height_px) <= 0.5 + 0.5 / ratio);
  }
}

TEST_CASE("Columns make the whole as wide as screens are") {
  const auto columns = [](std::size_t cells) { return make_grid(request(cells)).columns; };
  CHECK(columns(1) == 1);
  CHECK(columns(2) == 2);
  CHECK(columns(4) == 2);
  CHECK(columns(6) == 3);
  CHECK(columns(9) == 3);
  CHECK(make_grid(request(1)).width_px == 1280);
  CHECK(make_grid(request(4)).width_px == 1920);
}

TEST_CASE("A tag is above its box where that is free") {
  TagPlacer placer({0, 0, 400, 300}, 2);
  const std::vector<TagPosition> places =
      placer.place({{.box = {100, 100, 30, 20}, .tag = {60, 14}, .track = 1}});
  CHECK(places[0].tag == PixelRect{98, 84, 60, 14});
  CHECK_FALSE(places[0].led);
}

TEST_CASE("Tags stay in the picture and cover neither targets nor each other") {
  TagPlacer placer({0, 0, 400, 300}, 2);
  std::vector<Tagged> tags;
  for (int k = 0; k < 6; ++k)
    tags.push_back({.box = {4 + 62 * k, k % 2 == 0 ? 1 : 30, 40, 24}, .tag = {58, 14}, .track = k});
  const std::vector<TagPosition> places = placer.place(tags);
  for (std::size_t k = 0; k < tags.size(); ++k) {
    CAPTURE(k);
    CHECK(overlap_px(places[k].tag, {0, 0, 400, 300}) == 58 * 14);
    for (std::size_t other = 0; other < tags.size(); ++other) {
      CHECK(overlap_px(places[k].tag, tags[other].box) == 0);
      if (other != k) CHECK(overlap_px(places[k].tag, places[other].tag) == 0);
    }
  }
}

TEST_CASE("A tag keeps its place as its target moves on") {
  TagPlacer placer({0, 0, 400, 300}, 2);
  const Tagged wall{.box = {100, 80, 60, 16}, .tag = {1, 1}, .track = 2};  // where the first place would be
  const PixelRect beside =
      placer.place({{.box = {100, 100, 30, 20}, .tag = {60, 14}, .track = 1}, wall})[0].tag;
  CHECK(beside.y_px > 100);
  const PixelRect after = placer.place({{.box = {104, 101, 30, 20}, .tag = {60, 14}, .track = 1}})[0].tag;
  CHECK(after.x_px == beside.x_px + 4);
  CHECK(after.y_px == beside.y_px + 1);
  TagPlacer fresh({0, 0, 400, 300}, 2);
  CHECK(fresh.place({{.box = {104, 101, 30, 20}, .tag = {60, 14}, .track = 1}})[0].tag.y_px < 101);
}

}  // namespace grid_test
