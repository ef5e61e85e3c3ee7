#include "dataset/videos/tag_positions.h"

#include <algorithm>
#include <array>

namespace thermal {
namespace {

/// A candidate position of a tag relative to its box: the point of the tag, as a share of its size, that coincides with
/// a point of the box, and an offset in tag heights.
struct Position {
  double of_tag_x, of_tag_y;
  double of_box_x, of_box_y;
  double away_x, away_y;
};

/// In order of preference.
constexpr std::array<Position, 16> kPositions = {{
    {0, 1, 0, 0, 0, 0},         // above, left edges in line
    {1, 1, 1, 0, 0, 0},         // above, right edges in line
    {0, 0, 0, 1, 0, 0},         // below
    {1, 0, 1, 1, 0, 0},         //
    {0, 0.5, 1, 0.5, 0, 0},     // to the right
    {1, 0.5, 0, 0.5, 0, 0},     // to the left
    {0, 1, 1, 0, 0.8, -0.8},    // off the corners, with a leader line
    {1, 1, 0, 0, -0.8, -0.8},   //
    {0, 0, 1, 1, 0.8, 0.8},     //
    {1, 0, 0, 1, -0.8, 0.8},    //
    {0.5, 1, 0.5, 0, 0, -2.2},  // well above, well below
    {0.5, 0, 0.5, 1, 0, 2.2},   //
    {0, 1, 1, 0, 2, -2},        // far off the corners
    {1, 1, 0, 0, -2, -2},       //
    {0, 0, 1, 1, 2, 2},         //
    {1, 0, 0, 1, -2, 2},        //
}};
constexpr std::size_t kFirstLed = 6;

int moved(int start_px, int length_px, double of_box, double of_tag, int tag_px, double away_px) {
  return static_cast<int>(start_px + of_box * length_px - of_tag * tag_px + away_px);
}

/// Clamped into the picture.
int kept_inside(int start_px, int length_px, int from_px, int to_px) {
  return std::max(from_px, std::min(start_px, to_px - length_px));
}

}  // namespace

double overlap_px(const PixelRect& a, const PixelRect& b) noexcept {
  const int width = std::min(a.right_px(), b.right_px()) - std::max(a.x_px, b.x_px);
  const int height = std::min(a.bottom_px(), b.bottom_px()) - std::max(a.y_px, b.y_px);
  return width > 0 && height > 0 ? static_cast<double>(width) * height : 0;
}

TagPosition TagPlacer::candidate(const Tagged& tagged, std::size_t number) const {
  const Position& position = kPositions[number];
  const PixelRect box{tagged.box.x_px - gap_px_, tagged.box.y_px - gap_px_, tagged.box.width_px + 2 * gap_px_,
                      tagged.box.height_px + 2 * gap_px_};
  const PixelSize& tag = tagged.tag;
  const int x_px = moved(box.x_px, box.width_px, position.of_box_x, position.of_tag_x, tag.width_px,
                         position.away_x * tag.height_px);
  const int y_px = moved(box.y_px, box.height_px, position.of_box_y, position.of_tag_y, tag.height_px,
                         position.away_y * tag.height_px);
  return {.tag = {kept_inside(x_px, tag.width_px, picture_.x_px, picture_.right_px()),
                  kept_inside(y_px, tag.height_px, picture_.y_px, picture_.bottom_px()), tag.width_px,
                  tag.height_px},
          .led = number >= kFirstLed};
}

/// Weighted share of the tag that covers the target itself, other tags and other targets.
double TagPlacer::cost_of(const TagPosition& tag_position, const Tagged& owner, const std::vector<Tagged>& tags,
                          const std::vector<TagPosition>& placed) const {
  constexpr double kOwnBox = 8;
  constexpr double kTag = 6;
  constexpr double kOtherBox = 4;
  double covered = 0;
  for (const Tagged& other : tags)
    covered += (&other == &owner ? kOwnBox : kOtherBox) * overlap_px(tag_position.tag, other.box);
  for (const TagPosition& other : placed) covered += kTag * overlap_px(tag_position.tag, other.tag);
  return covered / std::max(1, tag_position.tag.width_px * tag_position.tag.height_px);
}

std::size_t TagPlacer::best_for(const Tagged& owner, const std::vector<Tagged>& tags,
                                const std::vector<TagPosition>& placed) const {
  constexpr double kStep = 0.02;  // earlier candidates are preferred
  constexpr double kMoving = 0.3;
  constexpr double kLed = 0.2;
  const auto last = last_.find(owner.track);
  std::size_t best = 0;
  double least = 0;
  for (std::size_t k = 0; k < kPositions.size(); ++k) {
    double cost = cost_of(candidate(owner, k), owner, tags, placed) + kStep * static_cast<double>(k);
    if (k >= kFirstLed) cost += kLed;
    if (last != last_.end() && last->second != k) cost += kMoving;
    if (k == 0 || cost < least) {
      best = k;
      least = cost;
    }
  }
  return best;
}

std::vector<TagPosition> TagPlacer::place(const std::vector<Tagged>& tags) {
  std::vector<TagPosition> placed;
  std::map<std::int64_t, std::size_t> chosen;
  for (const Tagged& tagged : tags) {
    const std::size_t number = best_for(tagged, tags, placed);
    placed.push_back(candidate(tagged, number));
    chosen[tagged.track] = number;
  }
  last_ = std::move(chosen);
  return placed;
}

}  // namespace thermal
