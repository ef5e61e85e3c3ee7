#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/image.h"
#include "bench/truth/targets.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Sampling of the passes: s x s rays, in all pixels or in those that show the target; or the target's coverage, as in
/// a cryptomatte.
struct ShippedSampling {
  enum class Kind { full, adaptive, coverage };
  std::string name;
  Kind kind = Kind::full;
  int factor = 1;
};

/// A clip of the product: a target in front of ground.
struct ShippedClip {
  SensorParameters sensor;  ///< without noise, shutter and bad pixels
  ShippedSampling sampling;
  GreySurface target;
  GreySurface ground;
  int width_px = 0;
  int height_px = 0;
  double frame_rate_hz = 30;
  int frames = 1;        ///< the last one is compared
  double camera_px = 0;  ///< motion of the picture to the left by the camera, per frame
  double walk_px = 0;    ///< additional motion of the target
};

/// The target's shapes in the n-th frame before the last.
using ShapesBefore = std::function<std::vector<TruthShape>(int frames)>;

/// Apparent temperature [K] of the clip's last frame: planes of indices -> FrameConverter -> ThermalCamera -> ir16.
[[nodiscard]] Plane<double> shipped_temperature_k(const ShippedClip& clip, const ShapesBefore& shapes);

/// Time [s] of a full-size frame through the same steps, from planes to both images, without noise.
[[nodiscard]] double shipped_frame_s(ShippedClip clip, const std::vector<TruthShape>& shapes);

/// A camera of the product, and the corresponding truth.
struct TruthPreset {
  std::string name;
  SensorParameters sensor;
  TruthCamera truth;
};

/// flir_vue_pro_640_13mm: f/1.25, 17 um; boson_640_14mm: f/1.0, 12 um; airsim_w: a Gaussian of 1 px. Without noise.
[[nodiscard]] std::vector<TruthPreset> truth_presets();

/// One measurement.
struct TruthCase {
  TruthTarget target;
  TruthPreset preset = truth_presets().front();
  ShippedSampling sampling = {"adaptive 4 x 4", ShippedSampling::Kind::adaptive, 4};  ///< a config's default
  double distance_m = 122;
  double speed_m_s = 12;  ///< of the camera; the target walks in the opposite direction
  bool walks = true;
  double frame_rate_hz = 30;
  int places = 32;  ///< subpixel positions
};

/// Errors of one measurement.
struct TruthErrors {
  double rms_mk = 0;  ///< over the target's pixels, at all positions
  double worst_mk = 0;
  double signal_percent = 0;   ///< of the sum of radiance above the ground, mean over positions
  double scatter_percent = 0;  ///< its standard deviation over positions
};

/// Differences of two images of apparent temperature over the target's pixels, and of their signal.
class ErrorSum {
 public:
  /// @param kelvin_per_count  to which the image is rounded, and the ground in it; 0: not rounded
  explicit ErrorSum(double kelvin_per_count) : kelvin_per_count_(kelvin_per_count) {}

  void add(const TruthCase& measured, const TruthShape& box, const Plane<double>& image_k,
           const Plane<double>& truth_k);
  [[nodiscard]] TruthErrors errors() const;

 private:
  double kelvin_per_count_;
  double sum2_k2_ = 0;
  double worst_k_ = 0;
  std::size_t pixels_ = 0;
  std::vector<double> signal_;
};

/// The bare ground of all measurements: soil of Table 1 on a winter night.
inline constexpr GreySurface kTruthSoil = {278, 0.914};

/// Scale at the target, and its motion in a second and in a time constant [px].
[[nodiscard]] double px_per_m(const TruthCase& measured);
[[nodiscard]] double px_per_s(const TruthCase& measured);
[[nodiscard]] double smear_px(const TruthCase& measured);

/// The image around the target: its size, and the target's shapes at one subpixel position.
struct TruthView {
  int width_px = 0;
  int height_px = 0;
  std::vector<TruthShape> shapes;
};
[[nodiscard]] TruthView view_at(const TruthCase& measured, int position);

/// Apparent temperature of each pixel, clipped to the range of the 16-bit frames.
[[nodiscard]] Plane<double> apparent_k(const TruthCase& measured, const Plane<double>& radiance);

/// The shipped chain's image at a subpixel position.
[[nodiscard]] Plane<double> shipped_image_k(const TruthCase& measured, const TruthView& view);

/// The shipped chain against the truth. `still` is the truth's kernel without motion.
[[nodiscard]] TruthErrors shipped_errors(const TruthCase& measured, const ContrastKernel& still);

/// Time of a whole frame of the shipped chain [ms].
[[nodiscard]] double shipped_ms(const TruthCase& measured);

}  // namespace thermal
