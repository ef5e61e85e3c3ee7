#include "dataset/reports/heat.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace thermal {
namespace {

/// A grid of cells over pictures of any size.
class Heat {
 public:
  explicit Heat(double height_to_width)
      : rows_(std::clamp(static_cast<int>(std::lround(kColumns * height_to_width)), 1, 4 * kColumns)),
        covered_(static_cast<std::size_t>(kColumns * rows_)) {}

  /// Adds to each cell the fraction of it that a box covers.
  void add(const LabelBox& box, const LabelImage& image) {
    const double to_columns = 1.0 * kColumns / image.width_px;
    const double to_rows = 1.0 * rows_ / image.height_px;
    const double left = box.x_px * to_columns;
    const double right = left + box.width_px * to_columns;
    const double top = box.y_px * to_rows;
    const double bottom = top + box.height_px * to_rows;
    for (int row = first(top); row < last(bottom, rows_); ++row) {
      for (int column = first(left); column < last(right, kColumns); ++column) {
        covered_[static_cast<std::size_t>(row * kColumns + column)] +=
            overlap(column, left, right) * overlap(row, top, bottom);
      }
    }
  }

  /// Mean over this many pictures.
  [[nodiscard]] Json json(std::size_t pictures) const {
    std::vector<double> mean;
    constexpr double kDigits = 1e5;
    for (const double sum : covered_)
      mean.push_back(std::round(kDigits * sum / static_cast<double>(pictures)) / kDigits);
    return {{"columns", kColumns}, {"rows", rows_}, {"boxes_over", mean}};
  }

 private:
  static constexpr int kColumns = 40;
  static int first(double edge) { return std::max(0, static_cast<int>(std::floor(edge))); }
  static int last(double edge, int count) { return std::min(count, static_cast<int>(std::ceil(edge))); }
  static double overlap(int cell, double low, double high) {
    return std::max(0.0, std::min(high, cell + 1.0) - std::max(low, 1.0 * cell));
  }

  int rows_;
  std::vector<double> covered_;
};

}  // namespace

Json heat_of(const LabelSet& set) {
  const auto has_size = [](const LabelImage& image) { return image.width_px > 0 && image.height_px > 0; };
  const auto sized = std::find_if(set.images.begin(), set.images.end(), has_size);
  if (sized == set.images.end()) return Json::object();
  Heat heat(1.0 * sized->height_px / sized->width_px);
  for (const Label& label : set.labels) {
    if (const LabelImage& image = set.images[label.image]; has_size(image)) heat.add(label.box, image);
  }
  return heat.json(static_cast<std::size_t>(std::count_if(set.images.begin(), set.images.end(), has_size)));
}

}  // namespace thermal
