#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/image.h"
#include "sensor/local_tone.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Marks with 1 the pixels at which the picture changes by more than `threshold_counts` from one neighbour to the
/// opposite one, along rows or columns, averaged over three parallel lines (Prewitt's operator), and others with 0.
/// White noise of 1 NETD changes that mean by sqrt(2 / 3) NETD. Edge pixels are replicated beyond the border.
void mark_information(const Plane<std::uint16_t>& ir16, double threshold_counts, Plane<std::uint8_t>& marks);

/// Of the 8-bit frame.
inline constexpr std::size_t kLevels = 256;

/// Mapping of a 16-bit frame to its 8-bit frame: thresholds[k] is the smallest 16-bit count shown as level k + 1 or
/// higher (65535: only clipped pixels), so that
///   level = number of thresholds <= count; black-hot shows 255 - level.
/// Exact in every mode except two: table_max, whose levels are computed from radiance, as in the published script, so
/// that the curve is within one level; and clahe, which has a curve for each pixel: is_local is set, and there are no
/// thresholds.
struct ToneCurve {
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  double low_k = 0;   ///< linear, percentile: start of level 0; other adaptive modes: end of the lower tail
  double high_k = 0;  ///< end of level 255; likewise
  bool is_local = false;  ///< the level also depends on the pixel's position

  [[nodiscard]] bool operator==(const ToneCurve&) const = default;
};

/// In-band radiance [W m^-2 sr^-1] -> temperature [K], exact.
using TemperatureOf = std::function<double(double radiance_w_m2_sr)>;

/// Parameters of the modes that the camera and the clip set.
struct AgcScene {
  double kelvin_per_count = 0.01;
  double frame_rate_hz = 9;
  double netd_k = 0.04;
  double brightest_w_m2_sr = 1;  ///< scene_max, table_max: radiance of level 255
  TemperatureOf temperature_of;  ///< scene_max, table_max
};

/// Automatic gain control of one clip: makes each frame's 8-bit picture from its 16-bit counts and earlier frames.
///
/// Counts 0 (no signal: NaN, no light) and 65535 (clipped) are shown as levels 0 and 255, but the adaptive modes ignore
/// them. All others are shown from black_level to white_level. A frame without any other count keeps the previous
/// frame's curve, or is black if it is the first. The adaptive modes never spread one NETD over more than
/// max_gain_dn_per_netd levels, so that a scene of low contrast stays near middle grey instead of showing its noise.
class Agc {
 public:
  Agc(const AgcParameters& parameters, AgcScene scene);

  /// The next frame's curve. Frames must come in order, from the first.
  const ToneCurve& next(const Plane<std::uint16_t>& ir16);

  /// The 8-bit frame of a picture by the latest curve, or, in mode clahe, by those of its tiles. For table_max, see
  /// truncate_to_levels().
  void show(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8) const;

 private:
  using Histogram = std::vector<std::uint32_t>;

  void make_radiance_curve(double rounding);
  void make_linear_curve(double low_count, double high_count);
  void adapt_percentiles(std::size_t low, std::size_t high);
  void adapt_locally(const Plane<std::uint16_t>& ir16);
  void adapt_plateau(std::size_t low, std::size_t high, std::size_t measured);
  void count_information(const Plane<std::uint16_t>& ir16);
  [[nodiscard]] double weight_of(std::size_t begin, std::size_t end) const;
  [[nodiscard]] std::vector<double> equalised(std::size_t low, std::size_t high, std::size_t measured) const;
  void make_thresholds_of_levels();
  void keep_headroom();

  AgcParameters parameters_;
  AgcScene scene_;
  double share_of_new_;  ///< weight of a frame's own curve; the rest is the previous curve
  double counts_per_netd_;
  bool adapted_ = false;  ///< a frame has set the curve
  double low_count_ = 0;  ///< percentile
  double high_count_ = 0;
  LevelBins bins_;                  ///< plateau, information, clahe
  std::vector<double> levels_;      ///< plateau, information: at the lower edge of each bin, damped
  Histogram histogram_;             ///< of all counts
  Histogram informed_;              ///< information: of the counts of pixels with information
  Plane<std::uint8_t> marks_;       ///< information: those pixels
  std::optional<LocalTone> local_;  ///< clahe
  ToneCurve curve_;
};

/// The 8-bit frame of the authors' script: radiance [W m^-2 sr^-1] over the brightest, times 255, truncated and
/// clipped. NaN shows as 0.
void truncate_to_levels(const Plane<float>& radiance_w_m2_sr, double brightest_w_m2_sr, Polarity polarity,
                        Plane<std::uint8_t>& ir8);

/// The 8-bit frame of a 16-bit one by a curve.
void apply_tone_curve(const ToneCurve& curve, Polarity polarity, const Plane<std::uint16_t>& ir16,
                      Plane<std::uint8_t>& ir8);

}  // namespace thermal
