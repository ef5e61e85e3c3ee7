#include "dataset/run/estimate.h"

namespace thermal {
namespace {

/// What an engine takes on two cores, conversion included [s].
struct Rates {
  double start_s;     ///< planning, baking, loading the scene, and Blender
  double per_clip_s;  ///< until the first frame
  double per_frame_s;
  double per_ray_s;  ///< of a pass pixel: traced and converted; with Blender, written and read in between
};

constexpr Rates kBlender = {.start_s = 35, .per_clip_s = 0.5, .per_frame_s = 0.05, .per_ray_s = 0.45e-6};
constexpr Rates kEmbree = {.start_s = 15, .per_clip_s = 0.1, .per_frame_s = 0.012, .per_ray_s = 0.055e-6};
/// Pixels that get all rays beside their first with adaptive sampling, as far as their time goes: these rays take longer
/// than others, because they meet the edges of plants. With 2 x 2, 0.7 of the time of all rays is left.
constexpr double kRefinedShare = 0.45;
constexpr double kBytesPerPixel = 2.2;  ///< both pictures and the preview

double rays_per_pixel(const Config& config) {
  const double all = 1.0 * config.supersample * config.supersample;
  return config.adaptive_sampling && config.supersample > 1 ? 1 + kRefinedShare * all : all;
}

const Rates& rates_of(const Config& config) { return config.engine == Engine::embree ? kEmbree : kBlender; }

double frame_seconds(const Config& config) {
  const double rays = rays_per_pixel(config) * (config.width_px + 2.0 * config.overscan_px) *
                      (config.height_px + 2.0 * config.overscan_px);
  return rates_of(config).per_frame_s + rays * rates_of(config).per_ray_s;
}

}  // namespace

double clip_seconds(const Config& config, int frames) {
  return rates_of(config).per_clip_s + frames * frame_seconds(config);
}

Estimate estimate_run(const Config& config, int clips, int frames) {
  const double pixels = static_cast<double>(config.width_px) * config.height_px;
  return {.seconds =
              rates_of(config).start_s + clips * rates_of(config).per_clip_s + frames * frame_seconds(config),
          .bytes = frames * pixels * kBytesPerPixel};
}

}  // namespace thermal
