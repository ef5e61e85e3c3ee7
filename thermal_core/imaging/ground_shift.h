#pragma once

#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"

namespace thermal {

/// Temperature offset, linear in the sky view, by which a part of the ground is drawn as bare soil with the same
/// apparent temperature.
struct GroundShift {
  double without_sky_k = 0;
  double by_sky_view_k = 0;
};

/// All kinds of ground are drawn as one surface, with the emissivity of bare soil. Higher emissivity looks warmer under
/// a clear sky: grass (0.96) beside soil (0.91) by about 1.5 K.
class SoilAppearance {
 public:
  /// @param reflects  whether surfaces reflect the sky and its obstacles
  SoilAppearance(BandRadiance soil, const BandAir& air, double air_k, bool reflects);

  /// Offset of a part at a temperature [K]: exact at that temperature without sky and with all of it, seen from above.
  /// At a point 10 K warmer or colder, the error is up to 11 K times the difference of the emissivities: 0.5 K for
  /// grass.
  [[nodiscard]] GroundShift shift(const BandRadiance& part, double temperature_k) const;

 private:
  [[nodiscard]] double apparent_k(const BandRadiance& part, double temperature_k, double sky_view) const;

  BandRadiance soil_;
  double air_k_;
  double sky_emissivity_;
  bool reflects_;
};

}  // namespace thermal
