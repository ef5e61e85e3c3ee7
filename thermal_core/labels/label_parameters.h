#pragma once

#include "labels/instances.h"

namespace thermal {

/// From where on a target counts as occluded, and under what it is left out of account.
struct LabelParameters {
  double occluded_below_visibility = 0.9;
  double ignore_below_visibility = 0;  ///< 0: none for that
  double ignore_below_area_px = 0;     ///< 0: none for that

  /// ConfigError unless visibilities are in [0, 1] and the area is finite and not negative.
  void validate() const;

  [[nodiscard]] bool operator==(const LabelParameters&) const = default;
};

/// Whether too little of a target is to be seen to ask a detector for it: its visibility, where that is known, or
/// the area of its mask is under its bound.
[[nodiscard]] bool is_ignored(const Instance& instance, const LabelParameters& parameters) noexcept;

}  // namespace thermal
