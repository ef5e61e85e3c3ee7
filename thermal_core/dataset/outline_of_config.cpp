#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>

#include "dataset/outline.h"
#include "dataset/outline_parts.h"
#include "io/lens_config.h"

namespace thermal {
namespace {

constexpr double kSquareMetresPerHectare = 1e4;

/// The look angle of a flight below the horizon; an orbit looks at its centre.
double look_angle_deg(const Json& flight) {
  if (flight["pattern"] != "orbit") return flight["look_angle_deg"];
  const double rise_m = std::abs(flight["altitude_m"].get<double>());
  return std::atan2(rise_m, flight["radius_m"].get<double>()) * 180 / std::numbers::pi;
}

struct Cover {
  std::string material;
  double crown_m2;
  double share;  ///< of the ground beneath it, if nothing taller hides it
};

/// Plants in an area or, given three areas, the mean; each covers about the same area.
double mean_per_ha(const Json& per_ha) {
  if (!per_ha.is_array()) return per_ha;
  const auto areas = per_ha.get<std::vector<double>>();
  return std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
}

/// Cover by the plants of `scene.plants`, the widest and therefore tallest first.
std::vector<Cover> plant_covers(const Json& plants, const Path& home) {
  std::vector<Cover> covers;
  for (const auto& [name, wanted] : plants.items()) {
    const Json plant = read_json(home / "assets" / "plants" / (name + ".json"));
    const double crown_m2 = plant.at("cover_m2");
    const double share = mean_per_ha(wanted["per_ha"]) * crown_m2 / kSquareMetresPerHectare;
    covers.push_back({plant.at("material"), crown_m2, std::min(0.9, share)});
  }
  std::ranges::stable_sort(covers, std::ranges::greater(), &Cover::crown_m2);
  return covers;
}

constexpr double kMostBare = 0.9;         // of a place that is all water, rock and road
constexpr double kWetMarginM = 2.5;       // as covers.py lays out the ground
constexpr double kRockOfCrag = 0.6;       // measured: cover of outcrops on the crag
constexpr double kRoadSideLengths = 2.2;  // loop and fork together, relative to the sides of the place

double disc_m2(double radius_m) { return std::numbers::pi * radius_m * radius_m; }

/// Cover of dry soil regardless of plants, as shares of the place.
std::map<std::string, double> bare_shares(const Json& terrain) {
  const double size_m = terrain["size_m"];
  std::map<std::string, double> shares;
  for (const char* key : {"water_radius_m", "pan_radius_m"}) {
    const double radius_m = terrain[key];
    if (radius_m == 0) continue;
    shares["water"] += disc_m2(radius_m) / (size_m * size_m);
    shares["wet_soil"] += (disc_m2(radius_m + kWetMarginM) - disc_m2(radius_m)) / (size_m * size_m);
  }
  if (!terrain.contains("heightmap")) shares["rock"] = kRockOfCrag * terrain["craggy_fraction"].get<double>();
  shares["road"] = kRoadSideLengths * terrain["road"]["width_m"].get<double>() / size_m;
  double sum = 0;
  for (const auto& [name, share] : shares) sum += share;
  const double room = std::min(1.0, kMostBare / sum);
  for (auto& [name, share] : shares) share *= room;
  return shares;
}

void add_ground(const Json& scene, const MaterialLibrary& materials, const Path& home,
                SceneOutline& outline) {
  std::map<std::string, double> shares = bare_shares(scene["terrain"]);
  double open = 1;
  for (const auto& [name, share] : shares) open -= share;
  for (const Cover& cover : plant_covers(scene["plants"], home)) {
    shares[cover.material] += open * cover.share;
    open *= 1 - cover.share;
  }
  const double grass = scene["terrain"]["grass_fraction"];
  shares["soil"] += open * (1 - grass);
  shares["grass"] += open * grass;
  for (const auto& [name, share] : shares) {
    if (share > 0) outline.covers.push_back({.material = &materials.find(name, "scene"), .share = share});
  }
}

}  // namespace

SceneOutline outline_of(const Config& config, const MaterialLibrary& materials, const Path& home) {
  SceneOutline outline = empty_outline(config);
  const Json& document = config.resolved;
  add_ground(document["scene"], materials, home, outline);
  std::set<std::string> actors;
  for (const Json& group : document["scene"]["groups"]) {
    const Path species = home / "assets" / "species" / (group["species"].get<std::string>() + ".json");
    actors.insert(read_json(species).at("material").get<std::string>());
  }
  add_actors(actors, materials, outline);
  const CameraIntrinsics camera = read_intrinsics(document["camera"]);
  Nights nights(config);
  for (const char* flown : {"clips", "flights"}) {
    for (const Json& one : document[flown]) {
      if (!one.contains("flight")) continue;
      nights.add(season_of(one["season"].get<std::string>()), one["flight"]["altitude_m"],
                 look_angle_deg(one["flight"]), camera);
    }
  }
  outline.nights = nights.list();
  return outline;
}

}  // namespace thermal
