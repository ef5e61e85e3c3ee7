#include "analysis/compare/target_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "analysis/compare/order_statistics.h"

namespace thermal {
namespace {

constexpr double kBandM = 20;
constexpr std::array kSizesPx = {0.0, 6.0, 9.0, 12.0, 16.0, 20.0, 26.0, 40.0};

using Crops = std::vector<const TargetCrop*>;

template <typename Value>
std::vector<double> values_in(const Crops& crops, const Value& value) {
  std::vector<double> values;
  for (const TargetCrop* crop : crops) values.push_back(value(*crop));
  return values;
}

AltitudeRow altitude_row(double from_m, const Crops& crops) {
  const auto median = [&crops](auto value) { return median_of(values_in(crops, value)); };
  return {.from_m = from_m,
          .to_m = from_m + kBandM,
          .targets = crops.size(),
          .width_px = median([](const TargetCrop& crop) { return crop.box.width_px; }),
          .height_px = median([](const TargetCrop& crop) { return crop.box.height_px; }),
          .contrast = median([](const TargetCrop& crop) { return crop.contrast; }),
          .ring_deviation = median([](const TargetCrop& crop) { return crop.ring_deviation; })};
}

MarginRow margin_row(std::size_t size, const Crops& crops) {
  const auto spread = [&crops](double BoxMargins::*side) {
    const std::vector<double> values =
        values_in(crops, [side](const TargetCrop& crop) { return (*crop.margins).*side; });
    return MeanAndDeviation{mean_of(values), deviation_of(values)};
  };
  return {.from_px = kSizesPx[size],
          .to_px = size + 1 < kSizesPx.size() ? kSizesPx[size + 1] : 0,
          .targets = crops.size(),
          .left_px = spread(&BoxMargins::left_px),
          .right_px = spread(&BoxMargins::right_px),
          .top_px = spread(&BoxMargins::top_px),
          .bottom_px = spread(&BoxMargins::bottom_px)};
}

double size_of(const TargetCrop& crop, MarginsBy by) {
  if (by == MarginsBy::box) return std::max(crop.box.width_px, crop.box.height_px);
  return std::max(crop.margins->blob_width_px, crop.margins->blob_height_px);
}

}  // namespace

std::vector<AltitudeRow> targets_by_altitude(const SetFigures& set) {
  std::map<double, Crops> bands;
  for (const FrameFigures& frame : set.frames) {
    const auto altitude_m = set.source.frames[frame.frame].altitude_m;
    if (!altitude_m) continue;
    const double from_m = kBandM * std::floor((*altitude_m + 0.5 * kBandM) / kBandM) - 0.5 * kBandM;
    for (const TargetCrop& crop : frame.crops) bands[from_m].push_back(&crop);
  }
  std::vector<AltitudeRow> rows;
  for (const auto& [from_m, crops] : bands) rows.push_back(altitude_row(from_m, crops));
  return rows;
}

std::vector<MarginRow> margins_by_size(const SetFigures& set, MarginsBy by) {
  std::array<Crops, kSizesPx.size()> sizes;
  for (const FrameFigures& frame : set.frames) {
    for (const TargetCrop& crop : frame.crops) {
      if (!crop.margins) continue;
      const auto above = std::upper_bound(kSizesPx.begin(), kSizesPx.end(), size_of(crop, by));
      sizes[static_cast<std::size_t>(above - kSizesPx.begin() - 1)].push_back(&crop);
    }
  }
  std::vector<MarginRow> rows;
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    if (!sizes[size].empty()) rows.push_back(margin_row(size, sizes[size]));
  }
  return rows;
}

TargetCounts target_counts(const SetFigures& set) {
  TargetCounts counts;
  for (const FrameFigures& frame : set.frames) {
    counts.boxes += set.source.frames[frame.frame].boxes.size();
    counts.targets += frame.crops.size();
    counts.with_margins += static_cast<std::size_t>(
        std::count_if(frame.crops.begin(), frame.crops.end(),
                      [](const TargetCrop& crop) { return crop.margins.has_value(); }));
  }
  return counts;
}

}  // namespace thermal
