#include "imaging/ground/temperatures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/interpolation.h"
#include "base/parallel.h"

namespace thermal {

SoilAppearance::SoilAppearance(BandRadiance soil, const BandAir& air, double air_k, bool reflects)
    : soil_(std::move(soil)), air_k_(air_k), sky_emissivity_(air.sky_emissivity()), reflects_(reflects) {}

GroundShift SoilAppearance::shift(const BandRadiance& part, double temperature_k) const {
  const double without_sky_k = apparent_k(part, temperature_k, 0);
  return {.without_sky_k = without_sky_k - temperature_k,
          .by_sky_view_k = apparent_k(part, temperature_k, 1) - without_sky_k};
}

double SoilAppearance::apparent_k(const BandRadiance& part, double temperature_k, double sky_view) const {
  double reflected_more_w_m2_sr = 0;
  if (reflects_) {
    const double received = 1 - sky_view * (1 - sky_emissivity_);
    reflected_more_w_m2_sr = (soil_.radiance(air_k_) - part.radiance(air_k_)) * received;
  }
  return soil_.temperature(part.radiance(temperature_k) + reflected_more_w_m2_sr);
}

namespace {

constexpr std::uint32_t kDampStream = 65;
constexpr double kDampLengthM = 15;
constexpr float kDampSpread = 0.02F;
constexpr std::uint32_t kFabricStream = 68;
constexpr double kFabricM = 2;
constexpr double kFinestFabricM = 0.25;
// Share of a part's variation within 2 m, set so that ground is as uneven as in night frames of HIT-UAV.
constexpr float kFabricSpread = 0.5F;
constexpr std::size_t kGroundRowsPerChunk = 16;
constexpr std::size_t kGroundCellsPerChunk = 4096;

/// Normals of grids of heights, from the slopes between a cell's neighbours.
class Slopes {
 public:
  explicit Slopes(const GroundMaps& maps)
      : maps_(maps), per_m_(static_cast<double>(maps.cells) / maps.size_m) {}

  [[nodiscard]] EastNorthUp normal(std::size_t x, std::size_t y) const {
    const std::size_t last = maps_.cells - 1;
    const double east = slope(std::min(x + 1, last), y, x == 0 ? 0 : x - 1, y);
    const double north = slope(x, std::min(y + 1, last), x, y == 0 ? 0 : y - 1);
    const double length = std::sqrt(east * east + north * north + 1);
    return {-east / length, -north / length, 1 / length};
  }

 private:
  [[nodiscard]] double slope(std::size_t x1, std::size_t y1, std::size_t x0, std::size_t y0) const {
    const auto cells = static_cast<double>(x1 - x0 + y1 - y0);
    return cells > 0 ? (height(x1, y1) - height(x0, y0)) * per_m_ / cells : 0;
  }
  [[nodiscard]] double height(std::size_t x, std::size_t y) const {
    return static_cast<double>(maps_.height_m[y * maps_.cells + x]);
  }

  const GroundMaps& maps_;
  double per_m_;
};

double part_of(std::uint8_t byte) { return byte / 255.0; }

/// Coordinates of a window's cells.
class Cells {
 public:
  Cells(const GroundMaps& maps, const GroundOfWindow& ground, double open_moisture, bool by_slope)
      : maps_(maps),
        window_(ground.maps),
        damp_(ground.damp),
        open_moisture_(open_moisture),
        by_slope_(by_slope),
        slopes_(maps) {
    if (maps.height_m.empty()) return;
    const auto [low, high] = std::ranges::minmax(maps.height_m);
    highest_m_ = high;
    per_relief_m_ = high > low ? 1 / (high - low) : 0;
  }

  [[nodiscard]] std::size_t count() const noexcept { return window_.width * window_.height; }
  /// Index among the cells of the maps.
  [[nodiscard]] std::size_t of_maps(std::size_t number) const noexcept {
    return row(number) * maps_.cells + column(number);
  }
  /// From 0 for the highest ground to 1 for the lowest.
  [[nodiscard]] double depth(std::size_t number) const {
    return static_cast<double>((highest_m_ - maps_.height_m[of_maps(number)]) * per_relief_m_);
  }
  [[nodiscard]] SurfaceExposure exposure(std::size_t number) const {
    const std::size_t cell = of_maps(number);
    const double damp = damp_.empty() ? 0 : static_cast<double>(damp_[number]);
    const double wetter = std::min(1.0, part_of(maps_.moisture[cell]) + damp);
    return {.normal = by_slope_ ? slopes_.normal(column(number), row(number)) : EastNorthUp{0, 0, 1},
            .sky_view = part_of(maps_.sky_view[cell]),
            .moisture = open_moisture_ + (1 - open_moisture_) * wetter};
  }

 private:
  [[nodiscard]] std::size_t column(std::size_t number) const noexcept {
    return window_.first_x + number % window_.width;
  }
  [[nodiscard]] std::size_t row(std::size_t number) const noexcept {
    return window_.first_y + number / window_.width;
  }

  const GroundMaps& maps_;
  const GroundWindow& window_;
  const std::vector<float>& damp_;
  double open_moisture_;
  bool by_slope_;
  Slopes slopes_;
  float highest_m_ = 0;
  float per_relief_m_ = 0;
};

/// Temperature and warming rate of one part, by the cells of the maps.
struct PartPlanes {
  std::vector<float> temperature_k;
  std::vector<float> per_h_k;
  float variation_k = 0;
};

double temperature_k(const GroundPart& part, const GroundMoment& moment, const Cells& cells,
                     SurfaceExposure exposure, std::size_t number) {
  if (!moment.sunlit.empty()) exposure.sunlit = static_cast<double>(moment.sunlit[cells.of_maps(number)]);
  const double ground_k = part.heat->temperature_k(exposure) + part.shift.without_sky_k +
                          part.shift.by_sky_view_k * exposure.sky_view;
  return moment.cold_pool_k > 0 ? ground_k - moment.cold_pool_k * cells.depth(number) : ground_k;
}

PartPlanes planes_of(std::size_t part, const Cells& cells, const GroundWarmth& heat) {
  PartPlanes planes;
  planes.variation_k = static_cast<float>(heat.first.parts[part].variation_k);
  planes.temperature_k.resize(cells.count());
  planes.per_h_k.resize(cells.count());
  parallel_for(cells.count(), kGroundCellsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SurfaceExposure exposure = cells.exposure(i);
      const double first_k = temperature_k(heat.first.parts[part], heat.first, cells, exposure, i);
      const double more_k =
          heat.hours > 0 ? temperature_k(heat.last.parts[part], heat.last, cells, exposure, i) - first_k : 0;
      planes.temperature_k[i] = static_cast<float>(first_k + more_k / 2);
      planes.per_h_k[i] = static_cast<float>(heat.hours > 0 ? more_k / heat.hours : 0);
    }
  });
  return planes;
}

/// Which parts occur in any cell.
std::vector<bool> present_parts(const std::vector<GroundMix>& mixes, std::size_t kinds) {
  std::vector<bool> present(kinds + kLoosePartNames.size());
  for (const GroundMix& mix : mixes) {
    present[mix.kind] = true;
    for (std::size_t k = 0; k < mix.share.size(); ++k)
      if (mix.share[k] > 0) present[kinds + k] = true;
  }
  return present;
}

/// Positions of rows or columns of the covers between the middles of cells of the maps, within a window of them.
std::vector<BetweenNodes> between_cells(std::size_t first_fine, std::size_t count, double coarse_a_fine,
                                        std::size_t first_coarse, std::size_t coarse_count) {
  std::vector<BetweenNodes> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double at =
        (static_cast<double>(first_fine + i) + 0.5) * coarse_a_fine - 0.5 - static_cast<double>(first_coarse);
    all.push_back(between_nodes(at, coarse_count));
  }
  return all;
}

/// The four cells of the maps around a cell of the covers, and their weights.
struct NearCells {
  std::array<std::size_t, 4> cell;
  std::array<float, 4> weight{};

  NearCells(const BetweenNodes& row, const BetweenNodes& column, std::size_t width)
      : cell{row.low * width + column.low, row.low * width + column.high, row.high * width + column.low,
             row.high * width + column.high} {
    const auto up = static_cast<float>(row.share_of_high);
    const auto right = static_cast<float>(column.share_of_high);
    weight = {(1 - up) * (1 - right), (1 - up) * right, up * (1 - right), up * right};
  }

  [[nodiscard]] float of(const std::vector<float>& plane) const noexcept {
    float sum = 0;
    for (std::size_t k = 0; k < cell.size(); ++k) sum += weight[k] * plane[cell[k]];
    return sum;
  }
};

/// The mixed temperature, warming and sky view of cells of the covers.
class Mixing {
 public:
  Mixing(const std::vector<PartPlanes>& parts, const std::vector<float>& sky_view, std::size_t kinds)
      : parts_(parts), sky_view_(sky_view), kinds_(kinds) {}

  /// Returns the standard deviation of the variation within the parts.
  float mix(const GroundMix& mix, const NearCells& near, std::size_t i, GroundValues& values) const {
    constexpr float kAll = 255;
    float temperature_k = 0;
    float per_h_k = 0;
    float variation_k = 0;
    const auto add = [&](std::size_t part, int bytes) {
      const float share = static_cast<float>(bytes) / kAll;
      temperature_k += share * near.of(parts_[part].temperature_k);
      per_h_k += share * near.of(parts_[part].per_h_k);
      variation_k += share * parts_[part].variation_k;
    };
    int left = static_cast<int>(kAll);
    for (std::size_t k = 0; k < mix.share.size(); ++k) {
      if (mix.share[k] == 0) continue;
      add(kinds_ + k, mix.share[k]);
      left -= mix.share[k];
    }
    if (left > 0) add(mix.kind, left);
    values.temperature_k[i] = temperature_k;
    values.per_h_k[i] = per_h_k;
    values.sky_view[i] = near.of(sky_view_);
    return variation_k;
  }

 private:
  const std::vector<PartPlanes>& parts_;
  const std::vector<float>& sky_view_;
  std::size_t kinds_;
};

/// Means of three neighbours along one axis, weighted 1, 2, 1; edge values are replicated.
std::vector<float> smoothed_along(const std::vector<float>& plane, std::size_t width, std::size_t step,
                                  std::size_t count) {
  std::vector<float> smooth(plane.size());
  parallel_for(plane.size(), kGroundCellsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t at = step == 1 ? i % width : i / width;
      const float before = plane[at > 0 ? i - step : i];
      const float after = plane[at + 1 < count ? i + step : i];
      smooth[i] = 0.25F * (before + 2 * plane[i] + after);
    }
  });
  return smooth;
}

/// Without smoothing, straight borders between kinds would follow the steps of their cells.
std::vector<float> smoothed(const std::vector<float>& plane, const GroundWindow& window) {
  return smoothed_along(smoothed_along(plane, window.width, 1, window.width), window.width, window.width,
                        window.height);
}

std::vector<float> sky_views(const Cells& cells) {
  std::vector<float> views(cells.count());
  for (std::size_t i = 0; i < views.size(); ++i) views[i] = static_cast<float>(cells.exposure(i).sky_view);
  return views;
}

double cells_a_m(const GroundMaps& maps) { return static_cast<double>(maps.cells) / maps.size_m; }

double covers_a_m(const GroundMaps& maps, const CutWindow& covers) {
  return static_cast<double>(covers.cuts * maps.covers.cells) / maps.size_m;
}

/// Coordinate of the south-west corner of a grid that starts at a cell.
double origin_m(const GroundMaps& maps, std::size_t first, double per_m) {
  return static_cast<double>(first) / per_m - maps.size_m / 2;
}

}  // namespace

GroundOfWindow ground_of_window(const GroundMaps& maps, const GroundWindow& window, bool rough,
                                std::uint32_t seed) {
  GroundOfWindow ground = {
      .maps = window, .covers = cut_window(maps, window), .mixes = {}, .damp = {}, .fabric = {}};
  ground.mixes = ground_mixture(maps, ground.covers, rough, seed);
  if (!rough) return ground;
  ground.damp = ground_noise(window, {.length_cells = kDampLengthM * cells_a_m(maps)}, seed, kDampStream);
  for (float& damp : ground.damp) damp = std::max(0.0F, kDampSpread * (1 + damp));
  const double fine_a_m = covers_a_m(maps, ground.covers);
  ground.fabric = ground_noise(ground.covers.cells,
                               {.length_cells = kFabricM * fine_a_m,
                                .roughness = kGroundRoughness,
                                .finest_cells = kFinestFabricM * fine_a_m},
                               seed, kFabricStream);
  return ground;
}

GroundTexture ground_temperatures(const GroundMaps& maps, const GroundOfWindow& ground,
                                  const GroundWarmth& heat) {
  const Cells cells(maps, ground, heat.open_moisture, heat.by_slope);
  const std::size_t kinds = maps.covers.kinds.size();
  const std::vector<bool> present = present_parts(ground.mixes, kinds);
  std::vector<PartPlanes> parts(present.size());
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (present[k]) parts[k] = planes_of(k, cells, heat);
  const std::vector<float> sky_view = sky_views(cells);
  const GroundWindow& fine = ground.covers.cells;
  const double fine_a_m = covers_a_m(maps, ground.covers);
  const double coarse_a_fine = cells_a_m(maps) / fine_a_m;
  const auto columns =
      between_cells(fine.first_x, fine.width, coarse_a_fine, ground.maps.first_x, ground.maps.width);
  const auto rows =
      between_cells(fine.first_y, fine.height, coarse_a_fine, ground.maps.first_y, ground.maps.height);
  GroundValues values;
  for (auto* plane : {&values.temperature_k, &values.per_h_k, &values.sky_view})
    plane->resize(fine.width * fine.height);
  std::vector<float> variation_k(fine.width * fine.height);
  const Mixing mixing(parts, sky_view, kinds);
  parallel_for(fine.height, kGroundRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * fine.width; i < end * fine.width; ++i) {
      const NearCells near(rows[i / fine.width], columns[i % fine.width], ground.maps.width);
      variation_k[i] = mixing.mix(ground.mixes[i], near, i, values);
    }
  });
  values.temperature_k = smoothed(values.temperature_k, fine);
  for (std::size_t i = 0; i < ground.fabric.size(); ++i)
    values.temperature_k[i] += kFabricSpread * variation_k[i] * ground.fabric[i];
  return {{.width = fine.width,
           .height = fine.height,
           .cells_per_m = fine_a_m,
           .origin_x_m = origin_m(maps, fine.first_x, fine_a_m),
           .origin_y_m = origin_m(maps, fine.first_y, fine_a_m)},
          std::move(values)};
}

WaterDepths::WaterDepths(const GroundMaps& maps, const GroundWindow& window)
    : width_(window.width),
      height_(window.height),
      per_m_(cells_a_m(maps)),
      origin_x_m_(origin_m(maps, window.first_x, per_m_)),
      origin_y_m_(origin_m(maps, window.first_y, per_m_)) {
  for (std::size_t row = 0; row < height_ && !maps.water_m.empty(); ++row) {
    const auto first = maps.water_m.begin() +
                       static_cast<std::ptrdiff_t>((window.first_y + row) * maps.cells + window.first_x);
    depth_m_.insert(depth_m_.end(), first, first + static_cast<std::ptrdiff_t>(width_));
  }
}

float WaterDepths::at(float x_m, float y_m) const noexcept {
  if (depth_m_.empty() || !std::isfinite(x_m) || !std::isfinite(y_m)) return 0;
  const BetweenNodes column = between_nodes((static_cast<double>(x_m) - origin_x_m_) * per_m_ - 0.5, width_);
  const BetweenNodes row = between_nodes((static_cast<double>(y_m) - origin_y_m_) * per_m_ - 0.5, height_);
  return NearCells(row, column, width_).of(depth_m_);
}

CrownTops::CrownTops(const GroundMaps& maps, const GroundWindow& window)
    : width_(window.width),
      height_(window.height),
      per_m_(cells_a_m(maps)),
      origin_x_m_(origin_m(maps, window.first_x, per_m_)),
      origin_y_m_(origin_m(maps, window.first_y, per_m_)) {
  for (std::size_t i = 0; i < width_ * height_; ++i) {
    const std::size_t cell = (window.first_y + i / width_) * maps.cells + window.first_x + i % width_;
    top_m_.push_back(maps.height_m[cell] + maps.crown_top_m[cell]);
  }
}

float CrownTops::at(float x_m, float y_m) const noexcept {
  const auto cell_of = [this](float place_m, double origin_m, std::size_t count) {
    const double cell = (static_cast<double>(place_m) - origin_m) * per_m_;
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  if (std::isnan(x_m) || std::isnan(y_m)) return top_m_.front();
  return top_m_[cell_of(y_m, origin_y_m_, height_) * width_ + cell_of(x_m, origin_x_m_, width_)];
}

}  // namespace thermal
