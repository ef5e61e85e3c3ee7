#pragma once

#include <vector>

#include "radiometry/atmosphere.h"
#include "radiometry/spectral_response.h"

namespace thermal {

/// Sky and path of one state of the air as a camera's response sees them: means over wavelength, weighted with the
/// response times Planck's law at the air's temperature for the sky, and times its derivative with temperature for
/// the path. A path takes away contrast with the air; weighted by that, what it leaves of a surface is right to first
/// order in the difference between surface and air.
///
/// Optical depth against wavelength, in steps of 0.1 um from 7 to 14.5 um, is the water vapour's continuum (Roberts,
/// Selby and Biberman, Appl. Opt. 15, 2085, 1976), plus tables of the lines of water vapour and of the other gases
/// (spectral_air.cpp). One factor per case scales it until the band that a published figure was made for has that
/// figure: clear_zenith_emissivity() and clear_sky_emissivity() in 8-14 um, path_transmittance() in 7.5-14 um at each
/// range from 30 m. So the published figures set how much is absorbed, the spectrum only where. Beyond the tables'
/// ends depths are those of the ends: right where water vapour and carbon dioxide are opaque, far too large for the
/// window at 3 to 5 um.
///
/// Against how LOWTRAN 7 splits the same figures: for flat responses 6 um wide, the sky within .01 of emissivity at
/// the zenith and .02 at 15 deg, the path within .005 of transmittance at 122 m and .014 at 1000 m; for bands of 1 to
/// 2 um, the sky within .11 and .15, the path within .007 and .075.
class BandAir {
 public:
  BandAir(const Air& air, const SpectralResponse& response);

  /// Emissivity of the sky over the hemisphere, as a diffuse surface sees it, with clouds: they close 84 % of the gap
  /// to a blackbody (published 78 to 90 %), at all wavelengths.
  [[nodiscard]] double sky_emissivity() const noexcept;

  /// Emissivity of the sky in one direction, by the cosine to the zenith: seen through a path longer by the secant. A
  /// cosine below 0.05, 3 deg above the horizon, where no plane's secant holds, counts as 0.05; NaN too.
  [[nodiscard]] double sky_emissivity(double cosine) const noexcept;

  /// Transmittance of a level path. Beer's law below 30 m, because the published fit has an infinite slope at 0. The
  /// range is clamped to [0, 1000] m; NaN counts as 1000 m.
  [[nodiscard]] double path_transmittance(double range_m) const noexcept;

  /// 1 minus the mean of path_transmittance() over a path from the camera to `range_m`; 0 at a range of 0, NaN and
  /// infinity count as 1000 m, as there. Under an inversion the air's temperature rises linearly in height (an
  /// estimate; measured inversions are steeper near the ground), hence linearly along any straight path from what
  /// stands near the ground up to the camera. The path then radiates more than air of the ground's temperature by
  /// this share of the difference between blackbodies at the camera's and at the ground's air: the integral of (1 - r
  /// / range) d(1 - transmittance). Relative error below 1e-8.
  [[nodiscard]] double mean_path_absorption(double range_m) const noexcept;

 private:
  /// A piece of a band: its weight in the mean, and its optical depth.
  struct Cell {
    double share = 0;
    double at_um = 0;
    double depth = 0;
  };
  using Cells = std::vector<Cell>;
  enum class Weighting { radiance, contrast };

  [[nodiscard]] static Cells cells_of(const SpectralResponse& response, double air_k, Weighting weighting);
  [[nodiscard]] static Cells path_cells(const SpectralResponse& response, const Air& air);
  [[nodiscard]] static double transmitted(const Cells& cells, double factor) noexcept;
  [[nodiscard]] static double factor_of(const Cells& cells, double goal) noexcept;
  [[nodiscard]] double far_transmittance(double range_m) const noexcept;

  Air air_;
  Cells sky_;                      ///< of the response; depths of the zenith
  Cells path_;                     ///< of the response; depths of a metre, not scaled
  Cells published_path_;           ///< of the band of the path's figure
  double hemisphere_ = 1;          ///< length of the path to the whole sky over that to the zenith
  double near_transmittance_ = 1;  ///< where Beer's law ends
};

}  // namespace thermal
