#pragma once

#include <functional>
#include <span>
#include <vector>

namespace thermal {

/// Radiance to apparent temperature, fast enough for every pixel: straight lines between nodes equally spaced
/// in radiance, and the exact inverse outside.
class TemperatureTable {
 public:
  /// Temperature [K] the exact inverse gives for a radiance [W m^-2 sr^-1].
  using Inverse = std::function<double(double radiance_w_m2_sr)>;

  /// Tabulates `inverse` over [low, high], then measures the error between all nodes.
  /// Requires 0 < low < high.
  TemperatureTable(Inverse inverse, double low_w_m2_sr, double high_w_m2_sr);

  /// Radiance plane to temperature plane, same size. Outside the table the exact inverse is called: radiance
  /// <= 0 gives 0 K, NaN gives NaN.
  void temperatures(std::span<const float> radiance_w_m2_sr, std::span<float> temperature_k) const;

  /// Largest error of the table itself between its nodes [K], measured when it was made; float rounding of the
  /// result (1.5e-5 K at 300 K) comes on top.
  [[nodiscard]] double worst_error_k() const noexcept { return worst_error_k_; }

 private:
  [[nodiscard]] float between_nodes(float position) const noexcept;

  Inverse inverse_;
  float low_w_m2_sr_;
  float nodes_per_w_m2_sr_;
  float last_position_;
  double worst_error_k_ = 0;
  std::vector<float> nodes_k_;
};

}  // namespace thermal
