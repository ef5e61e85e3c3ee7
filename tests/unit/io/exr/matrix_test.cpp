/// Index planes in every form of EXR: types, compressions, scanlines and tiles, orders; values to the bit.

#include <bit>
#include <cstdint>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/passes.h"
#include "support/catch.h"
#include "support/exr_forms.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_matrix_test {

using namespace thermal;
using exr_forms::floats;
using exr_forms::halves;
using exr_forms::numbers;
using exr_forms::window;

namespace {

struct Size {
  int width_px;
  int height_px;
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
};

constexpr Size kSize = {21, 70};  // more lines than two of PIZ's chunks, and than four of ZIP's

/// Indices up to the largest, which is in the first pixel.
std::vector<float> indices(Size size, int largest, std::uint32_t step) {
  std::vector<float> pixels;
  for (std::uint32_t i = 0; i < size.pixels(); ++i)
    pixels.push_back(static_cast<float>((i * step + static_cast<std::uint32_t>(largest)) %
                                        (static_cast<std::uint32_t>(largest) + 1)));
  return pixels;
}

/// Depths and special values. PXR24 keeps 24 bits of a float, so the last 8 are zero here.
std::vector<float> depths(Size size) {
  const std::vector<std::uint32_t> special = {0x7FC00100, 0x7F800000, 0xFF800000,
                                              0x80000000, 0x00000100, 0x501502F9};
  std::vector<float> pixels;
  for (std::uint32_t i = 0; i < size.pixels(); ++i) {
    const std::uint32_t bits = i < special.size() ? special[i] : 0x42000000 + i * 0x1300;
    pixels.push_back(std::bit_cast<float>(bits & 0xFFFFFF00));
  }
  return pixels;
}

std::vector<float> slopes(Size size, std::uint32_t step) {
  std::vector<float> pixels;
  for (std::uint32_t i = 0; i < size.pixels(); ++i)
    pixels.push_back(static_cast<float>(i * step % 257) / 128 - 1);
  return pixels;  // exact in half floats: 9 significant bits
}

std::vector<std::uint32_t> bits_of(std::span<const float> pixels) {
  std::vector<std::uint32_t> bits;
  for (const float pixel : pixels) bits.push_back(std::bit_cast<std::uint32_t>(pixel));
  return bits;
}

std::vector<float> numbers_in(const Plane<std::uint16_t>& plane) {
  return {plane.pixels().begin(), plane.pixels().end()};
}

int largest_in(Imf::PixelType type) { return type == Imf::HALF ? 2048 : 32767; }

/// A frame of all planes, of mixed types.
struct Frame {
  Frame(Size px, Imf::PixelType object_type, Imf::PixelType material_type)
      : size(px),
        objects(indices(px, largest_in(object_type), 7919)),
        materials(indices(px, largest_in(material_type), 104729)),
        depth(depths(px)) {
    part.display = window(0, 0, px.width_px, px.height_px);
    part.channels = {{"Scene.IndexOB.X", numbers(object_type, objects)},
                     {"Scene.IndexMA.X", numbers(material_type, materials)},
                     {"Scene.Depth.Z", floats(depth)},
                     {"Scene.Normal.X", halves(slopes(px, 3))},
                     {"Scene.Normal.Y", halves(slopes(px, 5))},
                     {"Scene.Normal.Z", floats(slopes(px, 7))},
                     {"Scene.Combined.R", halves(slopes(px, 11))}};
  }

  void check() const {
    const TestFolder folder;
    exr_forms::write(folder / "f.exr", {part});
    const ExrLayout layout = {.width_px = size.width_px, .height_px = size.height_px};
    const Passes passes = read_passes(folder / "f.exr", layout, {.depth = true, .normals = true});
    REQUIRE(numbers_in(passes.object_index) == objects);
    REQUIRE(numbers_in(passes.material_index) == materials);
    REQUIRE(bits_of(passes.depth_m.pixels()) == bits_of(depth));
    for (const std::uint32_t axis : {0U, 1U, 2U})
      REQUIRE(bits_of(passes.normal[axis].pixels()) == bits_of(slopes(size, 3 + 2 * axis)));
  }

  Size size;
  std::vector<float> objects;
  std::vector<float> materials;
  std::vector<float> depth;
  exr_forms::Part part;
};

const Imf::TileDescription kTiles(16, 9);
const Imf::TileDescription kMipmap(16, 9, Imf::MIPMAP_LEVELS);
const Imf::TileDescription kRipmap(16, 9, Imf::RIPMAP_LEVELS, Imf::ROUND_UP);

struct Form {
  std::string name;
  std::optional<Imf::TileDescription> tiles;
  Imf::LineOrder order;
};

const std::vector<Form> kForms = {{"lines", {}, Imf::INCREASING_Y},
                                  {"lines, the last first", {}, Imf::DECREASING_Y},
                                  {"tiles", kTiles, Imf::INCREASING_Y},
                                  {"tiles, the last row first", kTiles, Imf::DECREASING_Y},
                                  {"tiles in any order", kTiles, Imf::RANDOM_Y},
                                  {"mipmap", kMipmap, Imf::INCREASING_Y},
                                  {"ripmap", kRipmap, Imf::RANDOM_Y}};

}  // namespace

TEST_CASE("Every type, lossless compression, tiling and order is read to the bit") {
  const auto compression = GENERATE(Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                    Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION);
  const auto type = GENERATE(Imf::UINT, Imf::HALF, Imf::FLOAT);
  for (const Form& form : kForms) {
    CAPTURE(compression, type, form.name);
    Frame frame(kSize, type, type == Imf::UINT ? Imf::HALF : Imf::UINT);
    frame.part.compression = compression;
    frame.part.tiles = form.tiles;
    frame.part.order = form.order;
    frame.check();
  }
}

TEST_CASE("Pictures may be as small as a pixel, a line or a column") {
  const auto [width_px, height_px] = GENERATE(table<int, int>({{1, 1}, {1, 77}, {77, 1}, {2, 1}, {1, 2}}));
  for (const Form& form : kForms) {
    CAPTURE(width_px, height_px, form.name);
    Frame frame({width_px, height_px}, Imf::FLOAT, Imf::UINT);
    frame.part.tiles = form.tiles;
    frame.part.order = form.order;
    frame.check();
  }
}

TEST_CASE("Pictures may be of 3840 x 3072 pixels") {
  // Bands, which make a small file: this tests indices, not disks.
  constexpr Size kLarge = {3840, 3072};
  std::vector<float> bands;
  for (std::size_t i = 0; i < kLarge.pixels(); ++i) bands.push_back(static_cast<float>(i / 1000));
  const TestFolder folder;
  exr_forms::write(folder / "f.exr", {{.display = window(0, 0, kLarge.width_px, kLarge.height_px),
                                       .channels = {{"IndexOB.X", floats(bands)}},
                                       .compression = Imf::RLE_COMPRESSION}});
  CHECK((numbers_in(read_passes(folder / "f.exr", {}).object_index) == bands));  // millions are not printed
}

TEST_CASE("PXR24 keeps every index that a float can hold") {
  // It rounds floats to 15 bits after the leading one, so whole numbers up to 2^16 are kept. Indices end at 32767 <
  // 2^15.
  constexpr Size kAll = {256, 128};
  Frame frame(kAll, Imf::FLOAT, Imf::FLOAT);
  frame.part.compression = Imf::PXR24_COMPRESSION;
  CHECK(std::set<float>(frame.objects.begin(), frame.objects.end()).size() == 32768);
  frame.check();
}

TEST_CASE("Any of any number of channels is read, whatever the others are") {
  const auto count = GENERATE(1, 2, 3, 4, 5);
  const auto type = GENERATE(Imf::UINT, Imf::HALF, Imf::FLOAT);
  const auto others = GENERATE(Imf::UINT, Imf::HALF, Imf::FLOAT);
  const TestFolder folder;
  for (int wanted = 0; wanted < count; ++wanted) {
    CAPTURE(count, wanted, type, others);
    exr_forms::Part part = {.display = window(0, 0, kSize.width_px, kSize.height_px)};
    for (int i = 0; i < count; ++i) {
      const std::string name =
          i == wanted ? "S.IndexOB.X" : fmt::format("S.{}{}", i < wanted ? "before" : "later", i);
      part.channels[name] = numbers(i == wanted ? type : others, indices(kSize, 100 + i, 7));
    }
    exr_forms::write(folder / "f.exr", {part});
    REQUIRE(numbers_in(read_passes(folder / "f.exr", {}).object_index) == indices(kSize, 100 + wanted, 7));
  }
}

namespace {

/// What is wrong with a file of one index plane of two pixels.
std::string fault_of(const exr_forms::Stored& plane, Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::write(
      file,
      {{.display = window(0, 0, 2, 1), .channels = {{"IndexOB.X", plane}}, .compression = compression}});
  const std::string message = message_of<DataError>([&] { (void)read_passes(file, {}); });
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

}  // namespace

TEST_CASE("Whole numbers that are not indices are reported exactly, above 2^24 too") {
  const std::string rule = "; expected a whole number from 0 to 32767";
  for (const std::uint32_t number : {32768U, 65536U, 16777217U, 4294967295U}) {
    CHECK(fault_of(exr_forms::wholes({0, number})) ==
          "IndexOB.X at pixel (1, 0) = " + std::to_string(number) + rule);
  }
  CHECK(fault_of(exr_forms::wholes({0, 32767})) == "(no fault was thrown)");
}

TEST_CASE("Half floats hold indices up to 2048, and larger ones are errors") {
  const std::string rule = "; expected a whole number from 0 to 2048, up to which half floats are exact";
  CHECK(fault_of(halves({0, 2048})) == "(no fault was thrown)");
  CHECK(fault_of(halves({0, 2050})) == "IndexOB.X at pixel (1, 0) = 2050" + rule);
  CHECK(fault_of(halves({0, 65504})) == "IndexOB.X at pixel (1, 0) = 65504" + rule);
  CHECK(fault_of(halves({-1, 0})) == "IndexOB.X at pixel (0, 0) = -1" + rule);
  CHECK(fault_of(halves({0.5F, 0})) == "IndexOB.X at pixel (0, 0) = 0.5" + rule);
  CHECK(fault_of(floats({0, 2050})) == "(no fault was thrown)");
}

TEST_CASE("Index planes with a lossy compression are refused, whatever their pixels are") {
  const auto [compression, name] =
      GENERATE(table<Imf::Compression, std::string>({{Imf::B44_COMPRESSION, "B44"},
                                                     {Imf::B44A_COMPRESSION, "B44A"},
                                                     {Imf::DWAA_COMPRESSION, "DWAA"},
                                                     {Imf::DWAB_COMPRESSION, "DWAB"}}));
  const auto type = GENERATE(Imf::UINT, Imf::HALF, Imf::FLOAT);
  CHECK(fault_of(numbers(type, {0, 1}), compression) ==
        "IndexOB.X: compression = " + name +
            "; expected a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others change indices");
}

TEST_CASE("Depth and normals may have a lossy compression") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  const Imath::Box2i box = window(0, 0, 40, 40);
  const std::vector<float> flat(1600, 0.5F);
  const auto compression =
      GENERATE(Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION);
  exr_forms::write(file, {{.display = box, .channels = {{"IndexOB.X", floats(flat)}}, .name = "a"},
                          {.display = box,
                           .channels = {{"Depth.Z", halves(flat)},
                                        {"N.X", halves(flat)},
                                        {"N.Y", halves(flat)},
                                        {"N.Z", halves(flat)}},
                           .name = "b",
                           .compression = compression}});
  CHECK(message_of<DataError>([&] { (void)read_passes(file, {}, {.depth = true, .normals = true}); }) ==
        file.string() + ": a.IndexOB.X at pixel (0, 0) = 0.5; expected a whole number from 0 to 32767");
}

}  // namespace exr_matrix_test
