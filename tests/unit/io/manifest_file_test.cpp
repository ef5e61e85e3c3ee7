#include "io/manifest_file.h"

#include "base/error.h"
#include "io/json/file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace manifest_file_test {

using namespace thermal;

namespace {

Json example() {
  return parse_json(R"({
    "format": "veldt-passes", "version": 1, "clip": "night_1", "seed": 4294967295, "frame_rate_hz": 5,
    "camera": {"width_px": 64, "height_px": 48, "fx_px": 70.5, "fy_px": 70.5, "cx_px": 32, "cy_px": 24},
    "objects": [
      {"index": 1, "name": "ground", "class": "ground", "material": "soil"},
      {"index": 9, "name": "anna", "class": "actor", "material": "human", "category": "human", "species": "human",
       "track_id": 3, "bounds_m": [[-0.2, -0.3, 0], [0.2, 0.3, 1.8]]}],
    "materials": [{"index": 2, "material": "grass"}],
    "frames": [{"file": "000000.exr", "time_s": 1.5, "agl_m": 61,
                "camera_to_world": [1,0,0,5, 0,1,0,6, 0,0,1,7, 0,0,0,1],
                "actors": [{"index": 9, "position_m": [1, 2, 3], "heading_rad": 0.5}]},
               {"file": "000001.exr"}]})",
                    "");
}

std::string fault_in(const Json& document) {
  const TestFolder folder;
  const Path file = folder.file("manifest.json", document.dump());
  const std::string message = message_of<DataError>([&] { (void)read_manifest(file, kAssets); });
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : "not named: " + message;
}

}  // namespace

TEST_CASE("All fields of a manifest are read") {
  const TestFolder folder;
  const Manifest manifest = read_manifest(folder.file("manifest.json", example().dump()), kAssets);
  CHECK(manifest.clip == "night_1");
  CHECK(manifest.seed == 4294967295);
  CHECK(manifest.frame_rate_hz == 5);
  CHECK(manifest.layer.empty());
  CHECK(manifest.camera.width_px == 64);
  CHECK(manifest.camera.fx_px == 70.5);
  CHECK(manifest.supersample == 1);
  CHECK(manifest.overscan_px == 0);
  REQUIRE(manifest.objects.size() == 2);
  CHECK(manifest.objects[0].object_class == ObjectClass::ground);
  CHECK_FALSE(manifest.objects[0].bounds_m.has_value());
  CHECK(manifest.objects[1].object_class == ObjectClass::actor);
  CHECK(manifest.objects[1].track_id == 3);
  REQUIRE(manifest.objects[1].bounds_m.has_value());
  CHECK((*manifest.objects[1].bounds_m)[1][2] == 1.8);
  CHECK(manifest.materials.at(0).material == "grass");
  REQUIRE(manifest.frames.size() == 2);
  CHECK(manifest.frames[0].time_s == 1.5);
  CHECK(manifest.frames[0].agl_m == 61);
  REQUIRE(manifest.frames[0].camera_to_world.has_value());
  CHECK((*manifest.frames[0].camera_to_world)[7] == 6);
  CHECK(manifest.frames[0].actors.at(0).position_m[2] == 3);
  CHECK_FALSE(manifest.frames[1].agl_m.has_value());
  CHECK(manifest.frames[1].actors.empty());
}

TEST_CASE("Passes can be finer than the camera and extend further") {
  Json document = example();
  document["supersample"] = 2;
  document["overscan_px"] = 12;
  const TestFolder folder;
  const Manifest manifest = read_manifest(folder.file("manifest.json", document.dump()), kAssets);
  CHECK(manifest.supersample == 2);
  CHECK(manifest.overscan_px == 12);
}

TEST_CASE("Passes can follow a lens, whose coefficients are 0 where they are not given") {
  Json document = example();
  const TestFolder folder;
  CHECK(read_manifest(folder.file("pinhole.json", document.dump()), kAssets).lens.is_none());
  document["camera"]["distortion"] = {{"k1", -0.2}, {"p2", 0.001}};
  const Manifest manifest = read_manifest(folder.file("manifest.json", document.dump()), kAssets);
  CHECK(manifest.lens == LensDistortion{.k1 = -0.2, .p2 = 0.001});
}

TEST_CASE("Faults of a manifest are reported with their place") {
  Json document = example();
  SECTION("an index past Blender's largest") {
    document["objects"][0]["index"] = 32768;
    CHECK(fault_in(document) == "objects[0].index = 32768; expected at least 1 and at most 32767");
  }
  SECTION("a track past the largest number, which would become another's") {
    document["objects"][1]["track_id"] = 2147483648;
    CHECK(fault_in(document) ==
          "objects[1].track_id = 2147483648; expected at least 1 and at most 2147483647");
  }
  SECTION("another format") {
    document["format"] = "veldt-dataset";
    CHECK(fault_in(document) == "format = \"veldt-dataset\"; expected veldt-passes");
  }
  SECTION("a file outside its folder") {
    document["frames"][1]["file"] = "../000001.exr";
    CHECK_THAT(fault_in(document), StartsWith("frames[1].file = \"../000001.exr\"; expected "));
  }
  SECTION("a pose that is not a matrix") {
    document["frames"][0]["camera_to_world"] = {1, 2, 3};
    CHECK(fault_in(document) == "frames[0].camera_to_world = a list of 3; expected 16 entries");
  }
  SECTION("an index twice") {
    document["objects"][1]["index"] = 1;
    CHECK(fault_in(document) == "objects[1].index = 1; expected each value once");
  }
}

TEST_CASE("A manifest that is not JSON is a DataError, with line and column") {
  const TestFolder folder;
  const Path file = folder.file("manifest.json", "{\n");
  CHECK_THAT(message_of<DataError>([&] { (void)read_manifest(file, kAssets); }),
             StartsWith(file.string() + ":2:1: not JSON: "));
}

TEST_CASE("A missing manifest cannot be read") {
  CHECK(message_of<IoError>([] { (void)read_manifest("/nowhere/manifest.json", kAssets); }) ==
        "cannot read /nowhere/manifest.json: No such file or directory");
}

TEST_CASE("A written manifest is read back the same") {
  const TestFolder folder;
  Json document = example();
  document["of_flight"] = "north";
  document["layer"] = "Scene";
  document["actor_layer"] = "Actors";
  document["mirror_layer"] = "Mirror";
  document["supersample"] = 2;
  document["overscan_px"] = 3;
  document["camera"]["distortion"] = {{"k1", -0.1}, {"k2", 0.2}, {"p1", 0.03}, {"p2", 0.04}, {"k3", 5}};
  document["scene"] = "valley";
  document["beds"] = {
      {{"place_m", {4, 5}}, {"heading_rad", 0.5}, {"half_m", {0.9, 0.3}}, {"left_s", 300}, {"lain_s", 5400}}};
  document["objects"].push_back(
      {{"index", 90}, {"name", "fire_1"}, {"class", "plant"}, {"material", "fire"}});
  document["objects"].back()["fire"] = {
      {"place_m", {1, -2.5}}, {"diameter_m", 0.6}, {"state", "embers"}, {"since_s", 60}};
  for (Json& object : document["objects"]) {
    if (object["class"] == "actor") {
      object["engine"] = {{"state", "idling"}, {"since_s", 90}};
      object["wet_s"] = 600;
    }
  }
  document["materials"].push_back({{"index", 3}, {"material", "human"}, {"part", "face"}});
  document["frames"][0]["look_angle_deg"] = 1.0 / 3;
  document["frames"][1]["time_s"] = 0;
  document["frames"][1]["actors"] = Json::array();
  const Manifest manifest = read_manifest(folder.file("manifest.json", document.dump()), kAssets);
  const Path copy = folder / "copy.json";
  write_file_atomically(copy, to_text(manifest));
  CHECK(differences(read_json(copy), document).empty());
  CHECK(read_manifest(copy, kAssets).frames.size() == manifest.frames.size());
  CHECK(Json::parse(to_text(Manifest())).at("frames").empty());  // which no schema accepts
}

}  // namespace manifest_file_test
