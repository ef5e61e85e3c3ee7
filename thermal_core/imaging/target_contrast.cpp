#include "imaging/target_contrast.h"

#include <cstddef>

#include "labels/surroundings.h"

namespace thermal {
namespace {

double noise_at(const ThermalCamera& camera, const PixelBox& box) {
  return camera.noise_w_m2_sr(box.x_px + box.width_px / 2, box.y_px + box.height_px / 2);
}

}  // namespace

void set_contrast(const ThermalCamera& camera, const Plane<float>& radiance_w_m2_sr,
                  std::vector<Instance>& instances) {
  const std::vector<TargetMeans> means = target_means(radiance_w_m2_sr, instances);
  for (std::size_t i = 0; i < means.size(); ++i) {
    Instance& instance = instances[i];
    const auto& [target, ring] = means[i];
    instance.temperature_k = camera.temperature_k(target);
    if (!ring) continue;
    instance.contrast_k = *instance.temperature_k - camera.temperature_k(*ring);
    const double noise_w_m2_sr = noise_at(camera, instance.box);
    if (noise_w_m2_sr > 0) instance.contrast_noise = (target - *ring) / noise_w_m2_sr;
  }
}

}  // namespace thermal
