#include <limits>

#include "analysis/evaluate.h"
#include "support/catch.h"

namespace matching_test {

using namespace thermal;
using Found = std::vector<std::size_t>;

namespace {

constexpr LabelBox kBox{0, 0, 10, 10};
constexpr Target kTarget{.box = kBox};
constexpr Target kCrowd{.box = kBox, .crowd = true, .ignored = true};
constexpr Target kIgnored{.box = kBox, .ignored = true};

/// kBox moved right: its overlap with kBox is (10 - by) / (10 + by).
LabelBox moved(double by_px) { return {by_px, 0, 10, 10}; }

/// Matches of detections given by falling score.
Found found(const std::vector<LabelBox>& boxes, const std::vector<Target>& targets, double iou = 0.5) {
  std::vector<Detection> detections;
  for (const LabelBox& box : boxes) detections.push_back({0, 0, box, 0.5});
  return match({.detections = detections, .targets = targets}, iou);
}

Label label(std::size_t image, std::size_t category, bool ignore = false) {
  Label made;
  made.image = image;
  made.category = category;
  made.ignore = ignore;
  return made;
}

}  // namespace

TEST_CASE("Overlap is intersection over union") {
  CHECK(overlap(kBox, kTarget) == 1);
  CHECK(overlap(moved(5), kTarget) == 50. / 150);
  CHECK(overlap({2, 3, 4, 5}, kTarget) == 20. / 100);
  CHECK(overlap({-5, -5, 10, 10}, kTarget) == 25. / 175);
}

TEST_CASE("Overlap with a crowd is the fraction of the detection inside") {
  CHECK(overlap(moved(5), kCrowd) == 0.5);
  CHECK(overlap({2, 3, 4, 5}, kCrowd) == 1);
  CHECK(overlap({-10, 0, 40, 10}, kCrowd) == 0.25);
}

TEST_CASE("Boxes that touch, lie apart or have no area do not overlap") {
  CHECK(overlap(moved(10), kTarget) == 0);
  CHECK(overlap({0, 10, 10, 10}, kTarget) == 0);
  CHECK(overlap(moved(100), kCrowd) == 0);
  CHECK(overlap({5, 5, 0, 0}, kTarget) == 0);
  CHECK(overlap({5, 5, 0, 0}, Target{.box = {5, 5, 0, 0}}) == 0);
}

TEST_CASE("A target is matched once, by the best detection that overlaps it enough") {
  CHECK(found({kBox, kBox}, {kTarget}) == Found{0, kNoTarget});
  CHECK(found({moved(3), kBox}, {kTarget}) == Found{0, kNoTarget});  // 7 / 13, but with a higher score
  CHECK(found({moved(4), kBox}, {kTarget}) == Found{kNoTarget, 0});  // 6 / 14 is too little
  CHECK(found({moved(4)}, {kTarget}, 6. / 14) == Found{0});          // just enough
}

TEST_CASE("A detection takes the target it overlaps most; of equal ones, the last") {
  const Target right{.box = moved(2)};
  CHECK(found({moved(2), moved(2)}, {kTarget, right}) == Found{1, 0});
  CHECK(found({moved(1), moved(1)}, {kTarget, right}) == Found{1, 0});  // 9 / 11 with both
}

TEST_CASE("Targets that count take precedence over ignored ones, which are matched once") {
  CHECK(found({kBox, kBox, kBox}, {kTarget, kIgnored}) == Found{0, 1, kNoTarget});
  const Target far{.box = moved(3)};
  CHECK(found({kBox}, {far, kIgnored}) == Found{0});  // 7 / 13 that counts beats 1 that does not
}

TEST_CASE("A crowd matches any number of detections") {
  CHECK(found({kBox, moved(5), {1, 1, 2, 2}}, {kCrowd}) == Found{0, 0, 0});
  CHECK(found({moved(6)}, {kCrowd}) == Found{kNoTarget});  // 0.4 of it is inside
}

TEST_CASE("A target's own box reaches an IoU of 1, however it was rounded") {
  CHECK(found({kBox}, {kTarget}, 1) == Found{0});
  const Target rounded{.box = {0.2, 0, 0.5, 1}};  // 0.2 + 0.5 - 0.2 is 0.49999999999999994
  CHECK(overlap(rounded.box, rounded) < 1);
  CHECK(found({rounded.box}, {rounded}, 1) == Found{0});
  CHECK(found({moved(1e-6)}, {kTarget}, 1) == Found{kNoTarget});
}

TEST_CASE("Boxes whose area overflows do not match, and hide no others") {
  for (const double side_px : {1e-170, 1e200}) {
    const Target strange{.box = {0, 0, side_px, side_px}};
    CHECK(found({strange.box, kBox}, {kTarget, strange}) == Found{kNoTarget, 0});
  }
}

TEST_CASE("Without targets or detections nothing matches") {
  CHECK(found({kBox, kBox}, {}) == Found{kNoTarget, kNoTarget});
  CHECK(found({}, {kTarget}).empty());
}

TEST_CASE("EvaluationCells are sorted by category, then by the pictures' ids") {
  LabelSet truth;
  truth.categories = {{1, "human"}, {2, "elephant"}};
  truth.videos = {{"one"}};
  truth.images.resize(3);
  truth.images[0].id = 30;
  truth.images[1].id = 10;
  truth.images[2].id = 20;
  truth.labels = {label(0, 0, true), label(0, 0), label(0, 1), label(2, 0)};
  const std::vector<Detection> detections = {
      {0, 0, {}, 0.1}, {1, 1, {}, 0.2}, {0, 0, {}, 0.9}, {1, 0, {}, 0.3}, {0, 0, kBox, 0.9}};

  const EvaluationCells cells(truth, detections, false);
  std::vector<std::vector<std::size_t>> shapes;  // category, image, detections, targets
  for (const EvaluationCell& one : cells.all())
    shapes.push_back({one.category, one.image, one.detections.size(), one.targets.size()});
  CHECK(shapes == std::vector<std::vector<std::size_t>>{
                      {0, 1, 1, 0}, {0, 2, 0, 1}, {0, 0, 3, 2}, {1, 1, 1, 0}, {1, 0, 0, 1}});

  const EvaluationCell& both = cells.all()[2];
  CHECK(both.detections[0].score == 0.9);  // in the order given: the one without a box first
  CHECK(both.detections[0].box == LabelBox{});
  CHECK(both.detections[1].box == kBox);
  CHECK(both.detections[2].score == 0.1);
  CHECK(both.targets[0].label == 1);
  CHECK_FALSE(both.targets[0].ignored);
  CHECK(both.targets[1].label == 0);
  CHECK(both.targets[1].ignored);

  const EvaluationCells counted(truth, detections, true);
  CHECK(counted.all()[2].targets[0].label == 0);
  CHECK_FALSE(counted.all()[2].targets[0].ignored);
}

TEST_CASE("Crowds are ignored even if ignored targets count") {
  LabelSet truth;
  truth.images.resize(1);
  truth.labels = {label(0, 0)};
  truth.labels[0].crowd = true;
  for (const bool count_ignored : {false, true}) {
    const EvaluationCells cells(truth, {}, count_ignored);
    CHECK(cells.all()[0].targets[0].ignored);
    CHECK(cells.all()[0].targets[0].crowd);
  }
}

}  // namespace matching_test
