#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/pass_reader.h"
#include "scene/manifest.h"

/// Manifests of passes of 8 x 8 pixels, as make_seeds.py writes them.
inline constexpr int kSidePx = 8;

inline thermal::ManifestObject small_object(std::uint16_t index, const std::string& name,
                                            const std::string& material, const thermal::Colour& colour) {
  thermal::ManifestObject object;
  object.index = index;
  object.name = name;
  object.material = material;
  object.colour = colour;
  return object;
}

inline thermal::Manifest small_manifest() {
  thermal::Manifest manifest;
  manifest.clip = "clip";
  manifest.camera = {
      .width_px = kSidePx, .height_px = kSidePx, .fx_px = 9, .fy_px = 9, .cx_px = 4, .cy_px = 4};
  manifest.objects = {small_object(1, "ground__", "soil", {90, 60, 30}),
                      small_object(4, "shrub", "shrub", {0, 200, 0}),
                      small_object(101, "walker__", "human", {250, 0, 7})};
  manifest.objects[1].mattes = {"shrub*"};
  return manifest;
}

inline thermal::Manifest with_layers(std::string layer, std::string actor_layer) {
  thermal::Manifest manifest = small_manifest();
  manifest.layer = std::move(layer);
  manifest.actor_layer = std::move(actor_layer);
  return manifest;
}

inline thermal::Manifest with_channels() {
  thermal::Manifest manifest = small_manifest();
  manifest.channels = {.object_index = "id", .material_index = "mat", .depth = "far", .normal = "N"};
  return manifest;
}

inline thermal::Manifest with_cryptomatte(std::string name) {
  thermal::Manifest manifest = small_manifest();
  manifest.cryptomatte = std::move(name);
  return manifest;
}

/// Four times as many pixels along each axis: enough for every compression to be effective.
inline thermal::Manifest supersampled() {
  thermal::Manifest manifest = small_manifest();
  manifest.supersample = 4;
  return manifest;
}

/// The number of each is what make_seeds.py appends to a file.
inline std::vector<thermal::Manifest> small_manifests() {
  return {small_manifest(),
          with_layers("Scene", ""),
          with_layers("Scene", "Actors"),
          with_channels(),
          supersampled(),
          with_cryptomatte("CryptoObject"),
          with_cryptomatte("ViewLayer.CryptoMaterial")};
}

/// One reader each. Their limit is far above the size of the seeds, and small enough that planes of that size are
/// cheap.
inline std::vector<thermal::PassReader> readers_of(const std::vector<thermal::Manifest>& manifests) {
  std::vector<thermal::PassReader> readers;
  for (const thermal::Manifest& manifest : manifests)
    readers.emplace_back(manifest, thermal::ReadLimits{.pixels = 1'000'000});
  return readers;
}
