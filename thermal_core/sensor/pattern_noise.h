#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"
#include "sensor/shutter.h"

namespace thermal {

/// Noise that whole rows, columns or frames share, and noise that stands still: all of NVESD's components but
/// the temporal noise of single pixels. In units of that noise's standard deviation.
///
/// What stands still (vh, v, h) is what the last shutter correction left over, drawn anew at every closing. Since
/// then a second pattern has grown by sqrt(t) / 2 + t / 2, t the share of the shutter's interval that has passed:
/// a power law plus a linear part, as measured on uncooled cameras (SPIE 12533); the shares are an estimate.
class PatternNoise {
 public:
  PatternNoise(const NoiseParameters& parameters, std::uint32_t seed, std::string_view clip, int width_px,
               int height_px);

  /// Draws what this frame needs.
  void begin_frame(std::uint32_t frame, double time_s, const ShutterState& shutter);

  /// Adds `stddev` times this frame's noise to pixels [first, first + out.size()). Safe to call from several
  /// threads.
  void add(std::size_t first, float stddev, std::span<float> out) const;

 private:
  void draw_fixed(std::uint32_t event);
  [[nodiscard]] std::vector<float> normals(std::uint32_t stream, std::uint32_t frame, int count) const;

  NoiseParameters parameters_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  int width_px_;
  int height_px_;
  double banding_phase_;  ///< of a turn
  std::optional<std::uint32_t> event_;
  std::vector<float> fixed_;    ///< vh + v + h of this event; empty: none
  std::vector<float> drift_;    ///< that grows; empty: none
  float drifted_ = 0;           ///< how far
  std::vector<float> rows_;     ///< of this frame: tv, bands, t
  std::vector<float> columns_;  ///< of this frame: th
};

}  // namespace thermal
