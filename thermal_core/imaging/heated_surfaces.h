#pragma once

#include <memory>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "imaging/actor_states.h"
#include "imaging/heated_emission.h"
#include "imaging/surfaces.h"
#include "scene/ground_maps.h"
#include "scene/weather.h"

namespace thermal {

/// Inputs of temperatures by the heat balance: the weather's day, and maps of the ground.
struct HeatSettings {
  std::shared_ptr<const HeatOfDay> day;
  std::shared_ptr<const GroundMaps> ground;  ///< null: open level ground everywhere

  [[nodiscard]] bool operator==(const HeatSettings&) const = default;
};

/// Inputs that the passes of a scene provide, and terms that it keeps.
struct SceneHeatTerms {
  bool parts = false;
  bool variation = false;  ///< depths and poses are known
  bool place =
      false;  ///< the same, and maps of the ground; otherwise the ground is open, and leaves are mid-crown
  bool facing = false;  ///< normals and poses are known; otherwise ground faces up, and bodies sideways
};

/// Whether a material is leaves of shrubs or trees, not a cover of the ground.
[[nodiscard]] bool is_crown(const Material& material);

/// The surfaces of a scene and their temperatures at one moment: `middle` of each.
class HeatedSurfaces {
 public:
  /// @param states  of actors at the clip's midpoint, by the class of a surface
  /// @param later_s  offset of the moment from the clip's midpoint, whose weather is given
  HeatedSurfaces(const std::vector<Surface>& surfaces, const std::vector<ActorState>& states,
                 const HeatSettings& settings, const Weather& weather, double later_s,
                 const SceneHeatTerms& terms);

  [[nodiscard]] const HeatOfMoment& moment() const noexcept { return moment_; }
  [[nodiscard]] const std::vector<HeatedSurface>& surfaces() const noexcept { return surfaces_; }

 private:
  [[nodiscard]] HeatedSurface heat_of(const Surface& surface);
  [[nodiscard]] SurfaceExposure open_exposure() const;
  [[nodiscard]] BodyMoment moment_of(const ActorState& actor) const;
  void set(const GroundHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated);
  void set(const LeavesHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated);
  void set(const SlabHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated);
  void set_body(const BodyHeat& body, const BodyMoment& moment, HeatedSurface& heated) const;
  void set_oriented(const Orientation& orientation, HeatedSurface& heated) const;
  void set_cover(const MaterialMoment& by_exposure, HeatedSurface& heated);

  const std::vector<ActorState>& states_;
  const HeatSettings& settings_;
  Weather weather_;
  double later_s_;
  SceneHeatTerms terms_;
  HeatOfMoment moment_;
  std::vector<HeatedSurface> surfaces_;
};

}  // namespace thermal
