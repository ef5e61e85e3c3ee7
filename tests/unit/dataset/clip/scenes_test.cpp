#include "dataset/clip/scenes.h"

#include <functional>

#include "io/config/materials.h"
#include "io/manifest_file.h"
#include "io/pass_reader.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/own_settings.h"
#include "support/test_folder.h"
#include "support/tiny_clip.h"

namespace clip_scenes_test {

using namespace thermal;

namespace {

/// A clip's passes, and scenes to be made of them.
struct Clip {
  TestFolder folder;
  Path passes = tiny_clip::write(folder / "passes", "a");
  Manifest manifest = read_manifest(passes / "manifest.json", kAssets);
  MaterialLibrary materials = read_materials(kAssets);
  ClipScenes scenes{manifest, materials};
};

std::size_t scenes_of(const std::vector<ClipTask>& tasks) {
  Clip clip;
  for (const ClipTask& task : tasks) (void)clip.scenes.add(task);
  return clip.scenes.size();
}

/// Tasks that are the same before the sensor, which differs in everything possible.
std::vector<ClipTask> tasks_of_one_scene() {
  std::vector<ClipTask> tasks(3);
  tasks[1].seed = 7;
  own_settings(tasks[1]).sensor.optics.blur_sigma_px = 0;
  own_settings(tasks[1]).sensor.noise.amount = 0;
  own_settings(tasks[2]).labels.ignore_below_area_px = 9;
  own_settings(tasks[2]).sensor.netd_mk = 200;
  own_settings(tasks[2]).sensor.agc.mode = AgcMode::plateau;
  own_settings(tasks[2]).sensor.shutter.interval_s = 0.2;
  return tasks;
}

}  // namespace

TEST_CASE(
    "Tasks that differ in the sensor alone have one scene, those that differ in anything else their own") {
  CHECK(scenes_of(tasks_of_one_scene()) == 1);
  const auto own = [](const std::function<void(ClipTask&)>& change) {
    ClipTask physical;
    physical.physics.emplace();
    ClipTask changed = physical;
    change(changed);
    return scenes_of({physical, changed, physical}) == 2;
  };
  CHECK_FALSE(own([](ClipTask&) {}));
  CHECK(own([](ClipTask& task) { task.clip.season = Season::summer; }));
  CHECK(own([](ClipTask& task) { own_settings(task).sensor.response = SpectralResponse::flat(7.5, 14); }));
  CHECK(own([](ClipTask& task) { own_settings(task).sensor.radiance = RadianceModel::script; }));
  CHECK(own([](ClipTask& task) { own_settings(task).sensor.agc.mode = AgcMode::table_max; }));
  CHECK(own([](ClipTask& task) { task.physics.reset(); }));
  CHECK(own([](ClipTask& task) { task.physics->seed = 2; }));
  CHECK(own([](ClipTask& task) { task.physics->response = SpectralResponse({{8, 1}, {14, 0.5}}); }));
  CHECK(own([](ClipTask& task) { task.physics->weather.vehicle_stopped_s = 60; }));
  CHECK(own([](ClipTask& task) { task.physics->weather.air.temperature_k = 280; }));
  CHECK(own([](ClipTask& task) { task.physics->weather.air.relative_humidity = 0.2; }));
  CHECK(own([](ClipTask& task) { task.physics->weather.air.cloud_fraction = 0.5; }));
  for (const TermInfo& term : kTerms) {
    CAPTURE(term.name);
    if (term.name == "variation" || term.name == "sky" || term.name == "angular") continue;  // need poses
    CHECK(own([&](ClipTask& task) { task.physics->terms.*term.kept = true; }));
  }
}

TEST_CASE("Scenes are shared only if all their settings are equal, including lens and terms") {
  const SceneSettings settings = scene_settings(Season::winter, {}, PhysicsSettings());
  for (double LensDistortion::*part : {&LensDistortion::k1, &LensDistortion::k2, &LensDistortion::p1,
                                       &LensDistortion::p2, &LensDistortion::k3}) {
    SceneSettings bent = settings;
    bent.lens.*part = 0.01;
    CHECK_FALSE(bent == settings);
    CHECK_FALSE(scene_settings(Season::winter, {}, PhysicsSettings(), bent.lens) == settings);
  }
  for (const TermInfo& term : kTerms) {
    CAPTURE(term.name);
    SceneSettings other = settings;
    other.physics->terms.*term.kept = true;
    CHECK_FALSE(other == settings);
  }
}

TEST_CASE("A frame of a scene is converted once, whichever tasks share it") {
  Clip clip;
  ClipScenes& scenes = clip.scenes;
  for (const ClipTask& task : tasks_of_one_scene()) CHECK(scenes.add(task) == 0);
  ClipTask summer;
  summer.clip.season = Season::summer;
  CHECK(scenes.add(summer) == 1);
  std::vector<SceneFrame> frames;
  scenes.convert(PassReader(clip.manifest).read(clip.passes / tiny_clip::file_name(0), scenes.needs()), 0,
                 frames);
  CHECK(frames.size() == 2);
  CHECK(frames[0].radiance_w_m2_sr.at(5, 5) < frames[1].radiance_w_m2_sr.at(5, 5));  // a warmer night
  CHECK(scenes.temperatures(SpectralResponse::flat(8, 14)) ==
        scenes.temperatures(SpectralResponse::flat(8, 14)));
  CHECK(scenes.temperatures(SpectralResponse::flat(8, 14)) !=
        scenes.temperatures(SpectralResponse::flat(8, 13)));
}

}  // namespace clip_scenes_test
