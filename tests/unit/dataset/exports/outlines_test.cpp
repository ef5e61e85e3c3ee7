#include "dataset/exports/outlines.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "dataset/exports/segments.h"
#include "labels/rle.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace outlines_test {

using namespace thermal;

namespace {

/// Rows of '#' and '.', at (10, 20) of a picture.
TargetMask mask(const std::vector<std::string>& rows) {
  TargetMask made = {.left_px = 10,
                     .top_px = 20,
                     .pixels = Plane<std::uint8_t>(static_cast<int>(rows.front().size()) + 2,
                                                   static_cast<int>(rows.size()) + 2)};
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x)
      made.pixels.at(static_cast<int>(x) + 1, static_cast<int>(y) + 1) = rows[y][x] == '#' ? 1 : 0;
  return made;
}

/// The same corners from the first of them in reading order on.
Outline ordered(Outline outline) {
  const auto first = std::ranges::min_element(outline, [](const OutlinePoint& a, const OutlinePoint& b) {
    return a.y_px < b.y_px || (a.y_px == b.y_px && a.x_px < b.x_px);
  });
  std::ranges::rotate(outline, first);
  return outline;
}

/// Twice the area that a polygon encloses; negative one way around.
double doubled_area_px(const Outline& outline) {
  double sum = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const OutlinePoint& a = outline[k];
    const OutlinePoint& b = outline[(k + 1) % outline.size()];
    sum += a.x_px * b.y_px - b.x_px * a.y_px;
  }
  return sum;
}

/// Noise in which `filled` of 8 pixels are set.
TargetMask noise(std::uint32_t seed, int width_px, int height_px, unsigned filled) {
  TargetMask made = {.left_px = 3, .top_px = 5, .pixels = Plane<std::uint8_t>(width_px, height_px)};
  std::uint32_t state = seed;
  for (int y = 1; y < height_px - 1; ++y)
    for (int x = 1; x < width_px - 1; ++x) {
      state = state * 1664525U + 1013904223U;
      made.pixels.at(x, y) = (state >> 24U) % 8 < filled ? 1 : 0;
    }
  return made;
}

}  // namespace

TEST_CASE("The outline of a pixel is its edge") {
  const std::vector<Outline> outlines = edge_outlines(mask({"#"}));
  REQUIRE(outlines.size() == 1);
  CHECK(ordered(outlines[0]) == Outline{{11, 21}, {11, 22}, {12, 22}, {12, 21}});
}

TEST_CASE("Outlines turn at corners of pixels, inner ones too") {
  const std::vector<Outline> outlines = edge_outlines(mask({"##", "#."}));
  REQUIRE(outlines.size() == 1);
  CHECK(ordered(outlines[0]) == Outline{{11, 21}, {11, 23}, {12, 23}, {12, 22}, {13, 22}, {13, 21}});
}

TEST_CASE("Pixels that touch at a corner have one outline, parts one each, the largest first") {
  const std::vector<Outline> outlines = edge_outlines(mask({"#..#", ".#..", "...#"}));
  REQUIRE(outlines.size() == 3);
  CHECK(std::abs(doubled_area_px(outlines[0])) == 4);
  CHECK(std::abs(doubled_area_px(outlines[1])) == 2);
}

TEST_CASE("A hole is cut out of its outline") {
  const TargetMask ring = mask({"####", "#..#", "####"});
  const std::vector<Outline> outlines = edge_outlines(ring);
  REQUIRE(outlines.size() == 1);
  CHECK(std::abs(doubled_area_px(outlines[0])) == 20);  // 12 - 2 px
  CHECK(edge_iou(ring, outlines) == 1);
  CHECK(filled_iou(ring, filled_outline(ring)) == 1);
}

TEST_CASE("Holes beside and above each other, and an island in one") {
  const TargetMask made = mask({"#########", "#.##..###", "###.#.#.#", "#########", "#.......#", "#.##.#..#",
                                "#.##....#", "#.......#", "#########"});
  const std::vector<Outline> outlines = edge_outlines(made);
  CHECK(outlines.size() == 3);
  CHECK(edge_iou(made, outlines) == 1);
}

TEST_CASE("Outlines of noise are their masks, to the pixel") {
  for (std::uint32_t seed = 1; seed < 60; ++seed) {
    const TargetMask made = noise(seed, 9 + static_cast<int>(seed % 30), 20, 1 + seed % 7);
    CHECK(edge_iou(made, edge_outlines(made)) == 1);
  }
}

TEST_CASE("A single outline keeps within its pixels, near their edges") {
  Outline outline = ordered(filled_outline(mask({"##"})));
  REQUIRE(outline.size() == 4);
  std::ranges::sort(outline, {}, [](const OutlinePoint& point) { return std::pair(point.x_px, point.y_px); });
  constexpr double kTolerance = 1e-12;
  CHECK(std::abs(outline[0].x_px - 11.02) < kTolerance);
  CHECK(std::abs(outline[0].y_px - 21.02) < kTolerance);
  CHECK(std::abs(outline[3].x_px - 12.98) < kTolerance);
  CHECK(std::abs(outline[3].y_px - 21.98) < kTolerance);
}

TEST_CASE("A single outline of one part is its mask when it is drawn, holes too") {
  int found = 0;
  for (std::uint32_t seed = 1; seed < 400; ++seed) {
    const TargetMask made = noise(seed, 9 + static_cast<int>(seed % 9), 12, 5 + seed % 3);
    if (edge_outlines(made).size() != 1) continue;
    ++found;
    CHECK(filled_iou(made, filled_outline(made)) == 1);
  }
  CHECK(found > 100);
}

TEST_CASE("Parts are joined by the shortest line if they are larger than it") {
  // Two pixels between 9 and 6 px: 15 of 17 px.
  const TargetMask far = mask({"###..##", "###..##", "###..##"});
  CHECK(filled_iou(far, filled_outline(far)) == 15.0 / 17);
  // Two pixels between 9 and 2 px: the small part is left out.
  const TargetMask small = mask({"###....", "###..##", "###...."});
  CHECK(filled_iou(small, filled_outline(small)) == 9.0 / 11);
}

TEST_CASE("Overlap is that of pixels") {
  const TargetMask made = mask({"##", "##"});
  const std::vector<Outline> half = {{{11, 21}, {12, 21}, {12, 23}, {11, 23}}};
  CHECK(edge_iou(made, half) == 0.5);
  CHECK(filled_iou(made, {{11.5, 21.5}, {11.5, 22.5}, {11.5, 21.5}}) == 0.5);
}

TEST_CASE("A mask is read from run lengths, compressed or not") {
  // Columns of 3 px: one of zeros, one with the two lower pixels, one with the upper.
  const RunLengths counts = {4, 3, 5};
  for (const Json& code : {Json(encode_coco_rle(counts)), Json(counts)}) {
    const TargetMask made = mask_of({{"id", 7}, {"segmentation", {{"size", {3, 4}}, {"counts", code}}}});
    CHECK(made.left_px == 0);
    CHECK(made.top_px == -1);
    CHECK(made.pixels.width_px() == 4);
    CHECK(made.pixels.height_px() == 5);
    CHECK(made.pixels.at(1, 1) == 0);
    CHECK(made.pixels.at(1, 2) == 1);
    CHECK(made.pixels.at(1, 3) == 1);
    CHECK(made.pixels.at(2, 1) == 1);
  }
}

TEST_CASE("Masks that are none are faults") {
  const std::string rule = "; expected run lengths of a mask, or polygons of three corners or more";
  const auto fault_of = [](const Json& segmentation) {
    return message_of<DataError>([&] { (void)mask_of({{"id", 7}, {"segmentation", segmentation}}); });
  };
  CHECK(fault_of(Json()) == "annotation 7: segmentation = null" + rule);
  CHECK(fault_of({{1, 2, 3, 4, 5, 6}}) == "annotation 7: segmentation = [[1,2,3,4,5,6]]" + rule);
  for (const Json& code :
       {Json({{"size", {3, 4}}, {"counts", {4, 3, 4}}}), Json({{"size", {3, 4}}, {"counts", {12}}}),
        Json({{"size", {0, 4}}, {"counts", {0}}}), Json({{"size", "3"}, {"counts", {4}}}),
        Json({{"size", {60000, 60000}}, {"counts", {1, 3599999999}}})})
    CHECK(fault_of(code) == "annotation 7: segmentation = " + code.dump() + rule);
}

TEST_CASE("One polygon keeps its corners, and several are joined at the nearest ones") {
  const Outline square = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  CHECK(joined_outline({square}, 20, 10) == square);
  const Outline joined = joined_outline({square, {{9, 2.5}, {9, 5}, {5, 4}}}, 20, 10);
  CHECK(joined == Outline{{1, 1}, {3, 1}, {3, 3}, {5, 4}, {9, 2.5}, {9, 5}, {5, 4}, {3, 3}, {1, 3}});
}

TEST_CASE("Polygons are cut to their picture") {
  CHECK(ordered(joined_outline({{{-2, -2}, {8, -2}, {8, 4}, {-2, 4}}}, 6, 10)) ==
        Outline{{0, 0}, {6, 0}, {6, 4}, {0, 4}});
  CHECK(std::abs(doubled_area_px(joined_outline({{{2, -2}, {6, 2}, {2, 6}, {-2, 2}}}, 4, 4))) == 32);
  CHECK(joined_outline({{{7, 1}, {9, 1}, {9, 3}}, {{1, 1}, {2, 1}, {2, 2}}}, 6, 10) ==
        Outline{{1, 1}, {2, 1}, {2, 2}});
  CHECK(joined_outline({{{7, 1}, {9, 1}, {9, 3}}}, 6, 10).empty());
}

TEST_CASE("Too many corners in several polygons are not compared") {
  const Outline many(5000, {1, 1});
  CHECK(joined_outline({many}, 20, 10).size() == 5000);
  CHECK(joined_outline({many, {{1, 1}, {2, 1}, {2, 2}}}, 20, 10).empty());
}

namespace {

/// A label with id "a" in a picture of 6 x 4 px.
LabelSet one_label() {
  LabelSet set;
  set.images = {{.id = 1, .file = "a.png", .width_px = 6, .height_px = 4}};
  set.labels.emplace_back().id = "a";
  return set;
}

Json annotation(const Json& segmentation) { return {{"id", "a"}, {"segmentation", segmentation}}; }

}  // namespace

TEST_CASE("Polygons become run lengths, run lengths polygons, and what is as wanted stays") {
  const Json polygon = Json::array({{1, 1, 3, 1, 3, 3, 1, 3}});
  const Json runs = {{"size", {4, 6}}, {"counts", encode_coco_rle({5, 2, 2, 2, 13})}};
  const Json listed = {{"size", {4, 6}}, {"counts", {5, 2, 2, 2, 13}}};
  SegmentMaker to_runs(one_label(), Segmentation::rle);
  CHECK(to_runs.segmentation_of(annotation(runs)) == runs);
  CHECK(to_runs.segmentation_of(annotation(listed)) == listed);
  CHECK_FALSE(to_runs.has_changed());
  CHECK(to_runs.segmentation_of(annotation(polygon)) == runs);
  CHECK(to_runs.has_changed());
  SegmentMaker to_polygons(one_label(), Segmentation::polygon);
  CHECK(to_polygons.segmentation_of(annotation(polygon)) == polygon);
  CHECK_FALSE(to_polygons.has_changed());
  CHECK(to_polygons.segmentation_of(annotation(runs)) == Json::array({{1, 1, 1, 3, 3, 3, 3, 1}}));
  CHECK(to_polygons.outline_of(annotation(polygon)) == Outline{{1, 1}, {3, 1}, {3, 3}, {1, 3}});
}

TEST_CASE("Polygons that are none are faults") {
  SegmentMaker segments(one_label(), Segmentation::rle);
  const std::string rule = "; expected run lengths of a mask, or polygons of three corners or more";
  for (const char* text : {"null", "[]", "[1,2,3,4,5,6]", "[[1,2,3,4]]", "[[1,2,3,4,5,6,7]]",
                           "[[1,2,3,4,5,null]]", "[[1,2,3,4,5,1e+300]]", "\"a\"", "{\"counts\":\"05\"}"}) {
    const Json given = annotation(parse_json(text, "text"));
    const std::string message = "annotation \"a\": segmentation = " + std::string(text) + rule;
    CHECK(message_of<DataError>([&] { (void)segments.segmentation_of(given); }) == message);
    CHECK(message_of<DataError>([&] { (void)segments.outline_of(given); }) == message);
  }
  CHECK(message_of<DataError>([&] {
          (void)segments.outline_of(annotation(Json::array({{7, 1, 9, 1, 9, 3}})));
        }) ==
        "annotation \"a\": segmentation = [[7,1,9,1,9,3]]; expected polygons inside their picture, with at "
        "most 5000 "
        "corners if there are several");
}

TEST_CASE("Figures of outlines are by size class") {
  OutlineFigures figures;
  CHECK(figures.json() == Json::object());
  figures.add(SizeClass::small, 1);
  figures.add(SizeClass::small, 0.5);
  figures.add(SizeClass::large, 0.75);
  CHECK(figures.json() == Json({{"small", {{"targets", 2}, {"mean", 0.75}, {"least", 0.5}}},
                                {"large", {{"targets", 1}, {"mean", 0.75}, {"least", 0.75}}}}));
}

}  // namespace outlines_test
