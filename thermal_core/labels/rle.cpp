#include "labels/rle.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr int kGroupBits = 5;
constexpr int kGroupMask = 0x1F;
constexpr int kSignBit = 0x10;
constexpr int kContinues = 0x20;
constexpr int kAsciiOffset = 48;

}  // namespace

std::string encode_coco_rle(const RunLengths& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    auto rest = static_cast<std::int64_t>(counts[i]);
    if (i > 2) rest -= static_cast<std::int64_t>(counts[i - 2]);
    bool more = true;
    while (more) {
      int group = static_cast<int>(rest & kGroupMask);
      rest >>= kGroupBits;
      more = (group & kSignBit) != 0 ? rest != -1 : rest != 0;
      if (more) group |= kContinues;
      text.push_back(static_cast<char>(group + kAsciiOffset));
    }
  }
  return text;
}

RunLengths decode_coco_rle(std::string_view text) {
  const auto broken = [text] {
    return DataError(fmt::format("run lengths \"{}\" are not a COCO mask", text));
  };
  RunLengths counts;
  std::size_t at = 0;
  while (at < text.size()) {
    std::int64_t value = 0;
    int shift = 0;
    int group = kContinues;
    while ((group & kContinues) != 0) {
      if (at == text.size() || shift > 30) throw broken();
      group = text[at++] - kAsciiOffset;
      if (group < 0 || group > (kGroupMask | kContinues)) throw broken();
      value |= static_cast<std::int64_t>(group & kGroupMask) << shift;
      shift += kGroupBits;
    }
    if ((group & kSignBit) != 0) value -= std::int64_t{1} << shift;
    if (counts.size() > 2) value += counts[counts.size() - 2];
    if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) throw broken();
    counts.push_back(static_cast<std::uint32_t>(value));
  }
  return counts;
}

namespace {

constexpr std::int64_t kFifths = 5;
constexpr std::int64_t kMiddle = 2;  // fifths 2 and 3 of a column are on both sides of its middle
constexpr std::int64_t kMostCrossings = 4'194'304;

struct Corner {
  std::int64_t x = 0;  // fifths of a pixel
  std::int64_t y = 0;
};

/// Cut to whole numbers towards 0, as pycocotools does.
std::int64_t nearest(double value) {
  return static_cast<std::int64_t>(value + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

/// One edge of a polygon, sampled along its longer axis.
class Edge {
 public:
  Edge(Corner from, Corner to)
      : is_wide_(std::abs(to.x - from.x) >= std::abs(to.y - from.y)),
        from_(is_wide_ ? (from.x <= to.x ? from : to) : (from.y <= to.y ? from : to)),
        to_(from_.x == from.x && from_.y == from.y ? to : from),
        steps_(is_wide_ ? to_.x - from_.x : to_.y - from_.y),
        slope_(steps_ == 0 ? 0
               : is_wide_  ? static_cast<double>(to_.y - from_.y) / static_cast<double>(steps_)
                           : static_cast<double>(to_.x - from_.x) / static_cast<double>(steps_)) {}

  /// Columns whose middle the edge may cross, as a half-open range.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> columns(int width_px) const {
    const auto [low, high] = std::minmax({point(0).x, point(steps_).x});
    return {std::max<std::int64_t>(0, (low - kMiddle + kFifths - 1) / kFifths),
            std::min<std::int64_t>(width_px, (high - kMiddle - 1 + kFifths) / kFifths)};
  }

  /// The upper of the two points beside the middle of one of these columns [fifths].
  [[nodiscard]] std::int64_t top_at(std::int64_t column) const {
    const std::int64_t left = kFifths * column + kMiddle;
    if (is_wide_) {
      const std::int64_t step = left - from_.x;
      return std::min(point(step).y, point(step + 1).y);
    }
    return from_.y + last_before(left);
  }

 private:
  [[nodiscard]] Corner point(std::int64_t step) const {
    const double along = slope_ * static_cast<double>(step);
    if (is_wide_) return {.x = from_.x + step, .y = nearest(static_cast<double>(from_.y) + along)};
    return {.x = nearest(static_cast<double>(from_.x) + along), .y = from_.y + step};
  }

  /// The last step before a steep edge crosses from `left` to the next fifth, or back.
  [[nodiscard]] std::int64_t last_before(std::int64_t left) const {
    const bool begins_left = point(0).x <= left;
    std::int64_t before = 0;
    std::int64_t after = steps_;
    while (after - before > 1) {
      const std::int64_t between = (before + after) / 2;
      ((point(between).x <= left) == begins_left ? before : after) = between;
    }
    return before;
  }

  bool is_wide_;
  Corner from_;
  Corner to_;
  std::int64_t steps_;
  double slope_;
};

/// Positions in column-major order where a polygon toggles between outside and inside, ascending. `crossings` counts
/// those of all polygons.
std::vector<std::int64_t> changes_of(const std::vector<double>& polygon, int width_px, int height_px,
                                     std::int64_t& crossings) {
  const std::size_t corners = polygon.size() / 2;
  const auto corner = [&](std::size_t i) {
    return Corner{.x = nearest(kFifths * polygon[2 * (i % corners)]),
                  .y = nearest(kFifths * polygon[2 * (i % corners) + 1])};
  };
  std::vector<std::int64_t> changes;
  for (std::size_t i = 0; i < corners; ++i) {
    const Edge edge(corner(i), corner(i + 1));
    const auto [first, end] = edge.columns(width_px);
    crossings += std::max<std::int64_t>(0, end - first);
    if (crossings > kMostCrossings)
      throw DataError("polygons cross too many columns; expected at most 4194304 crossings");
    for (std::int64_t column = first; column < end; ++column) {
      const std::int64_t row = (edge.top_at(column) - kMiddle + kFifths - 1) / kFifths;
      changes.push_back(column * height_px + std::clamp<std::int64_t>(row, 0, height_px));
    }
  }
  std::ranges::sort(changes);
  return changes;
}

using Stretch = std::pair<std::int64_t, std::int64_t>;  // first pixel inside, first one outside again

RunLengths runs_of(std::vector<Stretch> stretches, std::int64_t pixels) {
  std::ranges::sort(stretches);
  RunLengths runs;
  std::int64_t at = 0;  // end of the last run
  for (const auto& [from, end] : stretches) {
    const std::int64_t begin = std::max(from, at);
    if (end <= begin) continue;
    if (runs.empty() || begin > at) {
      runs.push_back(static_cast<std::uint32_t>(begin - at));
      runs.push_back(0);
    }
    runs.back() += static_cast<std::uint32_t>(end - begin);
    at = end;
  }
  if (at < pixels) runs.push_back(static_cast<std::uint32_t>(pixels - at));
  return runs;
}

}  // namespace

RunLengths mask_of_polygons(std::span<const std::vector<double>> polygons, int width_px, int height_px) {
  const std::int64_t pixels = std::int64_t{width_px} * height_px;
  std::vector<Stretch> stretches;
  std::int64_t crossings = 0;
  for (const std::vector<double>& polygon : polygons) {
    std::vector<std::int64_t> changes = changes_of(polygon, width_px, height_px, crossings);
    if (changes.size() % 2 == 1) changes.push_back(pixels);
    for (std::size_t i = 0; i + 1 < changes.size(); i += 2)
      stretches.emplace_back(changes[i], changes[i + 1]);
  }
  return runs_of(std::move(stretches), pixels);
}

}  // namespace thermal
