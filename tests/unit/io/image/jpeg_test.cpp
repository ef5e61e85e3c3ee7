#include <algorithm>
#include <cmath>

#include "io/image/pictures.h"
#include "io/image/png.h"
#include "io/system/files.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace jpeg_test {

using namespace thermal;

namespace {

constexpr int kTolerance = 4;  // of JPEG at this quality, on a ramp

/// From `low` to `high`, from left to right.
template <typename Value>
Plane<Value> ramp(Value low, Value high) {
  Plane<Value> plane(128, 32);
  for (std::size_t k = 0; k < plane.size(); ++k)
    plane.pixels()[k] = static_cast<Value>(low + (high - low) * static_cast<float>(k % 128) / 127.0F);
  return plane;
}

/// Levels of the JPEG of a file in the folder.
Plane<std::uint16_t> shown(const TestFolder& folder, const char* name) {
  write_file_atomically(folder.path() / "shown.jpg", as_jpeg(folder.path() / name, 960));
  return read_grey_picture(folder.path() / "shown.jpg").levels;
}

Plane<std::uint16_t> shown_tiff(const TestFolder& folder, const auto& picture) {
  write_file_atomically(folder.path() / "picture.tif", encode_tiff(picture, {}));
  return shown(folder, "picture.tif");
}

Plane<std::uint16_t> shown_png(const TestFolder& folder, const auto& picture) {
  write_file(folder.path() / "picture.png", encode_png(picture));
  return shown(folder, "picture.png");
}

void check_is_ramp(const Plane<std::uint16_t>& levels, double first, double last) {
  for (int x = 0; x < levels.width_px(); ++x)
    CHECK(std::abs(levels.at(x, 16) - (first + (last - first) * x / 127.0)) < kTolerance);
}

}  // namespace

TEST_CASE("Grey levels of 8 bits are shown as they are") {
  const TestFolder folder;
  check_is_ramp(shown_png(folder, ramp<std::uint8_t>(40, 200)), 40, 200);
}

TEST_CASE("A picture in the place of another is shown in its own size") {
  const TestFolder folder;
  (void)shown_tiff(folder, Plane<float>(8, 6, 300.0F));
  const Plane<std::uint16_t> levels = shown_tiff(folder, ramp(281.0F, 294.0F));
  CHECK(levels.width_px() == 128);
  CHECK(levels.height_px() == 32);
}

TEST_CASE("Temperatures and counts fill the scale, whatever part of theirs they take") {
  const TestFolder folder;
  check_is_ramp(shown_tiff(folder, ramp<float>(281, 294)), 0, 255);
  check_is_ramp(shown_tiff(folder, ramp<std::uint16_t>(28100, 29400)), 0, 255);
  check_is_ramp(shown_png(folder, ramp<std::uint16_t>(28100, 29400)), 0, 255);
}

TEST_CASE("A few hot pixels, and those that are no number, leave the others their contrast") {
  const TestFolder folder;
  Plane<float> kelvin = ramp<float>(281, 294);
  kelvin.at(5, 3) = 900;
  kelvin.at(70, 4) = std::nanf("");
  check_is_ramp(shown_tiff(folder, kelvin), 0, 255);
  const Plane<std::uint16_t> flat = shown_tiff(folder, Plane<float>(64, 64, 290.0F));
  CHECK(*std::ranges::max_element(flat.pixels()) < kTolerance);
}

}  // namespace jpeg_test
