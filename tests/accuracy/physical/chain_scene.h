#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "accuracy/physical/assets.h"
#include "imaging/scene_radiance.h"

/// A small synthetic picture with everything that the terms act on: ground of several kinds, still water, a person
/// with a face, a truck with a warm hood, sky, at irregular ranges and angles.
namespace chain_scene {

inline constexpr int kWidth = 48;
inline constexpr int kHeight = 40;
inline constexpr double kFocalPx = 60;

enum Object : std::uint16_t { kSky, kSoil, kGrass, kWater, kSand, kHuman, kTruck, kObjects };
enum Part : std::uint16_t { kNoPart, kFace, kHood };

/// Materials from assets, and sand that is dark below 9.4 um and varies in temperature.
inline const thermal::MaterialLibrary& library() {
  static const thermal::MaterialLibrary kAll = [] {
    thermal::MaterialLibrary result;
    for (const auto& [name, one] : materials().all()) result.add(one);
    thermal::Material sand = material("soil");
    sand.name = "sand";
    sand.spectrum = quartz();
    result.add(sand);
    return result;
  }();
  return kAll;
}

inline thermal::ManifestObject object(Object index, const std::string& name, bool actor = false) {
  thermal::ManifestObject result;
  result.index = index;
  result.name = name;
  result.material = name;
  if (!actor) return result;
  result.object_class = thermal::ObjectClass::actor;
  result.category = name;
  result.track_id = index;
  return result;
}

/// Rows of a rotation to the world from a camera that looks down by an angle, and to the left by another.
inline std::array<double, 16> camera_to_world(double down_rad, double left_rad,
                                              std::array<double, 3> position_m) {
  const double cd = std::cos(down_rad);
  const double sd = std::sin(down_rad);
  const double cl = std::cos(left_rad);
  const double sl = std::sin(left_rad);
  // Columns: the camera's right, down and forward in the world, z up.
  return {sl,  -cl * sd, cl * cd, position_m[0],  //
          -cl, -sl * sd, sl * cd, position_m[1],  //
          0,   -cd,      -sd,     position_m[2],  //
          0,   0,        0,       1};
}

inline thermal::Manifest manifest() {
  thermal::Manifest result;
  result.camera = {kWidth, kHeight, kFocalPx, kFocalPx, kWidth / 2.0, kHeight / 2.0};
  result.objects = {object(kSoil, "soil"), object(kGrass, "grass"),       object(kWater, "water"),
                    object(kSand, "sand"), object(kHuman, "human", true), object(kTruck, "truck", true)};
  result.materials = {{kFace, "human", "face"}, {kHood, "truck", "hood"}};
  result.frames.resize(1);
  result.frames[0].camera_to_world = camera_to_world(0.9, 0.3, {12.5, -7.25, 61});
  return result;
}

/// Uniform passes: one object, at a depth, with a normal.
inline thermal::Passes uniform_passes(int width, int height, std::uint16_t object, float depth_m,
                                      std::array<float, 3> normal) {
  thermal::Passes passes;
  passes.object_index = {width, height, object};
  passes.depth_m = {width, height, depth_m};
  for (std::size_t axis = 0; axis < 3; ++axis) passes.normal.at(axis) = {width, height, normal.at(axis)};
  return passes;
}

/// The synthetic picture: every pixel drawn independently.
inline thermal::Passes passes() {
  thermal::Passes result = uniform_passes(kWidth, kHeight, kSky, 1e10F, {0, 0, 0});
  result.material_index = {kWidth, kHeight, kNoPart};
  std::mt19937 generator(20);  // the standard specifies its numbers
  const auto draw = [&generator] { return static_cast<double>(generator()) / 4294967296.0; };
  for (std::size_t i = 0; i < result.object_index.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(draw() * static_cast<int>(kObjects));
    const bool has_part = draw() < 0.5;
    const double depth_m = 2 + 200 * draw();
    const double up = draw();  // any direction of the upper half
    const double around = 2 * std::numbers::pi * draw();
    result.object_index.pixels()[i] = index;
    if (index == kSky) continue;
    if (has_part && index == kHuman) result.material_index.pixels()[i] = kFace;
    if (has_part && index == kTruck) result.material_index.pixels()[i] = kHood;
    result.depth_m.pixels()[i] = static_cast<float>(depth_m);
    const double level = std::sqrt(1 - up * up);
    result.normal[0].pixels()[i] = static_cast<float>(level * std::cos(around));
    result.normal[1].pixels()[i] = static_cast<float>(level * std::sin(around));
    result.normal[2].pixels()[i] = static_cast<float>(up);
  }
  return result;
}

inline thermal::PhysicsSettings settings(const thermal::Terms& terms) {
  thermal::PhysicsSettings result;
  result.terms = terms;
  result.weather = {.air = {281.5, 0.55, 0.2}, .vehicle_stopped_s = 1800};
  result.response = response("vox_germanium");
  result.seed = 11;
  return result;
}

inline thermal::Plane<float> radiance(const thermal::Terms& terms, const thermal::Passes& from = passes(),
                                      const thermal::Manifest& described = manifest()) {
  return thermal::SceneRadiance(described, library(), settings(terms)).radiance(from, described.frames[0]);
}

inline constexpr thermal::Terms kAllTerms = [] {
  thermal::Terms terms;
  for (const thermal::TermInfo& term : thermal::kTerms) terms.*term.kept = true;
  return terms;
}();

}  // namespace chain_scene
