#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Defective pixels, and how the camera corrects them. Which pixels they are is a function of (seed, clip). Dead pixels
/// measure nothing; the camera knows them and replaces them by the mean of their working neighbours, or shows 0 if
/// replacement is off. Blinking pixels (random telegraph noise) jump between two levels at random; the camera does not
/// know them. Nor does it know, until a restart, pixels that fail during the clip: these show 0 from then on, as an
/// open circuit does (estimate).
class BadPixels {
 public:
  BadPixels(const BadPixelParameters& parameters, std::uint32_t seed, std::string_view clip,
            double frame_rate_hz, int width_px, int height_px);

  /// Modifies a frame's signal; frame numbers must increase; gaps are allowed. `noise_stddev` is that of the white
  /// temporal noise, in the signal's unit.
  void apply(std::uint32_t frame, float noise_stddev, Plane<float>& signal);

  [[nodiscard]] const std::vector<std::size_t>& dead() const noexcept { return dead_; }

  /// A pixel that fails during the clip.
  struct LateDead {
    double frame = 0;  ///< first frame in which it has failed
    std::size_t pixel = 0;
  };

  /// In order of time, within the first kLateDeadHours of the clip.
  [[nodiscard]] const std::vector<LateDead>& late_dead() const noexcept { return late_dead_; }
  static constexpr double kLateDeadHours = 100;

  [[nodiscard]] const std::vector<std::size_t>& blinking() const noexcept { return blinking_; }

 private:
  void blink(std::uint32_t frame);
  void draw_late_dead(double frame_rate_hz, std::size_t pixels);
  [[nodiscard]] float living_mean(std::size_t pixel, const Plane<float>& signal) const;

  BadPixelParameters parameters_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  float flip_probability_;  ///< from one frame to the next
  std::vector<std::size_t> dead_;
  std::vector<bool> is_dead_;  ///< empty: none
  std::vector<LateDead> late_dead_;
  std::vector<std::size_t> blinking_;
  std::vector<bool> is_up_;  ///< of the blinking ones
  std::uint32_t next_ = 0;   ///< the first frame whose jumps are not applied yet
};

}  // namespace thermal
