#pragma once

#include <map>
#include <string>
#include <vector>

#include "radiometry/spectral_response.h"
#include "scene/material.h"
#include "scene/terms.h"
#include "scene/weather.h"

namespace thermal {

/// What a dataset's pictures will hold, as far as it is known before rendering.
struct SceneOutline {
  /// A material and the share of the pictures it fills.
  struct Cover {
    const Material* material = nullptr;
    double share = 0;
    bool actor = false;
  };
  /// A direction the camera looks in: how far the ground is, how steeply it is seen, how far off the axis.
  struct Look {
    double range_m = 0;
    double ground_cosine = 1;
    double axis_cosine = 1;
  };
  /// One season's flights.
  struct Night {
    Weather weather;
    std::vector<Look>
        looks;  ///< empty: nobody knows where it looks; terms that depend on it then weigh nothing
  };

  std::vector<Cover> covers;
  std::vector<Night> nights;
  SpectralResponse response = SpectralResponse::flat(8, 14);
  double netd_k = 0.04;
  std::map<std::string, std::string> impossible = {};  ///< by term: what there is not that it draws on
};

/// What one term does to apparent temperature.
struct TermEffect {
  std::string name;
  TermChoice choice = TermChoice::automatic;
  double spread_k = 0;       ///< 5th to 95th percentile of its shift over the pictures; the worst night's
  double actor_shift_k = 0;  ///< its largest shift of an actor
  bool kept = false;
  std::string impossible = {};  ///< what it lacks; empty: it can be had
};

struct Budget {
  std::vector<TermEffect> effects;  ///< in the order of kTerms
  Terms kept;
  double dropped_k = 0;  ///< spreads of what was dropped, added up
};

/// Decides which terms a scene needs: an automatic one is kept if what it changes differs across the pictures by
/// more than a third of the NETD, which adds at most 5 % to the noise in quadrature. Percentiles are over what
/// fills the pictures; for `parts` over the actors. Shifts of emission and reflection are against what comes
/// before them in kTerms, surfaces level and under an open sky. An automatic term that is impossible is dropped;
/// ConfigError if one is asked for.
[[nodiscard]] Budget weigh_terms(const SceneOutline& outline, const TermChoices& choices);

/// Shift of a material's apparent temperature by sky reflection, and by the path on top of it [K]; level surface
/// under an open sky, seen straight down.
struct MaterialShift {
  double sky_k = 0;
  double path_k = 0;
};
[[nodiscard]] MaterialShift shift_of(const Material& material, const Weather& weather, double range_m,
                                     const SpectralResponse& response);

}  // namespace thermal
