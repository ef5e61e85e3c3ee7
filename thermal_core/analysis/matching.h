#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "labels/detection.h"
#include "labels/label_set.h"

namespace thermal {

/// A target as a detection meets it.
struct Target {
  LabelBox box;
  bool crowd = false;     ///< many that no one told apart: any number of detections may find it
  bool ignored = false;   ///< found or not, it does not count; so are all crowds
  std::size_t label = 0;  ///< place in LabelSet::labels
};

/// The detections and targets of one category in one picture.
struct Encounter {
  std::size_t image = 0;
  std::size_t category = 0;
  std::span<const Detection> detections;  ///< by falling score; equal ones as they were given
  std::span<const Target> targets;        ///< those that count, then those ignored; each as in the set
};

/// All encounters of a set with detections of it, by category and, within one, by the ids of the pictures.
class Encounters {
 public:
  /// @param count_ignored  targets marked to be ignored count like others; crowds never do
  Encounters(const LabelSet& truth, std::span<const Detection> detections, bool count_ignored);
  Encounters(const Encounters&) = delete;
  Encounters& operator=(const Encounters&) = delete;

  [[nodiscard]] std::span<const Encounter> all() const noexcept { return encounters_; }

 private:
  std::vector<Detection> detections_;
  std::vector<Target> targets_;
  std::vector<Encounter> encounters_;
};

/// Intersection over union, 0..1; over the detection's own area where the target is a crowd. 0 where they only touch.
[[nodiscard]] double overlap(const LabelBox& detection, const Target& target) noexcept;

inline constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);

/// Which target each detection finds, as a place in `encounter.targets`, or kNoTarget: in turn, each takes the target
/// with the largest overlap that no one took before, at least `iou`; the last of equal ones. Targets that count go
/// first, whatever the overlap of ignored ones. These are COCO's rules (pycocotools 2.0, COCOeval), to the bit.
/// @param iou  above 0, at most 1; like COCO, an overlap of 1 - 1e-10 is enough for 1
[[nodiscard]] std::vector<std::size_t> match(const Encounter& encounter, double iou);

}  // namespace thermal
