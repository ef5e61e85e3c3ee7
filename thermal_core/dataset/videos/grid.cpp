#include "dataset/videos/grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace thermal {
namespace {

constexpr double kWidescreen = 16.0 / 9.0;

int even_down(int size_px) { return size_px - size_px % 2; }
int even_up(int size_px) { return size_px + size_px % 2; }
int rounded_px(double size_px) { return static_cast<int>(std::lround(size_px)); }

/// Aspect ratio of a cell that holds the widest and the tallest frame.
double flattest_ratio(const std::vector<PixelSize>& frames) {
  double ratio = std::numeric_limits<double>::infinity();
  for (const PixelSize& frame : frames)
    ratio = std::min(ratio, static_cast<double>(frame.width_px) / frame.height_px);
  return ratio;
}

int rows_of(int cells, int columns) { return (cells + columns - 1) / columns; }

/// Prefers full rows among equals, to avoid empty cells.
int best_columns(int cells, double ratio) {
  const auto badness = [&](int columns) {
    const int rows = rows_of(cells, columns);
    const int holes = rows * columns - cells;
    return std::abs(std::log(ratio * columns / rows / kWidescreen)) + 0.25 * holes;
  };
  int best = 1;
  for (int columns = 2; columns <= cells; ++columns) {
    if (badness(columns) < badness(best)) best = columns;
  }
  return best;
}

/// Lengths that follow from a cell's width.
struct Measures {
  int margin_px;
  int text_px;
  int caption_px;  ///< height
  int bar_px;      ///< width including labels and the gap before it
  int gap_px;      ///< between picture and bar

  Measures(int width_px, int columns, bool bar) {
    const double cell_px = static_cast<double>(width_px) / columns;
    text_px = std::clamp(rounded_px(cell_px / 52), std::min(12, static_cast<int>(cell_px / 14)), 26);
    margin_px = text_px;
    caption_px = rounded_px(2.1 * text_px);
    gap_px = rounded_px(0.8 * text_px);
    bar_px = bar ? rounded_px(6.4 * text_px) : 0;
  }
};

/// The largest rectangle of the frame's shape in an area, centred at its top.
PixelRect fitted(const PixelSize& frame, const PixelRect& area) {
  const double scale = std::min(static_cast<double>(area.width_px) / frame.width_px,
                                static_cast<double>(area.height_px) / frame.height_px);
  const int width_px = std::max(1, rounded_px(frame.width_px * scale));
  const int height_px = std::max(1, rounded_px(frame.height_px * scale));
  return {area.x_px + (area.width_px - width_px) / 2, area.y_px, width_px, height_px};
}

GridCell cell_at(int x_px, int y_px, const PixelSize& frame, const PixelSize& area,
                 const Measures& measures) {
  GridCell cell;
  cell.picture = fitted(frame, {x_px, y_px + measures.caption_px, area.width_px, area.height_px});
  cell.caption = {x_px, y_px, area.width_px + measures.bar_px, measures.caption_px};
  if (measures.bar_px > 0)
    cell.bar = {cell.picture.right_px() + measures.gap_px, cell.picture.y_px,
                measures.bar_px - measures.gap_px, cell.picture.height_px};
  return cell;
}

}  // namespace

Grid make_grid(const GridRequest& request) {
  assert(!request.frames.empty());
  constexpr int kOneColumnPx = 1280;
  constexpr int kColumnsPx = 1920;
  constexpr int kLeastColumnPx = 160;
  const int cells = static_cast<int>(request.frames.size());
  const double ratio = flattest_ratio(request.frames);
  Grid grid;
  grid.columns = request.columns > 0 ? request.columns : best_columns(cells, ratio);
  const int usual_px = grid.columns == 1 ? kOneColumnPx : kColumnsPx;
  grid.width_px =
      even_down(std::max(request.width_px > 0 ? request.width_px : usual_px, kLeastColumnPx * grid.columns));
  const Measures measures(grid.width_px, grid.columns, request.bar);
  grid.text_px = measures.text_px;
  const int column_px = (grid.width_px - measures.margin_px) / grid.columns;  // with the margin before it
  const int picture_px = std::max(1, column_px - measures.margin_px - measures.bar_px);
  const PixelSize area{picture_px, std::max(1, rounded_px(picture_px / ratio))};
  const int top_px = request.headings ? measures.margin_px + measures.caption_px : measures.margin_px / 2;
  const int row_px = measures.caption_px + area.height_px + measures.margin_px;
  const auto left_px = [&](int column) { return measures.margin_px + column * column_px; };
  for (int k = 0; k < cells; ++k)
    grid.cells.push_back(cell_at(left_px(k % grid.columns), top_px + k / grid.columns * row_px,
                                 request.frames[static_cast<std::size_t>(k)], area, measures));
  for (int k = 0; request.headings && k < grid.columns; ++k)
    grid.headings.push_back(
        {left_px(k), measures.margin_px / 2, picture_px + measures.bar_px, measures.caption_px});
  grid.height_px = even_up(top_px + rows_of(cells, grid.columns) * row_px);
  return grid;
}

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
double TagPlacer::cost_of(const TagPosition& tag_position, const Tagged& owner,
                          const std::vector<Tagged>& tags, const std::vector<TagPosition>& placed) const {
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
