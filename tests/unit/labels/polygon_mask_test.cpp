#include <sstream>
#include <string>

#include "base/error.h"
#include "labels/rle.h"
#include "support/catch.h"
#include "support/golden.h"
#include "support/message_of.h"

namespace polygon_mask_test {

using namespace thermal;

namespace {

using Polygons = std::vector<std::vector<double>>;

/// "1 2 3 4 5 6;7 8 …".
Polygons polygons_in(const std::string& text) {
  Polygons polygons;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) {
    std::istringstream numbers(part);
    std::vector<double>& polygon = polygons.emplace_back();
    for (double number = 0; numbers >> number;) polygon.push_back(number);
  }
  return polygons;
}

}  // namespace

TEST_CASE("Masks of polygons are those of pycocotools, to the pixel") {
  const std::vector<GoldenRow> rows = read_golden("polygon_masks.csv");
  REQUIRE(rows.size() == 82);
  for (const GoldenRow& row : rows) {
    CAPTURE(row.texts[2]);
    const int width_px = static_cast<int>(row.numbers[0]);
    const int height_px = static_cast<int>(row.numbers[1]);
    CHECK(encode_coco_rle(mask_of_polygons(polygons_in(row.texts[2]), width_px, height_px)) == row.texts[3]);
  }
}

TEST_CASE("A polygon far outside of its picture costs no more than the picture") {
  const Polygons large = {{-1e8, -1e8, 1e8, -1e8, 1e8, 1e8, -1e8, 1e8}};
  CHECK(mask_of_polygons(large, 3, 2) == RunLengths{0, 6});
  CHECK(mask_of_polygons({}, 3, 2) == RunLengths{6});
}

TEST_CASE("Borders that cross columns without end are refused") {
  constexpr int kWidthPx = 8192;
  std::vector<double> zigzag;
  for (int i = 0; i <= 513; ++i) zigzag.insert(zigzag.end(), {i % 2 == 0 ? 0.0 : kWidthPx, 1.0 * i});
  CHECK(message_of<DataError>([&] { (void)mask_of_polygons(Polygons{zigzag}, kWidthPx, 4); }) ==
        "polygons cross too many columns; expected at most 4194304 crossings");
}

}  // namespace polygon_mask_test
