#include "imaging/frame_converter.h"

#include "base/error.h"
#include "sensor/thermal_camera.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace frame_converter_test {

using namespace thermal;

namespace {

Material material_of(const std::string& name, double winter_k, bool in_table_1 = false) {
  Material material;
  material.name = name;
  material.emissivity = 0.5;
  material.winter_k = winter_k;
  material.summer_k = 2 * winter_k;
  material.in_table_1 = in_table_1;
  return material;
}

MaterialLibrary materials() {
  MaterialLibrary library;
  library.add(material_of("sky", 10));
  library.add(material_of("soil", 100, true));
  library.add(material_of("grass", 200));
  library.add(material_of("human", 300));
  library.add(material_of("lava", 900, true));
  return library;
}

/// Soil that is grass where the material plane says so, and a person.
Manifest manifest() {
  Manifest result;
  result.objects.resize(2);
  result.objects[0].index = 1;
  result.objects[0].name = "ground";
  result.objects[0].material = "soil";
  result.objects[1].index = 7;
  result.objects[1].name = "anna";
  result.objects[1].material = "human";
  result.objects[1].object_class = ObjectClass::actor;
  result.materials = {{4, "grass", ""}};
  return result;
}

Passes passes_of(const std::vector<std::uint16_t>& objects,
                 const std::vector<std::uint16_t>& material_plane = {}) {
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(static_cast<int>(objects.size()), 1);
  std::copy(objects.begin(), objects.end(), passes.object_index.pixels().begin());
  if (material_plane.empty()) return passes;
  passes.material_index = Plane<std::uint16_t>(static_cast<int>(objects.size()), 1);
  std::copy(material_plane.begin(), material_plane.end(), passes.material_index.pixels().begin());
  return passes;
}

FrameConverter converter(Season season = Season::winter, AgcMode mode = AgcMode::scene_max) {
  SensorParameters parameters;
  parameters.agc.mode = mode;
  return FrameConverter(manifest(), materials(), season, parameters);
}

/// The published model's radiance of a material: emissivity times the band's radiance, in single precision.
float radiance_at(double temperature_k) {
  return static_cast<float>(0.5 * radiance_of(SensorParameters())(temperature_k));
}

std::vector<float> radiances(const FrameConverter& used, const Passes& passes) {
  const Plane<float> plane = used.convert(passes).radiance_w_m2_sr;
  return {plane.pixels().begin(), plane.pixels().end()};
}

}  // namespace

TEST_CASE("A pixel has the radiance of its object's material, index 0 of the sky") {
  CHECK(radiances(converter(), passes_of({0, 1, 7})) ==
        std::vector<float>{radiance_at(10), radiance_at(100), radiance_at(300)});
}

TEST_CASE("In summer it has the summer temperature") {
  CHECK(radiances(converter(Season::summer), passes_of({1, 7})) ==
        std::vector<float>{radiance_at(200), radiance_at(600)});
}

TEST_CASE("The material plane overrides the object, except where it is 0") {
  CHECK(radiances(converter(), passes_of({1, 1, 7, 0}, {0, 4, 4, 4})) ==
        std::vector<float>{radiance_at(100), radiance_at(200), radiance_at(200), radiance_at(200)});
}

TEST_CASE("The brightest count is the brightest surface of the manifest, or of Table 1") {
  CHECK(converter().brightest_w_m2_sr() == radiance_at(300));
  CHECK(converter(Season::winter, AgcMode::table_max).brightest_w_m2_sr() == radiance_at(900));
}

TEST_CASE("Only actors are labelled") {
  const SceneFrame frame = converter().convert(passes_of({1, 7, 7, 0}));
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].index == 7);
  CHECK(frame.instances[0].area_px == 2);
}

TEST_CASE("Actors alone are needed if the manifest names their layer") {
  CHECK_FALSE(converter().needs().actors);
  Manifest layered = manifest();
  layered.actor_layer = "Actors";
  layered.camera = {.width_px = 3, .height_px = 1, .fx_px = 1, .fy_px = 1, .cx_px = 1.5, .cy_px = 0.5};
  const FrameConverter used(layered, materials(), Season::winter, SensorParameters());
  CHECK(used.needs().actors);
  Passes passes = passes_of({1, 7, 1});
  passes.actor_index = passes_of({0, 7, 7}).object_index;
  CHECK(used.convert(passes).instances.at(0).visibility == 0.5);
}

TEST_CASE("An index missing from the manifest is an error with place, number and the known ones") {
  CHECK(message_of<DataError>([] {
          (void)converter().convert(passes_of({1, 0, 5, 5}));
        }) ==
        "object index at pixel (2, 0) = 5 (2 pixels); expected an index of the manifest's objects: 0, 1, 7");
  CHECK(message_of<DataError>([] {
          (void)converter().convert(passes_of({1, 1, 1}, {4, 9, 0}));
        }) ==
        "material index at pixel (1, 0) = 9 (1 pixels); expected an index of the manifest's materials: 0, 4");
}

TEST_CASE("A material missing from the library is an error with its object") {
  const auto fault_in = [](const Manifest& wrong) {
    return message_of<ConfigError>(
        [&] { (void)FrameConverter(wrong, materials(), Season::winter, SensorParameters()); });
  };
  Manifest wrong_object = manifest();
  wrong_object.objects[1].material = "humn";
  CHECK(fault_in(wrong_object) ==
        "object anna: material = \"humn\"; expected one of grass, human, lava, sky, "
        "soil; did you mean \"human\"?");
  Manifest wrong_material = manifest();
  wrong_material.materials[0].material = "marble";
  CHECK(fault_in(wrong_material) ==
        "material index 4 = \"marble\"; expected one of grass, human, lava, sky, soil");
}

TEST_CASE("A finer frame is converted first and averaged afterwards") {
  Manifest finer = manifest();
  finer.supersample = 2;
  const FrameConverter used(finer, materials(), Season::winter, SensorParameters());
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(4, 2, 1);
  passes.object_index.at(0, 0) = passes.object_index.at(1, 1) = 7;  // half of the left block
  passes.object_index.at(2, 0) = 7;                                 // a quarter of the right one
  const SceneFrame frame = used.convert(passes);
  REQUIRE(frame.radiance_w_m2_sr.width_px() == 2);
  REQUIRE(frame.radiance_w_m2_sr.height_px() == 1);
  // Sums of four single-precision values, and a division: 4 roundings of 6e-8.
  const auto soil = static_cast<double>(radiance_at(100));
  const auto human = static_cast<double>(radiance_at(300));
  CHECK_THAT(static_cast<double>(frame.radiance_w_m2_sr.at(0, 0)), WithinRel((soil + human) / 2, 4 * 6e-8));
  CHECK_THAT(static_cast<double>(frame.radiance_w_m2_sr.at(1, 0)),
             WithinRel((3 * soil + human) / 4, 4 * 6e-8));
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].box == PixelBox{0, 0, 1, 1});  // half of a pixel is labelled, a quarter is not
}

namespace {

/// Passes of 6 x 5 px around a picture of 4 x 3 px: soil, and a person in the two columns from `left` on.
Passes wide_passes(int left) {
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(6, 5, 1);
  for (int y = 0; y < 5; ++y) passes.object_index.at(left, y) = passes.object_index.at(left + 1, y) = 7;
  return passes;
}

Manifest wide_manifest() {
  Manifest result = manifest();
  result.clip = "night";
  result.camera = {.width_px = 4, .height_px = 3, .fx_px = 4, .fy_px = 4, .cx_px = 2, .cy_px = 1.5};
  result.overscan_px = 1;
  return result;
}

FrameConverter wide_converter(const Manifest& used, const LensDistortion& lens = {}) {
  return FrameConverter(used, materials(), Season::winter, SensorParameters(), {}, lens);
}

}  // namespace

TEST_CASE("Overscan is cropped, from radiance and labels alike") {
  const SceneFrame frame = wide_converter(wide_manifest()).convert(wide_passes(0));
  REQUIRE(frame.radiance_w_m2_sr.width_px() == 4);
  REQUIRE(frame.radiance_w_m2_sr.height_px() == 3);
  CHECK(frame.radiance_w_m2_sr.at(0, 0) == radiance_at(300));
  CHECK(frame.radiance_w_m2_sr.at(1, 0) == radiance_at(100));
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].box == PixelBox{0, 0, 1, 3});
  CHECK(frame.instances[0].truncated);
  CHECK(wide_converter(wide_manifest()).convert(wide_passes(2)).instances[0].box == PixelBox{1, 0, 2, 3});
  Passes outside = wide_passes(2);
  outside.object_index = Plane<std::uint16_t>(6, 5, 1);
  outside.object_index.at(0, 2) = 7;
  CHECK(wide_converter(wide_manifest()).convert(outside).instances.empty());
}

TEST_CASE("Overscan counts in the camera's pixels, however fine the passes are") {
  Manifest finer = wide_manifest();
  finer.supersample = 2;
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(12, 10, 1);
  for (int i = 0; i < 4; ++i) passes.object_index.at(4 + i % 2, 6 + i / 2) = 7;  // the picture's pixel (1, 2)
  const SceneFrame frame = wide_converter(finer).convert(passes);
  REQUIRE(frame.radiance_w_m2_sr.width_px() == 4);
  REQUIRE(frame.radiance_w_m2_sr.height_px() == 3);
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].box == PixelBox{1, 2, 1, 1});
  // A mean of four equal values: three sums and a product.
  CHECK_THAT(static_cast<double>(frame.radiance_w_m2_sr.at(1, 2)),
             WithinRel(static_cast<double>(radiance_at(300)), 4 * 6e-8));
}

TEST_CASE("Labels are distorted with the picture") {
  // The outer pixels' centres are 2.5 px from the axis, x = 0.625. 0.875 (1 + k1 0.875^2) = 0.625 for this k1: they
  // show what lies 3.5 px away, in the overscan. Their neighbours, at 1.5 px, show what lies at 1.59 px: soil.
  const LensDistortion lens = {.k1 = (0.625 / 0.875 - 1) / (0.875 * 0.875)};
  Manifest used = wide_manifest();
  used.camera = {.width_px = 6, .height_px = 1, .fx_px = 4, .fy_px = 4, .cx_px = 3, .cy_px = 0.5};
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(8, 3, 1);
  passes.object_index.at(0, 1) = 7;
  const SceneFrame frame = wide_converter(used, lens).convert(passes);
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].box == PixelBox{0, 0, 1, 1});
  CHECK(frame.instances[0].truncated);
  // The source is the pixel's centre within about 1e-15 px, which is 0 in single precision.
  CHECK_THAT(static_cast<double>(frame.radiance_w_m2_sr.at(0, 0)),
             WithinRel(static_cast<double>(radiance_at(300)), 6e-8));
  CHECK(frame.radiance_w_m2_sr.at(1, 0) == radiance_at(100));
  // In the actor layer the person is also in the picture's last pixel, which is in the last column of the passes.
  passes.actor_index = Plane<std::uint16_t>(8, 3);
  passes.actor_index.at(0, 1) = passes.actor_index.at(7, 1) = 7;
  passes.actor_index.at(1, 1) = 7;  // outside the picture
  CHECK(wide_converter(used, lens).convert(passes).instances.at(0).visibility == 0.5);
}

TEST_CASE("Passes with too little overscan for the lens are an error with the needed amount") {
  CHECK(message_of<ConfigError>([] {
          Manifest narrow = wide_manifest();
          narrow.camera = {
              .width_px = 201, .height_px = 1, .fx_px = 100, .fy_px = 100, .cx_px = 100.5, .cy_px = 0.5};
          (void)wide_converter(narrow, {.k1 = -0.128});
        }) ==
        "clip night: overscan_px = 1 px; expected at least 25 px for this lens distortion "
        "(render.overscan_px), or a "
        "manifest whose camera is smaller than its passes");
}

namespace {

/// Passes of a surface 50 m before the camera, square to its axis, whose normals lean.
Passes slope_passes(int width_px, int height_px) {
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(width_px, height_px, 1);
  passes.depth_m = Plane<float>(width_px, height_px, 50);
  passes.normal = {Plane<float>(width_px, height_px, 0.6F), Plane<float>(width_px, height_px, 0),
                   Plane<float>(width_px, height_px, 0.8F)};
  return passes;
}

float slope_radiance(const CameraIntrinsics& camera, const LensDistortion& lens, int x_px, int y_px) {
  Manifest used = manifest();
  used.camera = camera;
  used.lens = lens;
  used.frames.emplace_back().camera_to_world = {1, 0, 0, 0, 0, -0.6, 0.8, 0, 0, -0.8, -0.6, 50, 0, 0, 0, 1};
  const PhysicsSettings physics = {.terms = {.variation = true, .sky = true, .angular = true, .path = true},
                                   .weather = weather_of(Season::winter),
                                   .response = SpectralResponse::flat(8, 14),
                                   .seed = 1};
  const FrameConverter converter(used, materials(), Season::winter, SensorParameters(), physics, lens);
  return converter.convert(slope_passes(camera.width_px, camera.height_px), used.frames[0])
      .radiance_w_m2_sr.at(x_px, y_px);
}

}  // namespace

TEST_CASE("Passes whose rays follow a lens have the radiance of the directions that the lens shows") {
  const CameraIntrinsics camera = {
      .width_px = 9, .height_px = 7, .fx_px = 8, .fy_px = 8.5, .cx_px = 4, .cy_px = 3.25};
  const LensDistortion lens = {.k1 = -0.25, .k2 = 0.03, .p1 = 0.01, .p2 = -0.02};
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      // A pinhole with one pixel, whose ray is the lens's. Its pixel is as wide as the camera's.
      const LensPoint ray = unproject(camera, lens, {x + 0.5, y + 0.5});
      const CameraIntrinsics pinhole = {.width_px = 1,
                                        .height_px = 1,
                                        .fx_px = camera.fx_px,
                                        .fy_px = camera.fy_px,
                                        .cx_px = 0.5 - camera.fx_px * ray.x,
                                        .cy_px = 0.5 - camera.fy_px * ray.y};
      CHECK_THAT(static_cast<double>(slope_radiance(camera, lens, x, y)),
                 WithinRel(static_cast<double>(slope_radiance(pinhole, {}, 0, 0)), 4 * 6e-8));
    }
  }
  CHECK(slope_radiance(camera, lens, 0, 0) != slope_radiance(camera, {}, 0, 0));
}

TEST_CASE("Passes whose rays follow a lens are cut, not distorted again") {
  const LensDistortion lens = {.k1 = -0.25};
  Manifest used = wide_manifest();
  used.lens = lens;
  const SceneFrame frame = wide_converter(used, lens).convert(wide_passes(0));
  REQUIRE(frame.radiance_w_m2_sr.width_px() == 4);
  CHECK(frame.radiance_w_m2_sr.at(0, 0) == radiance_at(300));
  CHECK(frame.radiance_w_m2_sr.at(1, 0) == radiance_at(100));
  CHECK(frame.instances.at(0).box == PixelBox{0, 0, 1, 3});
}

TEST_CASE("Passes whose rays follow a lens convert with that lens alone") {
  CHECK(message_of<ConfigError>([] {
          Manifest used = wide_manifest();
          used.lens = {.k1 = -0.25, .p2 = 0.001};
          (void)wide_converter(used);
        }) ==
        "clip night: camera.distortion = k1 0, k2 0, p1 0, p2 0, k3 0; expected k1 -0.25, k2 0, p1 0, p2 "
        "0.001, "
        "k3 0, the lens that the rays of these passes follow");
}

}  // namespace frame_converter_test
