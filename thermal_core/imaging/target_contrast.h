#pragma once

#include <vector>

#include "base/image.h"
#include "labels/instances.h"
#include "sensor/thermal_camera.h"

namespace thermal {

/// Sets the sensor-dependent fields of each actor's label from its radiance behind the optics (ThermalCamera::Look):
/// temperature_k, of the mean over its pixels; contrast_k, that minus the apparent temperature of its surroundings'
/// mean (target_means()); contrast_noise, the difference of both radiances in standard deviations of the noise of a
/// pixel at the centre of its box. The latter two are empty if the surroundings are not in the picture, the last also
/// without noise.
void set_contrast(const ThermalCamera& camera, const Plane<float>& radiance_w_m2_sr,
                  std::vector<Instance>& instances);

}  // namespace thermal
