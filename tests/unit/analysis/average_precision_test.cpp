#include "analysis/evaluate.h"
#include "support/catch.h"

namespace average_precision_test {

using namespace thermal;

namespace {

constexpr LabelBox kBox{0, 0, 10, 10};
constexpr double kSumming = 1.2e-14;  // 101 terms are added, each sum rounded by half of 2.2e-16

Detection detection(double score, const LabelBox& box = kBox) { return {.box = box, .score = score}; }

}  // namespace

TEST_CASE("IoU thresholds are rounded as numpy rounds them") {
  // python3 -c "import numpy; print(numpy.linspace(.5, .95, 10).tolist())"
  CHECK(iou_steps() ==
        std::array<double, kIouSteps>{0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.8999999999999999, 0.95});
}

TEST_CASE("Average precision is the area under precision over recall at 101 recalls") {
  CHECK(average_precision({true}, 1) == 1);
  CHECK(average_precision({true, true, true}, 3) == 1);
  CHECK(average_precision({}, 3) == 0);
  CHECK(average_precision({false, false}, 3) == 0);
  // Precision 1, 1/2, 2/3 at recall 1/2, 1/2, 1: up to 0.5, which is 51 of the recalls, it is 1, then 2/3.
  CHECK_THAT(average_precision({true, false, true}, 2), WithinRel((51 + 50 * 2. / 3) / 101, kSumming));
  // Matched last: made non-increasing in recall, precision is 1/3 throughout.
  CHECK_THAT(average_precision({false, false, true}, 1), WithinRel(1. / 3, kSumming));
  // Recall ends at 1/4: 26 of the recalls were reached.
  CHECK_THAT(average_precision({true, false, false}, 4), WithinRel(26. / 101, kSumming));
}

TEST_CASE("A recall on a threshold is reached as numpy rounds both") {
  // 7/10 is below 70 * 0.01 = 0.7000000000000001: 70 of the recalls are reached, not 71. 3/10 is not below 30 * 0.01.
  const std::vector<bool> seven(7, true);
  CHECK(average_precision(seven, 10) == 70. / 101);
  const std::vector<bool> three(3, true);
  CHECK(average_precision(three, 10) == 31. / 101);
}

TEST_CASE("The mean over IoU steps falls with the overlap") {
  const std::vector<Target> targets = {{.box = kBox}};
  // 8 of 12: an overlap of 2/3 is enough at 0.5, 0.55, 0.6 and 0.65.
  const std::vector<Detection> detections = {detection(0.5, {2, 0, 10, 10})};
  const std::vector<EvaluationCell> cells = {{.detections = detections, .targets = targets}};
  const AveragePrecision precision = average_precision_of(cells);
  CHECK(precision.at_50 == 1);
  CHECK(precision.at_50_to_95 == 0.4);
}

TEST_CASE("Scores are ranked over all pictures; equal ones in the order of the pictures") {
  const std::vector<Target> targets = {{.box = kBox}};
  const std::vector<Detection> wrong = {detection(0.5)};
  const std::vector<Detection> right = {detection(0.5)};
  const std::vector<EvaluationCell> wrong_first = {{.detections = wrong, .targets = {}},
                                                   {.detections = right, .targets = targets}};
  const std::vector<EvaluationCell> right_first = {{.detections = right, .targets = targets},
                                                   {.detections = wrong, .targets = {}}};
  CHECK(average_precision_of(wrong_first).at_50 == 0.5);
  CHECK(average_precision_of(right_first).at_50 == 1);

  const std::vector<Detection> surer = {detection(0.6)};
  const std::vector<EvaluationCell> surest_last = {{.detections = wrong, .targets = {}},
                                                   {.detections = surer, .targets = targets}};
  CHECK(average_precision_of(surest_last).at_50 == 1);
}

TEST_CASE("The hundred detections of highest score per picture count") {
  const std::vector<Target> targets = {{.box = kBox}};
  for (const std::size_t wrong : {99U, 100U}) {
    std::vector<Detection> detections(wrong, detection(0.9, {100, 100, 5, 5}));
    detections.push_back(detection(0.8));
    const std::vector<EvaluationCell> cells = {{.detections = detections, .targets = targets}};
    CHECK_THAT(*average_precision_of(cells).at_50, WithinRel(wrong == 99 ? 0.01 : 0, kSumming));
  }
}

TEST_CASE("Ignored targets and their detections leave no trace") {
  const std::vector<Target> targets = {{.box = kBox}, {.box = {50, 50, 10, 10}, .ignored = true}};
  const std::vector<Detection> detections = {detection(0.9, {50, 50, 10, 10}), detection(0.8)};
  const std::vector<EvaluationCell> cells = {{.detections = detections, .targets = targets}};
  CHECK(average_precision_of(cells).at_50 == 1);
  CHECK(average_precision_of(cells).at_50_to_95 == 1);
}

TEST_CASE("Without targets that count there is no average precision") {
  CHECK_FALSE(average_precision_of({}).at_50);
  const std::vector<Target> targets = {{.box = kBox, .ignored = true}};
  const std::vector<Detection> detections = {detection(0.9)};
  const std::vector<EvaluationCell> cells = {{.detections = detections, .targets = targets}};
  CHECK_FALSE(average_precision_of(cells).at_50);
  CHECK_FALSE(average_precision_of(cells).at_50_to_95);
}

TEST_CASE("The mean leaves out categories without figures") {
  const std::vector<AveragePrecision> categories = {{1, 0.5}, {}, {0.5, 0.25}};
  CHECK(mean_of(categories).at_50 == 0.75);
  CHECK(mean_of(categories).at_50_to_95 == 0.375);
  CHECK_FALSE(mean_of(std::vector<AveragePrecision>(2)).at_50);
}

}  // namespace average_precision_test
