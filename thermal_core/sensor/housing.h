#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sensor/sensor_parameters.h"
#include "sensor/shutter.h"

namespace thermal {

/// Two patterns of the camera's housing, which its pixels see around the lens:
///
/// Gain: a pixel's gain has an error that is fixed for a clip, half of its variance from pixel to pixel and half
/// smooth. A closing of the shutter, which has the housing's temperature, removes its effect at that temperature, so
/// that error times (scene - housing) is left.
///
/// Halo: lens and housing drift away from the shutter's temperature. Pixels see the more of the housing the farther
/// they are from the centre: nothing at the centre, growing with the square of the distance. Its size at the corners is
/// drawn at each closing, and grows as PatternNoise's drift does.
class Housing {
 public:
  /// @param housing_w_m2_sr  in-band radiance of the housing
  /// @param w_m2_sr_per_k  converts the halo
  /// @param amount  factor on both patterns
  Housing(const HousingParameters& parameters, double amount, std::uint32_t seed, std::string_view clip,
          int width_px, int height_px, double housing_w_m2_sr, double w_m2_sr_per_k);

  /// Draws the halo of this frame.
  void begin_frame(const ShutterState& shutter);

  /// Adds the patterns to the radiance of pixels [first, first + signal.size()). Safe to call from several threads.
  void apply(std::size_t first, std::span<float> signal) const;

  /// Standard deviation between pixels that the gain errors cause in a scene of this radiance.
  [[nodiscard]] double pixel_stddev_w_m2_sr(double scene_w_m2_sr) const noexcept;

  [[nodiscard]] bool has_gain() const noexcept { return !gain_errors_.empty(); }

 private:
  void draw_gain(int width_px, int height_px);

  double gain_error_;
  double halo_w_m2_sr_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  double housing_w_m2_sr_;
  std::vector<float> gain_errors_;  ///< by pixel; empty: none
  std::vector<double> rows_;  ///< part of each row in the halo, 1 at the corners with that of the column
  std::vector<double> columns_;
  std::vector<float> row_halo_;  ///< of this frame; empty: none
  std::vector<float> column_halo_;
};

}  // namespace thermal
