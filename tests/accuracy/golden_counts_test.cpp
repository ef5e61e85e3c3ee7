// The 8-bit counts that the script published with AirSim-W (Bondi et al., COMPASS 2018) gives for Table 1.

#include <array>
#include <string>
#include <vector>

#include "imaging/frame_converter.h"
#include "io/config/materials.h"
#include "sensor/thermal_camera.h"
#include "support/assets.h"
#include "support/catch.h"

namespace golden_counts_test {

using namespace thermal;

namespace {

constexpr int kRows = 12;
using Counts = std::array<int, kRows>;

const std::array<std::string, kRows> kTable1 = {"elephant",  "zebra", "rhinoceros", "hippopotamus",
                                                "crocodile", "human", "acacia",     "grass",
                                                "soil",      "shrub", "truck",      "water"};
constexpr std::size_t kTree = 6;

constexpr Counts kWinter = {220, 255, 223, 220, 238, 233, 162, 164, 171, 168, 136, 164};
constexpr Counts kSummer = {218, 255, 221, 218, 235, 234, 200, 201, 177, 207, 168, 201};

/// Twelve objects, one pixel each.
Manifest twelve_objects() {
  Manifest manifest;
  manifest.clip = "table_1";
  manifest.camera.width_px = kRows;
  manifest.camera.height_px = 1;
  for (int i = 0; i < kRows; ++i) {
    ManifestObject object;
    object.index = static_cast<std::uint16_t>(i + 1);
    object.name = object.material = kTable1[static_cast<std::size_t>(i)];
    manifest.objects.push_back(object);
  }
  return manifest;
}

SensorParameters script_parameters(RadianceModel model) {
  SensorParameters parameters;
  parameters.radiance = model;
  parameters.optics.blur_sigma_px = 0;
  parameters.noise.amount = 0;
  parameters.agc.mode = AgcMode::table_max;
  return parameters;
}

/// Counts of Table 1 through the whole chain: manifest, materials, radiance, sensor.
Counts counts_of(RadianceModel model, Season season) {
  const Manifest manifest = twelve_objects();
  const SensorParameters parameters = script_parameters(model);
  const FrameConverter converter(manifest, read_materials(kAssets), season, parameters);
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(kRows, 1);
  for (int i = 0; i < kRows; ++i) passes.object_index.at(i, 0) = static_cast<std::uint16_t>(i + 1);
  ThermalCamera sensor(parameters, {.id = manifest.clip, .width_px = kRows, .height_px = 1, .noise_gain = {}},
                       converter.brightest_w_m2_sr());
  const SensorFrame frame = sensor.expose(converter.convert(passes).radiance_w_m2_sr);
  Counts counts{};
  for (int i = 0; i < kRows; ++i) counts[static_cast<std::size_t>(i)] = frame.ir8.at(i, 0);
  return counts;
}

}  // namespace

TEST_CASE("All 24 counts of the published script come out of the real chain") {
  CHECK(counts_of(RadianceModel::script, Season::winter) == kWinter);
  CHECK(counts_of(RadianceModel::script, Season::summer) == kSummer);
}

TEST_CASE("Planck's law instead of the script's sum changes one count: the tree in winter") {
  Counts winter = kWinter;
  winter[kTree] = 163;
  CHECK(counts_of(RadianceModel::exact, Season::winter) == winter);
  CHECK(counts_of(RadianceModel::exact, Season::summer) == kSummer);
}

}  // namespace golden_counts_test
