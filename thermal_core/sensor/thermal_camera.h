#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "radiometry/temperature_table.h"
#include "sensor/agc.h"
#include "sensor/bad_pixels.h"
#include "sensor/convolution.h"
#include "sensor/flicker_noise.h"
#include "sensor/pattern_noise.h"
#include "sensor/sensor_parameters.h"
#include "sensor/shutter.h"

namespace thermal {

/// In-band radiance [W m^-2 sr^-1] of a blackbody at a temperature [K], by a sensor's model and response.
[[nodiscard]] std::function<double(double temperature_k)> radiance_of(RadianceModel model,
                                                                      const SpectralResponse& response);
[[nodiscard]] std::function<double(double temperature_k)> radiance_of(const SensorParameters& parameters);

/// Apparent temperature by exact Planck, tabulated for anything a savanna night holds: all that a ThermalCamera with this
/// response needs. It takes some 16,000 exact inverses, so cameras with one response may share it.
[[nodiscard]] std::shared_ptr<const TemperatureTable> apparent_temperatures(const SpectralResponse& response);

/// What the camera makes of one frame.
struct SensorFrame {
  Plane<std::uint8_t> ir8;    ///< what `curve` makes of ir16; in mode table_max, of radiance
  Plane<std::uint16_t> ir16;  ///< apparent temperature / kelvin_per_count, rounded; clipped to 0..65535
  ToneCurve curve;
  bool shutter_closed = false;  ///< the picture is the last one before the shutter closed
};

/// One uncooled camera through one clip: optics, thermal lag, noise, bad pixels, both outputs.
/// Holds all a clip carries from frame to frame; frames must come in order, from the first. Everything starts
/// stationary: the first frame is like any other. Pixels are a function of (parameters, clip, radiances), the same
/// whatever the number of threads.
class ThermalCamera {
 public:
  struct Clip {
    std::string id;
    std::uint32_t seed = 1;
    double frame_rate_hz = 9;
    int width_px = 0;
    int height_px = 0;
    Plane<float> noise_gain;  ///< factor on each pixel's noise, as lens fall-off makes it; empty: 1
    int supersample = 1;      ///< samples across a pixel whose mean the radiance already is
  };

  /// Looks at a radiance plane [W m^-2 sr^-1], which is gone when it returns.
  using Look = std::function<void(const Plane<float>& radiance_w_m2_sr)>;

  /// @param brightest_w_m2_sr  radiance of level 255 in the AGC modes scene_max and table_max, > 0
  /// @param temperatures  apparent_temperatures() of the parameters' response; null: the camera makes its own
  ThermalCamera(const SensorParameters& parameters, Clip clip, float brightest_w_m2_sr,
                std::shared_ptr<const TemperatureTable> temperatures = nullptr);

  /// Radiance plane [W m^-2 sr^-1] of the next frame to pictures; `out` is used again if it has the right size.
  /// NaN and negative radiance count as 0, more than the 16-bit picture can tell as that much: nothing that is not
  /// finite reaches the optics or what the camera remembers. Count 0 and level 0 stand for no light.
  /// `look` is shown what the detector would see without lag and noise: the radiance behind the optics, of this
  /// frame's moment even while the shutter is closed.
  void expose(const Plane<float>& radiance_w_m2_sr, SensorFrame& out, const Look& look = {});

  /// The same, into a new frame.
  [[nodiscard]] SensorFrame expose(const Plane<float>& radiance_w_m2_sr);

  /// Lets a frame's time pass of which nothing is known: noise of later frames is what it would have been, but what
  /// remembers earlier frames (lag, 1/f noise, blinking pixels, gain control) stands still, or, where no frame came
  /// before, starts with the first that does.
  void skip() noexcept { ++frame_; }

  /// Apparent temperature [K] of a radiance [W m^-2 sr^-1], as the 16-bit picture tells it before it is rounded.
  [[nodiscard]] double temperature_k(double radiance_w_m2_sr) const;

  /// Standard deviation [W m^-2 sr^-1] of a pixel's noise in the frames exposed so far: of white noise, times
  /// sqrt(1 + k f + vh^2 + v^2 + h^2 + tv^2 + th^2 + band^2 + g drift^2), plus the paper's pattern in quadrature, times
  /// the pixel's noise gain. Parts are independent, so variances add: k is the knee of the 1/f noise and f its variance
  /// for a knee at 1 Hz; vh to drift are ratios of NoiseParameters; g is the mean square of the drift's growth over a
  /// shutter interval, 0 without one; the paper's pattern is uniform, so it is its half width / sqrt(3). Noise that
  /// whole frames share is not among it: it moves a target and what surrounds it alike. Nor are bad pixels.
  [[nodiscard]] double noise_w_m2_sr(int x_px, int y_px) const;

 private:
  void take_in(const Plane<float>& radiance_w_m2_sr);
  void lag(std::size_t first, std::span<float> signal);
  void add_noise(std::size_t first, std::span<float> signal);
  void expose_signal();
  void count(Plane<std::uint16_t>& ir16) const;
  void show(SensorFrame& frame) const;

  SensorParameters parameters_;
  Clip clip_;
  std::uint64_t clip_hash_;
  double brightest_w_m2_sr_;
  std::shared_ptr<const TemperatureTable> temperatures_;
  float white_w_m2_sr_;    ///< standard deviation of white temporal noise
  float flicker_w_m2_sr_;  ///< of 1/f noise in units of FlickerFilter's
  float saturation_w_m2_sr_;
  float follow_;  ///< share of a new radiance that a pixel reaches within a frame's time
  Convolution optics_;
  Shutter shutter_;
  PatternNoise pattern_;
  std::optional<FlickerNoise> flicker_;
  BadPixels bad_pixels_;
  Agc agc_;
  Plane<float> signal_;             ///< radiance as the detector tells it
  std::vector<float> membrane_;     ///< lagging radiance; empty: no lag
  std::vector<float> first_frame_;  ///< the paper's fixed pattern; empty: none
  double first_frame_w_m2_sr_ = 0;  ///< its half width
  double noise_w_m2_sr_;            ///< of a pixel, without that pattern and the gain
  SensorFrame shown_;               ///< the last picture before the shutter closed
  std::uint32_t frame_ = 0;
  bool begun_ = false;  ///< a frame was exposed
};

}  // namespace thermal
