#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/rng.h"
#include "sensor/sensor_parameters.h"
#include "sensor/shutter.h"

namespace thermal {

/// Noise shared by whole rows, columns or frames, and fixed noise: all components of NVESD's model except the temporal
/// noise of single pixels. In units of that noise's standard deviation.
///
/// The fixed part (vh, v, h) is the residue of the last shutter correction, drawn anew at every closing. A second
/// pattern grows from then on, by ShutterState::growth().
class PatternNoise {
 public:
  PatternNoise(const NoiseParameters& parameters, std::uint32_t seed, std::string_view clip, int width_px,
               int height_px);

  /// Draws the random numbers of this frame.
  void begin_frame(std::uint32_t frame, double time_s, const ShutterState& shutter);

  /// Adds `stddev` times this frame's noise to pixels [first, first + out.size()). Safe to call from several
  /// threads.
  void add(std::size_t first, float stddev, std::span<float> out) const;

 private:
  void draw_fixed(std::uint32_t event);
  [[nodiscard]] RandomField field(std::uint32_t stream, std::uint32_t frame) const noexcept;

  NoiseParameters parameters_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  int width_px_;
  int height_px_;
  double banding_phase_;  ///< of a turn
  std::optional<std::uint32_t> event_;
  std::vector<float> fixed_;    ///< vh + v + h of this event; empty: none
  std::vector<float> drift_;    ///< growing pattern; empty: none
  float drifted_ = 0;           ///< its current amplitude
  std::vector<float> rows_;     ///< of this frame: tv, bands, t
  std::vector<float> columns_;  ///< of this frame: th
};

}  // namespace thermal
