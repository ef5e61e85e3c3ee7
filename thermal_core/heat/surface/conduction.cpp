#include "heat/surface/conduction.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace thermal {

namespace {

/// Appends layers of a part of the body. A rest thinner than half of a layer joins the one above it.
void divide(double part_m, double first_m, double ratio, std::vector<double>& layers_m) {
  for (double next_m = first_m; part_m > 1.5 * next_m; next_m *= ratio) {
    layers_m.push_back(next_m);
    part_m -= next_m;
  }
  if (part_m > 0) layers_m.push_back(part_m);
}

}  // namespace

std::vector<double> Layers::thicknesses_m(const GroundProperties& properties) const {
  const double top_m = properties.subsoil ? properties.subsoil->depth_m : properties.thickness_m;
  std::vector<double> layers_m;
  divide(top_m, first_m, ratio, layers_m);
  divide(properties.thickness_m - top_m, layers_m.back() * ratio, ratio, layers_m);
  return layers_m;
}

Conduction::Conduction(const GroundProperties& properties, const Layers& layers, double step_s,
                       double start_k) {
  assert(step_s > 0);
  const std::vector<double> thick_m = layers.thicknesses_m(properties);
  const std::size_t count = thick_m.size();
  temperature_k_.assign(count, start_k);
  own_k_.assign(count, 0);
  follow_.assign(count, 0);
  per_total_.assign(count, 0);
  std::vector<double> half_m2_k_w;  // resistance from a layer's middle to its edge
  double depth_m = 0;
  for (const double layer_m : thick_m) {
    const bool below = properties.subsoil && depth_m + layer_m / 2 > properties.subsoil->depth_m;
    const double conductivity =
        below ? properties.subsoil->conductivity_w_m_k : properties.conductivity_w_m_k;
    const double capacity =
        below ? properties.subsoil->heat_capacity_j_m3_k : properties.heat_capacity_j_m3_k;
    half_m2_k_w.push_back(layer_m / (2 * conductivity));
    stored_w_m2_k_.push_back(capacity * layer_m / step_s);
    depth_m += layer_m;
  }
  to_surface_w_m2_k_ = 1 / half_m2_k_w.front();
  for (std::size_t i = 0; i + 1 < count; ++i)
    below_w_m2_k_.push_back(1 / (half_m2_k_w[i] + half_m2_k_w[i + 1]));
  below_w_m2_k_.push_back(0);
  for (std::size_t i = count; i-- > 0;) {
    const double above = i == 0 ? to_surface_w_m2_k_ : below_w_m2_k_[i - 1];
    const double rest = i + 1 == count ? 0 : below_w_m2_k_[i] * (1 - follow_[i + 1]);
    per_total_[i] = 1 / (stored_w_m2_k_[i] + above + rest);
    follow_[i] = above * per_total_[i];
  }
}

/// From the bottom up, each layer's new temperature is follow * (that of the layer above) + own.
HeatUptake Conduction::prepare() noexcept {
  double below_k = 0;
  for (std::size_t i = temperature_k_.size(); i-- > 0;) {
    below_k = (stored_w_m2_k_[i] * temperature_k_[i] + below_w_m2_k_[i] * below_k) * per_total_[i];
    own_k_[i] = below_k;
  }
  return {.slope_w_m2_k = to_surface_w_m2_k_ * (1 - follow_.front()),
          .offset_w_m2 = to_surface_w_m2_k_ * own_k_.front()};
}

double Conduction::finish(double surface_k) noexcept {
  double above_k = surface_k;
  for (std::size_t i = 0; i < temperature_k_.size(); ++i) {
    above_k = follow_[i] * above_k + own_k_[i];
    temperature_k_[i] = above_k;
  }
  return to_surface_w_m2_k_ * (surface_k - temperature_k_.front());
}

}  // namespace thermal
