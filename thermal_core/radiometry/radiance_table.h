#pragma once

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

}  // namespace thermal
