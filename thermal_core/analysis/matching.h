#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "labels/detection.h"
#include "labels/label_set.h"

namespace thermal {

/// A target, as used by matching.
struct Target {
  LabelBox box;
  bool crowd = false;     ///< a group without separate boxes: any number of detections may match it
  bool ignored = false;   ///< a match or a miss does not count; true for all crowds
  std::size_t label = 0;  ///< index into LabelSet::labels
};

/// The detections and targets of one category in one picture.
struct EvaluationCell {
  std::size_t image = 0;
  std::size_t category = 0;
  std::span<const Detection> detections;  ///< by falling score; equal scores in the order given
  std::span<const Target> targets;  ///< those that count, then ignored ones; each in the order of the set
};

/// All cells of a set with its detections, by category and, within one, by the ids of the pictures.
class EvaluationCells {
 public:
  /// @param count_ignored  targets marked as ignored count like others; crowds never do
  EvaluationCells(const LabelSet& truth, std::span<const Detection> detections, bool count_ignored);
  EvaluationCells(const EvaluationCells&) = delete;
  EvaluationCells& operator=(const EvaluationCells&) = delete;

  [[nodiscard]] std::span<const EvaluationCell> all() const noexcept { return cells_; }

 private:
  std::vector<Detection> detections_;
  std::vector<Target> targets_;
  std::vector<EvaluationCell> cells_;
};

/// Intersection over union, 0..1; over the detection's own area if the target is a crowd. 0 if boxes only touch.
[[nodiscard]] double overlap(const LabelBox& detection, const Target& target) noexcept;

/// The index of a detection that matches no target.
inline constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);

/// Which target each detection matches, as an index into `cell.targets`, or kNoTarget: in order, each takes the
/// unmatched target of largest overlap, at least `iou`; the last of equal ones. Targets that count take precedence over
/// ignored ones, regardless of overlap. These are COCO's rules (pycocotools 2.0, COCOeval), to the bit.
/// @param iou  above 0, at most 1; like COCO, accepts an overlap of 1 - 1e-10 as 1
[[nodiscard]] std::vector<std::size_t> match(const EvaluationCell& cell, double iou);

}  // namespace thermal
