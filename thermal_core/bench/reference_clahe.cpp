#include "bench/reference_clahe.h"

#include <algorithm>
#include <cmath>

#include "bench/sensor_scene.h"

namespace thermal {
namespace {

constexpr double kTileBinK = 0.04;
constexpr std::size_t kTileBins = 16384;
constexpr double kTileWhite = 255;

/// Position of a pixel among the centres of tiles.
double tile_place(int at_px, int size_px, int tiles) {
  return std::clamp((at_px + 0.5) * tiles / size_px - 0.5, 0.0, tiles - 1.0);
}

}  // namespace

ReferenceClahe::ReferenceClahe(const AgcParameters& parameters, const AgcScene& scene)
    : parameters_(parameters), scene_(scene) {}

std::vector<double> ReferenceClahe::tile(const std::vector<double>& temperatures_k, int column,
                                         int row) const {
  const int across = parameters_.tiles_across;
  const int down = parameters_.tiles_down;
  std::vector<double> tile_k;
  for (int y = row * kSceneHeightPx / down; y < (row + 1) * kSceneHeightPx / down; ++y)
    for (int x = column * kSceneWidthPx / across; x < (column + 1) * kSceneWidthPx / across; ++x)
      tile_k.push_back(
          temperatures_k[static_cast<std::size_t>(y) * kSceneWidthPx + static_cast<std::size_t>(x)]);
  return tile_k;
}

ReferenceClahe::Levels ReferenceClahe::equalised(const std::vector<double>& tile_k) const {
  Levels pixels(kTileBins, 0);
  for (const double temperature_k : tile_k) ++pixels[static_cast<std::size_t>(temperature_k / kTileBinK)];
  const double tail = parameters_.tail_percent / 100 * static_cast<double>(tile_k.size());
  std::size_t first = 0;
  std::size_t last = kTileBins - 1;
  for (double below = pixels[first]; below <= tail; below += pixels[first]) ++first;
  for (double above = pixels[last]; above <= tail; above += pixels[last]) --last;
  double kept = 0;
  for (std::size_t bin = first; bin <= last; ++bin) kept += pixels[bin];
  const double mean = kept / static_cast<double>(last - first + 1);
  double excess = 0;
  for (std::size_t bin = first; bin <= last; ++bin)
    excess += std::max(0.0, pixels[bin] - parameters_.clip_limit * mean);
  const double steepest = parameters_.max_gain_dn_per_netd * kTileBinK / scene_.netd_k;
  const auto rise = [&](std::size_t bin) {
    if (bin < first || bin > last) return steepest;
    const double share =
        std::min(pixels[bin], parameters_.clip_limit * mean) + excess / static_cast<double>(last - first + 1);
    return std::min(steepest, kTileWhite * share / kept);
  };
  double risen = 0;
  for (std::size_t bin = first; bin <= last; ++bin) risen += rise(bin);
  Levels levels(kTileBins + 1);
  levels[first] = 0.5 * (kTileWhite - risen);
  for (std::size_t bin = first; bin < kTileBins; ++bin)
    levels[bin + 1] = std::min(kTileWhite, levels[bin] + rise(bin));
  for (std::size_t bin = first; bin > 0; --bin) levels[bin - 1] = std::max(0.0, levels[bin] - rise(bin - 1));
  return levels;
}

double ReferenceClahe::level(int column, int row, double temperature_k) const {
  const Levels& levels = levels_[static_cast<std::size_t>(row * parameters_.tiles_across + column)];
  const double position = temperature_k / kTileBinK;
  const auto bin = static_cast<std::size_t>(position);
  return levels[bin] + (position - static_cast<double>(bin)) * (levels[bin + 1] - levels[bin]);
}

std::vector<int> ReferenceClahe::next(const std::vector<double>& temperatures_k) {
  const int across = parameters_.tiles_across;
  const int down = parameters_.tiles_down;
  levels_.resize(static_cast<std::size_t>(across * down), Levels(kTileBins + 1, 0));
  for (int k = 0; k < across * down; ++k) {
    const Levels wanted = equalised(tile(temperatures_k, k % across, k / across));
    Levels& levels = levels_[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i] += share_of_new_ * (wanted[i] - levels[i]);
  }
  share_of_new_ = -std::expm1(-1 / (scene_.frame_rate_hz * parameters_.damping_s));
  std::vector<int> shown;
  for (int y = 0; y < kSceneHeightPx; ++y) {
    const double v = tile_place(y, kSceneHeightPx, down);
    const int top = std::min(static_cast<int>(v), down - 1);
    const int bottom = std::min(top + 1, down - 1);
    for (int x = 0; x < kSceneWidthPx; ++x) {
      const double u = tile_place(x, kSceneWidthPx, across);
      const int left = std::min(static_cast<int>(u), across - 1);
      const int right = std::min(left + 1, across - 1);
      const double temperature_k = temperatures_k[shown.size()];
      const double above =
          std::lerp(level(left, top, temperature_k), level(right, top, temperature_k), u - left);
      const double below =
          std::lerp(level(left, bottom, temperature_k), level(right, bottom, temperature_k), u - left);
      shown.push_back(static_cast<int>(std::lround(std::lerp(above, below, v - top))));
    }
  }
  return shown;
}

}  // namespace thermal
