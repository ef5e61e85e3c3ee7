#include "imaging/ground_shift.h"

#include <utility>

namespace thermal {

SoilAppearance::SoilAppearance(BandRadiance soil, const BandAir& air, double air_k, bool reflects)
    : soil_(std::move(soil)), air_k_(air_k), sky_emissivity_(air.sky_emissivity()), reflects_(reflects) {}

GroundShift SoilAppearance::shift(const BandRadiance& part, double temperature_k) const {
  const double without_sky_k = apparent_k(part, temperature_k, 0);
  return {.without_sky_k = without_sky_k - temperature_k,
          .by_sky_view_k = apparent_k(part, temperature_k, 1) - without_sky_k};
}

double SoilAppearance::apparent_k(const BandRadiance& part, double temperature_k, double sky_view) const {
  double reflected_more_w_m2_sr = 0;
  if (reflects_) {
    const double received = 1 - sky_view * (1 - sky_emissivity_);
    reflected_more_w_m2_sr = (soil_.radiance(air_k_) - part.radiance(air_k_)) * received;
  }
  return soil_.temperature(part.radiance(temperature_k) + reflected_more_w_m2_sr);
}

}  // namespace thermal
