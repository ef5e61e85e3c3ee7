#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "radiometry/band_radiance.h"

namespace thermal {

/// Temperature to in-band radiance for every pixel: straight lines between nodes a sixteenth of a kelvin apart,
/// which single precision steps through without rounding, and the reference outside.
class RadianceTable {
 public:
  static constexpr float kColdest = 180;  ///< [K]
  static constexpr float kHottest = 436;  ///< [K], exclusive
  static constexpr int kNodesPerKelvin = 16;
  static constexpr int kSteps = static_cast<int>(kHottest - kColdest) * kNodesPerKelvin;

  /// Evaluates `band` at every fourth node and puts cubics through the logarithms, then measures how far straight lines
  /// between the nodes depart from those.
  explicit RadianceTable(BandRadiance band);

  /// Temperature plane [K] to radiance plane [W m^-2 sr^-1], of equal size; they may be the same memory.
  /// Outside [kColdest, kHottest) the reference is called, which is right everywhere and about 100 times
  /// slower: <= 0 K gives 0, NaN gives NaN, infinity infinity.
  void radiances(std::span<const float> temperature_k, std::span<float> radiance_w_m2_sr) const noexcept;

  /// One temperature [K] to radiance, the same way.
  [[nodiscard]] float radiance(float temperature_k) const noexcept {
    return is_inside(temperature_k) ? between_nodes(temperature_k) : outside(temperature_k);
  }

  /// Adds the table's nodes for kernels that read several tables: radiance and step to the next, in turn.
  void append_nodes(std::vector<float>& nodes) const {
    for (const Node& node : nodes_) nodes.insert(nodes.end(), {node.radiance_w_m2_sr, node.step_w_m2_sr});
  }

  /// Bound of the error between nodes, as a difference in temperature [K]: the largest departure of the curve from
  /// its lines, measured when the table was made, and the most that rounding of nodes and result adds.
  [[nodiscard]] double worst_error_k() const noexcept { return worst_error_k_; }
  /// The same relative to the radiance.
  [[nodiscard]] double worst_relative_error() const noexcept { return worst_relative_error_; }

  /// Bound of the relative error of radiance() for a temperature as it is written: that of the table or, outside it, of
  /// single precision, of rounding the temperature to single precision, and of the reference. 1 where no float holds
  /// the radiance. Costs about six evaluations of the reference.
  [[nodiscard]] double relative_error_bound(double temperature_k) const noexcept;

  [[nodiscard]] const BandRadiance& reference() const noexcept { return band_; }

 private:
  /// A node's radiance and the step to the next node's: side by side, one cache line a pixel.
  struct Node {
    float radiance_w_m2_sr;
    float step_w_m2_sr;
  };

  [[nodiscard]] static double node_k(double node) noexcept {
    return static_cast<double>(kColdest) + node / kNodesPerKelvin;
  }
  [[nodiscard]] static bool is_inside(float temperature_k) noexcept {
    return temperature_k >= kColdest && temperature_k < kHottest;  // false for NaN
  }
  [[nodiscard]] float between_nodes(float temperature_k) const noexcept {
    const float position = (temperature_k - kColdest) * kNodesPerKelvin;  // exact: no bits are lost
    const auto index = static_cast<int>(position);
    const Node node = nodes_[static_cast<std::size_t>(index)];
    return node.radiance_w_m2_sr + (position - static_cast<float>(index)) * node.step_w_m2_sr;
  }
  [[nodiscard]] float outside(float temperature_k) const noexcept;
  void measure(const std::vector<double>& radiance);

  BandRadiance band_;
  std::vector<Node> nodes_;
  double worst_error_k_ = 0;
  double worst_relative_error_ = 0;
};

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
