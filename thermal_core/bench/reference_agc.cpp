#include "bench/reference_agc.h"

#include <algorithm>
#include <cmath>

#include "radiometry/band_radiance.h"

namespace thermal {
namespace {

constexpr double kBinK = 0.04;
constexpr std::size_t kBins = 16384;
constexpr double kWhite = 255;

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
  if (parameters_.mode != AgcMode::percentile && parameters_.mode != AgcMode::plateau) return;
  std::vector<double> kept_k = temperatures_k;
  std::sort(kept_k.begin(), kept_k.end());
  const auto tail =
      static_cast<std::ptrdiff_t>(parameters_.tail_percent / 100 * static_cast<double>(kept_k.size()));
  kept_k = std::vector<double>(kept_k.begin() + tail, kept_k.end() - tail);
  const double share = adapted_ ? share_of_new_ : 1;
  adapted_ = true;
  if (parameters_.mode == AgcMode::plateau) {
    const std::vector<double> wanted = equalised(kept_k);
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

std::vector<double> ReferenceAgc::equalised(const std::vector<double>& kept_k) const {
  const double most = parameters_.plateau_percent / 100 *
                      (static_cast<double>(kept_k.size()) / (1 - 0.02 * parameters_.tail_percent));
  const double steepest = parameters_.max_gain_dn_per_netd * kBinK / scene_.netd_k;
  const auto first = static_cast<std::size_t>(kept_k.front() / kBinK);
  const auto last = static_cast<std::size_t>(kept_k.back() / kBinK);
  std::vector<double> pixels(kBins, 0);
  for (const double temperature_k : kept_k) ++pixels[static_cast<std::size_t>(temperature_k / kBinK)];
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
  if (parameters_.mode == AgcMode::plateau) {
    const double place = temperature_k / kBinK;
    const auto bin = static_cast<std::size_t>(place);
    return levels_[bin] + (place - static_cast<double>(bin)) * (levels_[bin + 1] - levels_[bin]);
  }
  if (parameters_.mode == AgcMode::linear || parameters_.mode == AgcMode::percentile) {
    return kWhite * (temperature_k - low_k_) / (high_k_ - low_k_);
  }
  return kWhite * radiance_share;
}

}  // namespace thermal
