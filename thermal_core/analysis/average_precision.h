#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "analysis/matching.h"

namespace thermal {

/// Average precision at IoU 0.5, and the mean of those at 0.5, 0.55 … 0.95; 0..1, none where nothing counts.
struct AveragePrecision {
  std::optional<double> at_50;
  std::optional<double> at_50_to_95;
};

/// COCO's IoU thresholds, with numpy's rounding: 0.9 is 0.8999999999999999.
inline constexpr std::size_t kIouSteps = 10;
[[nodiscard]] std::array<double, kIouSteps> iou_steps() noexcept;

/// Area under the curve of precision over recall, as COCO takes it: precision made to fall with recall, its mean at
/// the recalls 0, 0.01 … 1, and 0 where recall was not reached.
/// @param found  whether each detection found a target, by falling score; those that do not count are left out
/// @param targets  how many there were to find, above 0
[[nodiscard]] double average_precision(const std::vector<bool>& found, std::size_t targets);

/// Average precision of one category as COCO takes it (pycocotools 2.0, COCOeval, boxes, all areas, the surest 100
/// detections a picture). Equal scores are ranked by the ids of their pictures, then as they were given.
/// @param encounters  all of this category, as Encounters has them
[[nodiscard]] AveragePrecision average_precision_of(std::span<const Encounter> encounters);

/// Means over categories that have figures; none where none has.
[[nodiscard]] AveragePrecision mean_of(std::span<const AveragePrecision> categories);

}  // namespace thermal
