#include "dataset/videos/grid.h"

#include <algorithm>
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

}  // namespace thermal
