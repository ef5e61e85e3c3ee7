#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "radiometry/radiance_table.h"
#include "sensor/agc.h"
#include "sensor/bad_pixels.h"
#include "sensor/flicker_noise.h"
#include "sensor/housing.h"
#include "sensor/optics/optics.h"
#include "sensor/optics/round_kernel.h"
#include "sensor/pattern_noise.h"
#include "sensor/processing.h"
#include "sensor/sensor_parameters.h"
#include "sensor/shutter.h"
#include "sensor/smear.h"

namespace thermal {

/// The frames that a sensor makes, every `step`-th of which is a frame of the video.
struct NativeRate {
  std::uint32_t step = 1;
  double rate_hz = 0;  ///< step times the video's rate

  /// @param native_rate_hz  the sensor's; 0: the video's. The step is the nearest one, so that the rate may differ:
  ///   a video of 9 Hz from a sensor of 60 Hz is every seventh frame at 63 Hz.
  [[nodiscard]] static NativeRate of(double native_rate_hz, double video_rate_hz) noexcept {
    constexpr double kRounding = 1e-12;  // of a quotient of decimals, or of a rate such as 60 / 7
    constexpr double kMostFrames = 1e6;
    const double step = std::round(std::clamp(native_rate_hz / video_rate_hz, 1.0, kMostFrames));
    const double rate_hz = step * video_rate_hz;
    const bool equal = std::abs(rate_hz - native_rate_hz) <= kRounding * native_rate_hz;
    return {.step = static_cast<std::uint32_t>(step), .rate_hz = equal ? native_rate_hz : rate_hz};
  }
};

/// In-band radiance [W m^-2 sr^-1] of a blackbody at a temperature [K], by a sensor's model and response.
[[nodiscard]] std::function<double(double temperature_k)> radiance_of(RadianceModel model,
                                                                      const SpectralResponse& response);
/// The same by the parameters of a sensor.
[[nodiscard]] std::function<double(double temperature_k)> radiance_of(const SensorParameters& parameters);

/// Inverse of exact Planck radiance for a ThermalCamera with this response, tabulated from 180 K to 420 K and, once a
/// hotter pixel occurs, to 2000 K. Building it takes about 16,000 exact inverses, so cameras with the same response may
/// share it.
[[nodiscard]] std::shared_ptr<const TemperatureTable> apparent_temperatures(const SpectralResponse& response);

/// The output of the camera for one frame.
struct SensorFrame {
  Plane<std::uint8_t>
      ir8;  ///< `curve` applied to ir16; in mode table_max, to radiance; in clahe, a curve that varies over the picture
  /// Apparent temperature, with the camera's radiometric error, / kelvin_per_count, rounded; clipped to 0..65535
  /// (655.35 K at the default of 0.01 K). Saturated pixels have saturation_k, if it is set.
  Plane<std::uint16_t> ir16;
  ToneCurve curve;
  bool shutter_closed = false;  ///< the picture is the last one before the shutter closed
};

/// One uncooled camera through one clip: optics, thermal lag, noise, bad pixels, both outputs. Holds all state that a
/// clip carries from frame to frame; frames must come in order, from the first. All processes start stationary: the
/// first frame is statistically like any other. Pixels are a function of (parameters, clip, radiances), whatever the
/// number of threads. Noise and the shutter are functions of the native frame (NativeRate): of a still scene, the
/// 16-bit pictures at the native rate / n are every n-th of those at the native rate, bit for bit.
class ThermalCamera {
 public:
  /// Determines a camera's noise, size and surroundings.
  struct Clip {
    std::string id;
    std::uint32_t seed = 1;
    double frame_rate_hz = 9;
    int width_px = 0;
    int height_px = 0;
    Plane<float> noise_gain;      ///< factor on each pixel's noise, from lens fall-off; empty: 1
    PixelSampling sampling = {};  ///< of the scene that the radiance averages
    double air_k = 293;           ///< around the camera, whose housing is HousingParameters::excess_k warmer
  };

  /// Receives a radiance plane [W m^-2 sr^-1], valid only during the call.
  using TakeSignal = std::function<void(const Plane<float>& radiance_w_m2_sr)>;

  /// @param brightest_w_m2_sr  radiance of level 255 in the AGC modes scene_max and table_max, > 0
  /// @param temperatures  apparent_temperatures() of the parameters' response; null: the camera makes its own
  ThermalCamera(const SensorParameters& parameters, Clip clip, float brightest_w_m2_sr,
                std::shared_ptr<const TemperatureTable> temperatures = nullptr);

  /// Makes the pictures of the next frame from its radiance plane [W m^-2 sr^-1]; `out` is reused if it has the right
  /// size. NaN and negative radiance count as 0, and radiance above that of 6000 K as that of 6000 K, so that optics
  /// and state stay finite. Count 0 and level 0 mean no light; the 16-bit picture ends at 65535. `detail` is subpixel
  /// data, finite, or empty; with it, `sampling` must have quarters. `look` receives the signal without lag and noise:
  /// the radiance behind the optics at this frame's time, even while the shutter is closed. `motion` smears the picture
  /// within the exposure, if there is a time constant. The pictures are then late by a time constant on average, as a
  /// membrane's signal is; without it, they mix this frame and those before.
  void expose(const Plane<float>& radiance_w_m2_sr, const SubpixelDetail& detail, const ImageMotion& motion,
              SensorFrame& out, const TakeSignal& take_signal = {});

  /// The same without detail and motion.
  void expose(const Plane<float>& radiance_w_m2_sr, SensorFrame& out, const TakeSignal& take_signal = {});

  /// The same, into a new frame.
  [[nodiscard]] SensorFrame expose(const Plane<float>& radiance_w_m2_sr);

  /// Advances the clock past a frame whose radiance is unknown. The noise of later frames is unaffected; state that
  /// depends on earlier frames' radiance (lag, gain control) is not advanced or, before the first frame, starts with
  /// the first one given.
  void skip() noexcept { ++frame_; }

  /// Apparent temperature [K] of a radiance [W m^-2 sr^-1], as in the 16-bit picture before rounding and without
  /// the camera's radiometric error.
  [[nodiscard]] double temperature_k(double radiance_w_m2_sr) const;

  /// Standard deviation [W m^-2 sr^-1] of a pixel's noise in the frames exposed so far: of white noise, times sqrt(1 +
  /// k f + vh^2 + v^2 + h^2 + tv^2 + th^2 + band^2 + g drift^2), plus the paper's pattern in quadrature, times the
  /// pixel's noise gain. Parts are independent, so variances add: k is the knee of the 1/f noise and f its variance for
  /// a knee at 1 Hz; vh to drift are ratios of NoiseParameters; g is the mean square of the drift's growth over a
  /// shutter interval, 0 without one; the paper's pattern is uniform, so its standard deviation is its half width /
  /// sqrt(3). The errors of the pixels' gains count by their standard deviation at the mean of the first frame. Smooth
  /// noise and that of whole frames is excluded, because it shifts a target and its surroundings alike. So are bad
  /// pixels. It is the noise before noise reduction, which moving objects keep.
  [[nodiscard]] double noise_w_m2_sr(int x_px, int y_px) const;

 private:
  /// The native frame whose picture the camera shows at `native`: itself, or the last one before a closing of the
  /// shutter; any number up to seen_ stands for the picture shown then.
  [[nodiscard]] std::uint32_t shown_at(std::uint32_t native) const noexcept;
  void make_picture(std::uint32_t native, SensorFrame& out);
  void take_in(const Plane<float>& radiance_w_m2_sr, const SubpixelDetail& detail);
  void begin();
  template <typename Work>
  void for_blocks(const Work& work);
  void lag(std::size_t first, std::span<float> signal);
  void add_noise(std::uint32_t native, std::size_t first, std::span<float> signal);
  void count(double error_k, Plane<std::uint16_t>& ir16) const;
  void show(SensorFrame& frame);

  SensorParameters parameters_;
  Clip clip_;
  std::uint64_t clip_hash_;
  double brightest_w_m2_sr_;
  std::shared_ptr<const TemperatureTable> temperatures_;
  NativeRate native_;
  float white_w_m2_sr_;            ///< standard deviation of white temporal noise …
  float fast_w_m2_sr_;             ///< … with what 1/f noise adds to it
  float flicker_w_m2_sr_;          ///< of 1/f noise in units of FlickerDesign's
  float brightest_taken_w_m2_sr_;  ///< brighter radiance counts as this
  float saturation_w_m2_sr_;       ///< of the 16-bit picture
  float follow_;                   ///< fraction of a change that a pixel follows within one frame
  Optics optics_;
  std::optional<Smear> smear_;  ///< none without a time constant
  Shutter shutter_;
  RadiometricError radiometric_error_;
  PatternNoise pattern_;
  Housing housing_;
  std::optional<FlickerNoise> flicker_;
  std::optional<std::uint32_t> event_;  ///< of the shutter, in the frame before
  BadPixels bad_pixels_;
  std::optional<TemporalFilter> denoise_;  ///< none without noise reduction
  Processing processing_;
  Agc agc_;
  DetailEnhancer sharpener_;
  Plane<float> signal_;                ///< radiance as measured by the detector
  std::vector<float> membrane_;        ///< lagging radiance; empty: no lag
  std::vector<float> first_frame_;     ///< the paper's fixed pattern; empty: none
  double first_frame_w_m2_sr_ = 0;     ///< its half width
  double noise_w_m2_sr_;               ///< of a pixel, without that pattern and the gain
  double gain_w_m2_sr_ = 0;            ///< of a pixel, by the errors of its gain in the first frame
  SensorFrame shown_;                  ///< the last picture before the shutter closed
  std::optional<std::uint32_t> seen_;  ///< native frame of the last frame that was exposed
  std::uint32_t frame_ = 0;
  bool begun_ = false;  ///< a frame was exposed
};

}  // namespace thermal
