#include "heat/surface/conduction.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace thermal {

std::vector<double> Layers::thicknesses_m(double thickness_m) const {
  std::vector<double> layers;
  double next_m = first_m;
  double left_m = thickness_m;
  // A rest thinner than half of a layer joins the one above it.
  for (; left_m > 1.5 * next_m; next_m *= ratio) {
    layers.push_back(next_m);
    left_m -= next_m;
  }
  layers.push_back(left_m);
  return layers;
}

Conduction::Conduction(const GroundProperties& properties, const Layers& layers, double step_s,
                       double start_k) {
  assert(step_s > 0);
  const std::vector<double> thick_m = layers.thicknesses_m(properties.thickness_m);
  const std::size_t count = thick_m.size();
  const double conductivity = properties.conductivity_w_m_k;
  temperature_k_.assign(count, start_k);
  own_k_.assign(count, 0);
  follow_.assign(count, 0);
  per_total_.assign(count, 0);
  to_surface_w_m2_k_ = 2 * conductivity / thick_m.front();
  for (std::size_t i = 0; i < count; ++i) {
    stored_w_m2_k_.push_back(properties.heat_capacity_j_m3_k * thick_m[i] / step_s);
    const bool last = i + 1 == count;
    below_w_m2_k_.push_back(last ? 0 : 2 * conductivity / (thick_m[i] + thick_m[i + 1]));
  }
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
