#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

inline constexpr std::size_t kLevels = 256;

/// How one 8-bit frame was made from its 16-bit frame: thresholds[k] is the smallest 16-bit count that shows as
/// level k + 1 or more (65535 stands for none but the clipped), so that
///   level = number of thresholds <= count; black-hot shows 255 - level.
/// Exact in every mode but table_max, whose levels come straight from radiance, as the script's do: there the curve
/// is within one level.
struct ToneCurve {
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  double low_k = 0;   ///< linear, percentile: where level 0 begins; plateau: the tail dropped
  double high_k = 0;  ///< where level 255 ends; likewise

  [[nodiscard]] bool operator==(const ToneCurve&) const = default;
};

/// In-band radiance [W m^-2 sr^-1] -> temperature [K], exact.
using TemperatureOf = std::function<double(double radiance_w_m2_sr)>;

/// What the modes need to know of the camera and the clip.
struct AgcScene {
  double kelvin_per_count = 0.01;
  double frame_rate_hz = 9;
  double netd_k = 0.04;
  double brightest_w_m2_sr = 1;  ///< scene_max, table_max: radiance of level 255
  TemperatureOf temperature_of;  ///< scene_max, table_max
};

/// Automatic gain control of one clip: makes each frame's tone curve from its 16-bit counts and those before.
///
/// Counts 0 (nothing measured: NaN, no light) and 65535 (clipped) are shown but say nothing to the adaptive modes.
/// A frame without any other count keeps the curve of the frame before; a first frame of that kind shows black.
/// percentile and plateau never show one NETD as more than max_gain_dn_per_netd levels: a bland scene stays bland
/// about middle grey instead of showing its noise.
class Agc {
 public:
  Agc(const AgcParameters& parameters, AgcScene scene);

  /// The next frame's curve. Frames must come in order, from the first.
  const ToneCurve& next(const Plane<std::uint16_t>& ir16);

 private:
  using Histogram = std::vector<std::uint32_t>;

  void make_radiance_curve(double rounding);
  void make_linear_curve(double low_count, double high_count);
  void adapt_percentiles(std::size_t low, std::size_t high);
  void adapt_plateau(std::size_t low, std::size_t high, std::size_t measured);
  [[nodiscard]] std::vector<double> equalised(std::size_t low, std::size_t high, std::size_t measured) const;
  void make_thresholds_of_levels();

  AgcParameters parameters_;
  AgcScene scene_;
  double share_of_new_;  ///< of what a frame asks for, in the curve; the rest is what was
  double counts_per_netd_;
  bool adapted_ = false;  ///< a frame has set the curve
  double low_count_ = 0;  ///< percentile
  double high_count_ = 0;
  std::size_t bin_counts_ = 1;  ///< plateau: counts a bin of the histogram holds
  std::vector<double> levels_;  ///< plateau: at the lower edge of each bin, damped
  Histogram histogram_;         ///< of counts
  ToneCurve curve_;
};

/// The 8-bit frame of the authors' script: radiance [W m^-2 sr^-1] over the brightest, times 255, truncated and
/// clipped. NaN shows as 0.
void truncate_to_levels(const Plane<float>& radiance_w_m2_sr, double brightest_w_m2_sr, Polarity polarity,
                        Plane<std::uint8_t>& ir8);

/// The 8-bit frame a curve makes of a 16-bit one.
void apply_tone_curve(const ToneCurve& curve, Polarity polarity, const Plane<std::uint16_t>& ir16,
                      Plane<std::uint8_t>& ir8);

}  // namespace thermal
