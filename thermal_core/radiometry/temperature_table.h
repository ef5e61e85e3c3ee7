#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace thermal {

/// Radiance to apparent temperature, fast enough for every pixel: straight lines between nodes equally spaced
/// in radiance; for what is hotter, lines between nodes 1024 an octave of radiance; and the exact inverse outside.
class TemperatureTable {
 public:
  /// Temperature [K] the exact inverse gives for a radiance [W m^-2 sr^-1]. Called from several threads at once.
  using Inverse = std::function<double(double radiance_w_m2_sr)>;

  /// Tabulates `inverse` over [low, high], then measures the error between all nodes. The hot part, over (high,
  /// hottest], is tabulated at the first radiance there: most clips have none, and it takes 0.05 s. Requires 0 < low <
  /// high; no hot part unless high < hottest, finite in single precision.
  TemperatureTable(Inverse inverse, double low_w_m2_sr, double high_w_m2_sr, double hottest_w_m2_sr = 0);
  ~TemperatureTable();
  TemperatureTable(const TemperatureTable&) = delete;
  TemperatureTable& operator=(const TemperatureTable&) = delete;

  /// Radiance plane to temperature plane, same size. Outside the tables the exact inverse is called, a thousand times
  /// slower: radiance <= 0 gives 0 K, NaN gives NaN. Safe to call from several threads.
  void temperatures(std::span<const float> radiance_w_m2_sr, std::span<float> temperature_k) const;

  /// Largest error of the first table itself between its nodes [K], measured when it was made; float rounding of the
  /// result (1.5e-5 K at 300 K) comes on top. Of the hot part: see thermal_core/ACCURACY.md.
  [[nodiscard]] double worst_error_k() const noexcept { return worst_error_k_; }

 private:
  class HotPart;

  [[nodiscard]] float between_nodes(float position) const noexcept;

  Inverse inverse_;
  float low_w_m2_sr_;
  float nodes_per_w_m2_sr_;
  float last_position_;
  double worst_error_k_ = 0;
  std::vector<float> nodes_k_;
  std::unique_ptr<HotPart> hot_;  ///< null where there is none
};

}  // namespace thermal
