#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace thermal {

/// A rectangle of whole pixels.
struct PixelRect {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] int right_px() const noexcept { return x_px + width_px; }
  [[nodiscard]] int bottom_px() const noexcept { return y_px + height_px; }
  [[nodiscard]] bool operator==(const PixelRect&) const = default;
};

/// Width and height of a picture.
struct PixelSize {
  int width_px = 0;
  int height_px = 0;
};

/// Request for the layout of a video.
struct GridRequest {
  std::vector<PixelSize> frames;  ///< of each clip, row by row; at least one
  int columns = 0;                ///< 0: for an aspect ratio of the whole closest to 16:9
  int width_px = 0;               ///< of the whole; 0: 1280 for one column, else 1920; at least 160 a column
  bool bar = false;               ///< a bar of temperatures beside each picture
  bool headings = false;          ///< a line of text over each column
};

/// Layout of one clip.
struct GridCell {
  PixelRect caption;  ///< over the picture
  PixelRect picture;  ///< of the frame's aspect ratio
  PixelRect bar;      ///< including its labels, to the right of the picture; empty if there is none
};

/// Layout of all clips of a video.
struct Grid {
  int width_px = 0;  ///< of the whole; both even, for video
  int height_px = 0;
  int text_px = 0;  ///< size of letters
  int columns = 0;
  std::vector<GridCell> cells;      ///< of each clip
  std::vector<PixelRect> headings;  ///< of each column; empty if there are none
};

/// Computes the layout of a video. Cells have equal sizes; a picture is as large as its shape allows.
[[nodiscard]] Grid make_grid(const GridRequest& request);

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
  [[nodiscard]] double cost_of(const TagPosition& tag_position, const Tagged& owner,
                               const std::vector<Tagged>& tags, const std::vector<TagPosition>& placed) const;
  [[nodiscard]] std::size_t best_for(const Tagged& owner, const std::vector<Tagged>& tags,
                                     const std::vector<TagPosition>& placed) const;

  PixelRect picture_;
  int gap_px_;
  std::map<std::int64_t, std::size_t> last_;  ///< candidate used last, by track
};

/// Area of the intersection of two rectangles.
[[nodiscard]] double overlap_px(const PixelRect& a, const PixelRect& b) noexcept;

}  // namespace thermal
