#include "labels/instances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Extents of the indices found so far, and for each possible index its position among them: planes hold few of the
/// possible indices, and this is reset for every frame.
class Survey {
 public:
  Survey() : places_(kIndexValues, kNone) {}

  /// Counts a run of equal indices, columns [begin, end) of row y; rows must come in order.
  void add_run(std::uint16_t index, int begin, int end, int y) {
    if (places_[index] == kNone) {
      if (index > kLargestIndex) refuse(index, begin, y);
      places_[index] = static_cast<std::uint16_t>(uses_.size());
      uses_.push_back({.index = index, .first_x_px = begin, .first_y_px = y, .box = {begin, y, 0, 0}});
    }
    IndexUse& use = uses_[places_[index]];
    const int right = std::max(use.box.x_px + use.box.width_px, end);
    use.pixels += static_cast<std::uint32_t>(end - begin);
    use.box.x_px = std::min(use.box.x_px, begin);
    use.box.width_px = right - use.box.x_px;
    use.box.height_px = y - use.box.y_px + 1;
  }

  /// By ascending index.
  std::vector<IndexUse> finish() && {
    std::sort(uses_.begin(), uses_.end(),
              [](const IndexUse& a, const IndexUse& b) { return a.index < b.index; });
    return std::move(uses_);
  }

 private:
  [[noreturn]] static void refuse(std::uint16_t index, int x, int y) {
    throw DataError(fault(fmt::format("index at pixel ({}, {})", x, y), fmt::format("{}", index), "",
                          fmt::format("a whole number from 0 to {}", kLargestIndex)));
  }

  static constexpr std::uint16_t kNone = 0xFFFF;
  std::vector<std::uint16_t> places_;
  std::vector<IndexUse> uses_;
};

/// The end of the run of equal pixels that starts at `begin`; compares four pixels at a time.
std::size_t run_end(std::span<const std::uint16_t> row, std::size_t begin) noexcept {
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t) / sizeof(std::uint16_t);
  constexpr std::uint64_t kOnes = 0x0001000100010001;
  const std::uint64_t four = kOnes * row[begin];
  std::size_t end = begin + 1;
  while (end + kAtOnce <= row.size()) {
    std::uint64_t next = 0;
    std::memcpy(&next, &row[end], sizeof next);
    if (next != four) break;
    end += kAtOnce;
  }
  while (end < row.size() && row[end] == row[begin]) ++end;
  return end;
}

/// Column-major run lengths of the pixels with this index; all of them are inside `box`.
RunLengths mask_of(const Plane<std::uint16_t>& plane, std::uint16_t index, const PixelBox& box) {
  RunLengths counts;
  const auto height = static_cast<std::size_t>(plane.height_px());
  std::size_t run_begin = 0;
  bool inside = false;
  for (int x = box.x_px; x < box.x_px + box.width_px; ++x) {
    for (int y = box.y_px; y <= box.y_px + box.height_px; ++y) {
      // A column's run ends one row below the box, unless the box is as high as the frame: then the run continues into
      // the next column.
      const bool past = y == box.y_px + box.height_px;
      if (past && box.height_px == plane.height_px()) break;
      const bool set = !past && plane.at(x, y) == index;
      if (set == inside) continue;
      const std::size_t here = static_cast<std::size_t>(x) * height + static_cast<std::size_t>(y);
      counts.push_back(static_cast<std::uint32_t>(here - run_begin));
      run_begin = here;
      inside = set;
    }
  }
  if (inside) {  // the last column's run ends at the bottom of the frame
    const std::size_t end = static_cast<std::size_t>(box.x_px + box.width_px) * height;
    counts.push_back(static_cast<std::uint32_t>(end - run_begin));
    run_begin = end;
  }
  const auto rest = static_cast<std::uint32_t>(plane.size() - run_begin);
  if (rest > 0) counts.push_back(rest);
  return counts;
}

}  // namespace

IndexSet::IndexSet(std::span<const std::uint16_t> indices) : contains_(kIndexValues) {
  for (const std::uint16_t index : indices) contains_[index] = true;
}

std::vector<IndexUse> survey_indices(const Plane<std::uint16_t>& index_plane) {
  Survey survey;
  for (int y = 0; y < index_plane.height_px(); ++y) {
    const auto row = index_plane.row(y);
    for (std::size_t begin = 0; begin < row.size();) {
      const std::size_t end = run_end(row, begin);
      survey.add_run(row[begin], static_cast<int>(begin), static_cast<int>(end), y);
      begin = end;
    }
  }
  return std::move(survey).finish();
}

const IndexUse* find_use(std::span<const IndexUse> uses, std::uint16_t index) noexcept {
  const auto found =
      std::lower_bound(uses.begin(), uses.end(), index,
                       [](const IndexUse& use, std::uint16_t wanted) { return use.index < wanted; });
  return found != uses.end() && found->index == index ? &*found : nullptr;
}

std::vector<Instance> extract_instances(const Plane<std::uint16_t>& index_plane,
                                        std::span<const IndexUse> uses, const IndexSet& actors) {
  std::vector<Instance> instances;
  for (const IndexUse& use : uses) {
    if (!actors.contains(use.index)) continue;
    Instance instance;
    instance.index = use.index;
    instance.box = use.box;
    instance.area_px = use.pixels;
    instance.truncated = touches_border(use.box, index_plane.width_px(), index_plane.height_px());
    instance.mask = mask_of(index_plane, use.index, use.box);
    instances.push_back(std::move(instance));
  }
  return instances;
}

bool touches_border(const PixelBox& box, int width_px, int height_px) noexcept {
  return box.x_px == 0 || box.y_px == 0 || box.x_px + box.width_px == width_px ||
         box.y_px + box.height_px == height_px;
}

namespace {

void check_share(const char* where, double value) {
  if (value >= 0 && value <= 1) return;
  throw ConfigError(fault(where, fmt::format("{}", value), "", "0 to 1"));
}

}  // namespace

void LabelParameters::validate() const {
  check_share("labels.occluded_below_visibility", occluded_below_visibility);
  check_share("labels.ignore_below_visibility", ignore_below_visibility);
  if (ignore_below_area_px >= 0 && std::isfinite(ignore_below_area_px)) return;
  throw ConfigError(
      fault("labels.ignore_below_area_px", fmt::format("{}", ignore_below_area_px), "px", "0 or more"));
}

bool is_ignored(const Instance& instance, const LabelParameters& parameters) noexcept {
  if (instance.visibility && *instance.visibility < parameters.ignore_below_visibility) return true;
  return static_cast<double>(instance.area_px) < parameters.ignore_below_area_px;
}

}  // namespace thermal
