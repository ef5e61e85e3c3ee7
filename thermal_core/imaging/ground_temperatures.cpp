#include "imaging/ground_temperatures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "imaging/ground_noise.h"

namespace thermal {
namespace {

constexpr std::uint32_t kNoiseStream = 65;
constexpr std::size_t kGroundRowsAChunk = 16;

/// Normals of level grids of heights, by the slopes between the neighbours of a cell.
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

double share_of(std::uint8_t byte) { return byte / 255.0; }

/// The places of a window's cells.
class Cells {
 public:
  Cells(const GroundMaps& maps, const GroundWindow& window, double open_moisture, bool by_slope)
      : maps_(maps), window_(window), open_moisture_(open_moisture), by_slope_(by_slope), slopes_(maps) {}

  [[nodiscard]] std::size_t count() const noexcept { return window_.width * window_.height; }
  /// Number among the cells of the maps.
  [[nodiscard]] std::size_t of_maps(std::size_t number) const noexcept {
    return row(number) * maps_.cells + column(number);
  }
  [[nodiscard]] SurfacePlace place(std::size_t number) const {
    const std::size_t cell = of_maps(number);
    return {.normal = by_slope_ ? slopes_.normal(column(number), row(number)) : EastNorthUp{0, 0, 1},
            .sky_view = share_of(maps_.sky_view[cell]),
            .moisture = open_moisture_ + (1 - open_moisture_) * share_of(maps_.moisture[cell])};
  }

 private:
  [[nodiscard]] std::size_t column(std::size_t number) const noexcept {
    return window_.first_x + number % window_.width;
  }
  [[nodiscard]] std::size_t row(std::size_t number) const noexcept {
    return window_.first_y + number / window_.width;
  }

  const GroundMaps& maps_;
  GroundWindow window_;
  double open_moisture_;
  bool by_slope_;
  Slopes slopes_;
};

float temperature_k(const GroundMoment& moment, std::size_t cover, SurfacePlace place, std::size_t cell) {
  if (!moment.sunlit.empty()) place.sunlit = static_cast<double>(moment.sunlit[cell]);
  return static_cast<float>(moment.covers[cover]->temperature_k(place));
}

}  // namespace

GroundTemperatures::GroundTemperatures(const GroundMaps& maps, const GroundWindow& window,
                                       std::span<const CoverVariation> variations, const GroundWarmth& heat,
                                       std::uint32_t seed)
    : width_(window.width),
      height_(window.height),
      per_m_(static_cast<double>(maps.cells) / maps.size_m),
      origin_x_m_(static_cast<double>(window.first_x) / per_m_ - maps.size_m / 2),
      origin_y_m_(static_cast<double>(window.first_y) / per_m_ - maps.size_m / 2),
      crown_top_m_(window.width * window.height) {
  const Cells cells(maps, window, heat.open_moisture, heat.by_slope);
  std::vector<CoverGrid> covers;
  for (const CoverVariation& variation : variations) {
    covers.push_back(
        {.temperature_k = ground_noise(window, variation.correlation_length_m * per_m_, seed, kNoiseStream),
         .per_h_k = std::vector<float>(cells.count())});
    for (float& noise : covers.back().temperature_k) noise *= static_cast<float>(variation.stddev_k);
  }
  std::vector<float> sky_view(cells.count());
  parallel_for(height_, kGroundRowsAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * width_; i < end * width_; ++i) {
      const std::size_t cell = cells.of_maps(i);
      const SurfacePlace place = cells.place(i);
      crown_top_m_[i] = maps.height_m[cell] + maps.crown_top_m[cell];
      sky_view[i] = static_cast<float>(place.sky_view);
      for (std::size_t c = 0; c < covers.size(); ++c) {
        const float first_k = temperature_k(heat.first, c, place, cell);
        covers[c].temperature_k[i] += first_k;
        if (!(heat.hours > 0)) continue;
        const float more_k = temperature_k(heat.last, c, place, cell) - first_k;
        covers[c].temperature_k[i] += more_k / 2;
        covers[c].per_h_k[i] = more_k / static_cast<float>(heat.hours);
      }
    }
  });
  texture_ = GroundTexture({.width = width_,
                            .height = height_,
                            .cells_per_m = per_m_,
                            .origin_x_m = origin_x_m_,
                            .origin_y_m = origin_y_m_},
                           std::move(covers), std::move(sky_view));
}

float GroundTemperatures::crown_top_m(float x_m, float y_m) const noexcept {
  const auto cell_of = [this](float place_m, double origin_m, std::size_t count) {
    const double cell = (static_cast<double>(place_m) - origin_m) * per_m_;
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  if (std::isnan(x_m) || std::isnan(y_m)) return crown_top_m_.front();
  return crown_top_m_[cell_of(y_m, origin_y_m_, height_) * width_ + cell_of(x_m, origin_x_m_, width_)];
}

}  // namespace thermal
