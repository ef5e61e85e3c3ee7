/// The picture is the display window: pixels that the data window lacks, and pixels beyond the display window.

#include <bit>
#include <cstdint>

#include "base/error.h"
#include "io/exr/header.h"
#include "io/exr/passes.h"
#include "support/catch.h"
#include "support/exr_forms.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_windows_test {

using namespace thermal;
using exr_forms::window;
using Imath::Box2i;

namespace {

/// A pixel's value, by its position in the windows' plane.
float index_at(int x, int y) { return static_cast<float>(1000 + 100 * y + x); }
float depth_at(int x, int y) { return 0.125F * index_at(x, y); }
float slope_at(int x, int y) { return -index_at(y, x); }

std::vector<float> pixels_of(const Box2i& box, float (*pixel_at)(int, int)) {
  std::vector<float> pixels;
  for (int y = box.min.y; y <= box.max.y; ++y) {
    for (int x = box.min.x; x <= box.max.x; ++x) pixels.push_back(pixel_at(x, y));
  }
  return pixels;
}

exr_forms::Part part_of(const Box2i& display, const Box2i& data) {
  return {.display = display,
          .data = data,
          .channels = {{"IndexOB.X", exr_forms::floats(pixels_of(data, index_at))},
                       {"IndexMA.X", exr_forms::numbers(Imf::UINT, pixels_of(data, index_at))},
                       {"Depth.Z", exr_forms::floats(pixels_of(data, depth_at))},
                       {"Normal.X", exr_forms::floats(pixels_of(data, slope_at))},
                       {"Normal.Y", exr_forms::floats(pixels_of(data, slope_at))},
                       {"Normal.Z", exr_forms::floats(pixels_of(data, slope_at))}}};
}

template <typename Pixel>
void check_plane(const Plane<Pixel>& plane, const Box2i& display, const Box2i& data,
                 float (*pixel_at)(int, int), float outside) {
  REQUIRE(plane.width_px() == static_cast<int>(exr_forms::width_of(display)));
  REQUIRE(plane.height_px() == exr_forms::height_of(display));
  for (int y = display.min.y; y <= display.max.y; ++y) {
    for (int x = display.min.x; x <= display.max.x; ++x) {
      const float expected = data.intersects(Imath::V2i(x, y)) ? pixel_at(x, y) : outside;
      if (static_cast<float>(plane.at(x - display.min.x, y - display.min.y)) == expected) continue;
      CAPTURE(x, y);
      REQUIRE(static_cast<float>(plane.at(x - display.min.x, y - display.min.y)) == expected);
    }
  }
}

/// `buffer` may hold another frame, of which nothing may remain.
void check(const Path& file, const Box2i& display, const Box2i& data, PassBuffer& buffer) {
  read_passes(file, {}, {.depth = true, .normals = true}, buffer);
  const Passes& passes = buffer.passes;
  check_plane(passes.object_index, display, data, index_at, 0);
  check_plane(passes.material_index, display, data, index_at, 0);
  check_plane(passes.depth_m, display, data, depth_at, 1e10F);
  for (const Plane<float>& normal : passes.normal) check_plane(normal, display, data, slope_at, 0);
}

/// Data windows by their position relative to the display window, and by their size.
const std::vector<Box2i> kData = {
    window(0, 0, 23, 41),    // the whole picture
    window(3, 2, 10, 20),    // within it
    window(-5, -9, 40, 60),  // around it
    window(-5, 3, 10, 20),   // beyond the left
    window(15, 3, 20, 20),   // beyond the right
    window(3, -30, 10, 40),  // beyond the top
    window(3, 30, 10, 40),   // beyond the bottom
    window(-3, 10, 40, 4),   // a band across
    window(5, -10, 2, 90),   // a column across
    window(22, 40, 1, 1),    // the last pixel
    window(-9, -9, 10, 10),  // touches the first pixel
    window(23, 0, 9, 41),    // all beyond, beside
    window(0, -41, 23, 41),  // all beyond, above
};

}  // namespace

TEST_CASE("Pixels outside the data window are sky, and those outside the display window are cropped") {
  const auto [left, top] = GENERATE(table<int, int>({{0, 0}, {-100, 7}, {1000, -3}}));
  const auto tiled = GENERATE(false, true);
  const auto compression = GENERATE(Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION);
  const Box2i display = window(left, top, 23, 41);
  const TestFolder folder;
  PassBuffer buffer;
  for (const Box2i& shape : kData) {
    const Box2i data = {shape.min + display.min, shape.max + display.min};
    CAPTURE(left, top, tiled, compression, shape.min.x, shape.min.y, shape.max.x, shape.max.y);
    exr_forms::Part part = part_of(display, data);
    part.compression = compression;
    if (tiled) part.tiles = Imf::TileDescription(8, 5);
    exr_forms::write(folder / "f.exr", {part});
    check(folder / "f.exr", display, data, buffer);
  }
}

TEST_CASE("Tiles may be larger than the picture and its data") {
  const Box2i display = window(0, 0, 5, 4);
  const TestFolder folder;
  PassBuffer buffer;
  for (const Box2i& data : {display, window(-3, -2, 9, 9), window(2, 3, 9, 9)}) {
    exr_forms::Part part = part_of(display, data);
    part.tiles = Imf::TileDescription(64, 64);
    exr_forms::write(folder / "f.exr", {part});
    check(folder / "f.exr", display, data, buffer);
  }
}

TEST_CASE("Every part has its own data window") {
  const TestFolder folder;
  const Box2i display = window(10, 10, 6, 5);
  const Box2i depth = window(12, 9, 9, 3);
  exr_forms::Part objects = part_of(display, window(11, 11, 2, 2));
  objects.name = "objects";
  for (const char* other : {"IndexMA.X", "Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"})
    objects.channels.erase(other);
  exr_forms::Part depths = {.display = display,
                            .data = depth,
                            .channels = {{"Depth.Z", exr_forms::floats(pixels_of(depth, depth_at))}},
                            .name = "depths",
                            .tiles = Imf::TileDescription(4, 4)};
  exr_forms::write(folder / "f.exr", {objects, depths});
  const Passes passes = read_passes(folder / "f.exr", {}, {.depth = true});
  check_plane(passes.object_index, display, window(11, 11, 2, 2), index_at, 0);
  check_plane(passes.depth_m, display, depth, depth_at, 1e10F);
}

TEST_CASE("Channels for other readers have the requested value outside the data window") {
  const TestFolder folder;
  const Box2i display = window(0, 0, 3, 2);
  exr_forms::write(folder / "f.exr", {part_of(display, window(1, 1, 1, 1))});
  const ExrHeader header = read_exr_header(folder / "f.exr");
  CHECK(header.width_px == 3);
  CHECK(header.height_px == 2);
  const Plane<float> depth = read_exr_channel(folder / "f.exr", header, *header.find_depth(""), -7);
  check_plane(depth, display, window(1, 1, 1, 1), depth_at, -7);
  check_plane(read_exr_channel(folder / "f.exr", header, *header.find_depth("")), display, window(1, 1, 1, 1),
              depth_at, 0);
}

TEST_CASE("Sizes are those of the display window, and checked before pixels are read") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::write(file, {part_of(window(0, 0, 30, 20), window(0, 0, 3, 2))});
  const auto fault_of = [&](const ExrLayout& layout) {
    return message_of<Error>([&] { (void)read_passes(file, layout); });
  };
  CHECK(fault_of({.width_px = 3, .height_px = 2}) ==
        file.string() + ": size = 30 x 20 px; expected the manifest's 3 x 2 px");
  CHECK(fault_of({.width_px = 30, .height_px = 20}) == "(no fault was thrown)");
  CHECK(fault_of({.limits = {.pixels = 599}}) ==
        "cannot read " + file.string() +
            ": part 0: displayWindow = 30 x 20 px, 0.0006 megapixels; expected at most 0.000599 (see "
            "--max-megapixels)");
  CHECK(fault_of({.limits = {.pixels = 600}}) == "(no fault was thrown)");
}

}  // namespace exr_windows_test
