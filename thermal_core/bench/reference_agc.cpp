#include "bench/reference_agc.h"

#include <algorithm>
#include <cmath>

#include "bench/sensor_scene.h"
#include "radiometry/band_radiance.h"

namespace thermal {
namespace {

constexpr double kBinK = 0.04;
constexpr std::size_t kBins = 16384;
constexpr double kWhite = 255;

bool is_equalising(AgcMode mode) { return mode == AgcMode::plateau || mode == AgcMode::information; }

}  // namespace

ReferenceAgc::ReferenceAgc(const AgcParameters& parameters, const AgcScene& scene)
    : parameters_(parameters),
      scene_(scene),
      share_of_new_(-std::expm1(-1 / (scene.frame_rate_hz * parameters.damping_s))),
      low_k_(parameters.low_k),
      high_k_(parameters.high_k) {}

std::vector<int> ReferenceAgc::next(const std::vector<double>& temperatures_k) {
  const BandRadiance band(SensorParameters().response);
  const bool by_radiance = parameters_.mode == AgcMode::scene_max || parameters_.mode == AgcMode::table_max;
  const bool cut_off = parameters_.mode == AgcMode::table_max;
  adapt(temperatures_k);
  std::vector<int> shown;
  for (const double temperature_k : temperatures_k) {
    const double share = by_radiance ? band.radiance(temperature_k) / scene_.brightest_w_m2_sr : 0;
    const double value = std::clamp(level(temperature_k, share), 0.0, kWhite);
    shown.push_back(static_cast<int>(cut_off ? value : value + 0.5));
  }
  return shown;
}

void ReferenceAgc::adapt(const std::vector<double>& temperatures_k) {
  if (parameters_.mode != AgcMode::percentile && !is_equalising(parameters_.mode)) return;
  std::vector<double> kept_k = temperatures_k;
  std::sort(kept_k.begin(), kept_k.end());
  const auto tail =
      static_cast<std::ptrdiff_t>(parameters_.tail_percent / 100 * static_cast<double>(kept_k.size()));
  kept_k = std::vector<double>(kept_k.begin() + tail, kept_k.end() - tail);
  const double share = adapted_ ? share_of_new_ : 1;
  adapted_ = true;
  if (is_equalising(parameters_.mode)) {
    const std::vector<double> wanted = equalised(temperatures_k, kept_k.front(), kept_k.back());
    levels_.resize(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) levels_[i] += share * (wanted[i] - levels_[i]);
    return;
  }
  const double narrowest_k = kWhite / parameters_.max_gain_dn_per_netd * scene_.netd_k;
  const double half_k = 0.5 * std::max(kept_k.back() - kept_k.front(), narrowest_k);
  const double middle_k = 0.5 * (kept_k.front() + kept_k.back());
  low_k_ += share * (middle_k - half_k - low_k_);
  high_k_ += share * (middle_k + half_k - high_k_);
}

double ReferenceAgc::weight(const std::vector<double>& temperatures_k, std::size_t pixel) const {
  if (parameters_.mode == AgcMode::plateau) return 1;
  const auto here_x = static_cast<int>(pixel % kSceneWidthPx);
  const auto here_y = static_cast<int>(pixel / kSceneWidthPx);
  const auto at = [&](int dx, int dy) {
    const int x = std::clamp(here_x + dx, 0, kSceneWidthPx - 1);
    const int y = std::clamp(here_y + dy, 0, kSceneHeightPx - 1);
    return temperatures_k[static_cast<std::size_t>(y * kSceneWidthPx + x)];
  };
  double across_k = 0;
  double along_k = 0;
  for (const int line : {-1, 0, 1}) {
    across_k += (at(1, line) - at(-1, line)) / 3;
    along_k += (at(line, 1) - at(line, -1)) / 3;
  }
  const double change_netd = std::max(std::abs(across_k), std::abs(along_k)) / scene_.netd_k;
  return change_netd > parameters_.information_threshold_netd ? 1 : parameters_.flat_weight;
}

std::vector<double> ReferenceAgc::equalised(const std::vector<double>& temperatures_k, double low_k,
                                            double high_k) const {
  std::vector<double> pixels(kBins, 0);
  double all = 0;
  for (std::size_t i = 0; i < temperatures_k.size(); ++i) {
    const double counts = weight(temperatures_k, i);
    const double temperature_k = temperatures_k[i];
    all += counts;
    if (temperature_k >= low_k && temperature_k <= high_k)
      pixels[static_cast<std::size_t>(temperature_k / kBinK)] += counts;
  }
  const double most = parameters_.plateau_percent / 100 * all;
  const double steepest = parameters_.max_gain_dn_per_netd * kBinK / scene_.netd_k;
  const auto first = static_cast<std::size_t>(low_k / kBinK);
  const auto last = static_cast<std::size_t>(high_k / kBinK);
  double counted = 0;
  for (double& bin : pixels) counted += bin = std::min(bin, most);
  double risen = 0;
  std::vector<double> rise(kBins, steepest);
  for (std::size_t bin = first; bin <= last; ++bin) {
    rise[bin] = std::min(steepest, kWhite * pixels[bin] / counted);
    risen += rise[bin];
  }
  std::vector<double> levels(kBins + 1);
  levels[first] = 0.5 * (kWhite - risen);
  for (std::size_t bin = first; bin < kBins; ++bin)
    levels[bin + 1] = std::min(kWhite, levels[bin] + rise[bin]);
  for (std::size_t bin = first; bin > 0; --bin) levels[bin - 1] = std::max(0.0, levels[bin] - rise[bin - 1]);
  return levels;
}

double ReferenceAgc::level(double temperature_k, double radiance_share) const {
  if (is_equalising(parameters_.mode)) {
    const double position = temperature_k / kBinK;
    const auto bin = static_cast<std::size_t>(position);
    return levels_[bin] + (position - static_cast<double>(bin)) * (levels_[bin + 1] - levels_[bin]);
  }
  if (parameters_.mode == AgcMode::linear || parameters_.mode == AgcMode::percentile) {
    return kWhite * (temperature_k - low_k_) / (high_k_ - low_k_);
  }
  return kWhite * radiance_share;
}

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
