#pragma once

#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"

namespace thermal {

/// How much warmer than it is a part of the ground must be drawn as bare soil, by a line in its sky view, so that it
/// looks as it does.
struct GroundShift {
  double without_sky_k = 0;
  double by_sky_view_k = 0;
};

/// Ground of all kinds is drawn as one surface, with the emissivity of bare soil. What emits more looks warmer under a
/// clear sky: grass (0.96) beside soil (0.91) by about 1.5 K.
class SoilLook {
 public:
  /// @param reflects  whether what is not emitted is reflected from the sky and from what hides it
  SoilLook(BandRadiance soil, const BandAir& air, double air_k, bool reflects);

  /// Of a part at a temperature [K]: exact there with no sky and with all of it, as seen from above. A place that is
  /// 10 K warmer or colder errs by up to 11 K times the difference of the emissivities: grass by 0.5 K.
  [[nodiscard]] GroundShift shift(const BandRadiance& part, double temperature_k) const;

 private:
  [[nodiscard]] double look_k(const BandRadiance& part, double temperature_k, double sky_view) const;

  BandRadiance soil_;
  double air_k_;
  double sky_emissivity_;
  bool reflects_;
};

}  // namespace thermal
