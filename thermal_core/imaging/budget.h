#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "radiometry/spectral_response.h"
#include "scene/material.h"
#include "scene/terms.h"
#include "scene/weather.h"

namespace thermal {

/// Contents of a dataset's pictures, as far as known before rendering.
struct SceneOutline {
  /// A material and the fraction of the pictures it fills.
  struct Cover {
    const Material* material = nullptr;
    double share = 0;
    bool actor = false;
  };
  /// A viewing direction: distance of the ground, angle of incidence on it, angle off the optical axis.
  struct ViewDirection {
    double range_m = 0;
    double ground_cosine = 1;
    double axis_cosine = 1;
  };
  /// Shift of a surface's temperature at a kind of exposure, and the share of the surface with it.
  struct ExposureShift {
    double shift_k = 0;
    double share = 0;
  };
  /// Clips under one weather, seen with one spectral response.
  struct Conditions {
    Weather weather;
    std::optional<SpectralResponse> response = {};  ///< empty: the outline's
    std::vector<ViewDirection>
        view_directions;  ///< empty: viewing directions are unknown; terms that depend on them have no effect
    /// Temperatures by the heat balance, by material and part ("" is the whole); others are on Table 1's line.
    std::map<std::string, std::map<std::string, double>> heated_k = {};
    std::map<std::string, std::vector<ExposureShift>> by_exposure = {};  ///< by material; see heat_night()
    std::map<std::string, std::vector<ExposureShift>> facing = {};

    [[nodiscard]] double temperature_k(const Material& material, const std::string& part) const;
  };

  std::vector<Cover> covers;
  std::vector<Conditions> conditions;
  SpectralResponse response = SpectralResponse::flat(8, 14);
  double netd_k = 0.04;
  double smear_px = 0;  ///< motion of the picture within the sensor's time constant, for the fastest clip
  std::map<std::string, std::string> impossible = {};  ///< by term: inputs of the term that are missing
};

/// Effect of one term on apparent temperature.
struct TermEffect {
  std::string name;
  TermChoice choice = TermChoice::automatic;
  double spread_k = 0;  ///< 5th to 95th percentile of its shift over the pictures, under the worst conditions
  double actor_shift_k = 0;  ///< its largest shift of an actor
  bool kept = false;
  std::string impossible = {};  ///< missing input; empty: the term is possible
};

/// The effect of each term, and which terms are kept.
struct Budget {
  std::vector<TermEffect> effects;  ///< in the order of kTerms
  Terms kept;
  double dropped_k = 0;  ///< sum of the spreads of dropped terms
};

/// Decides which terms a scene needs: an automatic term is kept if its effect varies across the pictures by more than a
/// third of the NETD; dropping less than that adds at most 5 % to the noise in quadrature. Percentiles are over all
/// pixels; for `parts` over the actors, for `facing` over actors or the rest, whichever differ more, for `mirror` over
/// the water. Shifts of emission and reflection are relative to the terms before them in kTerms, with level surfaces
/// under an open sky. `smear` counts at borders, of actors alone or of all: half of their pixels differ by the contrast
/// to the mean ground times the motion in px within a time constant, at most 1. A border loses that on one side and
/// gains it on the other; it counts once. An impossible term is dropped if it is automatic; ConfigError if the config
/// requires it.
[[nodiscard]] Budget weigh_terms(const SceneOutline& outline, const TermChoices& choices);

/// The same for several choices, in their order; the effects are computed once.
[[nodiscard]] std::vector<Budget> weigh_terms(const SceneOutline& outline,
                                              const std::vector<TermChoices>& choices);

/// Shift of a material's apparent temperature by sky reflection, and by the path on top of it [K], part of which is due
/// to the inversion; level surface under an open sky, seen from straight above.
struct MaterialShift {
  double sky_k = 0;
  double path_k = 0;
  double inversion_k = 0;
};
/// The shifts of a material at a distance of range_m.
[[nodiscard]] MaterialShift shift_of(const Material& material, const SceneOutline::Conditions& viewing,
                                     double range_m, const SpectralResponse& response);

}  // namespace thermal
