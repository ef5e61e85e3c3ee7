#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "imaging/budget.h"
#include "io/config.h"
#include "scene/manifest.h"

namespace thermal {

inline constexpr double kActorShare = 0.03;  ///< of the pictures; *estimate*

/// An empty outline, seen by the config's camera.
[[nodiscard]] SceneOutline empty_outline(const Config& config);

/// Adds the materials of actors, which share kActorShare evenly.
void add_actors(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline);

/// Collects the viewing directions of cameras, by season.
class Nights {
 public:
  explicit Nights(const Config& config) : config_(config) {}

  /// A camera above level ground, `look_angle_deg` below the horizon.
  void add(Season season, double height_m, double look_angle_deg, const CameraIntrinsics& camera);

  /// Other known viewing directions.
  void add(Season season, const std::vector<SceneOutline::Look>& looks);

  [[nodiscard]] std::vector<SceneOutline::Night> list() const;

 private:
  const Config& config_;
  std::map<Season, std::vector<SceneOutline::Look>> looks_;
  std::set<std::tuple<Season, double, double>> seen_;
};

}  // namespace thermal
