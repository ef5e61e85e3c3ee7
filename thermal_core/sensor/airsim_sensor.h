#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/image.h"
#include "radiometry/spectral_response.h"
#include "radiometry/temperature_table.h"
#include "sensor/noise.h"

namespace thermal {

/// Which in-band radiance a temperature has.
enum class RadianceModel {
  exact,  ///< Planck's law with SI 2019 constants and the sensor's response
  script  ///< the 600-point trapezoid of the authors' published script, 8-14 um
};

/// What the brightest 8-bit count stands for.
enum class Normalisation {
  scene_max,  ///< the most radiant material of the clip, as in the paper; counts are rounded
  table_max   ///< the most radiant row of Table 1, as in the script; counts are truncated
};

/// The sensor of AirSim-W (Bondi et al., COMPASS 2018). The paper gives no noise amplitudes; the defaults keep
/// a person at 61 m (60 counts above soil in winter) clearly visible.
struct SensorParameters {
  SpectralResponse response = SpectralResponse::flat(8, 14);
  RadianceModel radiance = RadianceModel::exact;
  Normalisation normalisation = Normalisation::scene_max;
  double blur_sigma_px = 1;
  double white_noise_stddev_dn = 2;      ///< Johnson and thermal noise, 8-bit counts
  double flicker_noise_stddev_dn = 1.5;  ///< 1/f noise of each pixel
  double fixed_pattern_ratio = 0.1;  ///< half width of the uniform pattern / first frame's standard deviation
  double kelvin_per_count = 0.01;    ///< step of the 16-bit frames
};

/// In-band radiance [W m^-2 sr^-1] of a blackbody at a temperature [K], by the sensor's model and response.
[[nodiscard]] std::function<double(double temperature_k)> radiance_of(const SensorParameters& parameters);

/// What the sensor makes of one frame.
struct SensorFrame {
  Plane<std::uint8_t> ir8;    ///< after normalisation; clipped to 0..255
  Plane<std::uint16_t> ir16;  ///< apparent temperature / kelvin_per_count, rounded; clipped to 0..65535
};

/// One camera through one clip: blur, then white, 1/f and fixed-pattern noise, then both outputs.
/// Holds the state a clip carries from frame to frame; frames must come in order, from the first.
class AirsimSensor {
 public:
  struct Clip {
    std::string id;
    std::uint32_t seed = 1;
    double frame_rate_hz = 9;
    int width_px = 0;
    int height_px = 0;
    Plane<float> noise_gain;  ///< factor on each pixel's noise, as lens fall-off makes it; empty: 1
  };

  /// @param brightest_w_m2_sr  radiance of count 255, > 0
  AirsimSensor(const SensorParameters& parameters, Clip clip, float brightest_w_m2_sr);

  /// Radiance plane [W m^-2 sr^-1] of the next frame to pictures. NaN becomes 0 in both.
  [[nodiscard]] SensorFrame expose(const Plane<float>& radiance_w_m2_sr);

 private:
  void add_noise(Plane<float>& signal_dn);
  [[nodiscard]] Plane<std::uint8_t> to_ir8(const Plane<float>& signal_dn) const;
  [[nodiscard]] Plane<std::uint16_t> to_ir16(const Plane<float>& signal_dn) const;

  SensorParameters parameters_;
  Clip clip_;
  double w_m2_sr_per_dn_;
  TemperatureTable temperature_table_;
  FlickerNoise flicker_;
  Plane<float> fixed_pattern_;
  std::optional<float> fixed_pattern_dn_;  ///< half width, known once the first frame is
  std::uint32_t frame_ = 0;
};

}  // namespace thermal
