#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/label_set.h"
#include "labels/rle.h"

namespace thermal {

/// Whole pixels [x, x + width) x [y, y + height), 0-based from the top left.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] bool operator==(const PixelBox&) const = default;
};

/// One actor in one frame: the exact set of pixels that carry its index, and what else is known about it.
struct Instance {
  std::uint16_t index = 0;
  PixelBox box;               ///< bounding box of its pixels
  std::uint32_t area_px = 0;  ///< number of its pixels
  bool truncated = false;  ///< touches the border of the frame, including hidden parts where those are known
  RunLengths mask;         ///< over the whole frame, column-major
  std::optional<double> covered_px = {};          ///< supersampled frames: its area in finer pixels
  std::optional<double> visibility = {};          ///< fraction of it not hidden by plants or ground
  std::optional<LabelBox> whole_box = {};         ///< including hidden parts and what lies beyond the border
  std::optional<double> truncated_fraction = {};  ///< fraction of whole_box beyond the border
  std::optional<double> range_m = {};
  std::optional<double> temperature_k = {};   ///< apparent, of its mean radiance
  std::optional<double> contrast_k = {};      ///< the same, minus that of its surroundings
  std::optional<double> contrast_noise = {};  ///< difference of their radiances / noise of a pixel
};

/// A set of indices.
class IndexSet {
 public:
  explicit IndexSet(std::span<const std::uint16_t> indices = {});
  [[nodiscard]] bool contains(std::uint16_t index) const noexcept { return contains_[index]; }

 private:
  std::vector<bool> contains_;
};

/// Where an index first occurs, in row-major order, and how often.
struct IndexUse {
  std::uint16_t index = 0;
  int first_x_px = 0;
  int first_y_px = 0;
  std::uint32_t pixels = 0;
  PixelBox box;
};

/// Every index of a plane with its extent, in ascending order, in one pass over the plane. DataError with the first pixel
/// whose index exceeds kLargestIndex.
[[nodiscard]] std::vector<IndexUse> survey_indices(const Plane<std::uint16_t>& index_plane);

/// The use of an index in a survey; null if absent.
[[nodiscard]] const IndexUse* find_use(std::span<const IndexUse> uses, std::uint16_t index) noexcept;

/// The actors among `uses`, in that order, with their masks. Pixels outside an actor's box are not read again, so the
/// cost is one pass over the plane plus the actors' boxes.
[[nodiscard]] std::vector<Instance> extract_instances(const Plane<std::uint16_t>& index_plane,
                                                      std::span<const IndexUse> uses, const IndexSet& actors);

/// Whether a box touches the border of a frame.
[[nodiscard]] bool touches_border(const PixelBox& box, int width_px, int height_px) noexcept;

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
