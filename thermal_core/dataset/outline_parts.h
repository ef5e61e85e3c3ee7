#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "imaging/budget.h"
#include "io/config.h"

namespace thermal {

inline constexpr double kActorShare = 0.03;  ///< of the pictures; *estimate*

/// An outline of nothing, seen by the config's camera.
[[nodiscard]] SceneOutline empty_outline(const Config& config);

/// Adds the materials of actors, which share kActorShare evenly.
void add_actors(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline);

/// Collects the directions in which cameras look, by season.
class Nights {
 public:
  explicit Nights(const Config& config) : config_(config) {}

  /// A camera above level ground, `look_angle_deg` below the horizon; halves of its picture are at depth 1.
  void add(Season season, double height_m, double look_angle_deg, double half_width, double half_height);

  /// Whatever else is known of where one looks.
  void add(Season season, const std::vector<SceneOutline::Look>& looks);

  [[nodiscard]] std::vector<SceneOutline::Night> list() const;

 private:
  const Config& config_;
  std::map<Season, std::vector<SceneOutline::Look>> looks_;
  std::set<std::tuple<Season, double, double>> seen_;
};

}  // namespace thermal
