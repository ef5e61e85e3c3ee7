#pragma once

#include "labels/instances.h"

namespace thermal {

/// Thresholds below which a target counts as occluded, and below which it is ignored.
struct LabelParameters {
  double occluded_below_visibility = 0.9;
  double ignore_below_visibility = 0;  ///< 0: disabled
  double ignore_below_area_px = 0;     ///< 0: disabled

  /// ConfigError unless visibilities are in [0, 1] and the area is finite and not negative.
  void validate() const;

  [[nodiscard]] bool operator==(const LabelParameters&) const = default;
};

/// Whether too little of a target is visible to expect a detection: its visibility, where known, or the area of its
/// mask is below its threshold.
[[nodiscard]] bool is_ignored(const Instance& instance, const LabelParameters& parameters) noexcept;

}  // namespace thermal
