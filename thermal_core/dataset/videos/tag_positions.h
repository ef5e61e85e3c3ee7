#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "dataset/videos/grid.h"

namespace thermal {

/// A target's box in the displayed picture, and its tag.
struct Tagged {
  PixelRect box;
  PixelSize tag;
  std::int64_t track = 0;  ///< the same target in other frames
};

/// Position of a tag.
struct TagPosition {
  PixelRect tag;
  bool led = false;  ///< so far off that a leader line connects it to its box
};

/// Places tags beside boxes, inside a picture, so that they cover neither boxes nor each other if possible; a tag keeps
/// its position from frame to frame while that is free.
class TagPlacer {
 public:
  /// `picture`: bounds of tags. `gap_px`: between box and tag.
  TagPlacer(const PixelRect& picture, int gap_px) : picture_(picture), gap_px_(gap_px) {}

  /// Positions of the tags of one frame, in their order. A tag larger than the picture starts at its top left.
  [[nodiscard]] std::vector<TagPosition> place(const std::vector<Tagged>& tags);

 private:
  [[nodiscard]] TagPosition candidate(const Tagged& tagged, std::size_t number) const;
  [[nodiscard]] double cost_of(const TagPosition& tag_position, const Tagged& owner, const std::vector<Tagged>& tags,
                               const std::vector<TagPosition>& placed) const;
  [[nodiscard]] std::size_t best_for(const Tagged& owner, const std::vector<Tagged>& tags,
                                     const std::vector<TagPosition>& placed) const;

  PixelRect picture_;
  int gap_px_;
  std::map<std::int64_t, std::size_t> last_;  ///< candidate used last, by track
};

/// Area of the intersection of two rectangles.
[[nodiscard]] double overlap_px(const PixelRect& a, const PixelRect& b) noexcept;

}  // namespace thermal
