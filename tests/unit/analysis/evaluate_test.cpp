#include "analysis/evaluate.h"

#include <limits>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace evaluate_test {

using namespace thermal;

namespace {

constexpr LabelBox kSmall{0, 0, 10, 10};        // 100 px
constexpr LabelBox kMedium{100, 0, 20, 20};     // 400 px
constexpr LabelBox kLarge{200, 0, 50, 50};      // 2500 px
constexpr LabelBox kNowhere{400, 400, 10, 10};  // away from all targets; small
constexpr double kSumming = 1.2e-14;            // 101 terms are added, each sum rounded by half of 2.2e-16

enum Category : std::size_t { human, elephant };

/// Two clips of two pictures each: in every picture a small human, a medium and a large elephant.
LabelSet two_clips() {
  LabelSet truth;
  truth.categories = {{1, "human"}, {2, "elephant"}};
  truth.videos = {{"day"}, {"night"}};
  for (std::size_t i = 0; i < 4; ++i) {
    LabelImage image;
    image.id = static_cast<std::int64_t>(i + 1);
    image.video = i / 2;
    truth.images.push_back(image);
    for (const auto& [category, box] : {std::pair(human, kSmall), {elephant, kMedium}, {elephant, kLarge}}) {
      Label& label = truth.labels.emplace_back();
      label.image = i;
      label.category = category;
      label.box = box;
    }
  }
  assign_size_classes(truth);
  return truth;
}

/// The output of a perfect detector.
std::vector<Detection> answers(const LabelSet& truth) {
  std::vector<Detection> detections;
  for (const Label& label : truth.labels) detections.push_back({label.image, label.category, label.box, 0.9});
  return detections;
}

Counts small_of(const SizeCounts& counts) { return counts[0]; }
Counts medium_of(const SizeCounts& counts) { return counts[1]; }
Counts large_of(const SizeCounts& counts) { return counts[2]; }

}  // namespace

TEST_CASE("The truth as detections is found completely, and nothing else") {
  const LabelSet truth = two_clips();
  const Evaluation evaluation = evaluate(truth, answers(truth), {});
  for (const std::size_t video : {0U, 1U}) {
    const SizeCounts counts = evaluation.of_video(video);
    for (const Counts& size : counts) CHECK(size == Counts{2, 0, 0});
  }
  CHECK(total(evaluation.overall()) == Counts{12, 0, 0});
  CHECK(total(evaluation.overall()).precision() == 1);
  CHECK(total(evaluation.overall()).recall() == 1);
  CHECK(evaluation.mean_average_precision.at_50 == 1);
  CHECK(evaluation.mean_average_precision.at_50_to_95 == 1);
}

TEST_CASE("A dropped box is missed") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  detections.erase(detections.begin());  // the human of the first picture
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(small_of(evaluation.of_video(0)) == Counts{1, 0, 1});
  CHECK(small_of(evaluation.of_video(0)).recall() == 0.5);
  CHECK(small_of(evaluation.of_video(0)).precision() == 1);
  CHECK(small_of(evaluation.of_video(1)) == Counts{2, 0, 0});
  // 3 of 4 humans, all right: precision is 1 at the 76 recalls up to 0.75, and 0 past them. Elephants have 1.
  CHECK_THAT(*evaluation.average_precision[human].at_50, WithinRel(76. / 101, kSumming));
  CHECK_THAT(*evaluation.mean_average_precision.at_50_to_95, WithinRel((76. / 101 + 1) / 2, kSumming));
}

TEST_CASE("A shifted box is found up to its IoU") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  for (Detection& detection : detections) detection.box.x_px += detection.box.width_px / 4;  // IoU 3 / 5
  CHECK(total(evaluate(truth, detections, {}).overall()) == Counts{12, 0, 0});
  CHECK(total(evaluate(truth, detections, {.iou = 0.6}).overall()) == Counts{12, 0, 0});
  CHECK(total(evaluate(truth, detections, {.iou = 0.61}).overall()) == Counts{0, 12, 12});
  // Found at 0.5, 0.55 and 0.6 of the ten steps.
  CHECK(evaluate(truth, detections, {}).mean_average_precision.at_50 == 1);
  CHECK_THAT(*evaluate(truth, detections, {}).mean_average_precision.at_50_to_95, WithinRel(0.3, kSumming));
}

TEST_CASE("Of two detections on one target, only one matches") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  detections.push_back(detections[0]);
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(small_of(evaluation.of_video(0)) == Counts{2, 1, 0});
  CHECK(small_of(evaluation.of_video(0)).precision() == 2. / 3);
  // All scores are equal, so the twin, of the first picture, is the second of five: precision 1, 1/2, 2/3, 3/4, 4/5.
  // Made non-increasing in recall it is 1 at the 26 recalls up to 1/4, then 4/5.
  CHECK_THAT(*evaluation.average_precision[human].at_50, WithinRel((26 + 75 * 0.8) / 101, kSumming));
}

TEST_CASE("A detection of another category does not match") {
  const LabelSet truth = two_clips();
  const std::vector<Detection> detections = {{0, elephant, kSmall, 0.9}};
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(small_of(evaluation.of_category(elephant)) == Counts{0, 1, 0});
  CHECK(small_of(evaluation.of_category(human)) == Counts{0, 0, 4});
  CHECK(small_of(evaluation.of_video(0)) == Counts{0, 1, 2});
}

TEST_CASE("A detection in another picture does not match") {
  LabelSet truth = two_clips();
  truth.labels.erase(truth.labels.begin());
  const std::vector<Detection> detections = {{0, human, kSmall, 0.9}};
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(small_of(evaluation.of_video(0)) == Counts{0, 1, 1});
  CHECK(small_of(evaluation.of_video(1)) == Counts{0, 0, 2});
}

TEST_CASE("Matched targets have their track's size class, wrong detections that of their own box") {
  LabelSet truth = two_clips();
  for (Label& label : truth.labels) label.track_id = label.category == human ? 1 : 2;
  assign_size_classes(truth);  // elephants of 400 and 2500 px, one track: 1450 px, medium
  std::vector<Detection> detections = answers(truth);
  detections.push_back({0, elephant, kNowhere, 0.9});
  detections.push_back({0, elephant, {300, 300, 20, 10}, 0.9});  // 200 px is not below 200 px
  detections.push_back({0, elephant, {300, 300, 40, 50}, 0.9});  // 2000 px is not above 2000 px
  detections.push_back({0, elephant, {300, 300, 41, 50}, 0.9});
  const SizeCounts counts = evaluate(truth, detections, {}).of_video(0);
  CHECK(small_of(counts) == Counts{2, 1, 0});
  CHECK(medium_of(counts) == Counts{4, 2, 0});
  CHECK(large_of(counts) == Counts{0, 1, 0});
}

TEST_CASE("Detections below the score count only in average precision") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  for (Detection& detection : detections) detection.score = detection.category == human ? 0.5 : 0.49;
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(total(evaluation.of_category(human)) == Counts{4, 0, 0});
  CHECK(total(evaluation.of_category(elephant)) == Counts{0, 0, 8});
  CHECK_FALSE(total(evaluation.of_category(elephant)).precision());
  CHECK(total(evaluation.of_category(elephant)).recall() == 0);
  CHECK(evaluation.mean_average_precision.at_50 == 1);
  CHECK(total(evaluate(truth, detections, {.score = 0.49}).overall()) == Counts{12, 0, 0});
}

TEST_CASE("Scores may be any finite numbers") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  for (Detection& detection : detections) detection.score = -3;
  CHECK(total(evaluate(truth, detections, {.score = -3}).overall()) == Counts{12, 0, 0});
  for (Detection& detection : detections) detection.score = 1e300;
  CHECK(total(evaluate(truth, detections, {.score = 2}).overall()) == Counts{12, 0, 0});
}

TEST_CASE("Ignored targets and detections on them are not counted") {
  LabelSet truth = two_clips();
  truth.labels[0].ignore = true;
  const Evaluation evaluation = evaluate(truth, answers(truth), {});
  CHECK(small_of(evaluation.of_video(0)) == Counts{1, 0, 0});
  CHECK(evaluation.ignored_targets == 1);
  CHECK(evaluation.ignored_detections == 1);
  CHECK(evaluation.mean_average_precision.at_50 == 1);

  const Evaluation none_found = evaluate(truth, {}, {});
  CHECK(small_of(none_found.of_video(0)) == Counts{0, 0, 1});

  const Evaluation counted = evaluate(truth, answers(truth), {.count_ignored = true});
  CHECK(small_of(counted.of_video(0)) == Counts{2, 0, 0});
  CHECK(counted.ignored_targets == 0);
}

TEST_CASE("A second detection on an ignored target counts, one on a crowd does not") {
  LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  detections.push_back(detections[0]);
  truth.labels[0].ignore = true;
  CHECK(small_of(evaluate(truth, detections, {}).of_video(0)) == Counts{1, 1, 0});
  truth.labels[0].crowd = true;
  for (const bool count_ignored : {false, true}) {
    const Evaluation evaluation = evaluate(truth, detections, {.count_ignored = count_ignored});
    CHECK(small_of(evaluation.of_video(0)) == Counts{1, 0, 0});
    CHECK(evaluation.ignored_targets == 1);
    CHECK(evaluation.ignored_detections == 2);
  }
}

TEST_CASE("Without detections everything is missed, and precision is undefined") {
  const LabelSet truth = two_clips();
  const Evaluation evaluation = evaluate(truth, {}, {});
  CHECK(total(evaluation.overall()) == Counts{0, 0, 12});
  CHECK_FALSE(total(evaluation.overall()).precision());
  CHECK(total(evaluation.overall()).recall() == 0);
  CHECK(evaluation.mean_average_precision.at_50 == 0);
}

TEST_CASE("Without targets, recall and average precision are undefined") {
  LabelSet truth = two_clips();
  truth.labels.clear();
  const std::vector<Detection> detections = {{0, human, kSmall, 0.9}};
  const Evaluation evaluation = evaluate(truth, detections, {});
  CHECK(total(evaluation.overall()) == Counts{0, 1, 0});
  CHECK(total(evaluation.overall()).precision() == 0);
  CHECK_FALSE(total(evaluation.overall()).recall());
  CHECK_FALSE(evaluation.mean_average_precision.at_50);
}

TEST_CASE("The order of detections with different scores does not matter") {
  const LabelSet truth = two_clips();
  std::vector<Detection> detections = answers(truth);
  for (std::size_t i = 0; i < detections.size(); ++i)
    detections[i].score = 0.5 + 0.01 * static_cast<double>(i);
  detections.push_back({0, human, kNowhere, 0.77});
  const Evaluation forth = evaluate(truth, detections, {});
  std::reverse(detections.begin(), detections.end());
  const Evaluation back = evaluate(truth, detections, {});
  CHECK(forth.counts == back.counts);
  CHECK(forth.mean_average_precision.at_50_to_95 == back.mean_average_precision.at_50_to_95);
}

TEST_CASE("Options out of range are reported") {
  const auto fault_of = [](const EvaluateOptions& options) {
    return message_of<ConfigError>([&] { options.validate(); });
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of({.iou = 0}) == "--iou = 0; expected above 0 and at most 1");
  CHECK(fault_of({.iou = 1.5}) == "--iou = 1.5; expected above 0 and at most 1");
  CHECK(fault_of({.iou = kNan}) == "--iou = nan; expected above 0 and at most 1");
  CHECK(fault_of({.score = kNan}) == "--score = nan; expected a finite number");
  CHECK_NOTHROW(EvaluateOptions{.iou = 1, .score = -5}.validate());
}

}  // namespace evaluate_test
