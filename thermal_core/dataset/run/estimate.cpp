#include "dataset/run/estimate.h"

namespace thermal {
namespace {

constexpr double kStartS = 35;           ///< planning, baking, Blender, loading the scene
constexpr double kSecondsPerClip = 0.5;  ///< until the first frame
constexpr double kSecondsPerFrame = 0.05;
constexpr double kSecondsPerRay = 0.7e-6;  ///< of a pass pixel: traced, written, read and converted
constexpr double kBytesPerPixel = 2.2;     ///< both pictures and the preview

double square(double value) { return value * value; }

}  // namespace

Estimate estimate_run(const Config& config, int clips, int frames) {
  const double pixels = static_cast<double>(config.width_px) * config.height_px;
  const double rays = square(config.supersample) * (config.width_px + 2.0 * config.overscan_px) *
                      (config.height_px + 2.0 * config.overscan_px);
  return {.seconds = kStartS + clips * kSecondsPerClip + frames * (kSecondsPerFrame + rays * kSecondsPerRay),
          .bytes = frames * pixels * kBytesPerPixel};
}

}  // namespace thermal
